"""How soon the console shows a plan: `python -m benchmarks.console_speed`.

Starts the service and opens its console in Debian's Chromium (`CHROMIUM` names another), which
plans the paper's hundred customers by itself; then presses Plan. Times are taken in the page, up
to the frame after the cost of a first plan is shown, with which the map is drawn.
"""

import os
import shutil
import statistics
from collections.abc import Iterator
from contextlib import contextmanager

import typer
from playwright.sync_api import Browser, Page, sync_playwright

from benchmarks.latency import service

WAIT_MS = 30_000

NEXT_COST = """(former) => new Promise((resolve) => {
  const look = () => {
    const cost = document.querySelector('#total-cost')?.textContent ?? '';
    if (cost && cost !== former) requestAnimationFrame(() => resolve(performance.now()));
    else requestAnimationFrame(look);
  };
  look();
})"""
"""Resolves in ms since the page began to load."""

PRESS = f"""async () => {{
  const former = document.querySelector('#total-cost').textContent;
  const plan = [...document.querySelectorAll('header button')].find(
    (button) => button.textContent.trim() === 'Plan');
  const pressed = performance.now();
  plan.click();
  return await ({NEXT_COST})(former) - pressed;
}}"""


@contextmanager
def browser() -> Iterator[Browser]:
    """Yield a browser.

    Raises
    ------
    RuntimeError
        If there is none.
    """
    path = os.environ.get("CHROMIUM") or shutil.which("chromium")
    if path is None:
        raise RuntimeError("there is no Chromium: apt-get install chromium")
    with sync_playwright() as playwright:
        opened = playwright.chromium.launch(executable_path=path, args=["--no-sandbox"])
        yield opened
        opened.close()


def first_plan(page: Page, address: str) -> float:
    """Open the console; return when its first plan is drawn, in ms."""
    page.goto(address, wait_until="commit")
    shown: float = page.evaluate(NEXT_COST, "")
    return shown


def plan_again(page: Page) -> float:
    """Press Plan; return after how many ms the next plan is drawn."""
    # While a plan is improved, its cost changes by itself.
    page.get_by_role("button", name="Stop").and_(page.locator(":disabled")).wait_for()
    drawn: float = page.evaluate(PRESS)
    return drawn


def main(runs: int = 10) -> None:
    """Print medians and the longest."""
    opened, pressed = [], []
    with service() as address, browser() as chromium:
        for _ in range(runs):
            page = chromium.new_page()
            page.set_default_timeout(WAIT_MS)
            opened.append(first_plan(page, address))
            pressed.append(plan_again(page))
            page.close()
    for name, times in (("from opening the page", opened), ("from pressing Plan", pressed)):
        print(f"first plan drawn {name}: median {statistics.median(times):.0f} ms, "
              f"longest {max(times):.0f} ms of {runs}")


if __name__ == "__main__":
    typer.run(main)
