"""Packages are installed by uv as pip is configured, and by pip where uv fails."""

import importlib.util
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).parents[2]

PIP = """#!/bin/sh
[ "$1" = config ] && cat <<'END' && exit
global.constraint='global.txt'
:env:.constraint='of-environment.txt'
global.extra-index-url='file:///one\\nfile:///other'
install.find-links='/here /there'
wheel.no-index='1'
END
echo "pip $@" >> "$TOLD"
"""

UV = """#!/bin/sh
echo "uv $@" >> "$TOLD"
echo "$UV_CONSTRAINT; $UV_INDEX; $UV_FIND_LINKS; $UV_DEFAULT_INDEX; $UV_NO_INDEX" >> "$TOLD"
exit $FAILS
"""


@pytest.fixture
def install(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> ModuleType:
    """Return the script, with a pip and a uv that note what they are asked for in `told`."""
    spec = importlib.util.spec_from_file_location("install", ROOT / ".ci/install.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    for name, does in (("pip", PIP), ("uv", UV)):
        (tmp_path / name).write_text(does)
        (tmp_path / name).chmod(0o755)
    monkeypatch.setattr(module, "PIP", [tmp_path / "pip"])
    monkeypatch.setattr(module.sys, "executable", str(tmp_path / "python"))
    monkeypatch.setenv("TOLD", str(tmp_path / "told"))
    monkeypatch.setenv("FAILS", "0")
    for name in module.SETTINGS.values():
        if name.startswith("UV_"):
            monkeypatch.delenv(name, raising=False)
    return module


def test_uv_installs_from_where_pip_would(install: ModuleType, tmp_path: Path) -> None:
    assert install.main(["--editable", "."]) == 0
    asked, settings = (tmp_path / "told").read_text().splitlines()
    assert asked.startswith("uv pip install")
    assert asked.endswith("--editable .")
    assert settings == "of-environment.txt; file:///one file:///other; /here,/there; ; "


def test_what_is_stated_to_uv_holds(install: ModuleType, monkeypatch: pytest.MonkeyPatch,
                                    tmp_path: Path) -> None:
    monkeypatch.setenv("UV_CONSTRAINT", "own.txt")
    assert install.main(["."]) == 0
    assert (tmp_path / "told").read_text().splitlines()[1].startswith("own.txt; ")


def test_pip_installs_where_uv_cannot(install: ModuleType, monkeypatch: pytest.MonkeyPatch,
                                      tmp_path: Path) -> None:
    monkeypatch.setenv("FAILS", "2")
    assert install.main(["."]) == 0
    assert (tmp_path / "told").read_text().endswith("pip install --quiet --no-compile .\n")


def test_pip_installs_where_there_is_no_uv(install: ModuleType, tmp_path: Path) -> None:
    (tmp_path / "uv").unlink()
    assert install.main(["."]) == 0
    assert (tmp_path / "told").read_text() == ("pip install --quiet --no-compile uv\n"
                                               "pip install --quiet --no-compile .\n")
