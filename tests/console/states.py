"""Makes pictures of the console in every state, to be looked at: they aren't kept.

Run as `python -m tests.console.states FOLDER`, with names of states behind it for these alone. Each
is shown at three widths, in both languages, in light and dark: one page of a language goes through
all states, and is resized and darkened for each.
"""

import json
import re
import sys
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import httpx
from playwright.sync_api import Page, ViewportSize, expect

from examples.many import many_customers, swept_reply
from examples.deliveries import sheet
from tests.app.records.days.living import begun, told
from tests.conftest import PATIENCE
from tests.console.serving import chromium, new_context, serving
from tests.console.steps import (
    EXAMPLES, awaited, choose_example, idle, open_file, open_tab, place_of,
)

SIZES: tuple[ViewportSize, ...] = (
    {"width": 1440, "height": 900}, {"width": 1024, "height": 768}, {"width": 390, "height": 844})
LANGUAGES = ("en", "de")

OPEN = """async (text) => {
  const { openRequest } = await loaded(`actions.js`);
  const { request, plan } = JSON.parse(text);
  const plans = plan ? [{ number: 1, name: 'Plan', request, plan, numbers: null }] : [];
  const name = plan ? '1000' : 'Montag';
  openRequest(request, { name, plans, shown: plan ? 1 : null, isSafe: true });
}"""


def open_example(page: Page, name: str) -> None:
    """Open an example and wait for its plan, whatever the language."""
    choose_example(page, name)
    idle(page)


def example(name: str) -> dict[str, Any]:
    """Return the request of an example."""
    return dict(json.loads((EXAMPLES / f"{name}.json").read_text("utf-8")))


def show(page: Page, request: dict[str, Any], name: str) -> None:
    """Open a problem and wait for its plan."""
    open_file(page, f"{name}.json", json.dumps(request))
    idle(page)
    page.wait_for_function("() => !document.querySelector('.failure')")


def empty(page: Page) -> None:
    """Nothing yet: no customers, no depots."""
    awaited(page, OPEN, json.dumps({"request": {
        "coordinate_system": "geographic", "depots": [], "customers": [], "fleet": []}}))
    open_tab(page, "customers")


def unplanned(page: Page) -> None:
    """Customers, and no plan."""
    awaited(page, OPEN, json.dumps({"request": example("berlin")}))
    open_tab(page, "routes")


def wrong(page: Page) -> None:
    """A problem that can't be planned: two errors of a form."""
    request = example("city_day")
    request["customers"][0]["demand"] = [-3, 4]
    request["fleet"][0]["speed_kmh"] = 0
    request["fleet"][1]["depot"] = "hub-west"
    open_file(page, "wrong.json", json.dumps(request))
    expect(page.get_by_role("alert").first).to_be_visible()


def plan_made(page: Page) -> None:
    """A plan of forty places."""
    open_example(page, "berlin")
    open_tab(page, "customers")


def routes(page: Page) -> None:
    """Tours, with one stop's details."""
    open_example(page, "berlin")
    open_tab(page, "routes")


def details(page: Page) -> None:
    """A selected customer."""
    open_example(page, "city_day")
    open_tab(page, "customers")
    page.mouse.click(*place_of(page, "c:restaurant-03"))


def costs(page: Page) -> None:
    """What a plan costs."""
    open_example(page, "city_day")
    open_tab(page, "costs")


def solving(page: Page) -> None:
    """How to plan."""
    open_example(page, "city_day")
    open_tab(page, "solve")


def left_out(page: Page) -> None:
    """Customers for whom there is no room."""
    request = example("berlin")
    request["fleet"][0] |= {"count": 1, "shift": {"earliest": 28800, "latest": 36000}}
    show(page, request, "one van")
    open_tab(page, "unassigned")


def importing(page: Page) -> None:
    """A spreadsheet as it was read."""
    open_example(page, "smallest")
    page.locator("#file-input").set_input_files(
        {"name": "touren.csv", "mimeType": "text/csv", "buffer": sheet()})
    page.locator("#import-depot").fill("48.1402, 11.5600")
    page.keyboard.press("Tab")
    expect(page.locator("#use-import")).to_be_enabled()
    expect(page.locator(".import")).to_have_attribute("aria-busy", "false")


