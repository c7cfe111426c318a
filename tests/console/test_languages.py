"""The console in the language of whoever looks at it."""

import json
import re
import subprocess
from collections.abc import Callable
from functools import cache
from typing import Any

import pytest
from playwright.sync_api import Page, expect

from app.schemas.request import PlanRequest
from tests.console.steps import (
    EXAMPLES, ROOT, STATIC, choose_example, idle, open_file, open_tab, planned,
)
from tests.console.test_everyone import findings

pytestmark = pytest.mark.slow

FORMS = (
    "CustomerInput", "TimeWindowInput", "VehiclesInput", "DepotInput", "PlaceInput",
    "VehicleTypeInput", "CostsInput", "SpeedChangeInput", "ShiftInput", "BreakInput",
    "BreakStartInput", "OvertimeInput",
    "DronesInput", "TurnaroundInput", "DroneCostsInput", "EnergyInput", "PowerInput", "ClimbInput",
    "WindInput", "LoadDimensionInput", "OptionsInput", "ChangeCostsInput", "LatenessRiskInput",
    "SpreadInput",
)
"""Schemas that the console makes forms of."""


@cache
def texts_of(language: str) -> dict[str, Any]:
    """Return the console's texts in a language, by view."""
    script = (f"import('{STATIC / 'texts' / f'{language}.js'}')"
              ".then((file) => console.log(JSON.stringify(file.default)))")
    done = subprocess.run(["node", "-e", script], text=True, capture_output=True, check=True)
    return dict(json.loads(done.stdout))


def test_console_speaks_the_browsers_language_until_another_is_chosen(
        open_page: Callable[..., Page], service: str) -> None:
    page = open_page(service, locale="de-CH")
    idle(page)
    expect(page.locator("html")).to_have_attribute("lang", "de")
    page.locator("#settings-button").click()
    page.get_by_label("Sprache").select_option("en")
    expect(page.get_by_label("Language")).to_have_value("en")
    expect(page.locator("html")).to_have_attribute("lang", "en")
    page.reload()
    idle(page)
    expect(page.get_by_label("Language")).to_have_value("en")


def test_console_speaks_english_to_whoever_reads_none_of_its_languages(
        open_page: Callable[..., Page], service: str) -> None:
    page = open_page(service, locale="fi-FI")
    expect(page.get_by_label("Language")).to_have_value("en")


def test_every_field_of_a_form_has_a_name_and_a_sentence_in_both_languages() -> None:
    schemas = PlanRequest.model_json_schema()["$defs"]
    for language in ("en", "de"):
        texts = texts_of(language)
        for owner in FORMS:
            for name in schemas[owner]["properties"]:
                assert texts["field"].get(name), f"{language}: the name of {owner}.{name}"
                assert texts["help"].get(owner, {}).get(name), f"{language}: {owner}.{name}"


def test_every_warning_is_said_in_both_languages() -> None:
    page = (ROOT / "docs" / "use" / "warnings.md").read_text("utf-8")
    codes = re.findall(r"^\| `([A-Z_]+)`", page, re.MULTILINE)
    assert len(codes) > 20
    for language in ("en", "de"):
        assert [code for code in codes if code not in texts_of(language)["said"]] == []


LEFT_OVERS = """async () => {
  const en = (await loaded(`../texts/en.js`)).default;
  const de = (await loaded(`../texts/de.js`)).default;
  const flat = (texts) => Object.values(texts).flatMap(
    (text) => (typeof text === 'string' ? [text] : flat(text)));
  const pattern = (text) => new RegExp(`^${text
    .replace(/[.*+?^$()|[\\]\\\\]/g, '\\\\$&').replace(/\\{\\{\\w+\\}\\}/g, '.+')}$`);
  const worded = (text) => /[a-z]{3}/i.test(text.replace(/\\{\\{\\w+\\}\\}/g, ''));
  window.patterns ??= { german: flat(de).map(pattern),
    english: flat(en).filter(worded).map(pattern), isEnglish: new Map() };
  const { german, english, isEnglish } = window.patterns;
  // Sentences that are in no file of texts give themselves away by such words.
  const common = /\\b(the|of|and|is|are|with|not|this|from|every|its|click)\\b/i;
  const texts = new Set();
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const { parentElement: parent, data } = walker.currentNode;
    if (!parent.closest('[lang=en], script, style, option[value], .leaflet-control')) {
      texts.add(data.trim());
    }
  }
  for (const name of ['aria-label', 'title', 'placeholder', 'alt', 'aria-valuetext']) {
    for (const element of document.querySelectorAll(`[${name}]`)) {
      if (!element.closest('[lang=en], .leaflet-control')) {
        texts.add(element.getAttribute(name).trim());
      }
    }
  }
  for (const text of texts) {
    if (isEnglish.has(text)) continue;
    isEnglish.set(text, /[a-z]{3}/i.test(text) && !german.some((known) => known.test(text))
      && (english.some((known) => known.test(text)) || common.test(text)));
  }
  return [...texts].filter((text) => isEnglish.get(text));
}"""
"""Texts of a page that are English: those of en.js, and what looks like a sentence of its own."""

