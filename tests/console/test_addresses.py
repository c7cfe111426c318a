"""Addresses in place of coordinates: opened, imported, searched for, and put right by hand."""

import json
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.app.maps.addresses.conftest import helsinki  # noqa: F401
from tests.console.serving import shared
from tests.console.steps import idle, open_file, open_tab, planned, state

pytestmark = [pytest.mark.slow, pytest.mark.thorough]

SHEET = """Name;Address;kg
Anna;Mikonkatu 18, Helsinki;2
Ben;Bulevardi, Helsinki;3
Cleo;Xyzzyweg 12;3
"""
REQUEST = {
    "coordinate_system": "geographic",
    "depots": [{"id": "hub", "location": {"address": "Kaivokatu 1, Helsinki"}}],
    "customers": [{"id": "Anna", "location": {"address": "Mikonkatu 18, Helsinki"}, "demand": [1]}],
    "fleet": [{"id": "van", "count": 1, "capacity": [5]}], "options": {"time_limit": 0}}


@pytest.fixture(scope="module")
def finding(helsinki: Path, shared_folder: Path) -> Iterator[str]:  # noqa: F811
    with shared(shared_folder / "finding", TANDEM_GEOCODER=f"extract:{helsinki}") as address:
        yield address


def test_addresses_are_placed_and_doubts_put_right(
        open_page: Callable[..., Page], finding: str) -> None:
    page = open_page(finding, allow=("422",))
    idle(page)
    open_file(page, "addresses.json", json.dumps(REQUEST))
    planned(page, "1 of 1 served")
    assert state(page, "state.request.customers.0.location")[0] == pytest.approx(24.945, abs=1e-3)

    open_file(page, "tour.csv", SHEET)
    page.locator("#use-import").click()
    expect(page.locator("#use-import")).to_have_count(0)
    open_tab(page, "customers")
    doubted = page.locator("#doubted")
    expect(doubted).to_contain_text("2 doubtful places")
    expect(page.locator(".doubt-mark")).to_have_count(1)
    doubted.get_by_role("button", name="Ben").click()
    place = page.get_by_role("group", name="Place of Ben")
    expect(place).to_contain_text("street alone")
    place.get_by_role("button", name="It is right").click()
    doubted.get_by_role("button", name="Cleo").click()
    page.get_by_role("button", name="Show it on the map").click()
    page.locator(".map").first.click(position={"x": 300, "y": 200})
    expect(doubted).to_have_count(0)

    page.get_by_label("Find an address").fill("Bulevardi 5")
    page.get_by_role("button", name="Find", exact=True).click()
    page.get_by_role("button", name="Add a customer").first.click()
    page.locator("#plan-button").click()
    planned(page, "of 4 served")
    assert state(page, "state.request.customers.3.id") == "Bulevardi 5"


def test_a_new_order_goes_to_an_address(open_page: Callable[..., Page], finding: str) -> None:
    page = open_page(finding, allow=("422",))
    idle(page)
    open_file(page, "addresses.json", json.dumps(REQUEST))
    planned(page, "1 of 1 served")
    page.locator(".new-order summary").click()
    page.locator("#order-place").fill("Xyzzyweg 12")
    page.locator("#order-place").press("Enter")
    expect(page.locator("#order-place-error")).to_be_visible()
    page.locator("#order-place").fill("Bulevardi 5")
    page.locator("#order-place").press("Enter")
    page.get_by_role("button", name="Take van").click()
    expect(page.locator("#hand-outcome")).to_contain_text("order-2 to van")
    order = state(page, "state.request.customers.1")
    assert order["location"][0] == pytest.approx(24.94, abs=1e-2)
    assert order["info"] == {"address": "Bulevardi 5"}
