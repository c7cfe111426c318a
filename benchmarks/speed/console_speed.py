"""How soon the console shows a plan: `python -m benchmarks.speed.console_speed`.

Starts the service and opens its console in Debian's Chromium (`CHROMIUM` names another), which
plans the paper's hundred customers by itself; then presses Plan. Times are taken in the page, up
to the frame after the cost of a first plan is shown, with which the map is drawn. Before that, the
console is opened over a slow line by who has never been there, and by who comes again.
"""

import json
import os
import shutil
import statistics
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import pairwise

import typer
from playwright.sync_api import Browser, Page, sync_playwright

from examples.many import many_customers, swept_reply
from benchmarks.speed.latency import service

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
  const pressed = performance.now();
  document.getElementById('plan-button').click();
  return await ({NEXT_COST})(former) - pressed;
}}"""

OPEN = """async (text) => {
  const began = performance.now();
  const { request, plan } = JSON.parse(text);
  const { module } = await import(document.querySelector('script[type=module]').src);
  const { openRequest } = await module('js/actions.js');
  const plans = [{ number: 1, name: 'Plan', request, plan, numbers: null }];
  openRequest(request, { name: 'many', plans, shown: 1 });
  for (let frame = 0; frame < 2; frame += 1)
    await new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve, 0)));
  return performance.now() - began;
}"""
"""Opens a plan; resolves in the ms until it is drawn."""

COUNT = """() => {
  window.frames = [];
  const note = (now) => {
    window.frames.push(now);
    window.frameRequest = requestAnimationFrame(note);
  };
  requestAnimationFrame(note);
}"""
COUNTED = "() => (cancelAnimationFrame(window.frameRequest), window.frames)"


LINE = {"offline": False, "latency": 80, "downloadThroughput": 9e6 / 8, "uploadThroughput": 9e6 / 8}
"""What a first open is measured over: 9 Mbit/s and 80 ms."""

PAINT = """() => performance.getEntriesByName('first-contentful-paint')[0]?.startTime ?? NaN"""


@contextmanager
def browser() -> Iterator[Browser]:
    """Yield a browser.

    Raises
    ------
    RuntimeError
        If there is none.
    """
    path = (os.environ.get("CHROMIUM") or shutil.which("chromium")
            or shutil.which("chromium-headless-shell"))
    if path is None:
        raise RuntimeError("there is no Chromium: apt-get install chromium")
    with sync_playwright() as playwright:
        opened = playwright.chromium.launch(executable_path=path, args=["--no-sandbox"])
        yield opened
        opened.close()


def first_plan(page: Page, address: str) -> float:
    """Open the console with `table1`; return when its first plan is drawn, in ms."""
    page.goto(f"{address}/#example=table1", wait_until="commit")
    shown: float = page.evaluate(NEXT_COST, "")
    return shown


def plan_again(page: Page) -> float:
    """Press Plan; return after how many ms the next plan is drawn."""
    # While a plan is improved, its cost changes by itself.
    page.locator("#plan-button").wait_for()
    drawn: float = page.evaluate(PRESS)
    return drawn


def frame_times(page: Page, is_pressed: bool) -> list[float]:
    """Return the ms from frame to frame while the pointer moves over the map, or moves it."""
    box = page.locator(".map").bounding_box()
    if box is None:
        raise RuntimeError("there is no map")
    x, y = box["x"] + 8, box["y"] + box["height"] / 2  # where nobody is who could be dragged
    page.mouse.move(x, y)
    if is_pressed:
        page.mouse.down()
    page.evaluate(COUNT)
    for step in range(100):
        page.mouse.move(x + 4 * step, y + step % 40)
    times = page.evaluate(COUNTED)
    page.mouse.up()
    return [float(after - before) for before, after in pairwise(times)]


def show_many(page: Page, number: int) -> None:
    """Print how soon a plan of so many customers is drawn, and how smoothly it is moved."""
    request = many_customers(number)
    text = json.dumps({"request": request, "plan": swept_reply(request)})
    print(f"{number:,} customers drawn after {page.evaluate(OPEN, text):.0f} ms")
    for name, is_pressed in (("pointer", False), ("map", True)):
        frames = frame_times(page, is_pressed)
        p95 = statistics.quantiles(frames, n=20)[-1]
        print(f"frames while the {name} moves: median {statistics.median(frames):.0f} ms, "
              f"95 % within {p95:.0f} ms")


def open_over_line(chromium: Browser, address: str) -> Iterator[tuple[float, float, float]]:
    """Yield ms to the first paint, to the plan, and kB, of a first visit and of another."""
    context = chromium.new_context()
    for _ in ("first", "again"):
        page = context.new_page()
        page.set_default_timeout(WAIT_MS)
        session = context.new_cdp_session(page)
        sizes: list[float] = []
        session.on("Network.loadingFinished", lambda told, to=sizes: to.append(
            told["encodedDataLength"]))
        session.send("Network.enable")
        session.send("Network.emulateNetworkConditions", LINE)
        planned = first_plan(page, address)
        yield page.evaluate(PAINT), planned, sum(sizes) / 1000
        page.close()
    context.close()


def print_visits(chromium: Browser, address: str, runs: int) -> None:
    """Print medians of first visits over a slow line, and of those again."""
    visits = [[*open_over_line(chromium, address)] for _ in range(runs)]
    for name, those in zip(("first visit", "again"), zip(*visits, strict=True), strict=True):
        paint, planned, size = map(statistics.median, zip(*those, strict=True))
        print(f"{name} over 9 Mbit/s and 80 ms: painted after {paint:.0f} ms, plan after "
              f"{planned:.0f} ms, {size:.0f} kB")


def main(runs: int = 10, many: str = "1000,10000") -> None:
    """Print medians and the longest, and what many customers take, for each of these numbers."""
    opened, pressed = [], []
    with service() as address, browser() as chromium:
        print_visits(chromium, address, runs)
        for _ in range(runs):
            page = chromium.new_page()
            page.set_default_timeout(WAIT_MS)
            opened.append(first_plan(page, address))
            pressed.append(plan_again(page))
            page.close()
        for number in map(int, many.split(",")):
            page = chromium.new_page()
            first_plan(page, address)
            show_many(page, number)
            page.close()
    for name, times in (("from opening the page", opened), ("from pressing Plan", pressed)):
        print(f"first plan drawn {name}: median {statistics.median(times):.0f} ms, "
              f"longest {max(times):.0f} ms of {runs}")


if __name__ == "__main__":
    typer.run(main)