COLOURS = ["color-contrast"]

TABS = ("customers", "fleet", "solve", "routes", "costs", "unassigned", "changes", "scenarios",
        "replan", "export", "drivers")


@pytest.mark.thorough
def test_german_pages_have_nothing_english(open_page: Callable[..., Page], service: str) -> None:
    page = open_page(service, locale="de-DE")
    idle(page)
    choose_example(page, "city_day")
    expect(page.locator(".result-line")).to_contain_text("bedient")
    idle(page)
    seen = page.evaluate(LEFT_OVERS)
    for tab in TABS:
        open_tab(page, tab)
        page.evaluate("""document.querySelectorAll('.panel details:not(.in-api)')
            .forEach((details) => { details.open = true; })""")
        seen += page.evaluate(LEFT_OVERS)
    open_tab(page, "routes")
    page.locator("tr[data-key^='c:'] button.link").first.click()
    page.get_by_role("button", name="Warum hier?").click()
    expect(page.get_by_text("Alle anderen bleiben, wo sie sind")).to_be_visible()
    seen += page.evaluate(LEFT_OVERS)
    for menu, button in (("settings", "Tasten"), ("open-menu", "Gespeichert"), (None, "Speichern")):
        if menu:
            page.locator(f"#{menu}-button").click()
            seen += page.evaluate(LEFT_OVERS)
        page.get_by_role("button", name=button, exact=True).click()
        expect(page.get_by_role("dialog")).to_be_visible()
        seen += page.evaluate(LEFT_OVERS)
        page.keyboard.press("Escape")
    page.get_by_role("button", name="Zeichnen", exact=True).click()
    for tool in page.locator(".draw-tools button").all():
        tool.click()
        seen += page.evaluate(LEFT_OVERS)
    assert sorted(set(seen)) == []


def closed() -> dict[str, Any]:
    """Return a problem of a hub whose drone may not land at its only customer, in strong gusts."""
    zone = {"identifier": "EDR1", "country": "DEU", "name": "Hafen", "type": "COMMON",
            "restriction": "REQ_AUTHORISATION", "zoneAuthority": [{"name": "Amt"}],
            "geometry": [{"uomDimensions": "M", "lowerLimit": 0, "lowerVerticalReference": "AGL",
                          "upperLimit": 500, "upperVerticalReference": "AMSL",
                          "horizontalProjection": {"type": "Circle", "center": [13.42, 52.5],
                                                   "radius": 500}}]}
    return {"coordinate_system": "geographic",
            "depots": [{"id": "Depot", "location": [13.4, 52.5]}],
            "customers": [{"id": "Anna", "location": [13.42, 52.5], "demand": [1]}],
            "fleet": [{"id": "Quad", "flies": True, "count": 2, "capacity": [2],
                       "max_wind_kmh": 30}],
            "airspace": {"zones": [{"format": "ed269", "data": {"features": [zone]}}],
                         "wind": [{"from": 0, "speed_kmh": 20, "gust_kmh": 25},
                                  {"from": 36000, "speed_kmh": 20, "gust_kmh": 40}]},
            "options": {"time_limit": 60, "search_iterations": 50}}


DOUBTFUL = """Kunde;Adresse;x;y;Von;Bis;kg;Soll
Anna;;11,58;48,14;8:00;2:00;5;1
Anna;;11,60;48,15;8:00;10:00;;2
Ben;;11,62;48,13;12:00;9:00 Z;1,250;3
Summe;;;;;;6,250;
Cleo;Tal 1;;;;;7;4
"""


