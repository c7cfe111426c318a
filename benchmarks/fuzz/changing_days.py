"""Days of trucks with drones that change while they go on: requests, plans and what happens.

All is drawn from the generator passed. What is drawn to happen is always allowed: nobody is
cancelled who has been served, and nothing is stated of the past that contradicts itself.
"""

import copy
import random
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from itertools import count
from typing import Any

Data = dict[str, Any]

PLACES = 8
"""Kilometres from the middle to the edge, which takes as many minutes."""

MOST_CUSTOMERS = 8


@dataclass(frozen=True)
class Change:
    """What has happened by an instant."""

    request: Data  # as it is from then on, without `replan`
    now: float
    broken: frozenset[str] = frozenset()  # vehicles
    lost: frozenset[str] = frozenset()  # drones
    back: float | None = None  # when parcels aboard broken vehicles are at the depots
    stay: frozenset[str] = frozenset()  # which of `pin_all` and `keep_order` hold

    def replan(self, plan: Data) -> Data:
        """Return the request to plan on from a plan."""
        terms = {"plan": {"routes": plan["routes"], "unassigned": plan["unassigned"]},
                 "freeze_before": self.now, "unavailable": sorted(self.broken | self.lost),
                 "parcels_back": self.back, **dict.fromkeys(sorted(self.stay), True)}
        return self.request | {"replan": terms}


def morning(rng: random.Random) -> Data:
    """Return a request."""
    depots = [{"id": f"D{number}", "location": _place(rng)} for number in range(rng.choice((1, 2)))]
    customers = [_customer(rng, f"c{number}", depots)
                 for number in range(rng.randint(2, MOST_CUSTOMERS))]
    fleet = [_vehicle_type(rng, f"t{number}", depots) for number in range(rng.choice((1, 1, 2)))]
    return {"coordinate_system": "planar", "planar_unit": 1000, "depots": depots,
            "customers": customers, "fleet": fleet, "unassigned_cost": rng.choice((None, 50, 500)),
            **_maybe(rng, 0.2, fairness=rng.choice((
                {"makespan_cost_per_hour": 20}, {"balance": {"measure": "duration", "cost": 10}},
                {"balance": {"measure": "stops", "cost": 1}, "makespan_cost_per_hour": 5}))),
            "options": {"time_limit": 20, "search_iterations": rng.choice((0, 20, 60)),
                        "threads": 1, "seed": rng.randrange(1000)}}


def _place(rng: random.Random) -> list[float]:
    return [round(rng.uniform(-PLACES, PLACES), 1), round(rng.uniform(-PLACES, PLACES), 1)]


def _maybe(rng: random.Random, share: float, **fields: Any) -> Data:
    """Return fields, or none of them."""
    return fields if rng.random() < share else {}


def _customer(rng: random.Random, name: str, depots: list[Data]) -> Data:
    earliest = rng.choice((0, 0, 0, 600, 1800))
    latest = earliest + rng.choice((900, 1800, 5400))
    at_depot = rng.random() < 0.05
    return {
        "id": name, "location": rng.choice(depots)["location"] if at_depot else _place(rng),
        "demand": [rng.choice((0, 1, 1, 2))], "service_duration": rng.choice((0, 60, 300, 333.333)),
        "served_by": rng.choice(("either", "either", "either", "truck", "drone")),
        **_maybe(rng, 0.15, pickup=[rng.choice((1, 2))]),
        **_maybe(rng, 0.25, time_window={
            "earliest": earliest, "latest": latest,
            "late_cost_per_hour": rng.choice((None, None, 20))}),
        **_maybe(rng, 0.1, setup_duration=60),
        **_maybe(rng, 0.1, max_time_aboard=rng.choice((1200, 3600))),
        **_maybe(rng, 0.1, release_time=rng.choice((300, 1500)))}


