"""Edits are undone and made again, never beyond what was opened; single keys can be put off."""

import json
from collections.abc import Callable
from typing import Any

import pytest
from playwright.sync_api import Page, expect

from tests.console.steps import idle, open_example, open_file, planned, state
from tests.console.test_everyone import findings
from tests.console.test_importing import SHEET, dialog, use
from tests.console.test_keeping import edit, first_customer, loaded_anew, save, saved

pytestmark = pytest.mark.slow

PROBLEM: dict[str, Any] = {
    "depots": [{"id": "hub", "location": [0, 0]}],
    "customers": [{"id": "mine", "location": [3, 4], "demand": [1]}],
    "fleet": [{"id": "truck", "count": 1, "capacity": [9]}], "options": {"time_limit": 0}}


def kept(page: Page) -> None:
    """Wait until the browser has kept what is worked on."""
    page.evaluate("async () => (await loaded(`keeping/drafts.js`)).keepNow()")


def a_sheet(page: Page) -> str:
    """Import a sheet; return its first customer."""
    open_file(page, "today.csv", SHEET)
    dialog(page)
    use(page)
    planned(page, "2 of 2 served")
    return "Anna"


def a_file(page: Page) -> str:
    """Open a problem as JSON; return its first customer."""
    open_file(page, "mine.json", json.dumps(PROBLEM))
    planned(page, "1 of 1 served")
    return "mine"


def an_example(page: Page) -> str:
    """Open another example; return its first customer."""
    open_example(page, "smallest")
    return str(first_customer(page))


def a_kept_plan(page: Page) -> str:
    """Open what was saved; return its first customer."""
    a_file(page)
    save(page, "kept", "This browser")
    open_example(page, "smallest")
    saved(page).get_by_role("button", name="Open kept").click()
    planned(page, "1 of 1 served")
    return "mine"


@pytest.mark.thorough
@pytest.mark.parametrize("opened", [a_sheet, a_file, an_example, a_kept_plan])
def test_undo_never_crosses_the_opening_of_something_else(
        page: Page, opened: Callable[[Page], str]) -> None:
    idle(page)
    edit(page, "of the example")
    first = opened(page)
    for key in ("u", "u", "Control+z", "y", "Control+y"):
        page.keyboard.press(key)
        assert first_customer(page) == first
    kept(page)
    assert first_customer(loaded_anew(page)) == first


def test_undone_edits_are_made_again_also_after_a_reload(page: Page) -> None:
    first = an_example(page)
    edit(page, "one")
    edit(page, "two")
    page.keyboard.press("u")
    page.keyboard.press("Control+z")
    assert first_customer(page) == first
    page.keyboard.press("u")
    assert first_customer(page) == first
    page.keyboard.press("y")
    assert first_customer(page) == "one"
    kept(page)
    loaded_anew(page)
    assert first_customer(page) == "one"
    page.keyboard.press("Control+Shift+Z")
    assert first_customer(page) == "two"
    page.keyboard.press("u")
    edit(page, "three")
    page.keyboard.press("y")
    assert first_customer(page) == "three"


@pytest.mark.thorough
def test_single_keys_are_put_off_and_stay_so(page: Page) -> None:
    idle(page)
    edit(page, "edited")
    page.keyboard.press("?")
    shown = page.get_by_role("dialog", name="Keys")
    shown.get_by_label("Single keys do something").uncheck()
    assert findings(page, "dialog") == []
    page.keyboard.press("Escape")
    expect(page.get_by_role("dialog")).to_have_count(0)
    kept(page)
    tab = state(page, "state.tab")
    theme = page.locator("html").get_attribute("data-theme")
    for _ in range(2):
        for key in ("u", "l", "4", "o", "?", "p", " "):
            page.keyboard.press(key)
        expect(page.get_by_role("dialog")).to_have_count(0)
        assert (first_customer(page), state(page, "state.tab")) == ("edited", tab)
        assert not state(page, "state.playing")
        expect(page.locator("html")).to_have_attribute("data-theme", str(theme))
        loaded_anew(page)
    page.keyboard.press("Control+z")
    assert first_customer(page) != "edited"
    page.locator("#settings-button").click()
    page.get_by_role("button", name="Keys").click()
    shown.get_by_label("Single keys do something").check()
    page.keyboard.press("Escape")
    page.keyboard.press("3")
    assert state(page, "state.tab") == "routes"
