"""A bare machine: what is missing is installed or told at once, and which Python is taken."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

CI = Path(__file__).parents[2] / ".ci"
BROWSER = "chromium-headless-shell"
PROGRAMS = {"make": "make", BROWSER: BROWSER, "node": "nodejs", "curl": "curl",
            "c++": "g++"}
PYTHON = ("python3", "python3-venv")
PACKAGES = ("make", *PYTHON, BROWSER, "nodejs", "curl", "postgresql",
            "g++", "doctest-dev")
RUNS, FAILS = "exit 0", "exit 1"


class Machine:
    """A copy of the scripts and a folder of programs, the only ones that they see."""

    def __init__(self, folder: Path) -> None:
        self.scripts = shutil.copytree(CI, folder / "project" / ".ci")
        self.programs = folder / "bin"
        self.programs.mkdir()
        for name in ("bash", "dirname", "cat"):
            (self.programs / name).symlink_to(str(shutil.which(name)))
        self.installed = folder / "installed"
        self.postgresql = folder / "postgresql"
        self.doctest = folder / "doctest.h"
        self.add("id", "echo 1000")

    def add(self, name: str, does: str = RUNS) -> None:
        """Install a program. In place."""
        path = self.programs / name
        path.write_text(f"#!/bin/sh\n{does}\n")
        path.chmod(0o755)

    def add_all(self) -> None:
        """Install all that is needed. In place."""
        for name in (*PROGRAMS, "python3"):
            self.add(name)
        self.postgresql.mkdir()
        (self.postgresql / "initdb").touch()
        self.doctest.touch()

    def become_root(self) -> None:
        """Have the right to install. In place."""
        self.add("id", "echo 0")
        self.add("apt-get", f'echo "$@" >> {self.installed}')

    def run(self, script: str, **environment: str) -> subprocess.CompletedProcess[str]:
        """Run a script and return what came of it."""
        return subprocess.run([self.scripts / script], text=True, capture_output=True, check=False,
                              env={"PATH": str(self.programs), "POSTGRESQL": str(self.postgresql),
                                   "LDCONFIG": str(self.programs / "ldconfig"),
                                   "DOCTEST": str(self.doctest), **environment})


@pytest.fixture
def machine(tmp_path: Path) -> Machine:
    """A machine without anything."""
    return Machine(tmp_path)


def test_where_nothing_is_missing_nothing_is_said(machine: Machine) -> None:
    machine.add_all()
    done = machine.run("prepare")
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def test_all_that_is_missing_is_told_in_one_message_with_the_command(machine: Machine) -> None:
    done = machine.run("prepare")
    assert done.returncode == 1
    assert f"missing here: {' '.join(PACKAGES)}.\n" in done.stderr
    assert (f"sudo apt-get install --yes --no-install-recommends {' '.join(PACKAGES)}\n"
            in done.stderr)


@pytest.mark.parametrize("name", [*PROGRAMS, "python3"])
def test_only_what_is_missing_is_named(machine: Machine, name: str) -> None:
    machine.add_all()
    (machine.programs / name).unlink()
    missing = PROGRAMS.get(name, " ".join(PYTHON))
    assert f"missing here: {missing}.\n" in machine.run("prepare").stderr


def test_database_is_missed_where_no_folder_has_its_programs(machine: Machine) -> None:
    machine.add_all()
    (machine.postgresql / "initdb").unlink()
    assert "missing here: postgresql.\n" in machine.run("prepare").stderr


def test_header_of_the_engines_tests_is_missed_where_it_is_not(machine: Machine) -> None:
    machine.add_all()
    machine.doctest.unlink()
    assert "missing here: doctest-dev.\n" in machine.run("prepare").stderr


@pytest.mark.parametrize(("listed", "message"), [
    ("libatomic.so.1 (libc6,x86-64) => /lib/libatomic.so.1", ""),
    ("libc.so.6 (libc6,x86-64) => /lib/libc.so.6", "missing here: libatomic1.\n")])
def test_library_of_the_browsers_driver_is_missed_where_it_is_not_listed(
        machine: Machine, listed: str, message: str) -> None:
    machine.add_all()
    machine.add("ldconfig", f'echo "{listed}"')
    done = machine.run("prepare")
    assert (done.returncode == 0) == (not message)
    assert message in done.stderr


def test_browser_may_be_chosen(machine: Machine) -> None:
    machine.add_all()
    (machine.programs / BROWSER).rename(machine.programs / "chrome")
    assert machine.run("prepare", CHROMIUM="chrome").returncode == 0
    assert f"missing here: {BROWSER}.\n" in machine.run("prepare", CHROMIUM="other").stderr


def test_browser_with_windows_will_do(machine: Machine) -> None:
    machine.add_all()
    (machine.programs / BROWSER).rename(machine.programs / "chromium")
    assert machine.run("prepare").returncode == 0


def test_python_is_not_missed_once_its_environment_is_made(machine: Machine) -> None:
    machine.add_all()
    (machine.programs / "python3").unlink()
    made = machine.scripts.parent / ".venv" / "created"
    made.parent.mkdir()
    made.touch()
    assert machine.run("prepare").returncode == 0


def test_root_gets_what_is_missing_installed(machine: Machine) -> None:
    machine.become_root()
    done = machine.run("prepare")
    assert done.returncode == 0, done.stderr
    updated, installed = machine.installed.read_text().splitlines()
    assert updated == "update -qq"
    assert installed == f"install --yes --no-install-recommends {' '.join(PACKAGES)} -qq"


def test_failed_installation_fails(machine: Machine) -> None:
    machine.become_root()
    machine.add("apt-get", FAILS)
    assert machine.run("prepare").returncode == 1


def test_root_without_debians_packages_is_told(machine: Machine) -> None:
    machine.add("id", "echo 0")
    assert "missing here" in machine.run("prepare").stderr


@pytest.mark.parametrize(("there", "chosen"), [
    ({"python3.11": RUNS, "python3.12": RUNS, "python3": RUNS}, "python3.11"),
    ({"python3.11": FAILS, "python3.13": RUNS, "python3": RUNS}, "python3.13"),
    ({"python3.14": RUNS}, "python3.14"),
    ({"python3": RUNS}, "python3")])
def test_first_python_that_runs_is_taken(machine: Machine, there: dict[str, str],
                                         chosen: str) -> None:
    for name, does in there.items():
        machine.add(name, does)
    assert machine.run("find-python").stdout == f"{machine.programs / chosen}\n"


def test_python_may_be_chosen(machine: Machine) -> None:
    for name in ("python3.11", "python3.12"):
        machine.add(name)
    told = machine.run("find-python", PYTHON="python3.12").stdout
    assert told == f"{machine.programs / 'python3.12'}\n"


@pytest.mark.parametrize("choice", [{}, {"PYTHON": "python3.9"}])
def test_python_that_will_not_do_is_told_with_what_would(machine: Machine,
                                                         choice: dict[str, str]) -> None:
    machine.add("python3.9", FAILS)
    done = machine.run("find-python", **choice)
    assert (done.returncode, done.stdout) == (1, "")
    assert "Python 3.11 to 3.14" in done.stderr
    assert "apt-get install python3 python3-venv" in done.stderr
    assert ("which python3.9 isn't" in done.stderr) == bool(choice)


@pytest.mark.parametrize(("version", "sqlite", "will_do"), [
    ((3, 10, 9), (3, 50), False), ((3, 11, 0), (3, 40), True), ((3, 12, 0), (3, 40), False),
    ((3, 14, 9), (3, 42), True), ((3, 15, 0), (3, 50), False)])
def test_python_of_other_versions_will_not_do(
        machine: Machine, version: tuple[int, ...], sqlite: tuple[int, ...], will_do: bool) -> None:
    told = (f"import sqlite3, sys; sys.version_info, sqlite3.sqlite_version_info = {version}, "
            f"{sqlite}; exec(sys.argv[1])")
    machine.add("python3", f'exec {sys.executable} -c "{told}" "$2"')
    assert (machine.run("find-python").returncode == 0) == will_do


def test_a_compiler_that_is_there_is_enough(machine: Machine) -> None:
    machine.become_root()
    machine.add("clang++")
    assert machine.run("compiler").returncode == 0
    assert not machine.installed.exists()


def test_root_gets_a_compiler_installed(machine: Machine) -> None:
    machine.become_root()
    assert machine.run("compiler").returncode == 0
    assert machine.installed.read_text().splitlines()[-1].split()[-1] == "g++"


def test_who_may_install_nothing_goes_on_without_a_compiler(machine: Machine) -> None:
    assert machine.run("compiler").returncode == 0
    assert machine.run("compiler", CXX="c++-17").returncode == 0
    assert "g++" in machine.run("prepare").stderr
