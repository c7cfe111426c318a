"""What an order that isn't accepted yet would cost a plan, slot by slot."""

from collections.abc import Callable, Sequence
from dataclasses import replace

from pydantic_core import to_json

from app.maps.roads.roads import NO_ROADS, Roads
from app.plans.checking import PLAN
from app.plans.explain_replies import more_than_without, placed_reply, rules_reply
from app.plans.explaining import preparing_within
from app.plans.fitting import bench_of, require_readable
from app.plans.quoted_plans import LastQuote, QuotedPlans, quoted_plans, read_quote
from app.plans.replies import Data
from app.plans.task import Task, task_of
from app.plans.timing import timed_plan
from app.requests.bounds import Bounds
from app.requests.conversion.units import money, thousandths
from app.schemas.fit import FitRequest
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
                 roads: Roads = NO_ROADS, plans: QuotedPlans | None = None,
                 first: Sequence[str] = ()) -> bytes:
    """Return the reply to a request of `POST /quote` as JSON, unless the work is to end.

    The problem and the plan are read once for all slots, and for all orders asked of `plans`.
    `first` are orders of the problem that the plan lacks, and that are put into it before.

    Raises
    ------
    RequestError
        If `body` is no valid request, the plan has routes that can't be read, or the work is to
        end.
    """
    request, quoted = read_quote(body.content, bounds, quoted_plans() if plans is None else plans,
                                 first)
    last = quoted.last_beside(request)
    task = task_of(request.whole_problem, preparing_within(bounds, should_stop),
                   roads=roads.with_all_legs(), known=None if last is None else last.task)
    ready = last if last is not None and last.fits(task) else _ready(task, request, first)
    bench = bench_of(task, request.asked, ready.solution, ready.judged)
    view = (view_of(bench) if task.replanning is None
            else seen(task.replanning, bench, ready.handed))
    quoted.keep(request, ready._replace(task=task, handed=None if view is None else view.solution))
    customers = [_within(bench.problem.customer_at(bench.last), slot) for slot in request.slots]
    future: list[float | None] = [None] * len(customers)
    if task.waves is not None and bench.shipment is None:
        future = task.waves.future_costs(task.judged_problem, task.replanning, bench.node,
                                         customers)
    slots = [_quoted(bench, slot, best, more) for slot, best, more in zip(
        request.slots, find_slots(bench, customers, view, request.search), future,
        strict=True)]
    costs = [(each["cost"], index) for index, each in enumerate(slots) if each["feasible"]]
    reply: Data = {"slots": slots, "best": min(costs)[1] if costs else None}
    task.telling.tell(QuoteReply, reply)
    return to_json(reply)


def _ready(task: Task, request: QuoteRequest, first: Sequence[str]) -> LastQuote:
    """Return the plan of a request, read and judged, with the first; raises as `answer_quote`."""
    solution = timed_plan(task, request.plan, (PLAN,))
    judged = task.judge_routes(solution)
    require_readable(task.setting.judge(task.judged_problem, solution, judged))
    shipments = {each.id for each in request.problem.shipments}
    for name in first:
        asked = FitRequest.model_construct(
            problem=request.problem, plan=request.plan,
            customer=None if name in shipments else name,
            shipment=name if name in shipments else None)
        bench = bench_of(task, asked, solution, judged)
        view = view_of(bench) if task.replanning is None else seen(task.replanning, bench)
        fit = next(find_slots(bench, [bench.problem.customer_at(bench.last)], view))
        if fit is not None and not new_violations(fit.bench, fit.trial):
            solution = fit.trial.solution
            judged = task.judge_routes(solution)
    return LastQuote(task, solution, judged)


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