def import_asks(page: Page) -> None:
    """A spreadsheet of which much is to be asked."""
    close_import(page)
    open_example(page, "smallest")
    lines = ["Ref;Kunde;Breite;Länge;Liefern;Holen;Wunsch;Team",
             "1;Anders;48,14;11,57;3;;9-12;A", "2;Berger;48,15;11,58;;2;;B",
             "2;Berger;48,15;11,58;;2;;B", "3;Cremer;48,13;11,55;2;;14-16;A",
             "Summe;;;;5;4;;"]
    open_file(page, "wunsch.csv", "\n".join(lines))
    expect(page.locator("#use-import")).to_be_visible()
    expect(page.locator(".import")).to_have_attribute("aria-busy", "false")


def close_import(page: Page) -> None:
    """Close the dialog of an import, if it is open."""
    cancel = page.locator(".import").get_by_role("button", name=re.compile("Cancel|Abbrechen"))
    if cancel.count():
        cancel.first.click()


def thousand(page: Page) -> None:
    """A thousand stops."""
    request = many_customers(1000)
    awaited(page, OPEN, json.dumps({"request": request, "plan": swept_reply(request)}))
    open_tab(page, "customers")


def thousand_routes(page: Page) -> None:
    """Tours of a thousand stops."""
    open_tab(page, "routes")


def hubs(page: Page) -> None:
    """Drones that fly from hubs, one flight's heights."""
    open_example(page, "hubs")
    open_tab(page, "routes")
    page.locator(".panel").get_by_role("row", name="quad").get_by_role("button").first.click()
    expect(page.locator(".height-profile").first).to_be_visible()


def fleet(page: Page) -> None:
    """Fields of vehicles."""
    open_example(page, "city_day")
    open_tab(page, "fleet")


def rules(page: Page) -> None:
    """The finder of rules."""
    open_example(page, "berlin")
    open_tab(page, "fleet")
    finder = page.locator("details.finder").first
    finder.locator("> summary").click()
    finder.scroll_into_view_if_needed()


def zones(page: Page) -> None:
    """Published zones under Fleet."""
    open_example(page, "zones")
    open_tab(page, "fleet")
    page.locator("fieldset", has_text="ED-269").last.scroll_into_view_if_needed()


def lockers(page: Page) -> None:
    """Customers that may be served at a locker with hours."""
    request = example("berlin")
    for customer in request["customers"][:6]:
        customer["alternatives"] = [{
            "id": "Paketstation Alexanderplatz", "location": [13.4132, 52.5219], "cost": 0.5,
            "service_duration": 30, "time_window": {"earliest": 32400, "latest": 43200}}]
        customer["served_by"] = "truck"
    show(page, request, "lockers")
    open_tab(page, "routes")
    key = page.evaluate("""async () => {
      const { store } = await loaded(`store.js`);
      const { plan } = store.get().plans.at(-1);
      const stops = plan.routes.flatMap(({ trips }) => trips.flatMap(({ stops }) => stops));
      return `c:${(stops.find(({ alternative }) => alternative) ?? stops[1]).id}`;
    }""")
    page.mouse.click(*place_of(page, key))


def profiles(page: Page) -> None:
    """The energy of a flight by a published rule."""
    open_example(page, "permits")
    open_tab(page, "routes")
    page.evaluate("async () => (await loaded(`store.js`)).store.set({ selection: 's:0/0/0' })")


def replanning(page: Page) -> None:
    """At ten past ten a truck has broken down."""
    open_example(page, "city_day")
    page.locator(".player input[type=range]").fill("36600")
    page.get_by_role("button", name=re.compile("Replan from here|Ab hier umplanen")).click()
    page.locator(".replan-vehicles input[type=checkbox]").nth(1).check()


def comparing(page: Page) -> None:
    """Two plans side by side."""
    open_example(page, "city_day")
    open_tab(page, "changes")


def scenarios(page: Page) -> None:
    """Fleets and sweeps."""
    open_example(page, "hetero_day")
    open_tab(page, "scenarios")


