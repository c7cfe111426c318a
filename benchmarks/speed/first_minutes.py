"""From a fresh page to printed driver sheets: `python -m benchmarks.speed.first_minutes`.

Starts the service, opens its console in Debian's Chromium (`CHROMIUM` names another) and does what
a dispatcher does with a spreadsheet of sixty deliveries in Munich: opens it, looks over how it was
read, states depot and fleet, plans, looks at the plan, and prints a sheet for each driver. Hands
and eyes take the time that `PAUSES` and `SECONDS_PER_KEY` state, beside what the page takes.
"""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import typer
from playwright.sync_api import Page, ViewportSize, expect

from benchmarks.speed.console_speed import browser
from benchmarks.speed.latency import service
from examples.deliveries import FLEET, NUM_CUSTOMERS, sheet

WAIT_MS = 120_000
SIZE: ViewportSize = {"width": 1440, "height": 900}

SECONDS_PER_KEY = 0.2
PAUSES = {"find the file": 5.0, "read how columns were taken": 15.0, "go to a field": 1.5,
          "look at the plan": 15.0, "find a button": 2.0}
"""Seconds that a person takes for what no computer speeds up."""


class Stopwatch:
    """Seconds of each step, of hands and eyes among them."""

    def __init__(self, page: Page) -> None:
        self.page = page
        self.seconds: dict[str, tuple[float, float]] = {}
        self._paused = 0.0

    @contextmanager
    def step(self, name: str) -> Iterator[None]:
        """Measure a step."""
        began, paused = time.monotonic(), self._paused
        yield
        self.seconds[name] = time.monotonic() - began, self._paused - paused

    def pause(self, what: str) -> None:
        """Wait as a person does."""
        self._wait(PAUSES[what])

    def write(self, field: str, text: str) -> None:
        """Go to a field and write into it, key by key."""
        self.pause("go to a field")
        self.page.locator(field).click()
        self.page.locator(field).press_sequentially(text, delay=SECONDS_PER_KEY * 1000)
        self._paused += SECONDS_PER_KEY * len(text)
        self.page.keyboard.press("Tab")

    def _wait(self, seconds: float) -> None:
        time.sleep(seconds)
        self._paused += seconds


def look_over(watch: Stopwatch, page: Page) -> None:
    """Read how the sheet was taken, and state depot and fleet."""
    watch.pause("read how columns were taken")
    for name, text in FLEET.items():
        watch.write(f"#import-{name}", text)
    expect(page.locator(".import")).to_have_attribute("aria-busy", "false")
    expect(page.locator("#use-import")).to_be_enabled()


def plan(watch: Stopwatch, page: Page) -> None:
    """Plan what was imported, and look at it."""
    watch.pause("find a button")
    page.locator("#use-import").click()
    expect(page.locator(".result-line")).to_contain_text(f"of {NUM_CUSTOMERS} served")
    expect(page.locator("header.head button.stop")).to_have_count(0)
    watch.pause("look at the plan")


def print_sheets(watch: Stopwatch, page: Page, folder: Path) -> None:
    """Print the sheets of all drivers, to a PDF."""
    watch.pause("find a button")
    page.locator("#room-export").click()
    # A print dialog would wait for a person.
    page.evaluate("window.print = () => {}")
    watch.pause("find a button")
    page.get_by_role("button", name="Print all driver sheets").click()
    expect(page.locator(".sheet-page").first).to_be_attached()
    page.pdf(path=folder / "driver-sheets.pdf")


def run(page: Page, address: str, folder: Path) -> Stopwatch:
    """Do it all once."""
    watch = Stopwatch(page)
    with watch.step("open the page"):
        page.goto(address)
        expect(page.locator("#total-cost")).to_be_visible()
    with watch.step("open the spreadsheet"):
        watch.pause("find the file")
        page.locator("#file-input").set_input_files(
            {"name": "touren.csv", "mimeType": "text/csv", "buffer": sheet()})
        expect(page.locator("#use-import")).to_be_visible()
    with watch.step("look it over, state depot and fleet"):
        look_over(watch, page)
    with watch.step("plan and look at the plan"):
        plan(watch, page)
    with watch.step("print the drivers' sheets"):
        print_sheets(watch, page, folder)
    return watch


def main(folder: Path = Path(".")) -> None:
    """Print the seconds of each step, the page's own and a person's.

    Parameters
    ----------
    folder
        Where `driver-sheets.pdf` is written.
    """
    expect.set_options(timeout=WAIT_MS)
    with service() as address, browser() as chromium:
        page = chromium.new_page(viewport=SIZE)
        page.set_default_timeout(WAIT_MS)
        watch = run(page, address, folder)
        served = page.locator(".result-line").inner_text()
    for name, (seconds, person) in watch.seconds.items():
        print(f"{name}: {seconds:.1f} s, of which {person:.1f} s a person's")
    total = sum(seconds for seconds, _ in watch.seconds.values())
    print(f"in all {total:.0f} s: {' '.join(served.split())}")


if __name__ == "__main__":
    typer.run(main)
