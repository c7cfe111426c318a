"""What follows from a day's new plan: what clients and customers are told of it."""

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from typing import Any

from pydantic_core import to_json

from app.records.days.fold import Data, Pace, ToldDay, visits
from app.records.days.remedies import MOST
from app.records.days.rows import DayTerms
from app.records.days.spreads import chance_of
from app.records.dispatches.rows import ToldRow
from app.records.dispatches.standing import of_steps
from app.records.dispatches.steps import flight_id, stop_ids
from app.records.jobs.webhook import ELSEWHERE
from app.schemas.plan import PlanInput, TripInput
from app.schemas.request import PlanRequest

OVER = 2 / 3
"""Share of the chance from which on an order is at risk, below which it is so no more."""


def news_of(number: int, planned: int, at: int, told: ToldDay, before: PlanInput | None,
            plan: PlanInput, reply: Mapping[str, Any], problem: PlanRequest,
            terms: DayTerms, pace: Pace,
            remedy: Callable[[str], Data | None]) -> list[ToldRow]:
    """Return the events of a plan that was just made, `at` being now in ms since 1970.

    It counts with events up to the one numbered `planned`; those since the one before had a `pace`.
    `remedy` finds what mends an order that may be late.
    """
    was = {order: vehicle for order, vehicle, _ in visits(before or PlanInput(routes=()))}
    moved = sum(was.get(order, vehicle) != vehicle for order, vehicle, _ in visits(plan))
    rows = [_row(number, at, "plan.changed", "", {
        "plan_number": number, "planned": planned, "cost": reply["cost"]["total"], "moved": moved,
        "left_out": len(reply["unassigned"]), "spread": reply["lateness"]["spread"],
        **({"pace": pace} if pace.ways else {})})]
    served = served_orders(plan, told)
    for order, vehicle, visit in visits(plan):
        told_before = told.etas.get(order)
        if order not in served and (
                told_before is None or abs(visit.arrival - told_before) > terms.eta_threshold):
            rows.append(_row(number, at, "eta.changed", order, {
                "order": order, "arrival": visit.arrival, "before": told_before,
                **chance_of(visit)}, vehicle))
    risks = dict(_risks(plan, reply, problem, served, told.at_risk, terms.risk_threshold))
    new = {order: why for order, why in risks.items() if order not in told.at_risk}
    late = [order for order, why in new.items() if why["why"] != "left_out"][:MOST]
    mended = {order: {"remedy": found} for order in late if (found := remedy(order)) is not None}
    rows += [_row(number, at, "order.at_risk", order, {
        "order": order, "at_risk": True, **why, **mended.get(order, {})})
        for order, why in new.items()]
    rows += [_row(number, at, "order.at_risk", order, {"order": order, "at_risk": False})
             for order in sorted(told.at_risk.keys() - risks.keys())]
    return rows


def names_of(day: str, number: int, news: Sequence[ToldRow]) -> list[str]:
    """Return the names of the messages that tell the news of a day's plan."""
    return [f"{ELSEWHERE}{day}:{number}:{kind}"
            for kind in dict.fromkeys(event.kind for event in news)]


def _row(number: int, at: int, kind: str, order: str, about: Data,
         vehicle: str | None = None) -> ToldRow:
    return ToldRow(f"{number}:{kind[:3]}:{order}"[:64], kind, at, vehicle,
                   body=to_json(about).decode())


def served_orders(plan: PlanInput, told: ToldDay) -> dict[str, bool]:
    """Return the orders of a plan of which was told that they were served, or (False) were not."""
    served: dict[str, bool] = {}
    for route in plan.routes:
        standing = of_steps(told.standings.get(route.vehicle, {}))
        for index, trip in enumerate(route.trips):
            for order, step in order_steps(index, trip):
                if step in standing and (standing[step].outcome == "failed" or "-launch-" not in
                                         step):
                    served[order] = standing[step].outcome == "done"
    return served


def order_steps(index: int, trip: TripInput) -> Iterator[tuple[str, str]]:
    """Yield the orders of a trip, each with the steps that tell what became of it."""
    for place, stop in enumerate(trip.stops):
        if stop.kind == "customer":
            yield stop.customer, stop_ids(index, trip, place)[0]
    for sortie in trip.sorties:
        for visit in sortie.customers:
            yield visit.customer, flight_id(index, "launch", sortie)
            yield visit.customer, flight_id(index, "recover", sortie)


def _risks(plan: PlanInput, reply: Mapping[str, Any], problem: PlanRequest,
           served: Mapping[str, bool], before: Collection[str],
           threshold: float) -> Iterator[tuple[str, Data]]:
    """Yield the orders that a plan leaves out, or reaches after their windows, or may so."""
    for left in reply["unassigned"]:
        reasons = left.get("reasons") or [{}]
        yield left["id"], {"why": "left_out", "reason": reasons[0]}
    latest = {customer.id: max((float("inf") if window.latest is None else window.latest
                                for window in customer.windows), default=float("inf"))
              for customer in problem.customers}
    for order, _, visit in visits(plan):
        if order in served:
            continue
        late = visit.service_start - latest.get(order, float("inf"))
        expected = chance_of(visit)
        if late > 0:
            yield order, {"why": "late", "by": late, **expected}
        elif (expected.get("chance") or 0.0) >= threshold * (OVER if order in before else 1.0):
            yield order, {"why": "chance", **expected}
