"""Requests of `POST /plan` that fit the schema and make little sense otherwise.

Each fits in kind and range; what it says is extreme, contradictory or hopeless. Most are to be
planned, some refused with 422. All is drawn from the generator passed.
"""

import math
import random
from collections.abc import Callable, Sequence
from typing import Any

from benchmarks.fuzz.wild_choices import (
    RICHEST, choose_vehicles, limit_ways, offer_places, places_of, prefer_vehicles, relate,
    set_hours_apart,
)
from benchmarks.fuzz.wild_rests import let_rest
from benchmarks.fuzz.wild_shipments import add_shipments
from benchmarks.fuzz.wild_wholes import wild_fairness, wild_options

Data = dict[str, Any]
Point = list[float]

LONGEST = 10**9
"""Largest amount, duration and distance that the schema takes; some draws go up to there."""

SIZES = (0, 1, 1, 2, 3, 5, 8, 13, 30)
SKILLS = ("cold", "crane", "Führerschein", "")
GOODS = ("food", "paint", "Ölfarbe", "ice")
NAMES = ("#", "kunde #", "顧客-#", "Ünïcødé #", "🚚#", "a/b?#&=", "'\"#\\", "\u202e#",
         "truck-#", "[#].x", "-#", "# " * 60)


def wild_request(rng: random.Random, number: int | None = None, *, tables: bool = True) -> Data:
    """Return a request, with so many customers; if so asked, without tables of legs."""
    dimensions, name = rng.choice((1, 1, 2, 2, 3, 3, 8)), rng.choice(NAMES)
    system, unit, place = _geography(rng)
    depots: list[Data] = [{"id": f"D{number}", "location": place(),
                           **_maybe(rng, 0.1, time_window=_shift(rng)),
                           **_maybe(rng, 0.2, chargers=rng.choice((0, 1, 1, 3)))}
                          for number in range(rng.randint(1, 3))]
    customers = [{"id": name.replace("#", str(each)), "location": place(),
                  **_customer(rng, dimensions)}
                 for each in range(rng.choice(SIZES) if number is None else number)]
    fleet = [{"id": rng.choice(NAMES).replace("#", f"t{number}"), **_vehicle_type(rng, dimensions),
              **({"depot": rng.choice(depots)["id"]} if rng.random() < 0.5 else {})}
             for number in range(rng.choice((1, 1, 2, 4)))]
    request: Data = {
        "coordinate_system": system, "planar_unit": unit, "depots": depots, "customers": customers,
        "fleet": fleet, "airspace": _airspace(rng, place, system), "options": wild_options(rng),
        "unassigned_cost": rng.choice((None, None, 0, 1e-9, 1.0, 1000, RICHEST))}
    if system == "planar" and rng.random() < 0.2:
        request["planar_rounding"] = rng.choice(
            ("exact", "round", "trunc", "dimacs", "thousandths"))
    for share, change in ((0.25, let_rest), (0.3, choose_vehicles), (0.2, prefer_vehicles),
                          (0.3, _keep_apart), (0.3, _serve_by_type), (0.2, _bar_launches),
                          (0.2, offer_places)):
        if rng.random() < share:
            change(rng, request)
    if rng.random() < 0.3 and customers:
        _share_places(rng, request)
    if rng.random() < 0.2:
        _let_stop(rng, request, place)
    if rng.random() < 0.2:
        add_shipments(rng, request, place, lambda: _windows(rng))
    if rng.random() < 0.25 and tables:
        _add_matrices(rng, request)
    if rng.random() < 0.1:
        request["fairness"] = wild_fairness(rng)
    if rng.random() < 0.25:
        relate(rng, request)
    set_hours_apart(request)
    if rng.random() < 0.5:
        _tame(rng, request, dimensions)
    return limit_ways(rng, request)


def _geography(rng: random.Random) -> tuple[str, float, Callable[[], Point]]:
    """Return a coordinate system, its unit, and a function that draws places."""
    if rng.random() < 0.6:
        unit, spread = rng.choice(((1.0, 3e4), (1000.0, 30.0), (1000.0, 9e3), (1e-3, 5.0),
                                   (1e6, 9.0), (1.0, 0.001), (1.0, 0.0)))
        return "planar", unit, lambda: [rng.uniform(-spread, spread), rng.uniform(-spread, spread)]
    longitude, latitude, spread = rng.choice((
        (13.4, 52.5, 0.3), (180.0, 0.0, 0.2), (-180.0, 60.0, 0.2), (0.0, 90.0, 0.1),
        (77.0, -90.0, 0.5), (0.0, 0.0, 180.0), (5.0, 5.0, 0.0)))

    def draw() -> Point:
        x = longitude + rng.uniform(-spread, spread)
        y = latitude + rng.uniform(-spread, spread)
        return [(x + 180) % 360 - 180, max(-90.0, min(90.0, y))]

    return "geographic", 1.0, draw


