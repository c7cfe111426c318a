"""`tandem database`."""

from pathlib import Path

import pytest
from typer.testing import CliRunner

from app.cli.commands import cli
from app.database.migrations.running import newest


@pytest.fixture(autouse=True)
def own_database(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Give each test an empty database."""
    monkeypatch.setenv("TANDEM_DATA_DIR", str(tmp_path))


def run(*arguments: str, status: int = 0) -> str:
    """Run the command; return what it printed."""
    done = CliRunner().invoke(cli, ["database", *arguments])
    assert done.exit_code == status, done.output
    return done.output.strip()


def test_tables_are_made_led_back_and_up_again() -> None:
    assert "lacks the table" in run("show", status=1)
    assert run("upgrade") == newest()
    assert run("show") == newest()
    assert run("downgrade", "0001") == "0001"
    assert run("upgrade") == newest()


def test_what_can_not_be_done_is_said_in_words(monkeypatch: pytest.MonkeyPatch) -> None:
    assert "leads back" in run("downgrade", "0001", status=1)
    monkeypatch.setenv("TANDEM_DATABASE_URL", "postgresql://ann:secret@127.0.0.1:1/none")
    said = run("upgrade", status=1)
    assert "TANDEM_DATABASE_URL" in said
    assert "secret" not in said
