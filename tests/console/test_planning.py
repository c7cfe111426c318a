"""Planning as it happens: the decoded plan, improvements, the cost curve, stopping."""

from collections.abc import Callable

from playwright.sync_api import Page, Route, expect

from tests.console.steps import idle, let_search, open_advanced, open_tab, state, stop_button


def set_option(page: Page, name: str, value: str) -> None:
    """Set one of the options of planning."""
    field = page.locator(f"#field-options-{name}")
    field.fill(value)
    field.press("Enter")


def test_decoded_plan_comes_at_once_and_improvements_follow(page: Page) -> None:
    idle(page)
    open_tab(page, "solve")
    set_option(page, "time_limit", "3")
    page.get_by_role("button", name="Plan", exact=True).click()
    expect(page.locator(".result-line")).to_contain_text("Improving")
    first = state(page, "state.run.points.0.cost")
    idle(page)
    points = state(page, "state.run.points")
    assert len(points) >= 2
    assert points[-1]["cost"] < first
    assert points[-1]["cost"] == min(point["cost"] for point in points)
    expect(page.get_by_text("From ", exact=False).first).to_be_visible()
    expect(page.locator(".curve canvas")).to_be_visible()
    assert abs(float(page.locator("#total-cost").inner_text()) - points[-1]["cost"]) < 0.01


def test_planning_is_stopped_with_the_best_plan_so_far(page: Page) -> None:
    idle(page)
    open_tab(page, "solve")
    set_option(page, "time_limit", "50")
    page.get_by_role("button", name="Plan", exact=True).click()
    expect(page.locator(".result-line")).to_contain_text("Improving")
    stop_button(page).click()
    idle(page)
    assert state(page, "state.run.state") == "idle"
    expect(page.get_by_text("100 of 100 served")).to_be_visible()


def test_policy_and_decoding_are_chosen(page: Page) -> None:
    idle(page)
    open_tab(page, "solve")
    expect(page.locator("#field-options-policy")).to_be_hidden()
    open_advanced(page)
    page.locator("#field-options-policy").select_option("pointer")
    page.locator("#field-options-decoding").select_option("sample")
    set_option(page, "num_samples", "4")
    set_option(page, "time_limit", "0")
    page.get_by_role("button", name="Plan", exact=True).click()
    expect(page.get_by_text("pointer, sample")).to_be_visible()
    idle(page)


def test_lost_connection_is_told_in_words(open_page: Callable[..., Page], service: str) -> None:
    page = open_page(service, allow=("ERR_FAILED", "Failed to load"))
    expect(page.locator("#total-cost")).to_be_visible()
    idle(page)
    page.route("**/plan", lambda route: route.abort())
    page.get_by_role("button", name="Plan", exact=True).click()
    expect(page.get_by_role("alert")).to_contain_text("The service does not answer.")


def test_stream_that_breaks_is_taken_up_again(open_page: Callable[..., Page],
                                              service: str) -> None:
    page = open_page(service, allow=("ERR_FAILED", "Failed to load"))
    idle(page)
    tries: list[str] = []

    def break_once(route: Route) -> None:
        tries.append(route.request.url)
        if len(tries) == 1:
            route.abort()
        else:
            route.continue_()

    page.route("**/events", break_once)
    let_search(page, 1.1)
    page.get_by_role("button", name="Plan", exact=True).click()
    expect(page.locator(".result-line")).to_contain_text("Improving")
    idle(page)
    assert len(tries) == 2
    assert state(page, "state.failure") is None
    assert float(page.locator("#total-cost").inner_text()) < 880
