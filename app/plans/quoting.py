"""What an order that isn't accepted yet would cost a plan, slot by slot."""

from collections.abc import Callable
from dataclasses import replace

from pydantic_core import to_json

from app.maps.roads.roads import NO_ROADS, Roads
from app.plans.checking import PLAN, read_about_plan
from app.plans.explain_replies import more_than_without, placed_reply, rules_reply
from app.plans.explaining import preparing_within
from app.plans.fitting import bench_of, require_readable
from app.plans.replies import Data
from app.plans.task import task_of
from app.plans.timing import timed_plan
from app.requests.bounds import Bounds
from app.requests.conversion.units import money, thousandths
from app.schemas.quote import QuoteReply, QuoteRequest, SlotInput
from app.serving.load.received import ReceivedBody
from model.counsel.bench import Bench
from model.counsel.fitting import Fit, new_violations
from model.counsel.slots import find_slots, view_of
from model.problem import Customer
from model.problem.quantities import UNLIMITED
from model.replanning.seen import seen


def answer_quote(body: ReceivedBody, bounds: Bounds,
                 should_stop: Callable[[], bool] = lambda: False,
                 roads: Roads = NO_ROADS) -> bytes:
    """Return the reply to a request of `POST /quote` as JSON, unless the work is to end.

    The problem and the plan are read once for all slots.

    Raises
    ------
    RequestError
        If `body` is no valid request, the plan has routes that can't be read, or the work is to
        end.
    """
    request = read_about_plan(body.content, bounds, QuoteRequest)
    task = task_of(request.whole_problem, preparing_within(bounds, should_stop),
                   roads=roads.with_all_legs())
    solution = timed_plan(task, request.plan, (PLAN,))
    judged = task.judge_routes(solution)
    require_readable(task.setting.judge(task.judged_problem, solution, judged))
    bench = bench_of(task, request.asked, solution, judged)
    customers = [_within(bench.problem.customer_at(bench.last), slot) for slot in request.slots]
    view = view_of(bench) if task.replanning is None else seen(task.replanning, bench)
    future: list[float | None] = [None] * len(customers)
    if task.waves is not None and bench.shipment is None:
        future = task.waves.future_costs(task.judged_problem, task.replanning, bench.node,
                                         customers)
    slots = [_quoted(bench, slot, best, more) for slot, best, more in zip(
        request.slots, find_slots(bench, customers, view), future, strict=True)]
    costs = [(each["cost"], index) for index, each in enumerate(slots) if each["feasible"]]
    reply: Data = {"slots": slots, "best": min(costs)[1] if costs else None}
    task.telling.tell(QuoteReply, reply)
    return to_json(reply)


def _quoted(bench: Bench, slot: SlotInput, best: Fit | None, future: float | None) -> Data:
    """Return what a slot would cost at the best place, and more for what may come."""
    reply: Data = {"earliest": slot.earliest, "latest": slot.latest, "by": slot.by,
                   "feasible": False, "cost": None, "of_which_future": None, "vehicle": None,
                   "arrival": None, "after": None, "why": []}
    if best is None:
        return reply
    broken = new_violations(best.bench, best.trial)
    if broken:
        return reply | {"why": rules_reply(broken)}
    placed = placed_reply(best.bench, best.trial, best.companions)
    cost = more_than_without(best.bench, best.trial)["total"]
    more = None if future is None else money(future)
    return reply | {"feasible": True, "cost": cost + (more or 0.0), "of_which_future": more,
                    "vehicle": placed["vehicle"], "arrival": placed["service_start"],
                    "after": placed["position"] and placed["position"]["after"]}


def _within(customer: Customer, slot: SlotInput) -> Customer:
    """Return a customer with the slot for his windows."""
    return replace(
        customer, earliest=thousandths(slot.earliest),
        latest=UNLIMITED if slot.latest is None else thousandths(slot.latest), gaps=(),
        served_by=slot.by)
