"""Makes the pictures of the console in `docs/screenshots`.

Run as `python -m tests.console.screenshots`, with names of pictures behind it for these alone.
"""

import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from playwright.sync_api import Browser, Page, expect

from examples.deliveries import FLEET, NUM_CUSTOMERS, sheet
from tests.console.serving import ROOT, WAIT_MS, chromium, new_context, serving
from tests.console.steps import idle, open_example, open_tab, place_of, planned

FOLDER = ROOT / "docs" / "screenshots"
DESK = {"width": 1440, "height": 900}
PHONE = {"width": 390, "height": 844}


def overview(page: Page) -> None:
    """Forty places in Berlin, as one sees them first, and what the drones do."""
    planned(page, "40 of 40 served")
    expect(page.locator(".drones-line")).to_contain_text("save")


def city(page: Page) -> None:
    """A city with a no-fly area, one stop selected."""
    open_example(page, "city_day")
    open_tab(page, "routes")
    page.mouse.click(*place_of(page, "c:restaurant-03"))


def what_if(page: Page) -> None:
    """Two plans of a city side by side."""
    open_example(page, "city_day")
    open_tab(page, "changes")
    page.get_by_role("button", name="One drone-truck fewer").click()
    idle(page)
    page.get_by_role("button", name="Former plan beside").click()


def sweep(page: Page) -> None:
    """Cost by hours and capacity."""
    open_example(page, "hetero_day")
    open_tab(page, "scenarios")
    page.get_by_label("Values of axis 1").fill("5:00, 6:00, 7:00, 8:00, 10:00")
    page.get_by_label("Values of axis 2").fill("100, 110, 150, 200")
    page.get_by_role("button", name="Sweep 20 scenarios").click()
    expect(page.locator("#scenario-state")).to_contain_text("done")
    page.locator("#heat-map").evaluate("each => each.scrollIntoView({ block: 'end' })")


def playing(page: Page) -> None:
    """The day at ten past ten."""
    open_example(page, "city_day")
    page.get_by_label("Time of day").fill("36660")
    open_tab(page, "costs")


def replanning(page: Page) -> None:
    """At ten past ten a truck has broken down, and an order is new."""
    open_example(page, "city_day")
    page.get_by_label("Time of day").fill("36600")
    page.get_by_role("button", name="Replan from here").click()
    page.get_by_label("drone-truck-1 is broken").check()
    page.get_by_role("button", name="Add orders on the map").click()
    page.mouse.click(760, 480)
    page.keyboard.press("Escape")
    page.locator(".panel").get_by_role("button", name="Plan on").focus()


def importing(page: Page) -> None:
    """A spreadsheet of sixty deliveries as it was read, depot and fleet stated."""
    page.locator("#file-input").set_input_files(
        {"name": "touren.csv", "mimeType": "text/csv", "buffer": sheet()})
    for name, text in FLEET.items():
        page.locator(f"#import-{name}").fill(text)
        page.keyboard.press("Tab")
    expect(page.locator(".import")).to_have_attribute("aria-busy", "false")
    expect(page.locator("#use-import")).to_be_enabled()
    page.evaluate("document.activeElement.blur()")


def first_planned(page: Page) -> None:
    """The plan of the spreadsheet."""
    importing(page)
    page.locator("#use-import").click()
    planned(page, f"of {NUM_CUSTOMERS} served")


def first_sheet(page: Page) -> None:
    """The sheet of its first driver."""
    first_planned(page)
    page.evaluate("window.print = () => {}")  # nobody is there to answer a dialog
    page.locator("#room-export").click()
    page.get_by_role("button", name="Print all driver sheets").click()
    expect(page.locator(".sheet-page").first).to_be_attached()
    page.emulate_media(media="print")
    page.add_style_tag(content="body { padding: 24px }")  # as paper has


def phone(page: Page) -> None:
    """As on a phone."""
    overview(page)


VIEWS: dict[str, tuple[Callable[[Page], None], dict[str, int], str]] = {
    "overview": (overview, DESK, "light"),
    "city": (city, DESK, "dark"),
    "what-if": (what_if, DESK, "light"),
    "replanning": (replanning, DESK, "light"),
    "sweep": (sweep, DESK, "light"),
    "playing": (playing, DESK, "light"),
    "import": (importing, DESK, "light"),
    "first-planned": (first_planned, DESK, "light"),
    "first-sheet": (first_sheet, DESK, "light"),
    "phone": (phone, PHONE, "light"),
}


def take(browser: Browser, address: str, name: str) -> None:
    """Write the picture of one view."""
    prepare, size, scheme = VIEWS[name]
    # Irish English, for sums in euros.
    context = new_context(browser, viewport=size, color_scheme=scheme, locale="en-IE")
    page = context.new_page()
    page.goto(address)
    expect(page.locator("#total-cost")).to_be_visible()
    idle(page)
    prepare(page)
    page.mouse.move(size["width"] / 2, 3)
    page.screenshot(path=FOLDER / f"{name}.png", full_page=size is PHONE, animations="disabled")
    context.close()


def main(names: Sequence[str]) -> None:
    """Write pictures."""
    expect.set_options(timeout=WAIT_MS)
    FOLDER.mkdir(parents=True, exist_ok=True)
    with TemporaryDirectory() as folder, serving(Path(folder)) as address, chromium() as browser:
        for name in names:
            take(browser, address, name)


if __name__ == "__main__":
    main(sys.argv[1:] or list(VIEWS))
