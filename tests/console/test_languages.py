"""The console in the language of whoever looks at it."""

from collections.abc import Callable

from playwright.sync_api import Page, expect

from tests.console.steps import idle


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
