"""What a plan costs is the same everywhere, penalties stand apart, badges are vehicles' numbers."""

import json
from collections.abc import Callable
from typing import Any

import pytest
from playwright.sync_api import Page, expect

from tests.console.steps import idle, open_example, open_file, open_tab, planned, state
from tests.console.test_everyone import findings
from tests.console.test_hands import PROBLEM, reply_of, told

pytestmark = [pytest.mark.slow, pytest.mark.one_page]

LEFT_OUT: dict[str, Any] = PROBLEM | {
    "customers": [*PROBLEM["customers"], {"id": "G", "location": [5, 5], "demand": [99]}]}


def number(text: str | None) -> float:
    """Return the first amount in a text."""
    assert text is not None
    return float(next(part for part in text.replace("+", " ").split() if part[0].isdigit()))


def costs_in(page: Page) -> list[float]:
    """Return what the open plan costs: in the header, Costs, What if, Search and its draft."""
    found = [number(page.locator("#total-cost").text_content())]
    open_tab(page, "costs")
    total = page.get_by_role("row", name="Total").get_by_role("cell").first
    found.append(number(total.text_content()))
    open_tab(page, "changes")
    row = page.locator("tr", has=page.locator("input[name=shown]:checked"))
    found.append(number(row.locator("td.number").first.text_content()))
    open_tab(page, "solve")
    fact = page.locator(".facts div").filter(has=page.get_by_text("Cost", exact=True))
    found.append(number(fact.locator("dd").text_content()))
    return found


def test_cost_is_the_same_everywhere_and_the_penalty_apart(page: Page) -> None:
    open_file(page, "left-out.json", json.dumps(LEFT_OUT))
    planned(page, "6 of 7 served")
    cost = state(page, "state.plans.0.plan.cost")
    assert cost["unassigned"] > 0
    costs = costs_in(page)
    assert costs == [pytest.approx(cost["total"] - cost["unassigned"], abs=0.01)] * 4
    # Nobody pays the penalty: the header says who is left out, and what is counted on asking.
    expect(page.locator(".result-line")).to_contain_text("1 left out")
    expect(page.locator("header.head")).not_to_contain_text("penalty")
    open_tab(page, "costs")
    expect(page.locator("#penalty")).to_be_visible()
    assert findings(page, ".panel") == []


def test_what_leaving_out_costs_is_part_of_the_cost_where_it_is_stated(page: Page) -> None:
    open_file(page, "priced.json", json.dumps(LEFT_OUT | {"unassigned_cost": 7}))
    expect(page.locator(".result-line")).to_contain_text("of 7 served")
    idle(page)
    total = state(page, "state.plans.0.plan.cost.total")
    assert costs_in(page) == [pytest.approx(total, abs=0.01)] * 4


def test_leaving_somebody_out_by_hand_tells_cost_and_penalty(page: Page, service: str) -> None:
    reply = reply_of(service, "ABC", "DEF")
    page.route("**/plan", lambda route: route.fulfill(json=reply), times=1)
    open_file(page, "six.json", json.dumps(PROBLEM))
    planned(page, "6 of 6 served")
    open_tab(page, "routes")
    page.get_by_role("button", name="A", exact=True).click()
    page.get_by_role("button", name="Leave out").click()
    told(page, "penalty +")
    change = page.locator("#hand-outcome strong").first.text_content()
    assert change is not None
    assert change[0] in "\u2212-"


def test_badges_are_the_numbers_of_the_vehicles(page: Page, service: str) -> None:
    text = json.dumps(reply_of(service, "ABC", "DEF")).replace("truck-2", "truck-3")
    page.route("**/plan", lambda route: route.fulfill(
        body=text, content_type="application/json"), times=1)
    open_file(page, "six.json", json.dumps(PROBLEM))
    planned(page, "6 of 6 served")
    open_tab(page, "routes")
    assert sorted(page.locator(".trip-mark").all_inner_texts()) == ["1", "3"]
    summaries = page.locator(".panel details summary").all_inner_texts()
    assert [part.split()[:2] for part in summaries] == [["1", "truck-1"], ["3", "truck-3"]]
    page.get_by_role("button", name="Play the day").click()
    expect(page.locator(".truck-mover span").last).to_have_text("3")


@pytest.mark.thorough
@pytest.mark.parametrize(("widths", "scheme", "locale"), [
    ((1440, 1024), "light", "en"), ((1024,), "dark", "de")])
def test_the_header_is_one_line(open_page: Callable[..., Page], service: str,
                                widths: tuple[int, ...], scheme: str, locale: str) -> None:
    page = open_page(service, color_scheme=scheme, locale=locale)
    open_file(page, "left-out-of-a-long-day-in-the-city.json", json.dumps(LEFT_OUT))
    expect(page.locator(".result-line .out")).to_be_visible()
    idle(page)
    for change in (None, "async () => (await loaded(`actions.js`)).edit("
                         "(request) => ({ ...request, unassigned_cost: 5 }))"):
        if change:
            page.evaluate(change)
        for width in widths:
            page.set_viewport_size({"width": width, "height": 768})
            if change:
                expect(page.locator(".result-line .stale")).to_be_in_viewport()
                assert findings(page, "header") == []
            hold_to_one_line(page, width)
            expect(page.locator("#total-cost")).to_be_in_viewport()


def hold_to_one_line(page: Page, width: int) -> None:
    """Fail if the header has more than a line, or more in it than the width."""
    header = page.locator("header.head")
    box = header.bounding_box()
    assert box is not None
    assert box["height"] == 48
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    for element in header.locator("button:visible:not(.menu *, .chip), #total-cost").all():
        own = element.bounding_box()
        assert own is not None
        assert box["y"] <= own["y"]
        assert own["y"] + own["height"] <= box["y"] + box["height"]
        assert own["x"] + own["width"] <= width


@pytest.mark.thorough
def test_a_narrow_header_has_all_within_its_width(page: Page) -> None:
    open_example(page, "city_day")
    header = page.locator("header.head")
    for width in (768, 390):
        page.set_viewport_size({"width": width, "height": 844})
        assert page.evaluate("document.documentElement.scrollWidth") <= width
        box = header.bounding_box()
        assert box is not None
        assert box["height"] == 48
        for part in header.locator("button:visible:not(.menu *)").all():
            own = part.bounding_box()
            assert own is not None
            assert own["x"] + own["width"] <= width
            expect(part).to_be_in_viewport()
