"""A page of a running service, which fails its test when something is wrong with it."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import httpx
import pytest
from playwright.sync_api import Browser, BrowserContext, ConsoleMessage, Page, Request, expect

from tests.conftest import PATIENCE
from tests.console.serving import VIEWPORT, WAIT_MS, chromium, new_context, shared
from tests.console.steps import awaited, beginning, idle

OF_A_PAGE = {"viewport", "color_scheme"}
"""What of a browser's context a page of another can be given."""

expect.set_options(timeout=WAIT_MS)


@pytest.fixture(scope="session")
def service(shared_folder: Path) -> Iterator[str]:
    """Return the address of a service with its real planner; see `tests.console.service`.

    All processes that run tests ask it, so that plans may have to wait for each other.
    """
    with shared(shared_folder / "console", "tests.console.service",
                TANDEM_MAX_CONCURRENT_PLANS="4", TANDEM_MAX_QUEUED_PLANS="100",
                TANDEM_MAX_QUEUE_SECONDS=str(PATIENCE)) as address:
        yield address


@pytest.fixture
def client(service: str) -> Iterator[httpx.Client]:
    """Return who tells the service what doesn't come from a page."""
    with httpx.Client(base_url=service, trust_env=False, timeout=PATIENCE) as client:
        yield client


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """Return the browser."""
    with chromium() as browser:
        yield browser


class Complaints:
    """What a page's console and network complain of.

    Parameters
    ----------
    page
        The page to listen to.
    address
        Of its service: whatever is asked elsewhere is complained of.
    allow
        Texts of errors that the test provokes.
    """

    def __init__(self, page: Page, address: str, allow: tuple[str, ...] = ()) -> None:
        self.texts: list[str] = []
        self._address = address
        self._allow = allow
        page.on("console", self._hear)
        page.on("pageerror", lambda error: self._note(f"error: {error}"))
        page.on("request", self._see)

    def _note(self, text: str) -> None:
        if not any(part in text for part in self._allow):
            self.texts.append(text)

    def _hear(self, message: ConsoleMessage) -> None:
        if message.type in ("error", "warning"):
            self._note(f"console {message.type}: {message.text}")

    def _see(self, request: Request) -> None:
        if not request.url.startswith((self._address, "data:", "blob:", "about:")):
            self._note(f"asked elsewhere: {request.url}")


@pytest.fixture
def begins_with(request: pytest.FixtureRequest) -> str:
    """Return the example that a console begins with: little, as most tests open another at once."""
    marker = request.node.get_closest_marker("begins_with")
    return "smallest" if marker is None else str(marker.args[0])


@contextmanager
def opening(browser: Browser, visitor: BrowserContext | None = None, example: str = "table1",
            ) -> Iterator[Callable[..., Page]]:
    """Yield a function that opens a page; what its console or network complain of is an error.

    Keywords are those of a browser's context, such as `locale`; `allow` are texts of errors that
    the test provokes. A console begins with an example.

    The first page is `visitor`'s, if that is given and has no page of a test open, unless the
    keywords ask for what a page can't be given.
    """
    complaints: list[Complaints] = []
    contexts: list[BrowserContext] = []

    def opener(address: str, allow: tuple[str, ...] = (), **options: Any) -> Page:
        if visitor and len(visitor.pages) == 1 and options.keys() <= OF_A_PAGE:
            page = visitor.new_page()
            forget(visitor, page, address)
            page.set_viewport_size(options.get("viewport", VIEWPORT))
            page.emulate_media(color_scheme=options.get("color_scheme", "light"))
        else:
            contexts.append(new_context(browser, **options))
            page = contexts[-1].new_page()
        complaints.append(Complaints(page, address.partition("#")[0], allow))
        page.goto(beginning(address, example))
        return page

    yield opener
    for context in contexts:
        context.close()
    if visitor is not None:
        leave(visitor)
    assert [text for each in complaints for text in each.texts] == []


