"""What is worked on outlives the page, and what is saved is found again, compared and shared."""

import re
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, Error, Locator, Page, expect

from tests.conftest import soon
from tests.console.conftest import opening
from tests.console.serving import launched
from tests.console.steps import beginning, idle, let_search, open_example, open_tab, state
from tests.console.test_everyone import findings

pytestmark = pytest.mark.slow

SMALL = "smallest"


def edit(page: Page, name: str) -> None:
    """Rename the first customer, and wait until the browser has kept that."""
    page.evaluate("""async (name) => {
      const { edit } = await loaded(`actions.js`);
      const { keepNow } = await loaded(`keeping/drafts.js`);
      edit(({ customers: [first, ...others], ...request }) => ({
        ...request, customers: [{ ...first, id: name }, ...others] }));
      await keepNow();
    }""", name)


def first_customer(page: Page) -> Any:
    """Return the id of the first customer."""
    return state(page, "state.request.customers.0.id")


def another(page: Page, address: str) -> Page:
    """Open another tab beside a page."""
    tab = page.context.new_page()
    tab.goto(beginning(address, SMALL))
    expect(tab.locator("#total-cost")).to_be_visible()
    return tab


def loaded_anew(page: Page) -> Page:
    """Load a page anew."""
    page.reload()
    expect(page.locator("#total-cost")).to_be_visible()
    return page


def save(page: Page, name: str, where: str) -> None:
    """Save what is open by a name."""
    page.keyboard.press("Control+s")
    page.locator("#save-name").fill(name)
    page.get_by_label(where).check()
    page.locator("#save-as").click()
    expect(page.get_by_role("dialog")).to_have_count(0)
    expect(page.locator("#save")).to_be_disabled()


def saved(page: Page) -> Locator:
    """Open the list of saved plans, once it is read."""
    page.locator("#open-menu-button").click()
    page.locator("#saved-plans").click()
    plans = page.get_by_role("list", name="Saved plans")
    expect(plans).to_be_attached()
    return plans


def refused(page: Page, told: str) -> None:
    """Expect to be told that the browser keeps nothing, while plans are made."""
    expect(page.get_by_role("alert")).to_contain_text(told)
    idle(page)
    page.keyboard.press("Control+s")
    page.locator("#save-as").click()
    expect(page.get_by_role("dialog").get_by_role("alert")).to_contain_text(told)


@pytest.fixture
def alone(browser: Browser, service: str) -> Iterator[Page]:
    """Return a page of a browser of its own, which takes none of another test with it."""
    with launched(browser.browser_type) as other, opening(other, example=SMALL) as opener:
        page = opener(service)
        expect(page.locator("#total-cost")).to_be_visible()
        yield page


def test_crash_and_reload_lose_nothing(alone: Page, service: str) -> None:
    page = alone
    open_example(page, SMALL)
    open_tab(page, "changes")
    page.get_by_role("button", name="One truck more").click()
    expect(page.locator("input[name=shown]")).to_have_count(2)
    idle(page)
    edit(page, "Zoe")
    expect(page.get_by_role("img", name="not saved")).to_be_visible()
    assert page.title() == "\u2022 Two customers \u2013 Tandem"
    before = [state(page, f"state.{part}") for part in ("request", "plans", "past", "besides")]
    with pytest.raises(Error, match="crash"):
        page.goto("chrome://crash")
    tab = another(page, service)
    for _ in ("after the crash", "loaded anew"):
        assert [state(tab, f"state.{part}") for part in
                ("request", "plans", "past", "besides")] == before
        assert tab.title() == "\u2022 Two customers \u2013 Tandem"
        expect(tab.get_by_text("The problem has changed since")).to_be_visible()
        loaded_anew(tab)
    tab.keyboard.press("u")
    expect(tab.get_by_text("The problem has changed since")).to_have_count(0)


