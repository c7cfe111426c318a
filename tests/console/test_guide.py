"""From the console to the guide, where one finds what one looks for."""

import re
from collections.abc import Callable

import pytest
from playwright.sync_api import Page, expect

from tests.console.test_everyone import findings

pytestmark = pytest.mark.slow


def test_console_leads_to_the_guide_which_can_be_searched(
        open_page: Callable[..., Page], service: str) -> None:
    page = open_page(service)
    page.get_by_role("link", name="Help").click()
    expect(page.get_by_role("heading", name="Tandem", level=1)).to_be_visible()
    page.get_by_role("button", name="Search").first.click()
    page.locator("input[aria-label=Search]").fill("endurance")
    page.get_by_role("option").first.click()
    expect(page).to_have_url(re.compile("/guide/.+"))
    expect(page.get_by_role("article")).to_contain_text("endurance")
    assert findings(page) == []


@pytest.mark.thorough
def test_documentation_of_the_api_leads_to_the_guide(
        open_page: Callable[..., Page], service: str) -> None:
    page = open_page(service)
    page.goto(f"{service}/docs")
    with page.expect_popup() as opened:
        page.get_by_role("link", name="guide").click()
    expect(opened.value).to_have_url(f"{service}/guide/")