def _amounts(rng: random.Random, dimensions: int, choices: Sequence[float]) -> list[float]:
    return [rng.choice(choices) for _ in range(dimensions)]


def _maybe(rng: random.Random, share: float, **fields: Any) -> Data:
    """Return fields, or none of them."""
    return fields if rng.random() < share else {}


def _customer(rng: random.Random, dimensions: int) -> Data:
    return {
        "demand": _amounts(rng, dimensions, (0, 1, 1, 2, 3, 7.5, 0.0004, 1e-3, 1e3, LONGEST)),
        "served_by": rng.choice(("either", "either", "truck", "drone")),
        **_maybe(rng, 0.3, pickup=_amounts(rng, dimensions, (0, 1, 2, 3, 7.5, 1e-3, LONGEST))),
        **_maybe(rng, 0.5, service_duration=rng.choice((0, 1e-4, 60, 900, 1e5, LONGEST))),
        **_windows(rng),
        **_maybe(rng, 0.1, skills=rng.sample(SKILLS[:3], rng.randint(1, 2))),
        **_maybe(rng, 0.15, max_time_aboard=rng.choice((None, 0, 60, 900, 3600, 86400, LONGEST))),
        **_maybe(rng, 0.15, release_time=rng.choice((0, 1, 3600, 86400, LONGEST))),
        **_maybe(rng, 0.2, unassigned_cost=rng.choice((None, 0, 1e-9, 3, 1000, RICHEST)))}


def _windows(rng: random.Random) -> Data:
    """Return no window, one, or several, which may be disordered now and then."""
    several = rng.random()
    if several < 0.5:
        return _maybe(rng, 0.8, time_window=_window(rng))
    if several < 0.7:
        return {}
    price = rng.choice((0, 0, 7, RICHEST))
    times = sorted(rng.sample((0, 1, 2.0005, 60, 600, 3600, 7200, 30000, 1e6, LONGEST),
                              2 * rng.randint(1, 4)))
    if rng.random() < 0.02:
        times.reverse()
    windows: list[Data] = [{"earliest": earliest, "latest": latest, "early_cost_per_hour": price}
                           for earliest, latest in zip(times[::2], times[1::2], strict=True)]
    windows[-1] |= rng.choice(({}, {"latest": None}, {"late_cost_per_hour": 12.5, "late_cost": 5}))
    return {"time_windows": windows}


def _window(rng: random.Random) -> Data:
    earliest = rng.choice((0, 0, 1.0005, 3600, 30000, 1e6, LONGEST))
    width = rng.choice((0, 0.0001, 1, 600, 7200, 1e5))
    latest = min(LONGEST, earliest + width)
    if rng.random() < 0.02:
        latest = earliest - 1
    return {"earliest": earliest, "latest": rng.choice((None, latest, latest, max(0, latest))),
            "late_cost_per_hour": rng.choice((None, None, 0, 12.5, RICHEST)),
            "early_cost_per_hour": rng.choice((0, 0, 7, RICHEST))}


def _vehicle_type(rng: random.Random, dimensions: int) -> Data:
    kind = _truck(rng, dimensions)
    return _flying(rng, kind, dimensions) if rng.random() < 0.2 else kind


def _flying(rng: random.Random, kind: Data, dimensions: int) -> Data:
    """Return a type that flies by itself, which has mostly nothing that only trucks have."""
    for name in ("drones", "speed_profile", "max_travel_duration", "max_sorties", "max_airborne",
                 "truck_waits"):
        if rng.random() < 0.98:
            kind.pop(name, None)
    return kind | {
        "flies": True,
        **_maybe(rng, 0.6, endurance=rng.choice((0, 1200, 1800, LONGEST)), max_wind_kmh=40),
        **_maybe(rng, 0.5, launch_duration=rng.choice((0, 30, 60, LONGEST)),
                 recovery_duration=rng.choice((0, 30, 60, LONGEST))),
        **_maybe(rng, 0.3, turnaround={"swap_duration": rng.choice((0, 45, LONGEST))}),
        **_maybe(rng, 0.6, energy=_energy(rng, dimensions),
                 **_maybe(rng, 0.4, turnaround={"charge_w": rng.choice((0, 1e-9, 40, 1e5))}))}


