"""What a new plan has to keep to, as a request states it."""

from collections import defaultdict

from app.requests.conversion.names import read_name
from app.requests.conversion.units import optional_thousandths, thousandths
from app.requests.plan_reading import read_earlier_plan
from app.schemas.request import OptionsInput, ReplanInput
from model.judge.changes import ChangePrices
from model.problem import Problem
from model.replanning.replan import Terms
from model.solution import Vehicle


def terms_of(replan: ReplanInput, options: OptionsInput, problem: Problem) -> Terms:
    """Return what a request to go on from a plan asks for.

    Raises
    ------
    InvalidRequestError
        If the plan names vehicles that the problem doesn't have.
    """
    plan = read_earlier_plan(replan.plan, problem, ("replan", "plan"))
    names = set(replan.pinned)
    pinned = frozenset(
        place for node, customer in enumerate(problem.customers, problem.num_depots)
        if replan.pin_all or customer.id in names for place in problem.places_of(node))
    unavailable, grounded = set[Vehicle](), defaultdict[Vehicle, set[int]](set)
    types = {kind.type_id for kind in problem.vehicle_types}
    prices, limits = options.change_costs, options.change_limits
    concerned = frozenset([Vehicle(*problem.find_vehicle(named.vehicle_type, named.number))
                           for name in replan.concerned
                           if (named := read_name(name, types)) is not None])
    for name in replan.unavailable:
        named = read_name(name, types)
        if named is None:
            raise ValueError(f"the fleet has no vehicle {name!r}")
        vehicle = Vehicle(*problem.find_vehicle(named.vehicle_type, named.number))
        if named.drone is None:
            unavailable.add(vehicle)
        else:
            grounded[vehicle].add(named.drone)
    return Terms(plan, optional_thousandths(replan.freeze_before), pinned, frozenset(unavailable),
                 optional_thousandths(replan.parcels_back),
                 {vehicle: frozenset(drones) for vehicle, drones in grounded.items()},
                 replan.keep_order,
                 None if prices is None else ChangePrices(**prices.model_dump()),
                 _promised(replan, problem),
                 concerned if limits.vehicles == "concerned" else None,
                 limits.new_orders == "behind")


def _promised(replan: ReplanInput, problem: Problem) -> dict[int, int]:
    """Return when customers, by node, were told that they are reached, in ms."""
    return {node: thousandths(replan.promised[customer.id])
            for node, customer in enumerate(problem.customers, problem.num_depots)
            if customer.id in replan.promised and problem.first_place(node) == node}
