"""The image states settings that exist and takes in what the service needs."""

import re
from pathlib import Path

import pytest

from app.serving.settings import Settings

ROOT = Path(__file__).parents[2]
DOCKERFILE = (ROOT / "Dockerfile").read_text("utf-8")
INSTRUCTIONS = [line.strip() for line in DOCKERFILE.replace("\\\n", " ").splitlines()
                if line.strip() and not line.startswith("#")]


def arguments(instruction: str) -> list[str]:
    """Return the arguments of each use of an instruction."""
    return [line.removeprefix(instruction).strip() for line in INSTRUCTIONS
            if line.startswith(f"{instruction} ")]


def test_settings_exist_and_are_valid(monkeypatch: pytest.MonkeyPatch) -> None:
    stated = dict(re.findall(r"(TANDEM_\w+)=(\S+)", " ".join(arguments("ENV"))))
    assert {name.removeprefix("TANDEM_").lower() for name in stated} <= set(Settings.model_fields)
    for name, value in stated.items():
        monkeypatch.setenv(name, value)
    settings = Settings()
    # Whoever runs the image without a word about access gets a service that wants keys.
    assert settings.access == "keys"
    assert str(settings.data_dir) in arguments("VOLUME")[0].split()


def test_nobody_is_root() -> None:
    assert arguments("USER") == ["tandem"]


def test_all_that_is_copied_exists_and_is_let_in() -> None:
    ignored = (ROOT / ".dockerignore").read_text("utf-8").splitlines()
    for copied in arguments("COPY"):
        if not copied.startswith("--from"):
            for name in copied.split()[:-1]:
                assert (ROOT / name).exists()
                assert f"!{name.removeprefix('./')}" in ignored
