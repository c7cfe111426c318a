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


def stop_button(page: Page) -> Locator:
    """Return the button that stops planning."""
    return page.locator("header.head button.stop")


SETTLED = """async (text) => {
  for (let frames = 2; frames; frames -= 1) await new Promise(requestAnimationFrame);
  const told = document.querySelector('.result-line')?.textContent.replaceAll(/\\s+/g, ' ');
  return document.getElementById('total-cost')?.checkVisibility() && told.includes(text)
    && document.querySelector('header.head button.stop').disabled;
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
    expect(stop_button(page)).to_be_disabled()


def open_example(page: Page, name: str) -> None:
    """Open an example and wait for its plan."""
    page.get_by_label("Open an example").select_option(name)
    planned(page, "served")


def open_file(page: Page, name: str, content: str | bytes) -> None:
    """Open a file."""
    data = content.encode() if isinstance(content, str) else content
    page.locator("#file-input").set_input_files(
        {"name": name, "mimeType": "application/octet-stream", "buffer": data})


def open_tab(page: Page, name: str) -> None:
    """Open a tab of the panel."""
    page.locator(f"#tab-{name}").click()


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
      const { selection } = store.get();
      store.set({ selection: key });
      await new Promise(requestAnimationFrame);
      const tip = document.querySelector('.leaflet-tooltip');
      const { left, width, top, bottom } = tip.getBoundingClientRect();
      store.set({ selection });
      const above = tip.classList.contains('leaflet-tooltip-top');
      return [left + width / 2, above ? bottom + 12 : top - 12];
    }""", key)
    return x, y
