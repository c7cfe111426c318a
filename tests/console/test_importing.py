"""Sheets of customers, looked over cell by cell and planned in place of what was open."""

import re
from collections.abc import Callable

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.app.formats.sheets import makes
from tests.console.steps import (
    open_example, open_file, open_tab, planned, show_rules, state,
)
from tests.console.test_everyone import findings

pytestmark = [pytest.mark.slow, pytest.mark.one_page]

SHEET = """name,lat,lon,kg,duration,open time,closes,notes
Anna,47.38,8.54,5,3,8.30,10.00,ring twice
Ben,47.39,8.51,7,3,,12.15,
"""


def dialog(page: Page) -> Locator:
    """Return the dialog, once the file has been read."""
    expect(page.locator("#use-import")).to_be_visible()
    return page.get_by_role("dialog")


def read_anew(page: Page) -> Locator:
    """Return the dialog, once the file has been read with what was changed."""
    expect(page.locator(".import")).to_have_attribute("aria-busy", "false")
    return page.get_by_role("dialog")


def state_field(page: Page, name: str, value: str) -> None:
    """State a depot or part of a fleet."""
    page.locator(f"#import-{name}").fill(value)
    page.locator(f"#import-{name}").press("Tab")
    read_anew(page)


def use(page: Page) -> None:
    """Plan what was imported."""
    button = page.locator("#use-import")
    expect(button).to_be_enabled()
    button.click()
    expect(button).to_have_count(0)


@pytest.mark.thorough
def test_times_are_read_as_they_are_meant_beside_their_cells(page: Page) -> None:
    open_file(page, "today.csv", SHEET)
    shown = dialog(page)
    for raw, made in (("8.30", "from 8:30"), ("12.15", "by 12:15"), ("3", "3 min")):
        cell = shown.get_by_role("cell", name=f"{raw} {made}", exact=True).first
        expect(cell).to_be_visible()
    expect(shown.get_by_role("cell", name="ring twice", exact=True)).to_be_visible()
    use(page)
    planned(page, "2 of 2 served")
    customer = state(page, "state.request.customers.0")
    assert customer["time_window"] == {"earliest": 30600, "latest": 36000}
    assert customer["service_duration"] == 180
    assert customer["info"] == {"notes": "ring twice"}


@pytest.mark.thorough
def test_an_import_takes_nothing_from_what_was_open(page: Page) -> None:
    open_example(page, "city_day")
    open_file(page, "today.csv", SHEET)
    dialog(page)
    state_field(page, "depot", "47.37, 8.53")
    state_field(page, "vehicles", "2")
    state_field(page, "capacity", "20")
    state_field(page, "shift", "7:00-18:00")
    use(page)
    planned(page, "2 of 2 served")
    request = state(page, "state.request")
    assert request["depots"] == [{"id": "depot", "location": [8.53, 47.37]}]
    assert request["fleet"] == [{"id": "vehicle", "count": 2, "capacity": [20], "max_trips": 5,
                                 "shift": {"earliest": 25200, "latest": 64800},
                                 "costs": {"fixed": 30, "per_km": 1, "per_hour": 30}}]
    assert "airspace" not in request


@pytest.mark.thorough
@pytest.mark.parametrize("zone", ["Europe/Zurich", "America/New_York"])
def test_trips_costs_and_currency_are_assumed_told_and_changed(
        open_page: Callable[..., Page], service: str, zone: str) -> None:
    page = open_page(service, timezone_id=zone)
    expect(page.locator("#total-cost")).to_be_visible()
    open_file(page, "today.csv", SHEET)
    shown = dialog(page)
    hour, currency = {"Europe/Zurich": ("45", "CHF"), "America/New_York": ("30", "USD")}[zone]
    expect(shown.get_by_text(f"an hour costs {hour} {currency}")).to_be_visible()
    expect(shown.get_by_text("Vehicles go out up to")).to_be_visible()
    for field, assumed in (("max_trips", "5"), ("per_hour", hour), ("currency", currency)):
        expect(page.locator(f"#import-{field}-taken")).to_have_text(f"taken: {assumed}")
    shown.get_by_text("More of trips, costs and drones").click()
    state_field(page, "max_trips", "1")
    state_field(page, "per_hour", "20")
    state_field(page, "currency", "pln")
    expect(shown.get_by_text("Vehicles go out up to")).to_have_count(0)
    use(page)
    planned(page, "2 of 2 served")
    request = state(page, "state.request")
    assert request["currency"] == "PLN"
    assert (request["fleet"][0]["max_trips"], request["fleet"][0]["costs"]["per_hour"]) == (1, 20)
    expect(page.locator("#total-cost")).to_contain_text("PLN")


