"""Make the example requests beside this file.

    python examples/make.py ../shared/data/seed

The argument is the folder with `table1.json` and `reference_plan.json`, the paper's Table 1 and a
feasible plan for it.
"""

import json
import random
import sys
from pathlib import Path
from typing import Any

import numpy as np
import osmium
from shapely import Point, Polygon

from app.requests.conversion.problem import to_problem
from app.schemas.openapi import EXAMPLES_DIR, EXAMPLES as DOCUMENTED
from app.schemas.request import PlanRequest
from model.judge.timing import RouteDecision, SortieDecision, TripDecision, schedule
from model.solution import Stop, Visit
from model.travel.matrices import great_circle_distances

WINDOWS_SEED = 20250926
CITY_SEED = 47
DAY_SEED = 12

HOUR = 3600
MINUTE = 60

Data = dict[str, Any]
Windows = dict[str, tuple[float, float]]
Location = tuple[float, float]
Address = tuple[str, str]
"""Street and number."""


def table1(seed_dir: Path) -> Data:
    """Return the paper's Table 1 with one cost unit per unit of length, for trucks and drones."""
    table = json.loads((seed_dir / "table1.json").read_text("utf-8"))
    depot = table["depot"]
    return {
        "coordinate_system": "planar",
        "planar_unit": 1000,
        "depots": [{"id": str(depot["id"]), "location": [depot["x"], depot["y"]]}],
        "customers": [
            {"id": str(row["id"]), "location": [row["x"], row["y"]], "demand": [row["demand"]],
             "served_by": row["served_by"]}
            for row in table["customers"]
        ],
        "fleet": [
            {"id": "truck", "count": 4, "capacity": [400], "costs": {"per_km": 1},
             "drones": {"count": 1, "capacity": [10], "costs": {"per_km": 1}}}
        ],
        "options": {"seed": 0, "time_limit": 1.0},
    }


