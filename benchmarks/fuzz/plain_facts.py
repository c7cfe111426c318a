"""What a plan says of the rules of a working day, read from request and reply alone.

A second judge beside the service's own, of rules that are told in a line each. It shares nothing
with it but the wire; plans that go on from others aren't read.
"""

import math
from collections import defaultdict
from collections.abc import Iterator
from itertools import combinations, pairwise
from typing import Any, NamedTuple

from benchmarks.quality.driving_law import Activity, Law, broken_laws

Data = dict[str, Any]

SLACK = 0.0015
"""Seconds by which sums of rounded times may differ."""

AT_LAST = 1000
"""The place in a stop's order of what comes aboard there, behind all that leaves."""

PRESETS = {
    "eu-561": Law(16_200_000, 2_700_000, (900_000, 1_800_000), 32_400_000),
    "eu-561+2002-15": Law(16_200_000, 2_700_000, (900_000, 1_800_000), 32_400_000, 21_600_000),
    "us-hos": Law(28_800_000, 1_800_000, None, 39_600_000, None, True)}


def faults_of(request: Data, plan: Data) -> Iterator[str]:
    """Yield what is wrong with a plan, in words."""
    kinds = {kind["id"]: kind for kind in request["fleet"]}
    for route in plan["routes"]:
        kind = kinds[route["type"]]
        yield from _faults_of_breaks(kind, route)
        yield from _faults_at_the_wheel(kind, route)
        yield from _faults_of_hours(request, kind, route)
        if not kind.get("flies"):
            yield from _faults_of_legs(request, route)
            yield from _faults_of_launches(kind, route)
    yield from _faults_of_shipments(request, plan)
    yield from _faults_of_relations(request, plan)


def _by_vehicle(plan: Data) -> Iterator[tuple[str, int, Data]]:
    """Yield all that is served, with its vehicle and the number of the trip."""
    for route in plan["routes"]:
        for number, trip in enumerate(route["trips"]):
            visits = [visit for sortie in trip["sorties"] for visit in sortie["customers"]]
            stops = [stop for stop in trip["stops"] if stop["kind"] == "customer"]
            for visit in (*stops, *visits):
                yield route["vehicle"], number, visit


def _ends_by_vehicle(plan: Data) -> Iterator[tuple[str, int, Data]]:
    """Yield ends of shipments likewise, by their names among customers."""
    for route in plan["routes"]:
        for number, trip in enumerate(route["trips"]):
            halts = [*trip["stops"],
                     *(visit for sortie in trip["sorties"] for visit in sortie["customers"])]
            for halt in halts:
                if halt.get("kind") in ("pickup", "delivery"):
                    yield route["vehicle"], number, halt | {"id": f"{halt['id']}/{halt['kind']}"}


def _faults_of_breaks(kind: Data, route: Data) -> Iterator[str]:
    stated = {each["id"]: each for each in kind.get("breaks", ())}
    departure = min(stop["arrival"] for stop in route["trips"][0]["stops"])
    seen = set[str]()
    for trip in route["trips"]:
        for stop in [stop for stop in trip["stops"] if stop["kind"] == "break"]:
            each, begin, end = stated.get(stop["id"]), stop["service_start"], stop["departure"]
            for sortie in trip["sorties"]:
                if any(begin + SLACK < sortie[name] < end - SLACK
                       for name in ("launch_time", "recovery_time")):
                    yield f"a drone is launched or recovered in break {stop['id']}"
            if each is None:
                continue
            window, since = each["start"], departure if each["after_departure"] else 0
            latest = window["latest"]
            if begin < window["earliest"] + since - SLACK or (
                    latest is not None and begin > latest + since + SLACK):
                yield f"break {stop['id']} begins at {begin}"
            if abs(end - begin - each["duration"]) > SLACK or stop["id"] in seen:
                yield f"break {stop['id']} is not as long as stated, or taken twice"
            seen.add(stop["id"])


def _record_of(route: Data) -> list[Activity]:
    """Return what a tachograph writes down."""
    found: list[Activity] = []
    now = round(1000 * route["trips"][0]["stops"][0]["arrival"])
    for trip in route["trips"]:
        for number, stop in enumerate(trip["stops"]):
            arrival, start, departure = (round(1000 * stop[name]) for name in (
                "arrival", "service_start", "departure"))
            found.append(("drive" if number else "work", now, arrival))
            is_break = stop["kind"] == "break"
            found += [("work", arrival, start), ("rest" if is_break else "work", start, departure)]
            now = departure
    return [each for each in found if each[2] > each[1]]


