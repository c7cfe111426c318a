"""Where a vehicle is: told by its driver's phone if the driver allows it, seen on the map."""

from collections.abc import Callable, Iterator

import httpx
import pytest
from playwright.sync_api import Browser, BrowserContext, Page, expect

from tests.app.records.days.living import begun, standing
from tests.app.records.days.test_positions import MUNICH
from tests.conftest import eventually
from tests.console.serving import new_context
from tests.console.test_drivers import PHONE
from tests.console.test_everyone import findings
from tests.console.test_lived_day import link_of_driver

pytestmark = [pytest.mark.slow, pytest.mark.thorough]


@pytest.fixture
def phone(browser: Browser) -> Iterator[BrowserContext]:
    """Return a driver's phone."""
    context = new_context(browser, **PHONE, geolocation={"longitude": 11.51, "latitude": 48.1})
    yield context
    context.close()


def test_position_is_told_once_the_driver_allows_it_and_seen_on_the_map(
        client: httpx.Client, service: str, open_page: Callable[..., Page],
        phone: BrowserContext) -> None:
    day = begun(client, MUNICH, clock=None)
    desk = open_page(f"{service}/#day={day}")
    expect(desk.get_by_role("timer")).to_be_visible()
    phone.grant_permissions(["geolocation"], origin=service)
    driver = phone.new_page()
    driver.goto(link_of_driver(client, day))
    sharing = driver.get_by_role("switch", name="Share where I am")
    expect(sharing).not_to_be_checked()
    expect(driver.get_by_text("Your dispatcher alone sees it")).to_be_visible()
    assert findings(driver) == []
    assert standing(client, day).vehicles[0].position is None
    sharing.check()
    mark = desk.locator(".sight-mark")
    expect(mark).to_contain_text("van, ")
    expect(mark).to_contain_text(" ago")
    assert standing(client, day).vehicles[0].position == (11.51, 48.1)

    # It is remembered, and what was told without network comes later.
    driver.evaluate("navigator.serviceWorker.ready.then(() => true)")
    phone.set_offline(True)
    phone.set_geolocation({"longitude": 11.52, "latitude": 48.1})
    driver.reload()
    expect(sharing).to_be_checked()
    expect(driver.get_by_role("status")).to_contain_text("No network")
    phone.set_offline(False)
    driver.evaluate("dispatchEvent(new Event('online'))")
    eventually(lambda: standing(client, day).vehicles[0].position == (11.52, 48.1))
    sharing.uncheck()
    driver.reload()
    expect(driver.get_by_role("status")).to_have_text("All is sent.")
    expect(sharing).not_to_be_checked()


def test_phone_that_refuses_says_so(client: httpx.Client, phone: BrowserContext) -> None:
    day = begun(client, MUNICH, clock=None)
    driver = phone.new_page()
    driver.goto(link_of_driver(client, day))
    sharing = driver.get_by_role("switch", name="Share where I am")
    sharing.click()
    expect(driver.get_by_role("alert")).to_contain_text("allow it for this page")
    expect(sharing).not_to_be_checked()
    assert standing(client, day).vehicles[0].position is None
