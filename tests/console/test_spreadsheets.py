"""Twenty-five kinds of spreadsheets: planned as meant in at most six clicks, or asked about."""

import pytest
from playwright.sync_api import Page, expect

from tests.console.spreadsheets import SPREADSHEETS, Spreadsheet
from tests.console.steps import open_file, state
from tests.console.test_importing import dialog, read_anew, use

MOST_CLICKS = 6

COUNT = """() => {
  window.clicks = 0;
  window.counting?.abort();
  window.counting = new AbortController();
  const count = ({ isTrusted }) => { window.clicks += Number(isTrusted); };
  document.addEventListener('click', count, { capture: true, signal: window.counting.signal });
}"""


@pytest.mark.parametrize("sheet", SPREADSHEETS, ids=lambda sheet: sheet.name)
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
    use(console)
    expect(console.locator(".result-line")).to_contain_text(f"of {sheet.served} served")
    request = state(console, "state.request")
    assert len(request["customers"]) == sheet.served
    assert sheet.holds(request)
    assert console.evaluate("window.clicks") <= MOST_CLICKS
