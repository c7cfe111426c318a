"""Warnings about fleets: too small by arithmetic, or with speeds that no vehicle has."""

from collections import defaultdict
from collections.abc import Iterable

import numpy as np

from app.requests.warnings.survey import Survey
from app.requests.warnings.warning import Warnings, amount_text, customers_text, warning_at
from app.schemas.customer import CustomerInput
from app.schemas.request import PlanRequest
from app.schemas.vehicle import VehicleTypeInput
from model.problem import BoolArray, IntArray

SLOW_KMH, FAST_KMH = 4.0, 150.0
"""Speeds of vehicles on the globe, at least and at most."""

MOST_MPS_KMH = 26.0
"""Metres a second that are 94 km/h: more aren't taken for such."""

KMH_STEP, KMH_ROUNDING = 5.0, 0.06
"""People know speeds in fives; in metres a second these look crooked, such as 13.89."""

TOLERANCE = 1e-9

Types = tuple[int, ...]
"""Indices of vehicle types, in order."""


def fleet_warnings(survey: Survey) -> Warnings:
    """Yield warnings about vehicles."""
    by_types = _must_customers(survey.request)
    yield from _nobody(survey, by_types)
    yield from _capacity(survey, by_types)
    yield from _hours(survey, by_types)
    yield from _speeds(survey)


def _must_customers(request: PlanRequest) -> dict[Types, IntArray]:
    """Return the customers nobody has priced leaving out, by the types that may serve them."""
    if request.unassigned_cost is not None:
        return {}
    alike: defaultdict[object, list[int]] = defaultdict(list)
    for index, customer in enumerate(request.customers):
        if customer.unassigned_cost is None:
            vehicles = customer.vehicles
            alike[tuple(customer.skills), vehicles and (
                tuple(vehicles.names), vehicles.allowed is None)].append(index)
    found: defaultdict[Types, list[int]] = defaultdict(list)
    for customers in alike.values():
        found[_types_for(request.fleet, request.customers[customers[0]])] += customers
    return {types: np.array(sorted(customers)) for types, customers in found.items()}


def _types_for(fleet: Iterable[VehicleTypeInput], customer: CustomerInput) -> Types:
    """Return the types that have the skills for a customer and may serve it, at least some."""
    allowed = customer.vehicles.allowed if customer.vehicles is not None else None
    forbidden = customer.vehicles.forbidden if customer.vehicles is not None else None
    return tuple(
        index for index, kind in enumerate(fleet)
        if set(customer.skills) <= set(kind.skills)
        and (allowed is None or any(_is_of(name, kind.id) for name in allowed))
        and kind.id not in (forbidden or ()))


def _is_of(name: str, type_id: str) -> bool:
    return name == type_id or name.startswith(f"{type_id}-")


def _nobody(survey: Survey, by_types: dict[Types, IntArray]) -> Warnings:
    request, count = survey.request, len(survey.customers)
    if () in by_types:
        first, customer = int(by_types[()][0]), request.customers[by_types[()][0]]
        skills = f" It needs the skills {customer.skills}." if customer.skills else ""
        yield warning_at(
            "NOBODY_MAY_SERVE", ("customers", first),
            f"{customers_text(len(by_types[()]), count, 'have', 'has')} nobody who may serve them, "
            f"such as {customer.id!r}.{skills} Give a vehicle type the skills, or change skills or "
            "vehicles of these customers.")
    large = {types: customers[~_fits(survey, customers, types)]
             for types, customers in by_types.items() if types}
    if some := [(int(customers[0]), types) for types, customers in large.items() if len(customers)]:
        index, types = min(some)
        most = [request.fleet[kind].capacity for kind in types]
        yield warning_at(
            "LARGER_THAN_ANY_VEHICLE", ("customers", index, "demand"),
            f"{customers_text(sum(map(len, large.values())), count, 'ask', 'asks')} for more than "
            f"any vehicle that may serve them holds, such as {request.customers[index].id!r} for "
            f"{_listed(request.customers[index].demand)}, vehicles hold "
            f"{' or '.join(map(_listed, most[:3]))}: split the order, or state a larger capacity.")


def _fits(survey: Survey, customers: IntArray, types: Types) -> BoolArray:
    """Tell which customers' goods some vehicle of these types holds."""
    most = np.maximum(survey.demand[customers], survey.pickup[customers])
    fits = np.zeros(len(customers), bool)
    for kind in types:
        fits |= (most <= np.array(survey.request.fleet[kind].capacity) + TOLERANCE).all(axis=1)
    return fits


def _listed(amounts: Iterable[float]) -> str:
    return "[" + ", ".join(f"{amount:g}" for amount in amounts) + "]"


