"""What a sheet leaves open is asked in the dialog, and answered by a click."""

import json
from collections.abc import Callable
from typing import Any

import pytest
from playwright.sync_api import Page, Route, expect

from tests.console.steps import choose_example, open_file, planned, state
from tests.console.test_importing import SHEET, dialog, read_anew, use
from tests.console.test_everyone import findings

pytestmark = [pytest.mark.slow, pytest.mark.thorough]

UNKNOWN: dict[str, Any] = {
    "id": "later:1", "kind": "later", "text": "Something that this console doesn't know?",
    "values": {}, "choices": [{"answer": "yes", "title": "Yes"}, {"answer": "no", "title": "No"}],
    "default": None}
"""A question of a kind that came later, which must be answered."""


class Asking:
    """Has the service's replies to imports ask questions; keeps the answers that it was sent."""

    def __init__(self, page: Page, questions: list[dict[str, Any]]) -> None:
        self.answers: dict[str, str] = {}
        self._questions = questions
        page.route("**/import", self._answer)

    def _answer(self, route: Route) -> None:
        content = route.request.post_data_buffer or b""
        settings = content[content.index(b'name="settings"'):].split(b"\r\n\r\n")[1]
        stated = json.loads(settings.split(b"\r\n")[0])
        self.answers = stated["mapping"].pop("answers", {})
        sent = json.dumps(stated).encode()
        response = route.fetch(post_data=content.replace(settings.split(b"\r\n")[0], sent))
        reply = response.json()
        reply["questions"] = [self._told(question) for question in self._questions]
        if any(question["answer"] is None for question in reply["questions"]):
            reply["request"] = None
        route.fulfill(response=response, json=reply)

    def _told(self, question: dict[str, Any]) -> dict[str, Any]:
        given = self.answers.get(question["id"])
        return question | {"answer": given or question["default"], "is_answered": given is not None,
                           "column": None, "cell": None, "sheet": None, "examples": []}


def test_questions_of_any_kind_are_asked_and_must_be_answered_where_nothing_is_taken(
        page: Page) -> None:
    asking = Asking(page, [UNKNOWN])
    open_file(page, "today.csv", SHEET)
    shown = dialog(page)
    question = shown.get_by_role("group", name=UNKNOWN["text"])
    expect(question).to_be_visible()
    expect(page.locator("#use-import")).to_be_disabled()
    question.get_by_role("button", name="No").click()
    read_anew(page)
    expect(question.get_by_role("button", name="No")).to_have_attribute("aria-pressed", "true")
    assert asking.answers == {"later:1": "no"}
    use(page)
    planned(page, "2 of 2 served")


@pytest.mark.parametrize(("scheme", "sizes"), [
    ("light", ((1440, 900), (390, 844), (1024, 768))), ("dark", ((1440, 900),))])
def test_everyone_can_answer(open_page: Callable[..., Page], service: str, scheme: str,
                             sizes: tuple[tuple[int, int], ...]) -> None:
    page = open_page(service, color_scheme=scheme)
    expect(page.locator("#total-cost")).to_be_visible()
    Asking(page, [UNKNOWN])
    open_file(page, "today.csv", SHEET)
    shown = dialog(page)
    for width, height in sizes:
        page.set_viewport_size({"width": width, "height": height})
        expect(shown.get_by_role("group", name=UNKNOWN["text"])).to_be_visible()
        assert findings(page, impacts=None) == [], width
        assert state(page, "state.importing.reply.questions.0.answer") is None
        widths = page.evaluate("""() => {
          const { scrollWidth, clientWidth } = document.querySelector('dialog');
          return [scrollWidth, clientWidth];
        }""")
        assert widths[0] <= widths[1], width


def test_the_example_of_a_working_day_is_read_and_planned(page: Page) -> None:
    page.get_by_role("button", name="Draw", exact=True).click()
    page.get_by_role("button", name="No-fly area").click()
    choose_example(page, "sheet")
    shown = dialog(page)
    question = shown.get_by_role("group", name="Plan")
    expect(question.get_by_role("button", name="Rules of the whole plan")).to_have_attribute(
        "aria-pressed", "true")
    # Of two types: what they have in common, and as many as there are in all.
    expect(shown.locator("#import-vehicles-taken")).to_have_text("taken: 3")
    expect(shown.locator("#import-capacity-taken")).to_have_text("")
    listed = shown.get_by_role("region", name="Vehicles of the file")
    expect(listed.get_by_role("cell", name="bike", exact=True)).to_be_visible()
    listed.get_by_label("bike: How many").fill("many")
    expect(shown.locator("#use-import")).to_be_disabled()
    listed.get_by_label("bike: How many").fill("2")
    listed.get_by_label("bike: Works").fill("8:30-17:00")
    lag = shown.get_by_label("Meaning of Least lag (min)")
    expect(lag.locator("option:checked")).to_have_text("Least time between the two of an order")
    with page.expect_download() as download:
        shown.get_by_role("link", name="Download an example").click()
    assert download.value.suggested_filename == "working-day.xlsx"
    use(page)
    # How many in the console's second is the machine's; that all fit, the import's own test plans.
    planned(page, "of 11 served")
    assert state(page, "state.request.fairness.min_vehicles") == 2
    bike, = [kind for kind in state(page, "state.request.fleet") if kind["id"] == "bike"]
    assert (bike["count"], bike["shift"]) == (2, {"earliest": 30_600, "latest": 61_200})
    assert state(page, "state.tool") is None