def _truck(rng: random.Random, dimensions: int) -> Data:
    kind = {
        "count": rng.choice((1, 1, 2, 3, 10_000)),
        "capacity": _amounts(rng, dimensions, (0, 5, 10, 10, 40, 1e-3, LONGEST)),
        **_maybe(rng, 0.6, costs={"fixed": rng.choice((0, 20, RICHEST)),
                                  "per_km": rng.choice((0, 1, 1e-9, RICHEST)),
                                  "per_load_km": rng.choice((0, 0, 0, 0.1, RICHEST)),
                                  "per_hour": rng.choice((0, 0, 30, RICHEST)),
                                  "per_stop": rng.choice((0, 0, 2, RICHEST))}),
        **_maybe(rng, 0.3, pickups=rng.choice(("any", "last"))),
        **_maybe(rng, 0.2, lifo=True),
        **_maybe(rng, 0.5, speed_kmh=rng.choice((1, 30, 50.123, 1000))),
        **_maybe(rng, 0.3, speed_profile=_speed_profile(rng)),
        **_maybe(rng, 0.5, shift=_shift(rng)),
        **_maybe(rng, 0.3, max_working_duration=rng.choice((0, 1, 1800, 28800, LONGEST))),
        **_maybe(rng, 0.2, overtime={"max_duration": rng.choice((None, 0, 600, 1e5, LONGEST)),
                                     "cost_per_hour": rng.choice((0, 20, RICHEST))}),
        **_maybe(rng, 0.2, max_stops=rng.choice((0, 1, 3, 1_000_000))),
        **_maybe(rng, 0.2, max_sorties=rng.choice((0, 1, 2, 1_000_000))),
        **_maybe(rng, 0.2, max_airborne=rng.choice((1, 1, 2, 1_000_000))),
        **_maybe(rng, 0.2, truck_waits=rng.random() < 0.7),
        **_maybe(rng, 0.2, max_travel_duration=rng.choice((0, 1, 1800, 28800, LONGEST))),
        **_maybe(rng, 0.3, max_trip_distance=rng.choice((0, 1, 1e4, 1e5, LONGEST))),
        **_maybe(rng, 0.4, max_trips=rng.choice((1, 2, 3, 1000)),
                 reload_duration=rng.choice((0, 0, 600, LONGEST))),
        **_maybe(rng, 0.2, skills=rng.sample(SKILLS[:3], rng.randint(1, 3))),
        **_maybe(rng, 0.5, drones=_drones_aboard(rng, dimensions))}
    if "speed_profile" in kind and rng.random() < 0.98:
        kind.pop("max_travel_duration", None)
    return kind


def _shift(rng: random.Random) -> Data:
    earliest = rng.choice((0, 0, 7200, 1e6, LONGEST))
    latest = rng.choice((None, earliest, earliest + 1, earliest + 14400, earliest + 1e6))
    if rng.random() < 0.02:
        latest = max(0, earliest - 1)
    return {"earliest": earliest, "latest": None if latest is None else min(latest, LONGEST)}


def _speed_profile(rng: random.Random) -> list[Data]:
    times = sorted(rng.sample((0, 0.001, 1, 59.9, 60, 3600, 7200, 30000, 1e6, LONGEST),
                              rng.randint(1, 6)))
    if rng.random() < 0.03:
        times.append(times[-1])
    return [{"from": time, **rng.choice(({"factor": rng.choice((0.05, 0.5, 1, 20))},
                                         {"speed_kmh": rng.choice((1, 17, 1000))}))}
            for time in times]


def _drones_aboard(rng: random.Random, dimensions: int) -> Data | list[Data]:
    """Return drones of one type, or a list of one to three types."""
    drones = _drones(rng, dimensions)
    if rng.random() < 0.7:
        return drones
    types = [drones, *(_drones(rng, dimensions) for _ in range(rng.randint(0, 2)))]
    return [each | {"id": f"kind {number}"} for number, each in enumerate(types)]


