"""Twenty-five kinds of spreadsheets: planned as meant in at most six clicks, or asked about."""

import httpx
import pytest
from playwright.sync_api import Page, expect

from tests.console.spreadsheets import CSV, HEAD, MUNICH, ROWS, SPREADSHEETS, Spreadsheet, book
from tests.console.steps import open_file, state
from tests.console.test_everyone import findings
from tests.console.test_importing import dialog, read_anew, use

pytestmark = pytest.mark.slow

MOST_CLICKS = 6

CLICKED = [sheet for sheet in SPREADSHEETS if sheet.answers or sheet.columns]

COUNT = """() => {
  window.clicks = 0;
  window.counting?.abort();
  window.counting = new AbortController();
  const count = ({ isTrusted }) => { window.clicks += Number(isTrusted); };
  document.addEventListener('click', count, { capture: true, signal: window.counting.signal });
}"""


def test_kinds_that_leave_nothing_open_are_planned_as_meant_without_a_question(
        client: httpx.Client) -> None:
    for sheet in SPREADSHEETS:
        if sheet in CLICKED:
            continue
        reply = client.post("/import", files={"file": sheet.content}).json()
        unanswered = [each for each in reply["questions"] if each["answer"] is None]
        assert (sheet.name, unanswered, reply["errors"]) == (sheet.name, [], [])
        request = reply["request"] | {"options": {"time_limit": 0}}
        assert sheet.holds(request), sheet.name
        assert (sheet.name, len(request["customers"])) == (sheet.name, sheet.served)
        assert client.post("/plan", json=request).json()["unassigned"] == []


@pytest.mark.thorough_after(1)
@pytest.mark.parametrize("sheet", CLICKED, ids=lambda sheet: sheet.name)
def test_a_kind_of_spreadsheet_is_planned_as_meant(console: Page, sheet: Spreadsheet) -> None:
    console.evaluate("localStorage.clear()")
    console.evaluate(COUNT)
    open_file(console, sheet.name, sheet.content)
    shown = dialog(console)
    for part, answer in sheet.answers:
        question = shown.get_by_role("group", name=part)
        expect(question).to_be_visible()
        if answer:
            question.get_by_role("button", name=answer).click()
            read_anew(console)
    for heading, meaning in sheet.columns:
        shown.get_by_label(f"Meaning of {heading}").select_option(label=meaning)
        read_anew(console)
    use(console)
    expect(console.locator(".result-line")).to_contain_text(f"of {sheet.served} served")
    request = state(console, "state.request")
    assert len(request["customers"]) == sheet.served
    assert sheet.holds(request)
    assert console.evaluate("window.clicks") <= MOST_CLICKS


@pytest.mark.thorough
def test_all_that_a_workbook_leaves_open_is_answered_and_remembered(page: Page) -> None:
    head = (*HEAD, "Status", "Zauber")
    more = (("offen", "rot"), ("storniert", "blau"), ("offen", "gelb"))
    rows = [head, *((*customer, *cells) for customer, cells in zip(MUNICH, more, strict=True))]
    content = book(("Touren", rows), ("Dienstag", [HEAD, ("Dora", 48.15, 11.6, 2)]), hide=(3,))
    page.evaluate(COUNT)
    open_file(page, "touren.xlsx", content)
    shown = dialog(page)
    expect(shown.get_by_text("1 customer of")).to_be_visible()
    for width in (1440, 1024, 390):
        page.set_viewport_size({"width": width, "height": 844})
        assert findings(page, impacts=None) == [], width
    shown.get_by_label("Meaning of Zauber").select_option(label="For the driver, as it is")
    read_anew(page)
    for part, answer in (("Dienstag", "Its rows, too"), ("hidden", "Planned"),
                         ("storniert", "Planned")):
        question = shown.get_by_role("group", name=part)
        question.get_by_role("button", name=answer).click()
        expect(question.get_by_role("button", name=answer)).to_have_attribute(
            "aria-pressed", "true")
        read_anew(page)
    expect(shown.get_by_text("All are answered.")).to_be_visible()
    use(page)
    expect(page.locator(".result-line")).to_contain_text("of 4 served")
    assert page.evaluate("window.clicks") <= MOST_CLICKS
    open_file(page, "tomorrow.xlsx", content)
    expect(dialog(page).get_by_text("Read as the last file like it")).to_be_visible()
    expect(read_anew(page).get_by_text("One is not answered")).to_be_visible()
    expect(shown.get_by_text("3 customers of")).to_be_visible()


@pytest.mark.thorough
def test_dozens_of_unused_columns_are_greyed_and_stay_within_the_table(console: Page) -> None:
    console.evaluate("localStorage.clear()")
    more = [f"Feld {number}" for number in range(30)]
    lines = [",".join([CSV, *more]), *(",".join([row, *["so und so"] * 30]) for row in ROWS)]
    open_file(console, "export.csv", "\n".join(lines))
    shown = dialog(console)
    expect(shown.locator("th.unused")).to_have_count(30)
    expect(shown.locator(".import-questions")).to_have_count(0)
    expect(shown.get_by_role("button", name="to look at")).to_have_count(0)
    shown.get_by_label("Meaning of Feld 29").select_option("notes")
    read_anew(console)
    expect(shown.locator("th.unused")).to_have_count(29)
    use(console)
    expect(console.locator(".result-line")).to_contain_text("of 3 served")
    assert state(console, "state.request.customers.0.info") == {"notes": "so und so"}