def _capacity(survey: Survey, by_types: dict[Types, IntArray]) -> Warnings:
    """Compare what is to be carried with what all trips hold, all together and by who may.

    Shipments are nobody's load: what is delivered makes room on the same trip.
    """
    ends = sum(len(each.named_ends()) for each in survey.request.shipments)
    first_end = len(survey.customers) - ends
    served = {types: customers[customers < first_end]
              for types, customers in by_types.items() if types}
    together = np.concatenate([*served.values(), np.zeros(0, np.int64)]).astype(np.int64)
    everyone = tuple(range(len(survey.request.fleet)))
    for types, customers in ({everyone: together} | {
            types: customers for types, customers in served.items() if types != everyone}).items():
        kinds = [survey.request.fleet[index] for index in types]
        room = np.array([[kind.count * kind.max_trips * amount for amount in kind.capacity]
                         for kind in kinds]).sum(axis=0)
        for name, amounts in (("demand", survey.demand), ("pickup", survey.pickup)):
            total = amounts[customers].sum(axis=0)
            if (total > room * (1 + TOLERANCE)).any():
                dimension = int((total > room * (1 + TOLERANCE)).argmax())
                yield warning_at(
                    "FLEET_TOO_SMALL", ("fleet", types[0], "capacity"),
                    f"{_who(len(customers), len(together), name)} {amount_text(total[dimension])}"
                    f"{_of_dimension(dimension, kinds[0])} in all, and {_named(kinds)} can carry "
                    f"{amount_text(room[dimension])} on all trips: add vehicles or trips "
                    "(max_trips), check the units of demand and capacity, or state what leaving "
                    "customers out costs (unassigned_cost).")
                return


def _who(some: int, of_all: int, name: str) -> str:
    verb = "ask for" if name == "demand" else "hand out"
    return (f"Customers {verb}" if some == of_all
            else f"{some:,} customers whom only some vehicles may serve {verb}")


def _of_dimension(dimension: int, kind: VehicleTypeInput) -> str:
    return f" of amount {dimension + 1}" if len(kind.capacity) > 1 else ""


def _named(kinds: list[VehicleTypeInput]) -> str:
    vehicles = sum(kind.count for kind in kinds)
    of_types = "" if len(kinds) > 3 else f" of {', '.join(kind.id for kind in kinds)}"
    return f"{vehicles:,} vehicle{'' if vehicles == 1 else 's'}{of_types}"


def _hours(survey: Survey, by_types: dict[Types, IntArray]) -> Warnings:
    """Compare what services take with what all vehicles work, where no drone serves beside."""
    fleet = survey.request.fleet
    hours = [_working_seconds(kind) for kind in fleet]
    if None in hours or any(kind.drone_types or kind.overtime for kind in fleet):
        return
    room = sum(kind.count * (seconds or 0.0) for kind, seconds in zip(fleet, hours, strict=True))
    needed = sum(float(survey.shortest_service[served].sum()) for served in by_types.values())
    if needed > room * (1 + TOLERANCE):
        yield warning_at(
            "SHIFTS_TOO_SHORT", ("fleet", 0, "shift"),
            f"Services alone take {amount_text(needed / 3600)} h, and all vehicles together work "
            f"{amount_text(room / 3600)} h: add vehicles or hours, or check that "
            "service_duration, shift and max_working_duration are in seconds.")


def _working_seconds(kind: VehicleTypeInput) -> float | None:
    """Return how long a vehicle works at most; None: without a limit."""
    shift = None if kind.shift.latest is None else kind.shift.latest - kind.shift.earliest
    limits = [limit for limit in (shift, kind.max_working_duration) if limit is not None]
    return min(limits, default=None)


def _speeds(survey: Survey) -> Warnings:
    for index, kind in enumerate(survey.request.fleet):
        speed = kind.speed_kmh
        if speed is None or not survey.is_located(kind) or not survey.is_lifelike:
            continue
        kmh = speed * 3.6
        crooked = speed * 2 != round(speed * 2)
        if speed <= MOST_MPS_KMH and crooked and (
                abs(kmh / KMH_STEP - round(kmh / KMH_STEP)) * KMH_STEP <= KMH_ROUNDING):
            yield warning_at(
                "SPEED_LOOKS_LIKE_METRES_PER_SECOND", ("fleet", index, "speed_kmh"),
                f"{speed:g} looks like {round(kmh):g} km/h in metres a second: speed_kmh is in "
                f"km/h, write {round(kmh):g}.")
        elif survey.is_geographic and not SLOW_KMH <= speed <= FAST_KMH:
            yield warning_at(
                "SPEED_UNLIKELY", ("fleet", index, "speed_kmh"),
                f"Vehicles of type {kind.id!r} drive {speed:g} km/h: check the unit of speed_kmh.")