@pytest.mark.thorough
def test_import_has_nothing_english_on_german_pages(open_page: Callable[..., Page],
                                                    service: str) -> None:
    page = open_page(service, locale="de-DE")
    idle(page)
    open_file(page, "touren.csv", DOUBTFUL)
    dialog = page.get_by_role("dialog")
    expect(dialog.get_by_text("Keine Arbeitszeit angegeben")).to_be_visible()
    expect(dialog.get_by_text("Spalte G: 1 Zelle ist leer, G3: Sie zählt 0.")).to_be_visible()
    expect(dialog.get_by_role("alert")).to_be_visible()
    dialog.evaluate("each => each.querySelectorAll('details').forEach((one) => one.open = true)")
    assert sorted(set(page.evaluate(LEFT_OVERS))) == []


@pytest.mark.thorough
def test_zones_and_wind_have_nothing_english_on_german_pages(
        open_page: Callable[..., Page], service: str) -> None:
    page = open_page(service, locale="de-DE")
    idle(page)
    open_file(page, "Hafen.json", json.dumps(closed()))
    planned(page, "0 von 1 bedient")
    open_tab(page, "unassigned")
    expect(page.locator(".panel")).to_contain_text(
        "Der Ort liegt in der Zone Hafen (EDR1): Fliegen braucht eine Genehmigung, vom Boden bis "
        "500 m \u00fcber dem Meer. Zust\u00e4ndig: Amt.")
    page.get_by_role("button", name="Anna").first.click()
    expect(page.get_by_role("region", name="Einzelheiten")).to_contain_text("Nicht mit Quad")
    seen = page.evaluate(LEFT_OVERS)
    open_tab(page, "fleet")
    expect(page.get_by_role("table", name="Wind je Stunde")).to_contain_text("Quad")
    seen += page.evaluate(LEFT_OVERS)
    assert sorted(set(seen)) == []


def test_language_changes_at_once_everywhere(console: Page) -> None:
    open_tab(console, "costs")
    console.locator("#settings-button").click()
    console.get_by_label("Language").select_option("de")
    expect(console.locator("#tab-costs")).to_have_text("Kosten")
    expect(console.locator("#total-cost")).to_have_text(re.compile(r"\d,\d\d"))
    expect(console.get_by_role("button", name="Tag abspielen")).to_be_visible()
    console.locator("#settings-button").click()
    console.get_by_label("Sprache").select_option("en")
    expect(console.locator("#tab-costs")).to_have_text("Costs")


def test_error_is_told_in_words_and_its_path_is_behind_a_click(
        open_page: Callable[..., Page], service: str) -> None:
    page = open_page(service, allow=("422",), locale="de-DE")
    request = json.loads((EXAMPLES / "smallest.json").read_text("utf-8"))
    request["fleet"][0]["speed_kmh"] = 0.1
    idle(page)
    open_file(page, "falsch.json", json.dumps(request))
    alert = page.get_by_role("alert")
    expect(alert).to_contain_text("Fahrzeugtyp truck \u203a Geschwindigkeit")
    expect(alert).to_contain_text("Die Zahl muss mindestens 1 sein.")
    expect(alert.locator("code")).to_be_hidden()
    page.locator("#settings-button").click()
    page.get_by_label("Ansicht für Entwickler").check()
    page.keyboard.press("Escape")
    alert.locator("summary").click()
    expect(alert.locator("code")).to_have_text("$.fleet[0].speed_kmh")


@pytest.mark.thorough
@pytest.mark.begins_with("city_day")
@pytest.mark.parametrize(("locale", "widths", "schemes"), [
    ("en-GB", (1440, 390), ("light", "dark")), ("de-DE", (1440, 1024), ("dark", "light"))])
def test_axe_finds_nothing_in_either_language(
        open_page: Callable[..., Page], service: str, locale: str, widths: tuple[int, ...],
        schemes: tuple[str, ...]) -> None:
    # Each language meets each scheme. Colours, by far the most work, are those of the scheme in any
    # language and at any width.
    page = open_page(service, locale=locale, color_scheme=schemes[0])
    expect(page.locator("#total-cost")).to_be_visible()
    seen = []
    for width, scheme, without in zip(widths, schemes, ([], COLOURS), strict=True):
        page.set_viewport_size({"width": width, "height": 900})
        open_tab(page, TABS[0])
        if page.locator("html").get_attribute("data-theme") != scheme:
            page.keyboard.press("l")
        expect(page.locator("html")).to_have_attribute("data-theme", scheme)
        seen += [f"{width}: {each}" for each in findings(page, None, without)]
        for tab in TABS[1:]:
            open_tab(page, tab)
            seen += [f"{width}: {each}" for each in findings(page, ".panel", without)]
    assert sorted(set(seen)) == []
