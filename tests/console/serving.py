"""A service of its own for the console's tests, and the browser that looks at it."""

import json
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from fcntl import LOCK_EX, LOCK_NB, LOCK_SH, flock
from pathlib import Path
from signal import SIGTERM
from typing import Any

import httpx
from filelock import FileLock
from playwright.sync_api import (
    Browser, BrowserContext, BrowserType, Error, ViewportSize, sync_playwright,
)

from tests.conftest import PATIENCE, free_port

ROOT = Path(__file__).resolve().parents[2]
ARGUMENTS = ("--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
             "--disable-background-networking", "--disable-component-update", "--disable-sync")
TOGETHER = ("--renderer-process-limit=1", "--disable-site-isolation-trials", "--in-process-gpu",
            "--num-raster-threads=1", "--js-flags=--no-opt")
"""All pages are shown by one process, in which scripts are compiled but once: few are looked at for
long enough to pay for more, though axe and large plans are for the second of three compilers."""

OPENING_MS = 180_000
"""For opening a browser or a page while other tests have all cores."""

WAIT_MS = 180_000
"""For what a page does, at most."""

VIEWPORT: ViewportSize = {"width": 1440, "height": 900}

MODULES = """window.loaded = async (path) => {
  const { module } = await import(document.querySelector('script[type=module]').src);
  return await module(new URL(path, 'file:///js/').pathname.slice(1));
};"""
"""Gives scripts of tests the modules that the console itself has loaded."""


@contextmanager
def serving(folder: Path, module: str = "app.cli", **settings: str) -> Iterator[str]:
    """Serve with the real planner and yield the address.

    Parameters
    ----------
    folder
        For the service's data and its log.
    module
        What serves.
    settings
        Variables of the environment besides.
    """
    log = folder / "service.log"
    address, command, environment = _stated(folder, module, settings)
    with log.open("wb") as output:
        process = subprocess.Popen(command, env=environment, stdout=output,
                                   stderr=subprocess.STDOUT)
    try:
        _wait_until_ready(lambda: process.poll() is None, address, log)
        yield address
    finally:
        process.terminate()
        process.wait(PATIENCE)


def _stated(folder: Path, module: str, settings: dict[str, str],
            ) -> tuple[str, list[str], dict[str, str]]:
    """Return where a service is to answer, what starts it, and its environment."""
    port = free_port()
    environment = {name: value for name, value in os.environ.items()
                   if not name.startswith("TANDEM_")}
    environment |= {"PYTHONPATH": str(ROOT), "TANDEM_DATA_DIR": str(folder),
                    "TANDEM_MAX_CUSTOMERS": "3000"} | settings
    command = [sys.executable, "-m", module, "serve", "--port", str(port)]
    return f"http://127.0.0.1:{port}", command, environment


@contextmanager
def shared(folder: Path, module: str = "app.cli", **settings: str) -> Iterator[str]:
    """Serve to all processes that run tests, like `serving`: the last one ends the service.

    To start one and to keep it idle would take a quarter of a minute's work for each of them.
    """
    folder.mkdir(exist_ok=True)
    told, log = folder / "service.json", folder / "service.log"
    lock = FileLock(folder / "lock")
    with (folder / "users").open("a") as users:
        with lock:
            flock(users, LOCK_SH)
            if not told.exists():
                address, command, environment = _stated(folder, module, settings)
                # It is no child of whoever starts it, who may end before others.
                shell = ["sh", "-c", '"$@" > "$0" 2>&1 & echo $!', str(log), *command]
                pid = int(subprocess.check_output(shell, env=environment))
                _wait_until_ready(lambda: _is_there(pid), address, log)
                told.write_text(json.dumps([pid, address]))
            pid, address = json.loads(told.read_text())
        yield address
        with lock, suppress(BlockingIOError):
            flock(users, LOCK_EX | LOCK_NB)  # who was killed holds it no longer
            told.unlink()
            os.kill(pid, SIGTERM)


def _is_there(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def _wait_until_ready(is_there: Callable[[], bool], address: str, log: Path) -> None:
    give_up = time.monotonic() + PATIENCE
    while time.monotonic() < give_up and is_there():
        try:
            if httpx.get(f"{address}/health/ready", trust_env=False).status_code == 200:
                return
        except httpx.TransportError:
            pass
        time.sleep(0.2)
    raise RuntimeError(f"the service did not start: {log.read_text()[-3000:]}")


@contextmanager
def chromium() -> Iterator[Browser]:
    """Yield Debian's Chromium, or the one that the variable CHROMIUM names."""
    with sync_playwright() as playwright, launched(playwright.chromium, TOGETHER) as browser:
        yield browser


@contextmanager
def launched(kind: BrowserType, more: Sequence[str] = ()) -> Iterator[Browser]:
    """Yield a browser with more arguments, by default with a process for each page.

    Where there is one without windows, that is taken: it opens a page in half of the time.
    """
    path = (os.environ.get("CHROMIUM") or shutil.which("chromium-headless-shell")
            or shutil.which("chromium"))
    if path is None:
        raise RuntimeError("the console is tested with Chromium: .ci/prepare says how to get it")
    browser = _launch(kind, path, [*ARGUMENTS, *more])
    yield browser
    browser.close()


def _launch(kind: BrowserType, path: str, arguments: Sequence[str]) -> Browser:
    for _ in range(2):
        # Chromium itself was seen to crash before its first page, once in some thousand launches.
        with suppress(Error):
            return kind.launch(executable_path=path, args=arguments, timeout=OPENING_MS)
    return kind.launch(executable_path=path, args=arguments, timeout=OPENING_MS)


def new_context(browser: Browser, **options: Any) -> BrowserContext:
    """Return what stands for a visitor's own browser, who likes nothing to move.

    What moves is drawn in each frame, which takes an eighth of all that the browser does.
    """
    context = browser.new_context(
        **{"viewport": VIEWPORT, "reduced_motion": "reduce"} | options)
    context.set_default_timeout(WAIT_MS)
    context.set_default_navigation_timeout(OPENING_MS)
    context.add_init_script(MODULES)
    return context