def _vehicle_type(rng: random.Random, name: str, depots: list[Data]) -> Data:
    ends = rng.random()
    trips = rng.choice((1, 1, 2, 3))
    return {
        "id": name, "count": rng.choice((1, 1, 2, 3)), "depot": rng.choice(depots)["id"],
        "capacity": [rng.choice((4, 8, 20))], "speed_kmh": 60, "max_trips": trips,
        "reload_duration": rng.choice((0, 120)),
        "costs": {"fixed": rng.choice((0, 5)), "per_km": 1, "per_hour": rng.choice((0, 0, 20))},
        "pickups": rng.choice(("any", "last")),
        **({"end": "open"} if ends < 0.25 else {"end": {"location": _place(rng)}}
           if ends < 0.5 else {}),
        **_maybe(rng, 0.35, start_location=_place(rng)),
        **_maybe(rng, 0.2, reload_depots=[depot["id"] for depot in depots]),
        **_maybe(rng, 0.2, max_working_duration=rng.choice((3600, 7200))),
        **_maybe(rng, 0.2, max_trip_distance=rng.choice((30_000, 60_000))),
        **_maybe(rng, 0.1, max_stops=rng.choice((2, 4))),
        **_maybe(rng, 0.15, shift={"earliest": 0, "latest": rng.choice((3600, 7200))}),
        **_maybe(rng, 0.15, overtime={"max_duration": 1800, "cost_per_hour": 30}),
        **_maybe(rng, 0.25, breaks=_breaks(rng)), **_maybe(rng, 0.2, driving_rules=_rules(rng)),
        **_maybe(rng, 0.8, drones=_drones(rng))}


def _breaks(rng: random.Random) -> list[Data]:
    return [{"id": f"b{number}", "duration": rng.choice((120, 600)),
             "start": {"earliest": 1800 * number + rng.choice((0, 300)),
                       "latest": 1800 * number + rng.choice((600, 1500))},
             "after_departure": rng.random() < 0.3, "at": rng.choice(("stop", "anywhere")),
             "paid": rng.random() < 0.7} for number in range(rng.choice((1, 1, 2)))]


def _rules(rng: random.Random) -> Data:
    return {"max_driving": rng.choice((900, 1800, 3600)), "break_duration": rng.choice((300, 600)),
            "split": rng.choice((None, [120, 300])),
            "max_work_before_break": rng.choice((None, None, 5400)),
            "while_drones_fly": rng.random() < 0.7}


def _drones(rng: random.Random) -> Data:
    return {
        "count": rng.choice((1, 1, 2)), "capacity": [rng.choice((1, 2, 4))],
        "speed_kmh": rng.choice((30, 60, 90)), "endurance": rng.choice((1200, 3600, None)),
        "endurance_includes_waiting": rng.random() < 0.5,
        "launch_duration": rng.choice((0, 30)), "recovery_duration": rng.choice((0, 30)),
        "max_customers_per_sortie": rng.choice((1, 1, 2)),
        "costs": {"per_km": 0.1, "per_hour": 0},
        **_maybe(rng, 0.15, turnaround={"swap_duration": 60, "batteries": rng.choice((1, 3))})}


def by_hand(rng: random.Random, plan: Data) -> Data:
    """Return a plan without times whose flights are met later, or whose stops have swapped."""
    routes = [{"vehicle": route["vehicle"], "type": route["type"],
               "trips": [_untimed(trip) for trip in route["trips"]]} for route in plan["routes"]]
    for route in routes:
        for trip in route["trips"]:
            last = len(trip["stops"]) - 1
            if trip["sorties"] and rng.random() < 0.7:
                sortie = rng.choice(trip["sorties"])
                sortie["recovery_stop"] = last
            elif last > 2 and rng.random() < 0.3:
                at = rng.randrange(1, last - 1)
                trip["stops"][at:at + 2] = reversed(trip["stops"][at:at + 2])
    return {"routes": routes, "unassigned": [{"id": left["id"]} for left in plan["unassigned"]]}


def _untimed(trip: Data) -> Data:
    """Return a trip without times and breaks."""
    stops = [stop for stop in trip["stops"] if stop["kind"] != "break"]
    return {"stops": [{"kind": stop["kind"], "id": stop["id"]} for stop in stops],
            "sorties": [{"drone": sortie["drone"],
                         **{name: stops.index(trip["stops"][sortie[name]])
                            for name in ("launch_stop", "recovery_stop")},
                         "customers": [{"id": visit["id"]} for visit in sortie["customers"]]}
                        for sortie in trip["sorties"]]}


def what_happens(rng: random.Random, request: Data, plan: Data, since: float = 0.0) -> Change:
    """Return what has happened by an instant after `since`, of which some is past by then."""
    now = _instant(rng, plan, since)
    later = copy.deepcopy(request)
    later["options"]["search_iterations"] = rng.choice((0, 20, 60))
    events = rng.choices((_windows_change, _orders_change, _fleet_changes), k=rng.choice((0, 1, 2)))
    committed = set(committed_to(plan, now, request))
    for event in events:
        if later["customers"]:
            event(rng, later, committed, now)
    broken = frozenset(route["vehicle"] for route in plan["routes"] if rng.random() < 0.12)
    drones = sorted({sortie["drone"] for route in plan["routes"] for trip in route["trips"]
                     for sortie in trip["sorties"]})
    lost = frozenset(drone for drone in drones if rng.random() < 0.2)
    back = round(now + rng.choice((0, 600)), 3) if broken and rng.random() < 0.5 else None
    stay = frozenset(rng.choice(((), (), (), ("pin_all",), ("pin_all", "keep_order"))))
    return Change(later, now, broken, lost, back, stay)


