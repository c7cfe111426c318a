"""Who leaves now and who waits for what may come, in plans whose requests have a forecast."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from app.plans.replies import Data
from app.requests.conversion.ground import Ground
from app.requests.conversion.places import PlacedRequest
from app.requests.conversion.preparing import Preparing
from app.requests.conversion.problem import problem_of
from app.requests.conversion.travels import Travels
from app.requests.conversion.units import money, thousandths
from app.requests.forecast_validation import orders_to_come
from app.maps.roads.roads import Roads
from app.schemas.forecast import ComingInput
from model.judge.rules import seconds
from model.planner import Listener, Planner, PlanOptions, PlanResult
from model.problem import Customer, Problem, VehicleType
from model.replanning.remainder import held_back
from model.replanning.replan import Replanning
from model.search.waves.decide import Outlook, WaveConfig, decide
from model.search.waves.forecasts import AreaRate, PastOrder, by_past_days, by_rates
from model.search.waves.future import Forecast, Wave
from model.search.waves.opportunity import future_costs
from model.solution import Solution

DECIDING = 0.4
"""Share of the time limit in which it is decided who waits."""

PLANNING = 0.8
"""Share of the time limit after which it is planned as if nobody waited, if somebody is left out.
"""

QUOTED = WaveConfig(futures=6, seconds=0.3)
"""How far it is looked ahead for a quote, whose slots share the futures."""

TURNS_SHARE = 60
"""Of the turns asked for, one in so many is made in each future."""


@dataclass(eq=False)
class Waves:
    """When vehicles leave, and what may come until then."""

    placed: PlacedRequest
    preparing: Preparing
    roads: Roads
    stated: ComingInput
    outlooks: tuple[Outlook, ...] = ()  # by what was decided last

    @classmethod
    def of(cls, placed: PlacedRequest, preparing: Preparing, roads: Roads) -> "Waves | None":
        """Return what a request states; None: no forecast."""
        stated = placed.request.forecast
        return None if stated is None else cls(placed, preparing, roads, stated)

    @cached_property
    def problem(self) -> Problem:
        """The problem in which orders that may come are customers behind those of the request."""
        request = self.placed.request
        whole = PlacedRequest(request.model_copy(update={
            "customers": [*request.customers, *orders_to_come(self.stated)], "replan": None}))
        ground = Ground(whole, self.preparing, self.roads.zones)
        return problem_of(whole, Travels(whole, self.preparing, ground, self.roads))

    def plan(self, problem: Problem, replanning: Replanning | None, planner: Planner,
             options: PlanOptions, received_at: float, listener: Listener) -> PlanResult:
        """Decide who waits, and plan so; arguments are those of `Planner.plan`. In place."""
        self.outlooks = self._decide(problem, replanning, options)
        held = self._held(0 if replanning is None else replanning.past.now)

        def planned(held: Mapping[int, int], share: float) -> PlanResult:
            own = replace(options, time_limit=share * options.time_limit)
            if replanning is not None:
                return replanning.plan(planner, own, received_at, listener, held=held)
            return planner.plan(held_back(problem, held), own, received_at, listener)

        if not held:
            return planned({}, 1.0)
        waiting = planned(held, PLANNING)
        if not waiting.solution.unassigned:
            return waiting
        # Later trips may not take all of them after all.
        return min(waiting, planned({}, 1.0), key=lambda result: result.final_cost)

    def _decide(self, problem: Problem, replanning: Replanning | None,
               options: PlanOptions) -> tuple[Outlook, ...]:
        """Decide which customers of a problem leave now, and which wait.

        Nodes are those of the problem.
        """
        now = 0 if replanning is None else replanning.past.now
        wave, ahead = self._wave(problem, replanning), self._ahead(problem)
        if wave is None:
            return ()
        config = WaveConfig(seed=options.seed, seconds=DECIDING * options.time_limit)
        if options.search_iterations is not None:
            turns = max(1, options.search_iterations // TURNS_SHARE)
            config = replace(config, seconds=math.inf, turns=turns, last_turns=turns)
        found = decide(wave, self._forecast(now, wave.departures[-1]), config)
        return tuple([replace(each, node=each.node - ahead) for each in found.outlooks])

    def future_costs(self, problem: Problem, replanning: Replanning | None, node: int,
                     slots: Sequence[Customer]) -> list[float | None]:
        """Return what a customer of the problem costs for what may come, slot by slot.

        None: nothing is forecast, or no truck comes there in time.
        """
        now = 0 if replanning is None else replanning.past.now
        wave, own = self._wave(problem, replanning, node), node + self._ahead(problem)
        forecast = None if wave is None else self._forecast(now, wave.departures[-1])
        if wave is None or forecast is None:
            return [None] * len(slots)
        costs = future_costs(wave, own, slots, forecast, QUOTED)
        return [cost if math.isfinite(cost) else None for cost in costs.tolist()]

    def _ahead(self, problem: Problem) -> int:
        """Return by how much nodes of customers are higher here than in a problem."""
        return self.problem.num_depots - problem.num_depots

    def _wave(self, problem: Problem, replanning: Replanning | None,
              but: int | None = None) -> Wave | None:
        """Return the orders that are open, but for one; None: none is, or no vehicle is there."""
        departures = self._departures(0 if replanning is None else replanning.past.now)
        nodes = [node for node in _free(problem, replanning) if node != but]
        kinds, ahead = self._types(problem, replanning), self._ahead(problem)
        if not nodes or not kinds:
            return None
        return Wave(self._with(kinds), tuple([node + ahead for node in nodes]), departures,
                    departures[-1] + self._every < self._latest)

    def _held(self, now: int) -> dict[int, int]:
        """Return until when customers wait, by node, who do so."""
        until = self._departures(now)[1:2]
        return {each.node: until[0] for each in self.outlooks
                if until and not each.leaves and not each.must}

    def replies(self, problem: Problem, plan: Solution, now: int) -> list[Data]:
        """Return what a reply says of who leaves and who waits, by the plan itself."""
        until = min(self._departures(now)[1:2], default=math.inf)
        begins = {node: trip.stops[0].departure for route in plan.routes
                  for trip in route.trips for node in trip.served}
        return [_reply(problem, each, begins[each.node] < until)
                for each in self.outlooks if each.node in begins]

    @property
    def _every(self) -> int:
        return thousandths(self.stated.every)

    @property
    def _latest(self) -> int:
        """When the last vehicle may leave."""
        return max([kind.latest for kind in self.problem.vehicle_types])

    def _departures(self, now: int) -> tuple[int, ...]:
        """Return now, and the next departures."""
        begin = now // self._every + 1
        later = [number * self._every for number in range(begin, begin + self.stated.look_ahead)]
        return (now, *(each for each in later if each < self._latest))

    def _types(self, problem: Problem,
               replanning: Replanning | None) -> list[tuple[int, VehicleType]]:
        """Return the types of vehicles that may begin trips, with their indices in the problem."""
        kinds = self.problem.vehicle_types
        if replanning is None:
            return list(enumerate(kinds))
        left = replanning.left
        if left is None:
            return []
        found = [(left.kinds[here], left.problem.vehicle_types[here]) for here in left.beginning]
        return [(whole, replace(
            kinds[whole], count=kind.count, numbers=(), max_trips=kind.max_trips,
            earliest=max(kind.earliest, kind.busy_until), fixed_cost=kind.fixed_cost))
            for whole, kind in found if max(kind.earliest, kind.busy_until) <= kinds[whole].latest]

    def _with(self, kinds: Sequence[tuple[int, VehicleType]]) -> Problem:
        """Return the problem with the types that there are, and their rows of its tables."""
        problem, rows = self.problem, [index for index, _ in kinds]
        return replace(
            problem, vehicle_types=tuple([kind for _, kind in kinds]),
            may_serve=None if problem.may_serve is None else problem.may_serve[rows],
            vehicle_costs=None if problem.vehicle_costs is None else problem.vehicle_costs[rows],
            may_stop=None if problem.may_stop is None else problem.may_stop[rows])

    def _forecast(self, now: int, until: int) -> Forecast | None:
        stated = self.stated
        node = self.problem.num_depots + len(self.placed.request.customers)
        nodes = iter(range(node, self.problem.num_nodes))
        days = [[PastOrder(node, thousandths(order.placed_at), self.problem.customer_at(node))
                 for order, node in zip(orders, nodes, strict=False)]
                for orders in stated.past_days]
        if any(days):
            return by_past_days(days, now, until)
        if not stated.rates:
            return None
        return by_rates([AreaRate(
            thousandths(rate.since), thousandths(rate.until), rate.per_hour,
            tuple([(node, self.problem.customer_at(node))
                   for _, node in zip(rate.like, nodes, strict=False)]))
            for rate in stated.rates], now, until)


def _free(problem: Problem, replanning: Replanning | None) -> list[int]:
    """Return the customers who are on no trip yet, and may be on any vehicle's."""
    nodes = range(problem.num_depots, problem.num_nodes)
    if replanning is None:
        return list(nodes)
    bound = {*replanning.past.carriers(), *replanning.past.pinned}
    left = replanning.left
    return [] if left is None else [node for node in left.numbers if node not in bound]


