"""What people do in the console, again and again."""

from contextlib import suppress
from pathlib import Path
from typing import Any

from playwright.sync_api import Locator, Page, TimeoutError, expect

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "app" / "schemas" / "examples"
STATIC = ROOT / "app" / "console" / "static"


def beginning(address: str, example: str) -> str:
    """Return the address that has a console begin with an example."""
    return address if "#" in address else f"{address}/#example={example}"


ROOMS = {"customers": "orders", "unassigned": "orders", "fleet": "fleet", "routes": "routes",
         "costs": "routes", "solve": "routes", "replan": "day", "changes": "compare",
         "scenarios": "compare", "drivers": "drivers", "export": "export"}
"""Rooms of the desk by the tabs that are in them."""


def stop_button(page: Page) -> Locator:
    """Return the button that stops planning, which is there while something is planned."""
    return page.locator("header.head button.stop")


SETTLED = """async (text) => {
  for (let frames = 2; frames; frames -= 1) await new Promise(requestAnimationFrame);
  const told = document.querySelector('.result-line')?.textContent.replaceAll(/\\s+/g, ' ');
  return document.getElementById('total-cost')?.checkVisibility() && told.includes(text)
    && !document.querySelector('header.head button.stop');
}"""
"""Tells whether a plan is shown, the header tells a text of it, and nothing is being planned."""


def idle(page: Page) -> None:
    """Wait until there is a plan and nothing is being planned."""
    planned(page, "")


def planned(page: Page, text: str) -> None:
    """Wait until the header tells `text` of a plan and nothing is being planned.

    The page is looked at in each frame: what is expected is looked at ever more seldom.
    """
    with suppress(TimeoutError):
        page.wait_for_function(SETTLED, arg=text)
    expect(page.locator(".result-line")).to_contain_text(text)
    expect(page.locator("#total-cost")).to_be_visible()
    expect(stop_button(page)).to_have_count(0)


def open_example(page: Page, name: str) -> None:
    """Open an example and wait for its plan."""
    choose_example(page, name)
    planned(page, "served")


def choose_example(page: Page, name: str) -> None:
    """Open an example."""
    page.locator("#open-menu-button").click()
    page.locator(f"#example-{name}").click()
    page.mouse.move(0, 0)  # off the map, where it would point to something


def open_file(page: Page, name: str, content: str | bytes) -> None:
    """Open a file."""
    data = content.encode() if isinstance(content, str) else content
    page.locator("#file-input").set_input_files(
        {"name": name, "mimeType": "application/octet-stream", "buffer": data})


def open_tab(page: Page, name: str) -> None:
    """Open a tab of the panel."""
    room = page.locator(f"#room-{ROOMS[name]}")
    if room.get_attribute("aria-selected") != "true":
        room.click()
    if [*ROOMS.values()].count(ROOMS[name]) > 1:
        page.locator(f"#tab-{name}").click()


def follow(page: Page, dispatch: str) -> None:
    """Follow a plan that is on the road, of which the service may have others."""
    page.get_by_role("button", name="Look for them").click()
    buttons = page.get_by_role("button", name="Follow the plan of")
    expect(buttons.first).to_be_visible()
    found = [each["id"] for each in state(page, "state.onTheRoad")]
    buttons.nth(found.index(dispatch)).click()


def show_rules(page: Page) -> None:
    """Show the rules that few need, of all vehicle types or of who is selected."""
    expect(page.locator("details.finder").last).to_be_visible()
    for finder in page.locator("details.finder:visible").all():
        if finder.get_attribute("open") is None:
            finder.locator("> summary").click()
        finder.get_by_role("button", name="Show all rules").click()


def open_advanced(page: Page) -> None:
    """Show the options of planning that few need."""
    open_tab(page, "solve")
    page.locator("details.card", has_text="Advanced").locator("> summary").click()


def awaited(page: Page, script: str, argument: Any = None) -> Any:
    """Return what a function that waits for something in the page comes to.

    It fails where that doesn't happen: for a script that is evaluated alone Playwright waits for
    ever.
    """
    told = page.wait_for_function(f"async (given) => ({{ told: await ({script})(given) }})",
                                  arg=argument)
    return told.json_value()["told"]


def let_search(page: Page, seconds: float) -> None:
    """State for how long what is open is searched."""
    page.evaluate("""async (seconds) => {
      const { edit } = await loaded(`actions.js`);
      edit((request) => ({ ...request, options: { ...request.options, time_limit: seconds } }));
    }""", seconds)


def state(page: Page, expression: str) -> Any:
    """Return part of the console's state, such as `state.selection`."""
    return page.evaluate("""async (read) => {
      const { store } = await loaded(`store.js`);
      return read.split('.').slice(1).reduce((part, key) => part?.[key], store.get());
    }""", expression)


def place_of(page: Page, key: str) -> tuple[float, float]:
    """Return where on the screen the map shows a customer, found by its tip."""
    x, y = awaited(page, """async (key) => {
      const { store } = await loaded(`store.js`);
      const { hover, selection } = store.get();
      // A narrow tip is above its place at the edge of the map, too.
      const narrow = document.createElement('style');
      narrow.textContent = '.leaflet-tooltip { max-width: 40px; overflow: hidden; }';
      document.head.append(narrow);
      store.set({ hover: key, selection: null });
      await new Promise(requestAnimationFrame);
      const tip = document.querySelector('.leaflet-tooltip');
      const { left, width, top, bottom } = tip.getBoundingClientRect();
      store.set({ hover, selection });
      narrow.remove();
      const above = tip.classList.contains('leaflet-tooltip-top');
      return [left + width / 2, above ? bottom + 12 : top - 12];
    }""", key)
    return x, y