def _instant(rng: random.Random, plan: Data, since: float) -> float:
    """Return an instant while drones are in the air or trucks drive, most times."""
    moments = [stop[name] for route in plan["routes"] for trip in route["trips"]
               for stop in trip["stops"] for name in ("arrival", "departure")]
    flights = [(sortie["launch_time"], sortie["recovery_time"]) for route in plan["routes"]
               for trip in route["trips"] for sortie in trip["sorties"]]
    draw = rng.random()
    if flights and draw < 0.4:
        begin, end = rng.choice(flights)
        now = begin + rng.random() * (end - begin)
    elif moments and draw < 0.6:
        now = rng.choice(moments)
    elif moments:
        now = min(moments) + rng.random() * (max(moments) - min(moments))
    else:
        now = 600.0
    return round(max(since, now), 3)


def committed_to(plan: Data, now: float, request: Data) -> Iterator[str]:
    """Yield whom vehicles have served, are on their way to, or where they meet drones.

    Drivers who rest make the trips that they have begun to the end.
    """
    resting = {kind["id"] for kind in request["fleet"]
               if kind.get("breaks") or kind.get("driving_rules")}
    durations = {kind["id"]: _longest_launch(kind.get("drones") or {})
                 for kind in request["fleet"]}
    for route in plan["routes"]:
        for trip in route["trips"]:
            left = 0
            while left < len(trip["stops"]) and trip["stops"][left]["departure"] <= now:
                left += 1
            flown = [sortie for sortie in trip["sorties"]
                     if sortie["launch_time"] - durations[route["type"]] <= now]
            if not left and not flown:
                continue
            if route["type"] in resting:
                left, flown = len(trip["stops"]), trip["sorties"]
            yield from (stop["id"] for stop in trip["stops"][:left + 1]
                        if stop["kind"] == "customer")
            for sortie in flown:
                yield from (visit["id"] for visit in sortie["customers"])
                yield trip["stops"][sortie["recovery_stop"]]["id"]


def _longest_launch(drones: Data) -> float:
    """Return how long a launch takes that needs another battery."""
    swapping: float = (drones.get("turnaround") or {}).get("swap_duration", 0)
    return swapping + float(drones.get("launch_duration", 0))


def _windows_change(rng: random.Random, later: Data, committed: Collection[str],
                    now: float) -> None:
    """Close or change windows, past ones most times. In place."""
    past = [customer for customer in later["customers"] if customer["id"] in committed]
    chosen = rng.choice(past if past and rng.random() < 0.7 else later["customers"])
    chosen.pop("time_windows", None)
    chosen["time_window"] = {"earliest": 0, "latest": rng.choice((0, 0, now, now + 900))}


def _orders_change(rng: random.Random, later: Data, committed: Collection[str],
                   now: float) -> None:
    """Cancel orders, take new ones, or have them weigh more. In place."""
    customers = later["customers"]
    free = [customer for customer in customers if customer["id"] not in committed]
    draw = rng.random()
    if draw < 0.5 and free:
        gone = rng.sample(free, rng.randint(1, len(free)))
        later["customers"] = [customer for customer in customers if customer not in gone]
    elif draw < 0.8:
        taken = {customer["id"] for customer in customers}
        name = next(name for number in count(len(customers))
                    if (name := f"n{number}-{round(now)}") not in taken)
        customers.append(_customer(rng, name, later["depots"]))
    else:
        chosen = rng.choice(customers)
        chosen["demand"] = [2 * amount for amount in chosen["demand"]]


def _fleet_changes(rng: random.Random, later: Data, _: Collection[str], now: float) -> None:
    """Change a rule of a vehicle type. In place."""
    kind = rng.choice(later["fleet"])
    kind |= rng.choice((
        {"pickups": "last"}, {"shift": {"earliest": 0, "latest": now + rng.choice((0, 600, 1800))}},
        {"max_working_duration": rng.choice((600, 1800))}, {"max_trip_distance": 10_000},
        {"max_stops": 1}, {"capacity": [2]}, {"max_trips": 3}))
    if "overtime" in kind and rng.random() < 0.5:
        del kind["overtime"]
