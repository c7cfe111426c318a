"""Customers' page on a phone."""

from collections.abc import Iterator

import httpx
import pytest
from playwright.sync_api import Browser, Page, expect

from app.serving.settings import Settings
from tests.app.conftest import SearchingPlanner, ready, serving
from tests.app.records.days.living import PROBLEM, begun, clock, standing, told
from tests.console.serving import new_context
from tests.console.test_everyone import findings

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[httpx.Client]:
    """Return a client of a service of this module's own."""
    settings = Settings(data_dir=tmp_path_factory.mktemp("visited"), role="api", drain_seconds=0)
    with serving(SearchingPlanner(), settings) as client:
        yield ready(client)


@pytest.fixture
def page(browser: Browser) -> Iterator[Page]:
    """Return a page of a phone whose clock stands still until it is told."""
    context = new_context(browser, viewport={"width": 390, "height": 844}, locale="en-GB")
    page = context.new_page()
    page.clock.install()
    yield page
    context.close()


def test_customer_sees_when_who_comes_and_what_changed(client: httpx.Client, page: Page) -> None:
    day = begun(client, {**PROBLEM, "plan_start": "2026-06-01T08:00:00+02:00"})
    vehicle = next(each.vehicle for each in standing(client, day).orders if each.id == "A")
    url = next(link["url"] for link in client.get(f"/days/{day}/links").json()["links"]
               if link["order"] == "A")
    page.goto(url)
    expect(page.get_by_role("heading", name="Your delivery")).to_be_visible()
    expect(page.get_by_text("Between 8:")).to_be_visible()
    expect(page.get_by_text(f"{vehicle} brings it.")).to_be_visible()
    assert findings(page) == []
    told(client, day, clock(), {"kind": "vehicle.departed", "vehicle": vehicle, "at": 100},
         {"kind": "vehicle.delayed", "vehicle": vehicle, "by": 900}, at=101)
    page.clock.run_for(31_000)
    expect(page.get_by_role("heading", name="What changed")).to_be_visible()
    page.get_by_label("Language").select_option("de")
    expect(page.get_by_text("Was sich geändert hat")).to_be_visible()
    told(client, day, {"kind": "vehicle.served", "vehicle": vehicle, "order": "A"}, at=1500)
    page.clock.run_for(31_000)
    expect(page.get_by_text("Sie wurde zugestellt.")).to_be_visible()
    page.goto(url[:-3])
    page.reload()
    expect(page.get_by_text("Dieser Link ist nicht gültig.")).to_be_visible()