@pytest.mark.thorough
def test_tabs_do_not_overwrite_each_other(page: Page, service: str) -> None:
    open_example(page, SMALL)
    edit(page, "one")
    tab = another(page, service)
    open_example(tab, SMALL)
    edit(tab, "two")
    assert [first_customer(loaded_anew(each)) for each in (page, tab)] == ["one", "two"]
    # As browsers do when a tab is duplicated.
    draft = page.evaluate("sessionStorage.getItem('tandem-draft')")
    tab.evaluate("(draft) => sessionStorage.setItem('tandem-draft', draft)", draft)
    assert first_customer(loaded_anew(tab)) == "one"
    edit(tab, "three")
    edit(page, "four")
    assert [first_customer(loaded_anew(each)) for each in (page, tab)] == ["four", "three"]
    page.close()
    tab.wait_for_function("async () => (await navigator.locks.query()).held.length <= 1")
    tab.keyboard.press("o")
    drafts = tab.get_by_role("list", name="Drafts").get_by_role("listitem")
    expect(drafts).to_have_count(2)
    drafts.first.get_by_role("button", name="Go on with Two customers").click()
    expect(tab.get_by_role("dialog")).to_have_count(0)
    assert first_customer(tab) == "four"
    assert first_customer(loaded_anew(tab)) == "four"


@pytest.mark.thorough
def test_tab_that_lost_its_draft_goes_on_with_a_copy(page: Page) -> None:
    open_example(page, SMALL)
    edit(page, "one")
    page.evaluate("""async () => {
      const { readDraft } = await loaded(`keeping/draft-records.js`);
      await readDraft(sessionStorage.getItem('tandem-draft'), 'another tab');
    }""")
    edit(page, "two")
    drafts = page.evaluate("""async () => {
      const { listDrafts } = await loaded(`keeping/draft-records.js`);
      return (await listDrafts()).filter(({ isTrivial }) => !isTrivial).length;
    }""")
    assert drafts == 2
    assert first_customer(loaded_anew(page)) == "two"


@pytest.mark.thorough
def test_what_was_being_planned_is_found_again(page: Page) -> None:
    idle(page)
    let_search(page, 600)
    page.keyboard.press("p")
    expect(page.locator(".result-line")).to_contain_text("Improving")
    job = soon(lambda: state(page, "state.run.job"))
    edit(page, "Zoe")
    loaded_anew(page)
    expect(page.locator(".result-line")).to_contain_text("Improving")
    assert state(page, "state.run.job") == job
    page.keyboard.press("s")
    idle(page)
    assert state(page, "state.plans.length") == 2


@pytest.mark.thorough
@pytest.mark.parametrize("where", ["This browser", "The service"])
def test_change_in_another_tab_is_not_overwritten_unseen(
        open_page: Callable[..., Page], service: str, where: str) -> None:
    page = open_page(service, allow=("412",))
    idle(page)
    open_example(page, SMALL)
    save(page, f"Monday {where}", where)
    assert page.title() == f"Monday {where} \u2013 Tandem"
    tab = another(page, service)
    saved(tab).get_by_role("button", name=f"Open Monday {where}").click()
    expect(tab.locator("#problem-name")).to_contain_text("Monday")
    edit(tab, "theirs")
    tab.keyboard.press("Control+s")
    expect(tab.locator("#save")).to_be_disabled()
    edit(page, "mine")
    page.keyboard.press("Control+s")
    expect(page.get_by_role("heading", name="Changed elsewhere")).to_be_visible()
    page.get_by_role("button", name="Save as another").click()
    page.locator("#save-name").fill("mine")
    page.locator("#save-as").click()
    plans = saved(page)
    expect(plans.get_by_role("button", name="Open mine")).to_have_count(1)
    plans.get_by_role("button", name=f"Open Monday {where}").click()
    expect(page.get_by_role("dialog")).to_have_count(0)
    assert first_customer(page) == "theirs"
    for name in ("mine", f"Monday {where}"):
        plans = saved(page)
        plans.get_by_role("button", name=f"Delete {name}").click()
        page.get_by_role("button", name="Delete for good").click()
        expect(plans.get_by_text(name)).to_have_count(0)
        page.keyboard.press("Escape")
    expect(page.locator("#save")).to_be_enabled()


@pytest.mark.thorough
def test_saved_plan_stands_beside_the_open_one(page: Page) -> None:
    open_example(page, SMALL)
    save(page, "as it was", "This browser")
    page.evaluate("""async () => {
      const { edit } = await loaded(`actions.js`);
      edit((request) => ({ ...request, customers: request.customers.slice(1) }));
    }""")
    page.keyboard.press("p")
    expect(page.locator(".result-line")).to_contain_text("1 of 1 served")
    idle(page)
    saved(page).get_by_role("button", name="Compare as it was with what is open").click()
    expect(page.locator("#differences")).to_be_visible()
    assert first_customer(page) != state(page, "state.plans.2.request.customers.0.id")
    assert state(page, "state.besides") == 3