@pytest.fixture
def open_page(browser: Browser, visitor: BrowserContext, begins_with: str,
              ) -> Iterator[Callable[..., Page]]:
    """Return what `opening` yields, for one test."""
    with opening(browser, visitor, begins_with) as opener:
        yield opener


@pytest.fixture(scope="module")
def console(browser: Browser, service: str) -> Iterator[Page]:
    """Return a console for the tests of a module that leave nothing behind that others meet."""
    with opening(browser) as opener:
        page = opener(service)
        expect(page.locator("#total-cost")).to_be_visible()
        yield page


@pytest.fixture(scope="session")
def visitor(browser: Browser) -> Iterator[BrowserContext]:
    """Return one browser's visitor for all tests that begin with a console as it is at first.

    Who comes again has the files of the console at hand: that is half of what opening it takes.
    """
    context = new_context(browser)
    context.new_page()
    yield context
    context.close()


@pytest.fixture
def page(request: pytest.FixtureRequest, begins_with: str) -> Page:
    """Return the console with an example planned, to whoever has never been there.

    All tests of a module that is marked `one_page` share a page, set back through its store; there
    only an example that a test says to begin with is planned.
    """
    if request.node.get_closest_marker("one_page") is None:
        opened: Page = request.getfixturevalue("page_of_its_own")
        return opened
    console: Page = request.getfixturevalue("console")
    set_back(console, begins_with,
             is_planned=request.node.get_closest_marker("begins_with") is not None)
    return console


@pytest.fixture
def page_of_its_own(visitor: BrowserContext, service: str, begins_with: str) -> Iterator[Page]:
    """Return a page that is opened for a test."""
    leave(visitor)
    page = visitor.new_page()
    forget(visitor, page, service)
    complaints = Complaints(page, service)
    page.goto(beginning(service, begins_with))
    expect(page.locator("#total-cost")).to_be_visible()
    yield page
    leave(visitor)
    assert complaints.texts == []


AS_AT_FIRST = """async ([example, isPlanned]) => {
  const [{ store }, { openRequest }, { plan }] = await Promise.all(
    ['store', 'actions', 'planning'].map((name) => loaded(`${name}.js`)));
  const parts = await Promise.all(['looking', 'plans', 'problem', 'scenarios'].map(
    async (name) => Object.values(await loaded(`state/${name}.js`))));
  localStorage.clear();
  sessionStorage.clear();
  document.documentElement.dataset.theme = 'light';
  const { language, examples, epoch, request: former, stated } = store.get();
  // Another language is another page: what views keep for themselves is gone.
  store.set({
    ...Object.assign({}, ...parts.flat()), epoch, request: former, stated, language: null });
  for (let frames = 2; frames; frames -= 1) await new Promise(requestAnimationFrame);
  const { request } = examples.find(({ name }) => name === example);
  openRequest(request, { name: example, isSafe: true });
  store.set({ language });
  if (isPlanned) await plan();
}"""


def set_back(page: Page, example: str, *, is_planned: bool) -> None:
    """Have a console show an example and nothing of what was done before. In place."""
    page.unroute_all()
    page.set_viewport_size(VIEWPORT)
    page.emulate_media(media="screen", color_scheme="light")
    page.mouse.move(0, 0)
    awaited(page, AS_AT_FIRST, [example, is_planned])
    if is_planned:
        idle(page)


def leave(visitor: BrowserContext) -> None:
    """Close what a test has opened. In place."""
    for page in visitor.pages[1:]:
        page.close()
    visitor.unroute_all()


def forget(visitor: BrowserContext, page: Page, address: str) -> None:
    """Have a browser forget what it keeps for a service, but for the service's files. In place."""
    session = visitor.new_cdp_session(page)
    session.send("Storage.clearDataForOrigin", {"origin": address, "storageTypes": "all"})
    session.detach()