def _reply(problem: Problem, outlook: Outlook, leaves: bool) -> Data:
    """Return what a reply says of an order."""
    agrees = leaves == outlook.leaves
    saved = money(outlook.saved) if agrees and outlook.saved is not None else None
    return {"id": problem.customer_at(outlook.node).id, "leaves": leaves, "must": outlook.must,
            "futures": outlook.futures, "later_in": outlook.later_in,
            "departure": None if outlook.departure is None else outlook.departure / 1000,
            "saved": saved, "text": _text(outlook, leaves, saved)}


def _text(outlook: Outlook, leaves: bool, saved: float | None) -> str:
    """Return why an order leaves, or waits."""
    if outlook.must:
        return "Leaves now: no later departure serves it in time."
    if not outlook.futures:
        return "Leaves now, though it might wait." if leaves else (
            "Waits: without a forecast, as late as is safe.")
    many = f"in {outlook.later_in} of {outlook.futures} futures it rides along"
    less = "" if saved is None or saved < 0.005 else f" for {saved:.2f} less"
    if not leaves and outlook.departure is not None and 2 * outlook.later_in > outlook.futures:
        return f"Waits: {many} at {seconds(outlook.departure)}{less and ','}{less}."
    return f"{'Leaves now' if leaves else 'Waits'}{less}: {many} later."