def _drones(rng: random.Random, dimensions: int) -> Data:
    return {
        "count": rng.choice((0, 1, 1, 2, 3, 32)),
        "capacity": _amounts(rng, dimensions, (0, 1, 3, 10, 10, LONGEST)),
        **_maybe(rng, 0.5, speed_kmh=rng.choice((1, 40, 120, 1000))),
        **_maybe(rng, 0.7, endurance=rng.choice((0, 60, 1200, 1800, LONGEST))),
        **_maybe(rng, 0.1, preset=rng.choice(("eu-pdra-g01", "eu-pdra-g02", "us-part-107"))),
        **_maybe(rng, 0.2, max_wind_kmh=rng.choice((0, 20, 40, 500))),
        **_maybe(rng, 0.2, max_range=rng.choice((0, 500, 5e3, 2e4, LONGEST))),
        **_maybe(rng, 0.3, endurance_includes_waiting=rng.random() < 0.5),
        **_maybe(rng, 0.5, launch_duration=rng.choice((0, 30, 60, LONGEST)),
                 recovery_duration=rng.choice((0, 30, 60, LONGEST))),
        **_maybe(rng, 0.3, service_duration=rng.choice((0, 30, 1e6))),
        **_maybe(rng, 0.4, max_customers_per_sortie=rng.choice((1, 2, 3, 100))),
        **_maybe(rng, 0.5, costs={"per_km": rng.choice((0, 0.25, RICHEST)),
                                  "per_hour": rng.choice((0, 5, RICHEST))}),
        **_maybe(rng, 0.3, turnaround={"swap_duration": rng.choice((0, 45, LONGEST)),
                                       "batteries": rng.choice((None, 0, 1, 3, 1_000_000))}),
        **_maybe(rng, 0.4, energy=_energy(rng, dimensions),
                 **_maybe(rng, 0.4, turnaround={"charge_w": rng.choice((0, 1e-9, 40, 1e5))}))}


def _energy(rng: random.Random, dimensions: int) -> Data:
    """Return a battery that is empty at once, never, or that makes little sense."""
    power = {"cruise_w": rng.choice((0, 100, 1e5)), "cruise_w_per_kg": rng.choice((0, 30, 1e5)),
             **_maybe(rng, 0.5, hover_w=rng.choice((0, 80, 1e5)), hover_w_per_kg=0)}
    climb = {"altitude": rng.choice((0, 50, LONGEST)), "up_seconds": rng.choice((0, 9, LONGEST)),
             "down_seconds": rng.choice((0, 0.001, 20)), "up_w": rng.choice((0, 300))}
    model = rng.choice(({"power": power}, {"power": power}, {"preset": "murray-raj-2020"},
                        {"preset": "dorling-2017"}, {"preset": "rodrigues-2022"}))
    return {
        "battery_wh": rng.choice((0.001, 20, 130, 1e6)), **model,
        "weight_dimension": rng.randrange(dimensions),
        **_maybe(rng, 0.5, reserve=rng.choice((0, 0.2, 0.99))),
        **_maybe(rng, 0.5, kg_per_unit=rng.choice((0, 0.1, 1, LONGEST))),
        **_maybe(rng, 0.4, climb=climb), **_maybe(rng, 0.5, lands=rng.random() < 0.5)}


def _airspace(rng: random.Random, place: Callable[[], Point], system: str) -> Data:
    """Return none, some or all of the sky, and some wind or more than a drone can bear."""
    areas = []
    for _ in range(rng.choice((0, 0, 0, 1, 3))):
        x, y = place()
        size = rng.choice((1e-3, 0.1, 1.0, 10.0) if system == "planar" else (1e-3, 0.1, 1.0))
        corners = rng.choice((3, 4, 7))
        areas.append([[x + size * math.cos(math.tau * corner / corners),
                       y + size * math.sin(math.tau * corner / corners)]
                      for corner in range(corners)])
    kept = _maybe(rng, 0.3, buffer=rng.choice((0, 1, 30, 10_000)))
    if rng.random() < 0.8:
        return {"no_fly": areas, "wind": _wind(rng), **kept}
    times = sorted(rng.sample((0, 1, 59.9, 600, 3600, 7200, 30000, 1e6, LONGEST),
                              rng.randint(1, 5)))
    return {"no_fly": areas, **kept, "wind": [
        {"from": time, **_wind(rng), **_maybe(rng, 0.5, gust_kmh=rng.choice((0, 30, 500)))}
        for time in times]}


def _wind(rng: random.Random) -> Data:
    return {"speed_kmh": rng.choice((0, 0, 0, 10, 60, 500)),
            "direction_deg": rng.choice((0, 90, 123.4, 360))}