def _faults_at_the_wheel(kind: Data, route: Data) -> Iterator[str]:
    record = _record_of(route)
    longest = kind.get("max_travel_duration")
    driven = sum(end - begin for what, begin, end in record if what == "drive")
    if longest is not None and driven > 1000 * longest:
        yield f"{route['vehicle']} is on legs for {driven} ms"
    farthest = kind.get("max_distance")
    if farthest is not None and sum(trip["distance"] for trip in route["trips"]) > farthest + SLACK:
        yield f"{route['vehicle']} drives more than {farthest} m"
    rules = kind.get("driving_rules")
    if rules is None:
        return
    before = [round(1000 * rules.get(name, 0)) for name in ("driven_before", "worked_before")]
    law = PRESETS[rules["preset"]] if "preset" in rules else _law_of(rules)
    for what in broken_laws(record, law, *before):
        yield f"{route['vehicle']} breaks a driving rule: {what}"


def _law_of(rules: Data) -> Law:
    def milliseconds(name: str) -> int | None:
        return None if rules[name] is None else round(1000 * rules[name])

    split = rules["split"]
    return Law(milliseconds("max_driving") or 10**15, milliseconds("break_duration") or 0,
               None if split is None else (round(1000 * split[0]), round(1000 * split[1])),
               milliseconds("max_driving_per_day"), milliseconds("max_work_before_break"),
               rules.get("other_work_interrupts", False))


def _faults_of_hours(request: Data, kind: Data, route: Data) -> Iterator[str]:
    hours = {depot["id"]: depot.get("time_window", {}) for depot in request["depots"]}
    for trip in route["trips"]:
        for stop in trip["stops"]:
            opens = hours.get(stop["id"], {}) if stop["kind"] == "depot" else {}
            latest = opens.get("latest")
            if stop["departure"] < opens.get("earliest", 0) - SLACK or (
                    latest is not None and stop["arrival"] > latest + SLACK):
                yield f"{route['vehicle']} is at {stop['id']} while it is closed"


def _faults_of_legs(request: Data, route: Data) -> Iterator[str]:
    durations = (request.get("matrices") or {}).get("truck", {}).get("durations")
    if durations is None:
        return
    places: dict[tuple[str, str, str | None], Data] = {
        **{(kind, each["id"], None): each for kind in ("launch_site", "depot", "customer")
           for each in request.get(f"{kind}s", ())},
        **{(kind, each["id"], part): end for each in request.get("shipments", ())
           for kind, part, end in _ends_of(each)}}
    for trip in route["trips"]:
        known = [None if stop.get("alternative")
                 else places.get((stop["kind"], stop["id"], stop.get("part")))
                 for stop in trip["stops"] if stop["kind"] != "break"]
        for origin, to in pairwise(known):
            if origin is not None and to is not None and durations[
                    origin["location_index"]][to["location_index"]] is None:
                yield f"{route['vehicle']} takes a leg that isn't there"


def _ends_of(shipment: Data) -> Iterator[tuple[str, str | None, Data]]:
    """Yield a shipment's ends by kind and part."""
    if shipment.get("pickup"):
        yield "pickup", None, shipment["pickup"]
    for part in shipment.get("pickups", ()):
        yield "pickup", part["id"], part
    yield "delivery", None, shipment["delivery"]


def _faults_of_launches(kind: Data, route: Data) -> Iterator[str]:
    drones = kind.get("drones") or {}
    for trip in route["trips"]:
        for sortie in trip["sorties"]:
            if kind.get("truck_waits") and sortie["launch_stop"] != sortie["recovery_stop"]:
                yield f"{route['vehicle']} drives while {sortie['drone']} is out"
            if len(sortie["customers"]) > drones.get("max_customers_per_sortie", 1):
                yield f"{sortie['drone']} serves {len(sortie['customers'])} on one sortie"


class _Change(NamedTuple):
    """What comes aboard a truck of a shipment, or leaves it."""

    stop: int
    order: int  # at that stop: what leaves, comes and leaves on one sortie, comes, leaves again
    comes: bool
    id: str
    time: float  # of the end of service at a pickup, of its start at a delivery


def _changes_of(trip: Data) -> list[_Change]:
    """Return what a trip fetches and brings, in order.

    A drone does so where it is recovered or launched, or both there if it is on one sortie. What
    it brings may have come aboard where it is launched, if it takes off behind that.
    """
    changes, ready = [], dict[tuple[int, str], float]()

    def add(stop: int, order: int, visit: Data) -> None:
        comes = visit["kind"] == "pickup"
        changes.append(_Change(stop, order, comes, visit["id"],
                               visit["departure" if comes else "service_start"]))

    def come(stop: int, visit: Data, time: float) -> None:
        add(stop, AT_LAST, visit)
        ready[stop, visit["id"]] = max(time, ready.get((stop, visit["id"]), time))

    for number, stop in enumerate(trip["stops"]):
        if stop["kind"] == "pickup":
            come(number, stop, stop["service_start"])
        elif stop["kind"] == "delivery":
            add(number, 0, stop)
    brought = []
    for sortie in trip["sorties"]:
        ends = [visit for visit in sortie["customers"] if visit.get("kind")]
        for number, visit in enumerate(ends, 1):
            if sum(each["id"] == visit["id"] for each in ends) > 1:
                add(sortie["launch_stop"], number, visit)
            elif visit["kind"] == "pickup":
                come(sortie["recovery_stop"], visit, sortie["recovery_time"])
            else:
                brought.append((sortie, visit))
    for sortie, visit in brought:
        since = ready.get((sortie["launch_stop"], visit["id"]), math.inf)
        is_from_there = since <= sortie["launch_time"] + SLACK
        add(sortie["launch_stop"], AT_LAST + 1 if is_from_there else 0, visit)
    return sorted(changes)