def test_what_is_assumed_is_told(page: Page) -> None:
    open_file(page, "today.csv", SHEET)
    shown = dialog(page)
    expect(shown.get_by_text("No depot is stated")).to_be_visible()
    expect(shown.locator("#import-depot-taken")).to_have_text("taken: 47.385, 8.525")
    expect(shown.locator("#import-vehicles-taken")).to_have_text("taken: 1")
    expect(shown.locator("#import-depot")).not_to_have_attribute("placeholder", re.compile(""))


def test_a_wrong_cell_is_named_and_its_row_left_out(page: Page) -> None:
    open_file(page, "today.csv", SHEET.replace("47.39", "47.x"))
    shown = dialog(page)
    expect(shown.get_by_role("alert")).to_contain_text("B3: \u201c47.x\u201d is no number")
    expect(page.locator("#use-import")).to_be_disabled()
    shown.get_by_label("Leave out the rows with errors").check()
    use(page)
    planned(page, "1 of 1 served")


def test_a_guess_is_corrected_by_a_choice_and_remembered(page: Page) -> None:
    open_file(page, "today.csv", SHEET)
    shown = dialog(page)
    shown.get_by_label("Unit of duration").select_option("seconds")
    expect(read_anew(page).get_by_role("cell", name="3 0 min 3 s").first).to_be_visible()
    shown.get_by_label("Meaning of notes").select_option("ignored")
    read_anew(page)
    use(page)
    planned(page, "2 of 2 served")
    assert state(page, "state.request.customers.0.service_duration") == 3
    assert "info" not in state(page, "state.request.customers.0")
    open_file(page, "tomorrow.csv", SHEET.replace("Ben", "Cleo"))
    shown = dialog(page)
    expect(shown.get_by_text("Read as the last file like it")).to_be_visible()
    expect(shown.get_by_label("Unit of duration")).to_have_value("seconds")
    expect(shown.get_by_label("Meaning of notes")).to_have_value("ignored")


@pytest.mark.thorough
def test_a_list_of_pickups_is_put_right_by_one_choice(page: Page) -> None:
    open_file(page, "today.csv", SHEET)
    dialog(page).get_by_label("Meaning of kg").select_option("pickup")
    read_anew(page)
    use(page)
    planned(page, "2 of 2 served")
    customers = state(page, "state.request.customers")
    assert [customer["pickup"] for customer in customers] == [[5], [7]]
    assert all(not any(customer["demand"]) for customer in customers)


MARKED = """Kunde;Lat;Lon;Kz.;Beginn;XQ
A;48.1312;11.5712;7;8:00;3
B;48.1412;11.5612;4;9:00;8
"""


@pytest.mark.thorough
def test_columns_to_look_at_are_counted_and_settled_one_by_one(page: Page) -> None:
    open_file(page, "today.csv", MARKED)
    shown = dialog(page)
    chip = shown.get_by_role("button", name="2 columns to look at")
    chip.click()
    expect(shown.get_by_label("Meaning of Kz.")).to_be_focused()
    chip.click()
    expect(shown.get_by_label("Meaning of XQ")).to_be_focused()
    likely = shown.get_by_label("Meaning of Kz.").locator("optgroup").first.locator("option")
    assert "demand" in [option.get_attribute("value") for option in likely.all()]
    shown.get_by_label("Meaning of Kz.").select_option("demand")
    expect(read_anew(page).get_by_role("button", name="1 column to look at")).to_be_visible()
    expect(shown.get_by_role("cell", name="7", exact=True)).to_be_visible()
    shown.get_by_label("Meaning of XQ").select_option("ignored")
    expect(read_anew(page).get_by_role("button", name="to look at")).to_have_count(0)
    use(page)
    planned(page, "2 of 2 served")
    assert [customer["demand"] for customer in state(page, "state.request.customers")] == [[7], [4]]


def test_what_is_doubtful_is_said_and_taken_as_right(page: Page) -> None:
    rows = "A\t48.1312\t11.5712\t48.1512\t11.5912\t8:00"
    open_file(page, "rides.txt", "Name\tPickup lat\tPickup lon\tDelivery lat\tDelivery lon\t"
              f"Start\n{rows}\n")
    shown = dialog(page)
    heading = shown.get_by_role("columnheader", name="Start")
    expect(heading).to_contain_text("At the pickup, or at the delivery?")
    expect(shown.get_by_role("cell", name="48.1312 Pickup: 48.1312\u00b0")).to_be_visible()
    expect(shown.get_by_role("columnheader", name="Pickup lat")).to_contain_text("with C")
    heading.get_by_role("button", name="That is right").click()
    read_anew(page)
    expect(heading).not_to_contain_text("At the pickup")
    use(page)
    planned(page, "2 of 2 served")