def _tame(rng: random.Random, request: Data, dimensions: int) -> None:
    """Have most customers served: by amounts that fit, and fewer limits. In place."""
    for customer in request["customers"]:
        customer["demand"] = [rng.randint(0, 4) for _ in range(dimensions)]
        if "pickup" in customer:
            customer["pickup"] = [rng.randint(0, 4) for _ in range(dimensions)]
        for name in ("release_time", "skills"):
            customer.pop(name, None)
        if rng.random() < 0.7:
            customer.pop("time_window", None)
            customer.pop("time_windows", None)
            for name in ("service_duration", "setup_duration", "max_time_aboard"):
                customer.pop(name, None)
    for kind in request["fleet"]:
        kind["capacity"] = [20] * dimensions
        for name in ("max_working_duration", "max_travel_duration", "max_trip_distance", "shift",
                     "speed_profile", "max_stops"):
            if rng.random() < 0.6:
                kind.pop(name, None)
        drones = kind.get("drones") or []
        for each in drones if isinstance(drones, list) else [drones]:
            each["capacity"] = [4] * dimensions


def _keep_apart(rng: random.Random, request: Data) -> None:
    """Let some goods not be carried with others. In place."""
    for customer in request["customers"]:
        if rng.random() < 0.7:
            customer["goods"] = rng.sample(GOODS, rng.choice((0, 1, 1, 1, 1, 2)))
    request["incompatible_goods"] = [
        {"goods": rng.sample(GOODS, rng.randint(2, 3)), "scope": rng.choice(("trip", "vehicle"))}
        for _ in range(rng.randint(1, 2))]


def _serve_by_type(rng: random.Random, request: Data) -> None:
    """Let service take some vehicles longer than others, now and then unknown ones. In place."""
    names = [kind["id"] for kind in request["fleet"]]
    for kind in request["fleet"]:
        types = kind.get("drones")
        names += [f"{kind['id']}/{each['id']}" for each in (
            types if isinstance(types, list) else [{"id": "drone"}])]
    if rng.random() < 0.02:
        names.append("nobody")
    for customer in request["customers"]:
        if rng.random() < 0.5:
            customer["service_duration_by_type"] = {
                name: rng.choice((0, 1e-4, 60, 900, 1e5, LONGEST))
                for name in rng.sample(names, rng.randint(1, min(3, len(names))))}


def _share_places(rng: random.Random, request: Data) -> None:
    """Let customers ask for a setup, some of them where others are. In place."""
    places = [*request["depots"], *request["customers"]]
    for customer in request["customers"]:
        customer["setup_duration"] = rng.choice((0, 1e-4, 60, 60, 300, 900, 1e5, LONGEST))
        if rng.random() < 0.4:
            customer["location"] = rng.choice(places)["location"]


def _bar_launches(rng: random.Random, request: Data) -> None:
    """Let drones take off at some places alone. In place."""
    share = rng.choice((0.1, 0.5, 1))
    for place in (*request["depots"], *request["customers"]):
        if rng.random() < share:
            place["launch"] = rng.random() < 0.1


def _let_stop(rng: random.Random, request: Data, place: Callable[[], Point]) -> None:
    """Let trucks stop for their drones alone, or come back for them. In place."""
    names = [kind["id"] for kind in request["fleet"]]
    request["launch_sites"] = [{
        "id": f"🅿 {number}", "location": place(),
        **_maybe(rng, 0.4, cost=rng.choice((0, 1, RICHEST))),
        **_maybe(rng, 0.3, time_window=rng.choice((
            {"earliest": 3600}, {"earliest": 60, "latest": 60}, {"latest": 0},
            {"earliest": LONGEST}))),
        **_maybe(rng, 0.3, vehicles={rng.choice(("allowed", "forbidden")): [rng.choice(names)]})}
        for number in range(rng.choice((0, 1, 1, 3, 20)))]
    for kind in request["fleet"]:
        kind["revisits"] = not kind.get("flies") and rng.random() < 0.5


def _add_matrices(rng: random.Random, request: Data) -> None:
    """State legs that need not be those of any map. In place."""
    places = places_of(request)
    longest = rng.choice((0, 1, 900, 36000, LONGEST))
    keeps_locations = rng.random() < 0.5
    for index, stated in enumerate(places):
        stated["location_index"] = index
        if not keeps_locations:
            del stated["location"]
    if not keeps_locations:
        for kind in request["fleet"]:
            drones = kind.get("drones") or []
            for each in drones if isinstance(drones, list) else [drones]:
                each.pop("max_range", None)
                each.pop("preset", None)

    def table() -> list[list[float]]:
        return [[rng.choice((0, rng.uniform(0, longest), longest)) for _ in places]
                for _ in places]

    request["matrices"] = {profile: {"durations": table(), "distances": table()}
                           for profile in ("truck", "drone")}
    if rng.random() < 0.3 and keeps_locations:
        del request["matrices"][rng.choice(("truck", "drone"))]
