"""How a day's orders and vehicles stand."""

from collections.abc import Iterable

from app.records.days.fold import ToldDay, visits
from app.records.days.news import served_orders
from app.records.days.schemas import OrderReply, OrderState, PinReply, VehicleReply
from app.records.days.spreads import chance_of
from app.records.dispatches.rows import DayRow
from app.schemas.plan import PlanInput


def orders_of(told: ToldDay, plan: PlanInput, now: float) -> Iterable[OrderReply]:
    """Yield how orders stand: those of the plan, those it leaves out, and those it lacks yet."""
    served = served_orders(plan, told)
    seen: set[str] = set()
    for order, vehicle, visit in visits(plan):
        seen.add(order)
        state: OrderState = "planned"
        if order in told.elsewhere:
            state, vehicle = "served", told.elsewhere[order]
        elif order in served:
            state = "served" if served[order] else "failed"
        elif visit.departure <= now:
            state = "doubtful"
        yield OrderReply(id=order, state=state, vehicle=vehicle, arrival=visit.arrival,
                         told=told.etas.get(order), at_risk=order in told.at_risk,
                         pinned=_pin(told, order),
                         remedy=told.at_risk.get(order, {}).get("remedy"), **chance_of(visit))
    for left in plan.unassigned:
        seen.add(left.id)
        yield OrderReply(id=left.id, state="left_out", at_risk=left.id in told.at_risk,
                         pinned=_pin(told, left.id))
    whole = {name.partition("/")[0] for name in seen}
    for order in (*told.customers, *told.shipments):
        if order not in seen and order not in whole:
            pin = _pin(told, order)
            is_left_out = pin is not None and pin.vehicle is None
            yield OrderReply(id=order, vehicle=told.elsewhere.get(order), pinned=pin,
                             state="served" if order in told.elsewhere
                             else "left_out" if is_left_out else "waiting")


def _pin(told: ToldDay, order: str) -> PinReply | None:
    pin = told.pins.get(order.partition("/")[0])
    return None if pin is None else PinReply(**pin._asdict())


def vehicles_of(told: ToldDay, plan: PlanInput, row: DayRow) -> list[VehicleReply]:
    """Return how vehicles stand, those of the plan first."""
    names = dict.fromkeys([*(route.vehicle for route in plan.routes), *told.told_at])
    listed = []
    for name in names:
        done, failed = told.count(name)
        at, seen = told.told_at.get(name), told.sighted.get(name)
        listed.append(VehicleReply(
            vehicle=name, told_at=None if at is None else row.seconds(at), done=done,
            failed=failed, position=None if seen is None else tuple(seen.about["location"]),
            position_at=None if seen is None else row.seconds(seen.time),
            broken=name in told.out))
    return listed