def _faults_of_shipments(request: Data, plan: Data) -> Iterator[str]:
    stated = {each["id"]: each for each in request.get("shipments", ())}
    left = {each["id"] for each in plan["unassigned"] if each.get("kind") == "shipment"}
    stacks = {kind["id"] for kind in request["fleet"] if kind.get("lifo")}
    found = dict[str, int]()
    for route in plan["routes"]:
        for trip in route["trips"]:
            begun, stack = dict[str, float](), list[str]()
            visits = [visit for sortie in trip["sorties"] for visit in sortie["customers"]]
            if route["type"] in stacks and any(visit.get("kind") for visit in visits):
                yield f"a drone takes from the stack of {route['vehicle']}"
            for change in _changes_of(trip):
                if change.comes:
                    begun.setdefault(change.id, change.time)
                    stack.append(change.id)
                    continue
                found[change.id] = found.get(change.id, 0) + 1
                parts = max(1, len(stated[change.id].get("pickups", ())))
                if stack.count(change.id) != parts:
                    yield f"{change.id} is delivered before its pickup"
                    continue
                if route["type"] in stacks and {*stack[-parts:]} != {change.id}:
                    yield f"{change.id} isn't on top"
                stack = [name for name in stack if name != change.id]
                between = change.time - begun.pop(change.id)
                longest = stated[change.id].get("max_time_between")
                if longest is not None and between > longest + SLACK:
                    yield f"{change.id} is aboard for {between} s"
            if begun:
                yield f"{sorted(begun)} aren't delivered on the trip"
    if {*found, *left} != {*stated} or any(times > 1 for times in found.values()):
        yield "shipments are brought twice, or neither brought nor left out"


def _faults_of_relations(request: Data, plan: Data) -> Iterator[str]:
    visits = [*_by_vehicle(plan), *_ends_by_vehicle(plan)]
    where = {visit["id"]: (vehicle, trip) for vehicle, trip, visit in visits}
    begins = {visit["id"]: visit["service_start"] for _, _, visit in visits}
    for relation in request.get("relations", ()):
        scope = 2 if relation.get("scope") == "trip" else 1
        served = [name for name in relation["customers"] if name in where]
        groups = defaultdict[tuple[Any, ...], list[str]](list)
        for name in served:
            groups[where[name][:scope]].append(name)
        if relation["kind"] == "apart" and len(groups) < len(served):
            yield f"{served} are not kept apart"
        if (relation["kind"] != "apart" and relation.get("same_vehicle", True)
                and len(groups) > 1):
            yield f"{served} are not kept together"
        if relation["kind"] == "before":
            yield from _faults_of_order(relation, served, begins)


def _faults_of_order(relation: Data, served: list[str], begins: dict[str, float]) -> Iterator[str]:
    for name, behind in combinations(served, 2):
        if begins[behind] - begins[name] < relation.get("min_lag", 0) - SLACK:
            yield f"{behind} is served too soon after {name}"
    if relation.get("max_lag") is not None and len(served) == len(relation["customers"]):
        for name, behind in pairwise(served):
            if begins[behind] - begins[name] > relation["max_lag"] + SLACK:
                yield f"{behind} is served too late after {name}"


def met_in(request: Data, plan: Data) -> set[str]:
    """Return the rules of a day that a plan shows."""
    stops = [stop for route in plan["routes"] for trip in route["trips"] for stop in trip["stops"]]
    visits = [visit for _, _, visit in _by_vehicle(plan)]
    served = {visit["id"] for visit in visits}
    met = {"driving_rules" if stop["id"] == "rest" else "breaks"
           for stop in stops if stop["kind"] == "break"}
    met |= {"shipments" for stop in (*stops, *visits) if stop.get("kind") == "pickup"}
    met |= {"alternatives" for visit in visits if visit.get("alternative")}
    met |= {"vehicle_costs" for each in request["customers"]
            if each["id"] in served and each.get("vehicle_costs")}
    met |= {"late_cost" for visit in visits if visit.get("lateness")}
    met |= {relation["kind"] for relation in request.get("relations", ())
            if len(served & set(relation["customers"])) > 1}
    return met | {name for name in ("makespan", "balance") if plan["cost"][name]}
