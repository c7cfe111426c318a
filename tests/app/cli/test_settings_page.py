"""docs/operate/settings.md is what `tandem settings` prints."""

from pathlib import Path

from typer.testing import CliRunner

from app.cli.commands import cli
from app.serving.settings import Settings

PAGE = Path(__file__).parents[3] / "docs" / "operate" / "settings.md"


def test_the_page_in_docs_is_up_to_date() -> None:
    printed = CliRunner().invoke(cli, ["settings"])
    assert printed.exit_code == 0
    assert PAGE.read_text("utf-8") == printed.stdout, (
        "run: tandem settings > docs/operate/settings.md")


def test_every_setting_is_explained() -> None:
    for name, field in Settings.model_fields.items():
        assert field.description, name
        assert f"`TANDEM_{name.upper()}`" in PAGE.read_text("utf-8")


def test_no_default_names_this_machine() -> None:
    assert str(PAGE.parents[1]) not in PAGE.read_text("utf-8")
