"""How the search sees a plan that is under way: what is left of it, as a plan of its own."""

from collections import Counter
from dataclasses import replace

from model.counsel.bench import Bench
from model.counsel.slots import SearchedPlan
from model.judge.places import Place
from model.problem import Customer
from model.problem.altered import with_customers
from model.replanning.handover import hand_over, take_back
from model.replanning.kept import Kept
from model.replanning.replan import Replanning
from model.solution import Solution, Vehicle


def seen(replanning: Replanning, bench: Bench,
         handed: Solution | None = None) -> SearchedPlan | None:
    """Return what is left of a plan without a customer; None: nothing, or nobody may begin a trip.

    `handed` is what is left of the plan, if it is known already.
    """
    left, plan = replanning.left, bench.left_out.solution
    if left is None or bench.node not in left.numbers:
        return None
    kept = {each.vehicle: each for each in replanning.kept}
    known, used = dict[Vehicle, Vehicle](), Counter[int]()
    for route in plan.routes:
        vehicle = route.driven_by
        kind = left.later(vehicle)
        if kind is not None and len(route.trips) > _begun(kept, vehicle):
            known[Vehicle(kind, used[kind])] = vehicle
            used[kind] += 1
    taken = {*kept, *replanning.past.unavailable, *(
        route.driven_by for route in plan.routes)}

    def whole(place: Place) -> Place | None:
        kind = place.vehicle.type
        worker = left.workers.get(kind)
        vehicle = known.get(place.vehicle) or (None if worker is None else worker.vehicle)
        if vehicle is None:
            own = left.kinds[kind]
            vehicle = next((Vehicle(own, number)
                            for number in range(bench.problem.vehicle_types[own].count)
                            if Vehicle(own, number) not in taken), None)
        return None if vehicle is None else place._replace(
            vehicle=vehicle, trip=place.trip + _begun(kept, vehicle))

    node = left.numbers[bench.node]

    def joined(found: Solution, customer: Customer) -> Solution:
        asked = left
        # Of trips that are yet to begin, the times found stand.
        if any(worker.is_under_way for worker in left.workers.values()):
            asked = replace(left, problem=with_customers(left.problem, {node: customer}))
        return take_back(replanning.problem, replanning.past, plan, kept, asked, found)

    return SearchedPlan(
        left.problem, handed or hand_over(replanning.problem, plan, kept, left),
        node, left.beginning, whole, joined)


def _begun(kept: dict[Vehicle, Kept], vehicle: Vehicle) -> int:
    """Return how many trips a vehicle has begun."""
    return len(kept[vehicle].route.trips) if vehicle in kept else 0
