"""A page of a running service, which fails its test when something is wrong with it."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import pytest
from playwright.sync_api import Browser, BrowserContext, Page, expect

from tests.console.serving import chromium, serving

WAIT_MS, OPENING_MS = 30_000, 120_000
"""For what a page does, and for opening one while other tests have all cores."""

expect.set_options(timeout=WAIT_MS)


@pytest.fixture(scope="session")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Return the address of a service with its real planner."""
    with serving(tmp_path_factory.mktemp("console")) as address:
        yield address


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """Return the browser."""
    with chromium() as browser:
        yield browser


@contextmanager
def opening(browser: Browser) -> Iterator[Callable[..., Page]]:
    """Yield a function that opens a page; what its console or network complain of is an error.

    Keywords are those of a browser's context, such as `color_scheme`; `allow` are texts of errors
    that the test provokes.
    """
    complaints: list[str] = []
    contexts: list[BrowserContext] = []

    def opener(address: str, allow: tuple[str, ...] = (), **options: Any) -> Page:
        context = browser.new_context(**{"viewport": {"width": 1440, "height": 900}} | options)
        contexts.append(context)
        context.set_default_navigation_timeout(OPENING_MS)
        page = context.new_page()

        def note(text: str) -> None:
            if not any(part in text for part in allow):
                complaints.append(text)

        page.on("console", lambda message: note(f"console {message.type}: {message.text}")
                if message.type in ("error", "warning") else None)
        page.on("pageerror", lambda error: note(f"error: {error}"))
        page.on("request", lambda request: note(f"asked elsewhere: {request.url}")
                if not request.url.startswith((address, "data:", "blob:")) else None)
        page.goto(address)
        return page

    yield opener
    for context in contexts:
        context.close()
    assert complaints == []


@pytest.fixture
def open_page(browser: Browser) -> Iterator[Callable[..., Page]]:
    """Return what `opening` yields, for one test."""
    with opening(browser) as opener:
        yield opener


@pytest.fixture(scope="module")
def console(browser: Browser, service: str) -> Iterator[Page]:
    """Return a console for the tests of a module that leave nothing behind that others meet."""
    with opening(browser) as opener:
        page = opener(service)
        expect(page.locator("#total-cost")).to_be_visible()
        yield page


@pytest.fixture
def page(open_page: Callable[..., Page], service: str) -> Page:
    """Return the console with its first example planned."""
    page = open_page(service)
    expect(page.locator("#total-cost")).to_be_visible()
    return page