def test_cells_are_pasted_from_a_sheet(page: Page) -> None:
    page.evaluate("""(text) => {
      const data = new DataTransfer();
      data.setData('text/plain', text);
      const event = new ClipboardEvent('paste', { clipboardData: data, bubbles: true });
      document.body.dispatchEvent(event);
    }""", SHEET.replace(",", "\t"))
    expect(dialog(page)).to_contain_text("Import what was pasted")
    use(page)
    planned(page, "2 of 2 served")


@pytest.mark.thorough
def test_drivers_are_told_where_and_whom_to_call(page: Page) -> None:
    open_file(page, "german.csv", makes.GERMAN.encode("cp1252"))
    dialog(page)
    use(page)
    planned(page, "3 of 3 served")
    page.evaluate("window.print = () => {}")
    open_tab(page, "export")
    page.get_by_role("button", name="Print all driver sheets").click()
    sheet = page.locator(".sheet-page").first
    for text in ("Am Bach 5, 81369 M\u00fcnchen", "48.1102, 11.5454", "Phone: 089 77",
                 "2x klingeln"):
        expect(sheet).to_contain_text(text)
    expect(sheet.locator("th", has_text="Drones")).to_have_count(0)


@pytest.mark.thorough
def test_what_drivers_are_told_is_edited_line_by_line(page: Page) -> None:
    open_file(page, "today.csv", SHEET)
    dialog(page)
    use(page)
    planned(page, "2 of 2 served")
    page.get_by_role("button", name="Anna", exact=True).first.click()
    show_rules(page)
    field = page.locator("#field-customers-0-info")
    expect(field).to_have_value("notes: ring twice")
    field.fill("notes: ring once\nphone: 044 123")
    field.blur()
    assert state(page, "state.request.customers.0.info") == {"notes": "ring once",
                                                             "phone": "044 123"}
    field.fill("no name")
    expect(page.get_by_text("Write lines such as")).to_be_visible()


def test_a_file_that_is_no_sheet_is_refused_in_words(open_page: Callable[..., Page],
                                                     service: str) -> None:
    page = open_page(service, allow=("422",))
    expect(page.locator("#total-cost")).to_be_visible()
    open_file(page, "scan.pdf", b"%PDF-1.7")
    expect(page.get_by_role("alert")).to_contain_text("The file is a PDF")
    expect(page.get_by_role("dialog")).to_have_count(0)


# `tests.app.formats.sheets.test_makes` tells how those and many others are read.
@pytest.mark.thorough_after(1)
@pytest.mark.parametrize(("name", "content", "served"), [
    ("german.csv", makes.GERMAN.encode("cp1252"), 3), ("tabs.txt", makes.TABS.encode("utf-16"), 3),
    ("rows.csv", makes.SEVERAL_ROWS.encode(), 4), ("merged.xlsx", makes.merged_headings(), 3),
], ids=lambda value: value if isinstance(value, str) else "")
def test_sheets_of_several_makes_are_planned_in_one_click(console: Page, name: str, content: bytes,
                                                      served: int) -> None:
    open_file(console, name, content)
    expect(dialog(console)).to_contain_text(f"{served} customers of")
    use(console)
    expect(console.locator(".result-line")).to_contain_text(
        re.compile(f"of {served} served"))


@pytest.mark.thorough
def test_everyone_can_import(page: Page) -> None:
    open_file(page, "today.csv", SHEET.replace("47.39", "47.x"))
    expect(dialog(page).get_by_role("alert")).to_be_visible()
    for width, height, scheme in ((1440, 900, "light"), (1440, 900, "dark"), (390, 844, "light"),
                                  (1024, 768, "light")):
        page.set_viewport_size({"width": width, "height": height})
        page.evaluate("(scheme) => { document.documentElement.dataset.theme = scheme; }", scheme)
        assert findings(page, impacts=None) == [], (width, scheme)
        widths = page.evaluate("""() => {
          const { scrollWidth, clientWidth } = document.querySelector('dialog');
          return [scrollWidth, clientWidth];
        }""")
        assert widths[0] <= widths[1]


def test_an_import_needs_no_mouse(page: Page) -> None:
    open_file(page, "today.csv", SHEET)
    dialog(page)
    for _ in range(40):
        if page.evaluate("document.activeElement.id") == "use-import":
            break
        page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    expect(page.get_by_role("dialog")).to_have_count(0)
    planned(page, "2 of 2 served")
    open_file(page, "today.csv", SHEET)
    dialog(page)
    page.keyboard.press("Escape")
    expect(page.get_by_role("dialog")).to_have_count(0)


def test_all_that_can_be_read_can_be_chosen(page: Page) -> None:
    listed = page.locator("#file-input").get_attribute("accept") or ""
    assert {".gpx", ".kmz", ".kml", ".xml", ".csv", ".xlsx", ".geojson"} <= set(listed.split(","))