def test_one_click_keeps_a_plan_for_all_and_makes_a_link_to_it(
        page: Page, open_page: Callable[..., Page], service: str) -> None:
    open_example(page, SMALL)
    page.get_by_role("button", name="Share", exact=False).click()
    url = page.locator("#share-url").input_value()
    assert state(page, "state.home.where") == "service"
    visitor = open_page(service)
    visitor.goto("about:blank")
    visitor.goto(url)
    expect(visitor.get_by_text("You look at a shared plan")).to_be_visible()
    expect(visitor.locator(".result-line")).to_contain_text("2 of 2 served")


def test_link_opens_a_plan_without_a_key(page: Page, open_page: Callable[..., Page],
                                         service: str) -> None:
    open_example(page, SMALL)
    save(page, "for all", "The service")
    saved(page).get_by_role("button", name="Share for all").first.click()
    page.get_by_role("button", name="Make a link").click()
    url = page.locator("#share-url").input_value()
    visitor = open_page(service, allow=("401", "404"))
    asked: list[str] = []
    visitor.on("request", lambda request: asked.append(request.url))
    visitor.context.route(re.compile(r"/(plan|plans|jobs)(\?.*)?$"),
                          lambda route: route.fulfill(status=401, json={}))
    visitor.goto("about:blank")
    visitor.goto(url)
    expect(visitor.get_by_text("You look at a shared plan")).to_be_visible()
    expect(visitor.locator(".result-line")).to_contain_text("2 of 2 served")
    expect(visitor.get_by_role("dialog")).to_have_count(0)
    token = url.partition("#shared=")[2]
    assert token
    assert not [address for address in asked if token in address.partition("#")[0]]
    edit(visitor, "mine")
    expect(visitor.get_by_text("You look at a shared plan")).to_have_count(0)
    assert "#" not in visitor.url
    page.get_by_role("list", name="Links").get_by_role("button", name="End").click()
    expect(page.get_by_role("list", name="Links").get_by_role("listitem")).to_have_count(0)
    visitor.goto(f"{service}/#shared={token}")
    expect(visitor.get_by_role("alert")).to_contain_text("There is no such link")
    assert first_customer(visitor) == "mine"


@pytest.mark.thorough
def test_browser_that_keeps_nothing_says_so(page: Page) -> None:
    page.add_init_script("Object.defineProperty(window, 'indexedDB', { get() { "
                         "throw new DOMException('no', 'SecurityError'); } });")
    loaded_anew(page)
    refused(page, "keeps nothing here")


@pytest.mark.thorough
def test_browser_without_room_says_so(page: Page) -> None:
    idle(page)
    page.evaluate("() => { IDBObjectStore.prototype.put = () => { "
                  "throw new DOMException('full', 'QuotaExceededError'); }; }")
    # The notice of a draft that isn't kept may come before, with a button of the same name.
    page.locator("#save").click()
    page.locator("#save-as").click()
    expect(page.get_by_role("dialog").get_by_role("alert")).to_contain_text("has no room left")
    page.keyboard.press("Escape")
    page.keyboard.press("p")
    refused(page, "has no room left")


@pytest.mark.thorough
@pytest.mark.parametrize("options", [
    {"color_scheme": "dark"}, {"viewport": {"width": 390, "height": 844}}], ids=["dark", "phone"])
def test_everyone_can_save(open_page: Callable[..., Page], service: str,
                           options: dict[str, object]) -> None:
    page = open_page(service, **options)
    expect(page.locator("#total-cost")).to_be_visible()
    page.keyboard.press("Control+s")
    for view in ("save", "plans"):
        dialog = page.get_by_role("dialog")
        expect(dialog).to_be_visible()
        assert findings(page, impacts=None) == []
        widths = page.evaluate("""() => {
          const { scrollWidth, clientWidth } = document.querySelector('dialog');
          return [scrollWidth, clientWidth];
        }""")
        assert widths[0] <= widths[1]
        if view == "save":
            page.locator("#save-name").press("Enter")
            expect(dialog).to_have_count(0)
            page.keyboard.press("o")
            expect(page.get_by_role("list", name="Saved plans")).to_be_attached()
