"""What a customer is told of a day, by the link of one order alone."""

from typing import Any

import httpx
import pytest
from itsdangerous import URLSafeSerializer

from app.records.days.schemas import CustomerLinksReply, VisitStatusReply
from tests.app.records.days.living import PROBLEM, begun, clock, order, plan_of, told
from tests.app.records.dispatches.days import holding, token_of

pytestmark = pytest.mark.slow

START = "2026-06-01T08:00:00+02:00"


def links(service: httpx.Client, day: str) -> dict[str, str]:
    """Return the tokens of a day's customers."""
    reply = CustomerLinksReply.model_validate_json(service.get(f"/days/{day}/links").text)
    return {link.order: token_of({"url": link.url}) for link in reply.links}


def seen(service: httpx.Client, token: str) -> VisitStatusReply:
    """Return what a customer sees."""
    reply = service.get("/visit/order", headers=holding(token))
    assert reply.status_code == 200, reply.text
    return VisitStatusReply.model_validate_json(reply.text)


def test_customer_sees_when_who_comes_and_what_changed(service: httpx.Client) -> None:
    day = begun(service, {**PROBLEM, "plan_start": START})
    token = links(service, day)["A"]
    stop, vehicle = next((stop, route["vehicle"]) for route in plan_of(service, day)["routes"]
                         for trip in route["trips"] for stop in trip["stops"]
                         if stop["id"] == "A")
    visit = seen(service, token)
    assert (visit.order, visit.state, visit.by, visit.vehicle) == ("A", "coming", "truck", vehicle)
    assert visit.arrival is not None
    assert visit.arrival.isoformat() == stop["arrival"]
    assert visit.earliest is not None
    assert visit.latest is not None
    assert visit.earliest < visit.arrival < visit.latest
    assert [each.arrival for each in visit.told] == [visit.arrival]
    told(service, day, clock(), {"kind": "vehicle.departed", "vehicle": vehicle, "at": 100},
         {"kind": "vehicle.delayed", "vehicle": vehicle, "by": 900}, at=101)
    late = seen(service, token)
    assert [(each.arrival - visit.arrival).total_seconds() for each in late.told] == [0, 900]
    told(service, day, {"kind": "vehicle.served", "vehicle": vehicle, "order": "A"}, at=1500)
    assert seen(service, token).state == "served"


def test_link_opens_no_other_order_and_none_that_is_cancelled(service: httpx.Client) -> None:
    first, second = begun(service), begun(service)
    token = links(service, first)["A"]
    day, _ = URLSafeSerializer("").loads_unsafe(token)[1]
    forged = URLSafeSerializer("guessed", "customer").dumps([day, "B"])
    other, signature = token.rpartition(".")[0], links(service, second)["A"].rpartition(".")[2]
    for wrong in (forged, f"{other}.{signature}", "nonsense", token[:-2]):
        reply = service.get("/visit/order", headers=holding(wrong))
        assert reply.status_code == 401, reply.text
    told(service, first, clock(), {"kind": "order.cancelled", "order": "A"}, at=1)
    reply = service.get("/visit/order", headers=holding(token))
    assert (reply.status_code, reply.json()["type"]) == (410, "urn:tandem:error:link-over")
    assert "A" not in links(service, first)


def test_order_that_is_not_planned_is_open(service: httpx.Client) -> None:
    day = begun(service)
    told(service, day, clock(), order("G", 1, 1, time_window={"latest": 0.5}), at=1)
    visit = seen(service, links(service, day)["G"])
    assert (visit.state, visit.by, visit.arrival, visit.told) == ("open", None, None, [])


def test_links_end_with_their_day(service: httpx.Client, monkeypatch: pytest.MonkeyPatch) -> None:
    day = begun(service)
    token = links(service, day)["A"]
    ends = seen(service, token).ends_at.timestamp()
    monkeypatch.setattr("app.records.days.customers.now_ms", lambda: round(1000 * ends) + 1)
    assert service.get("/visit/order", headers=holding(token)).status_code == 410


def test_page_may_do_little(service: httpx.Client) -> None:
    reply = service.get("/visit/")
    assert reply.status_code == 200
    assert "default-src 'none'" in reply.headers["content-security-policy"]


def names(problem: dict[str, Any]) -> set[str]:
    """Return whom a problem has."""
    return {each["id"] for each in problem["customers"]}


def test_each_order_has_a_link(service: httpx.Client) -> None:
    assert links(service, begun(service)).keys() == names(PROBLEM)