def table1_windows(seed_dir: Path) -> Data:
    """Return Table 1 as a working day with a time window for most customers.

    Every window contains the customer's arrival in the reference plan, driven from 7:00 on, so
    that all hard windows can be kept at once. Times are seconds since midnight.
    """
    request = table1(seed_dir)
    request["fleet"][0] |= {"shift": {"earliest": 6 * HOUR, "latest": 18 * HOUR},
                            "max_working_duration": 10 * HOUR,
                            "costs": {"fixed": 50, "per_km": 1, "per_hour": 20}}
    request["fleet"][0]["drones"] |= {"endurance": 2 * HOUR, "launch_duration": MINUTE,
                                      "recovery_duration": MINUTE}
    for customer in request["customers"]:
        customer["service_duration"] = 5 * MINUTE
    rng = random.Random(WINDOWS_SEED)
    for customer, arrival in zip(request["customers"], _arrivals(request, seed_dir), strict=True):
        kind = rng.choices(("none", "hard", "soft"), (20, 50, 30))[0]
        width = rng.choice((1, 2, 4)) * HOUR
        earliest = arrival - rng.uniform(0.2, 0.8) * width
        if kind == "none":
            continue
        quarter = 15 * MINUTE
        window: Data = {"earliest": max(6 * HOUR, int(earliest // quarter) * quarter),
                        "latest": (int((earliest + width) // quarter) + 1) * quarter}
        if kind == "soft":
            window["late_cost_per_hour"] = rng.choice((10, 30, 60))
        customer["time_window"] = window
    return request


def _arrivals(request: Data, seed_dir: Path) -> list[float]:
    """Return when the reference plan, begun at 7:00, serves each customer, in seconds."""
    problem = to_problem(PlanRequest.model_validate_json(json.dumps(request)))
    plan = json.loads((seed_dir / "reference_plan.json").read_text("utf-8"))
    arrivals = [0.0] * problem.num_customers
    for vehicle, truck in enumerate(plan["vehicles"]):
        stops = truck["truck_route"]
        nodes = (0, *(customer + 1 for customer in stops[1:-1]), 0)
        sorties = tuple(
            SortieDecision(tuple(customer + 1 for customer in sortie["customers"]),
                           stops.index(sortie["launch"]), stops.index(sortie["recover"]))
            for sortie in truck["sorties"]
        )
        trip = TripDecision(nodes, sorties, start=7 * HOUR * 1000)
        timed = schedule(problem, RouteDecision(0, vehicle, (trip,))).trips[0]
        visits = [visit for sortie in timed.sorties for visit in sortie.visits]
        halts: list[Stop | Visit] = [*timed.stops[1:-1], *visits]
        for halt in halts:
            arrivals[halt.node - 1] = halt.arrival / 1000
    return arrivals


def hetero_day() -> Data:
    """Return a day of three vehicle types that drive up to three trips within working hours.

    One unit is a kilometre, times are seconds since midnight.
    """
    rng = random.Random(DAY_SEED)
    customers = []
    for number in range(1, 51):
        customer: Data = {
            "id": f"c{number:02}", "location": [rng.randint(0, 40), rng.randint(0, 40)],
            "demand": [rng.randint(5, 35)], "service_duration": 5 * MINUTE}
        if number % 3 == 0:
            earliest = rng.randint(8, 13) * HOUR
            customer["time_window"] = {"earliest": earliest, "latest": earliest + 3 * HOUR}
        customers.append(customer)
    shift = {"earliest": 8 * HOUR, "latest": 18 * HOUR}
    fleet = [
        {"id": f"van-{capacity}", "count": count, "capacity": [capacity],
         "costs": {"fixed": fixed, "per_km": per_km, "per_hour": 15}, "speed_kmh": 45,
         "shift": shift, "max_working_duration": 8 * HOUR, "max_trips": 3,
         "reload_duration": 15 * MINUTE}
        for capacity, count, fixed, per_km in ((100, 3, 20, 0.4), (150, 2, 30, 0.5),
                                               (200, 2, 40, 0.6))
    ]
    return {
        "coordinate_system": "planar",
        "planar_unit": 1000,
        "depots": [{"id": "depot", "location": [20, 20]}],
        "customers": customers,
        "fleet": fleet,
        "options": {"seed": 0, "time_limit": 1.0},
    }


CITY_EXTRACT = Path(__file__).parent / "helsinki.osm.pbf"
CITY_HUB = ("Siltasaarenkatu", "12")
CITY_SPACING = 40.0  # metres between two customers at least
CITY_NO_FLY = ((24.9384, 60.1708), (24.9433, 60.1706), (24.9427, 60.1744), (24.9397, 60.1778),
               (24.9379, 60.1777))
"""Around the station and its tracks."""

CITY_KINDS = (  # name, how many, kg, litres, minutes of service
    ("pharmacy", 8, (1, 4), (2, 10), 3),
    ("clinic", 4, (2, 8), (5, 20), 6),
    ("bakery", 6, (15, 60), (40, 150), 8),
    ("office", 10, (5, 40), (10, 90), 5),
    ("restaurant", 8, (40, 140), (80, 300), 12),
    ("parcel-shop", 4, (60, 180), (200, 600), 15),
)


def city_day() -> Data:
    """Return a day in Helsinki's centre: three vehicle types, two trips, rush hours, wind and a
    no-fly area.

    Customers are at true addresses; who they are and what they order is made up. Times are seconds
    since midnight, amounts kilograms and litres.
    """
    rng = random.Random(CITY_SEED)
    addresses = _addresses(CITY_EXTRACT)
    hub = addresses.pop(CITY_HUB)
    chosen = iter(_spread(rng, addresses, sum(count for _, count, *_ in CITY_KINDS)))
    customers = [
        _city_customer(rng, f"{kind}-{number:02}", kind, next(chosen), kilograms, litres, minutes)
        for kind, count, kilograms, litres, minutes in CITY_KINDS
        for number in range(1, count + 1)
    ]
    return {
        "coordinate_system": "geographic",
        "depots": [{"id": "hub-north", "location": list(hub)}],
        "customers": customers,
        "fleet": [_van(), _drone_truck(), _cargo_bike()],
        "airspace": {
            "no_fly": [[list(corner) for corner in CITY_NO_FLY]],
            "wind": {"speed_kmh": 18, "direction_deg": 240},
        },
        "options": {"seed": 0, "time_limit": 2.0},
    }


def _addresses(extract: Path) -> dict[Address, Location]:
    """Return the house numbers of an extract, by street and number, in a settled order."""
    found: dict[Address, Location] = {}
    for node in (osmium.FileProcessor(str(extract), osmium.osm.NODE)
                 .with_filter(osmium.filter.KeyFilter("addr:housenumber"))):
        number = node.tags["addr:housenumber"]
        if not isinstance(node, osmium.osm.Node):
            continue
        if "addr:street" in node.tags and number.isalnum():
            place = (round(node.location.lon, 5), round(node.location.lat, 5))
            found.setdefault((node.tags["addr:street"], number), place)
    return dict(sorted(found.items()))


def _spread(rng: random.Random, addresses: dict[Address, Location],
            count: int) -> list[tuple[Address, Location]]:
    """Draw so many addresses that keep their distance from each other."""
    chosen: list[tuple[Address, Location]] = []
    for address, place in rng.sample(list(addresses.items()), len(addresses)):
        places = np.array([place, *(other for _, other in chosen)])
        gaps = great_circle_distances(places)[0, 1:]
        if (gaps >= CITY_SPACING).all():
            chosen.append((address, place))
    return chosen[:count]


def _city_customer(rng: random.Random, name: str, kind: str, address: tuple[Address, Location],
                   kilograms: tuple[int, int], litres: tuple[int, int], minutes: int) -> Data:
    (street, number), location = address
    customer: Data = {
        "id": name,
        "location": list(location),
        "demand": [rng.randint(*kilograms), rng.randint(*litres)],
        "service_duration": minutes * MINUTE,
        "info": {"address": f"{street} {number}"},
    }
    if kind == "clinic":
        customer |= {"skills": ["cooled"],
                     "time_window": {"earliest": 7 * HOUR, "latest": 11 * HOUR}}
    elif kind == "bakery":
        customer |= {"served_by": "truck",
                     "time_window": {"earliest": 6 * HOUR, "latest": 9 * HOUR,
                                     "late_cost_per_hour": 40}}
    elif kind == "restaurant":
        customer |= {"served_by": "truck",
                     "time_window": {"earliest": 9 * HOUR, "latest": 11.5 * HOUR,
                                     "late_cost_per_hour": 60, "early_cost_per_hour": 5}}
    elif kind == "pharmacy":
        in_no_fly = Polygon(CITY_NO_FLY).covers(Point(location))
        customer |= {"served_by": "either" if in_no_fly else rng.choice(("drone", "either")),
                     "release_time": rng.choice((0, 10 * HOUR))}
    elif kind == "office":
        customer["time_window"] = {"earliest": 8 * HOUR, "latest": 17 * HOUR}
    return customer


def _van() -> Data:
    return {
        "id": "van", "profile": "van", "depot": "hub-north", "count": 2, "capacity": [900, 4000],
        "costs": {"fixed": 60, "per_km": 0.45, "per_hour": 32}, "speed_kmh": 36,
        "speed_profile": _rush_hours(), "shift": {"earliest": 6 * HOUR, "latest": 18 * HOUR},
        "max_working_duration": 8.5 * HOUR, "max_trip_distance": 120_000, "max_trips": 2,
        "reload_duration": 20 * MINUTE, "skills": ["cooled"],
    }


def _drone_truck() -> Data:
    return {
        "id": "drone-truck", "profile": "van", "depot": "hub-north", "count": 2,
        "capacity": [600, 2500], "costs": {"fixed": 80, "per_km": 0.5, "per_hour": 32},
        "speed_kmh": 36, "speed_profile": _rush_hours(),
        "shift": {"earliest": 6 * HOUR, "latest": 18 * HOUR},
        "max_working_duration": 8.5 * HOUR, "max_trips": 2, "reload_duration": 20 * MINUTE,
        "drones": {"count": 2, "capacity": [5, 12], "speed_kmh": 55, "endurance": 25 * MINUTE,
                   "launch_duration": 45, "recovery_duration": 45, "service_duration": 90,
                   "max_customers_per_sortie": 2, "costs": {"per_km": 0.1, "per_hour": 2}},
    }


def _cargo_bike() -> Data:
    return {
        "id": "cargo-bike", "profile": "bicycle", "depot": "hub-north", "count": 3,
        "capacity": [120, 500], "costs": {"fixed": 15, "per_km": 0.05, "per_hour": 26},
        "speed_kmh": 16, "shift": {"earliest": 7 * HOUR, "latest": 17 * HOUR},
        "max_working_duration": 8 * HOUR, "max_trip_distance": 40_000, "max_trips": 2,
        "reload_duration": 10 * MINUTE,
    }


def _rush_hours() -> list[Data]:
    return [{"from": 7 * HOUR, "speed_kmh": 22}, {"from": 9 * HOUR, "speed_kmh": 34},
            {"from": 16 * HOUR, "speed_kmh": 20}, {"from": 18.5 * HOUR, "speed_kmh": 36}]


def write(request: Data, file: Path) -> None:
    """Write a request with one line per customer and vehicle type."""
    lines = []
    for name, value in request.items():
        if name in ("customers", "fleet"):
            entries = ",\n".join(f"    {json.dumps(entry)}" for entry in value)
            lines.append(f'  "{name}": [\n{entries}\n  ]')
        else:
            lines.append(f'  "{name}": {json.dumps(value)}')
    file.write_text("{\n" + ",\n".join(lines) + "\n}\n", "utf-8")


def main() -> None:
    """Write all examples, those of the API's documentation into the package too."""
    seed_dir, folder = Path(sys.argv[1]), Path(__file__).parent
    examples = {"table1": table1(seed_dir), "table1_windows": table1_windows(seed_dir),
                "hetero_day": hetero_day(), "city_day": city_day()}
    for name, request in examples.items():
        write(request, folder / f"{name}.json")
        if name in DOCUMENTED:
            write(request, EXAMPLES_DIR / f"{name}.json")


if __name__ == "__main__":
    main()