def drivers(page: Page) -> None:
    """Before a plan is sent."""
    open_example(page, "berlin")
    open_tab(page, "drivers")


def exporting(page: Page) -> None:
    """What can be taken away."""
    open_example(page, "city_day")
    open_tab(page, "export")


def settings(page: Page) -> None:
    """Settings over the map."""
    page.locator("#settings-button").click()


def living(page: Page) -> None:
    """A day that goes on: an order is new, a van is late."""
    address = page.url.partition("#")[0]
    with httpx.Client(base_url=address, trust_env=False, timeout=PATIENCE) as client:
        request = example("city_day")
        request["options"] = {"search_iterations": 300}
        day = begun(client, request)
        told(client, day, {"kind": "clock"}, at=32400)
        told(client, day, {"kind": "order.placed", "customer": {
            "id": "Neue Kundin", "location": [24.95, 60.18], "demand": [2, 3]}},
            {"kind": "vehicle.delayed", "vehicle": "van-1", "by": 2400}, at=32460)
    page.goto("about:blank")
    page.goto(f"{address}#day={day}")
    expect(page.get_by_role("timer")).to_be_visible()
    expect(page.locator(".links li").first).to_be_visible()


def long_names(page: Page) -> None:
    """Vehicles, depots and customers with long names, one of whom is late."""
    request = example("berlin")
    request["depots"][0]["id"] = "Logistikzentrum Westhafen, Halle 3, Tor 17"
    request["fleet"][0] |= {"names": ["Sprinter Kühlfahrzeug Nordost (Frau Wischnewski)",
                                      "Vito Expresstour Südwest (Herr Brandstätter)"]}
    for customer in request["customers"]:
        customer["id"] = f"Apotheke am Platz {customer['id']}, Hintereingang"
        customer["time_window"] = {"latest": 30600, "late_cost_per_hour": 20}
    show(page, request, "Lange Namen einer Tour am Montag mit allem")
    open_tab(page, "routes")


def zone(page: Page) -> None:
    """A zone that was clicked."""
    open_example(page, "zones")
    page.evaluate("async () => (await loaded(`store.js`)).store.set({ selection: 'z:2' })")


STATES: dict[str, Callable[[Page], None]] = {
    each.__name__.replace("_", "-"): each for each in (
        plan_made, routes, details, costs, solving, left_out, importing, import_asks, thousand,
        thousand_routes, hubs, fleet, rules, zones, lockers, profiles, replanning, comparing,
        scenarios, drivers, exporting, settings, unplanned, wrong, empty, long_names, zone, living)}


def go_through(page: Page, names: list[str], folder: Path, language: str) -> None:
    """Write pictures of states, as one page shows them."""
    for name in names:
        page.set_viewport_size(SIZES[0])
        close_import(page)
        page.keyboard.press("Escape")
        try:
            STATES[name](page)
        except Exception as error:
            print(language, name, "FAILED", str(error)[:600])
            page.goto(page.url)
            idle(page)
        for size in SIZES:
            page.set_viewport_size(size)
            page.mouse.move(size["width"] / 2, 3)
            for scheme in ("light", "dark"):
                page.evaluate("(to) => { document.documentElement.dataset.theme = to; }", scheme)
                page.wait_for_timeout(400)
                page.screenshot(path=folder / f"{name}-{size['width']}-{language}-{scheme}.png",
                                animations="disabled")
                wide = page.evaluate("document.documentElement.scrollWidth")
                if wide > size["width"]:
                    print(language, name, size["width"], "scrolls sideways", wide)
        print(language, name, flush=True)


def main(given: str, *names: str) -> None:
    """Write pictures."""
    expect.set_options(timeout=30_000)
    folder = Path(given)
    folder.mkdir(parents=True, exist_ok=True)
    with (TemporaryDirectory() as data, chromium() as browser,
          serving(Path(data), "tests.console.service") as address):
        for language in LANGUAGES:
            context = new_context(browser, locale=language)
            context.set_default_timeout(20_000)
            page = context.new_page()
            page.goto(f"{address}/#example=smallest")
            idle(page)
            go_through(page, [*(names or STATES)], folder, language)
            context.close()


if __name__ == "__main__":
    main(*sys.argv[1:])
