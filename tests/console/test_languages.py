"""The console in the language of whoever looks at it."""

import json
import re
import subprocess
from collections.abc import Callable
from functools import cache
from typing import Any

from playwright.sync_api import Page, expect

from app.schemas.request import PlanRequest
from tests.console.steps import ROOT, STATIC, idle

FORMS = (
    "CustomerInput", "TimeWindowInput", "VehiclesInput", "DepotInput", "PlaceInput",
    "VehicleTypeInput", "CostsInput", "SpeedChangeInput", "ShiftInput", "OvertimeInput",
    "DronesInput", "TurnaroundInput", "DroneCostsInput", "EnergyInput", "PowerInput", "ClimbInput",
    "WindInput", "LoadDimensionInput", "OptionsInput",
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
    page = (ROOT / "docs" / "warnings.md").read_text("utf-8")
    codes = re.findall(r"^\| `([A-Z_]+)`", page, re.MULTILINE)
    assert len(codes) > 20
    for language in ("en", "de"):
        assert [code for code in codes if code not in texts_of(language)["said"]] == []
