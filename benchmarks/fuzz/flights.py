"""Reads random plans' flights back and flies them: `python -m benchmarks.fuzz.flights`.

Cities with zones, wind and drones of all kinds are planned, and their flights written in every
format. Others' readers read them. Each flight must keep out of all zones, begin and end where and
when its truck is there, come to all of its customers in their order, land or hover there, and take
as long as planned. Fails if one doesn't.
"""

import io
import math
import random
import zipfile
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Annotated, Any

import typer
from pyproj import Geod
from shapely import LineString, Polygon, union_all

from benchmarks.fuzz.flight_readers import READERS, Place, Read
from benchmarks.fuzz.problems import Fault, Study, tried

Data = dict[str, Any]

SAME_PLACE_M = 0.02
"""Rounding of coordinates."""

INSIDE = 1e-7
"""Degrees by which a flight may cut into a zone: what its coordinates are rounded to."""

NEARBY = 0.02
"""Degrees around a flight within which all zones are told: somewhat less than promised."""

LATE_SECONDS, LATE_SHARE = 2.0, 0.01
"""By how much a flight's times may differ from the plan's: the earth is no sphere."""

GLOBE = Geod(ellps="WGS84")


def random_city(rng: random.Random) -> Data:
    """Return a problem with drones, most of which have zones and wind to fly around and in."""
    latitude = rng.uniform(-55, 65)
    centre = (rng.choice((rng.uniform(-170, 170), 0.0)), latitude)
    size = rng.choice((0.01, 0.03, 0.06))

    def place() -> list[float]:
        return [round(centre[0] + rng.uniform(-size, size) / math.cos(math.radians(latitude)), 6),
                round(latitude + rng.uniform(-size, size), 6)]

    zones = [_zone(rng, place(), size) for _ in range(rng.choice((0, 1, 2, 4)))]
    hub = place()
    customers: list[Data] = [
        {"id": f"C{number}", "location": place(), "demand": [rng.randint(1, 3)],
         "service_duration": rng.choice((0, 60, 300)),
         "served_by": rng.choice(("either", "drone", "drone")),
         "time_window": {"earliest": rng.choice((0, 0, 600)), "latest": None}}
        for number in range(rng.randint(3, 12))]
    return {
        "coordinate_system": "geographic", "depots": [{"id": "hub", "location": hub}],
        "customers": [customer for customer in customers
                      if not _holds(zones, customer["location"])],
        "fleet": [{"id": "van", "count": rng.randint(1, 2), "capacity": [30],
                   "speed_kmh": rng.choice((15, 40)), "costs": {"per_km": 1, "per_hour": 20},
                   "drones": _drones(rng)}, *([_hub_drones(rng)] if rng.random() < 0.4 else [])],
        "airspace": {"no_fly": [zone for zone in zones[1:] if not _holds([zone], hub)],
                     "zones": [_published(rng, zone) for zone in zones[:1]
                               if not _holds([zone], hub)],
                     "buffer": rng.choice((0, 0, 30)),
                     "wind": {"speed_kmh": rng.choice((0, 0, 15)),
                              "direction_deg": rng.randint(0, 360)}},
        "unassigned_cost": 100, "options": {"time_limit": 0.1, "seed": rng.randint(0, 99)}}


def _zone(rng: random.Random, centre: list[float], size: float) -> list[list[float]]:
    """Return a star around a place, so that it has corners inwards too."""
    corners = rng.randint(3, 9)
    wide = 1 / math.cos(math.radians(centre[1]))
    ring = []
    for number in range(corners):
        radius = size * rng.uniform(0.05, 0.4)
        angle = 2 * math.pi * number / corners
        ring.append([round(centre[0] + wide * radius * math.cos(angle), 6),
                     round(centre[1] + radius * math.sin(angle), 6)])
    return ring


def _published(rng: random.Random, zone: list[list[float]]) -> Data:
    """Return a zone as GeoJSON, at times with a hole that no flight gets to."""
    (x, y), rings = Polygon(zone).representative_point().coords[0], [[*zone, zone[0]]]
    if rng.random() < 0.5:
        rings.append([[x, y], [x + 1e-4, y], [x, y + 1e-4], [x, y]])
    return {"format": "geojson", "data": {"type": "Polygon", "coordinates": rings}}


def _holds(zones: list[list[list[float]]], place: list[float]) -> bool:
    return any(Polygon(zone).buffer(1e-6).intersects(LineString([place, place])) for zone in zones)


def _drones(rng: random.Random) -> Data:
    drones: Data = {
        "count": rng.randint(1, 2), "capacity": [3], "speed_kmh": rng.choice((30, 38)),
        "launch_duration": rng.choice((0, 30)), "recovery_duration": rng.choice((0, 40)),
        "max_customers_per_sortie": rng.choice((1, 3)), "costs": {"per_km": 0.1},
        "endurance": rng.choice((None, 1800))}
    if rng.random() < 0.5:
        drones["energy"] = {
            "battery_wh": 800, "lands": rng.random() < 0.5, "power": {"cruise_w": 300},
            "climb": {"altitude": 100, "up_seconds": rng.choice((0, 20)), "up_w": 500,
                      "down_seconds": rng.choice((0, 25)), "down_w": 200}}
    return drones


def _hub_drones(rng: random.Random) -> Data:
    """Return drones that fly from the hub by themselves."""
    drones = _drones(rng)
    for name in ("count", "max_customers_per_sortie"):
        del drones[name]
    return drones | {"id": "flyer", "flies": True, "count": 2, "max_trips": 3,
                     "costs": {"per_km": 0.1}}


@dataclass
class FlightStudy(Study):
    """What came of all flights."""

    read: Counter[str] = field(default_factory=Counter)
    bent: int = 0

    def try_city(self, seed: int) -> None:
        """Have a city planned and its flights written and read. In place.

        Raises
        ------
        Fault
            If one isn't flown as planned.
        """
        problem = random_city(random.Random(seed))
        plan = self.planned(problem)
        planned = [] if plan is None else list(planned_flights(problem, plan))
        if plan is None or not planned:
            return
        for file_format, reader in READERS.items():
            try:
                flights, fences = reader(self._files(problem, plan, file_format))
            except ValueError as error:
                raise Fault(f"{file_format} can't be read: {error}") from error
            if len(flights) != len(planned):
                raise Fault(f"{file_format}: {len(flights)} of {len(planned)} flights")
            for flight, expected in zip(flights, planned, strict=True):
                try:
                    expected.hold_to(flight)
                except Fault as fault:
                    raise Fault(f"{file_format}: {fault}") from fault
                self.bent += len(flight.way) > len(expected.places)
            _hold_fences(problem, planned, fences)
            self.read[file_format] += len(flights)

    def _files(self, problem: Data, plan: Data, file_format: str) -> dict[str, bytes]:
        reply = self.client.post("/flights", json={
            "problem": problem, "plan": plan, "format": file_format})
        if reply.status_code != 200:
            raise Fault(f"{file_format} is answered with {reply.status_code}: {reply.text[:500]}")
        if reply.headers["content-type"] != "application/zip":
            return {"flight" + (".kmz" if file_format == "dji-wpml" else ""): reply.content}
        with zipfile.ZipFile(io.BytesIO(reply.content)) as archive:
            return {name: archive.read(name) for name in archive.namelist()
                    if name != "README.txt"}


@dataclass(frozen=True)
class Planned:
    """A flight as problem and plan have it."""

    launch_time: float
    recovery_time: float
    places: list[Place]  # launch, customers, recovery
    stays: list[float]  # seconds at customers
    climb: float  # seconds of each leg
    lands: bool
    recovery_begins: float
    zones: list[Polygon]

    def hold_to(self, flight: Read) -> None:
        """Raise `Fault` if it is not flown so."""
        if flight.heights != {100.0}:
            raise Fault(f"heights {flight.heights}")
        landings = [*(self.places[1:-1] if self.lands else ()), self.places[-1]]
        if not _same(flight.landings, landings):
            raise Fault(f"lands at {flight.landings}, not {landings}")
        self._hold_order(flight)
        way = LineString(flight.way) if len(flight.way) > 1 else None
        if way is not None and any(way.intersects(zone) for zone in self.zones):
            raise Fault(f"{flight.way} leads through a zone")
        if flight.launch_time is not None:
            self._hold_times(flight)
        elif any(step.speed for step in flight.steps):
            self._hold_durations(flight)

    def _hold_order(self, flight: Read) -> None:
        left = list(self.places)
        for place in (step.place for step in flight.steps):
            while left and _metres(left[0], place) < SAME_PLACE_M:
                left.pop(0)
        ends = (flight.steps[0].place, flight.steps[-1].place)
        if left or not _same(ends, (self.places[0], self.places[-1])):
            raise Fault(f"{flight.way} leaves out {left} of {self.places}")

    def _hold_times(self, flight: Read) -> None:
        told = (flight.launch_time, flight.recovery_time)
        planned = (self.launch_time, self.recovery_time)
        if any(abs((one or 0.0) - other) > 1e-2 for one, other in zip(told, planned, strict=True)):
            raise Fault(f"from {told[0]} to {told[1]}, not {planned}")

    def _hold_durations(self, flight: Read) -> None:
        """Raise `Fault` if a flight by the file takes longer or shorter than planned."""
        flown = sum(_metres(before.place, after.place) / after.speed
                    for before, after in pairwise(flight.steps)
                    if after.speed and before.place != after.place)
        waited = sum(step.waiting for step in flight.steps)
        climbs = self.climb * sum(before != after for before, after in pairwise(self.places))
        stayed = 0.0 if flight.tells_stays else sum(self.stays)
        seconds = flown + waited + climbs + stayed
        planned = self.recovery_begins - self.launch_time
        if abs(seconds - planned) > LATE_SECONDS + LATE_SHARE * planned:
            raise Fault(f"takes {seconds:.1f} s, not {planned:.1f}")


def planned_flights(problem: Data, plan: Data) -> Iterator[Planned]:
    """Yield the flights of a plan as files list them: by vehicle, in the order of take-off."""
    places = {("customer", each["id"]): tuple(each["location"]) for each in problem["customers"]}
    places |= {("depot", each["id"]): tuple(each["location"]) for each in problem["depots"]}
    kinds = {kind["id"]: kind for kind in problem["fleet"]}
    zones = [zone.buffer(-INSIDE) for zone in _zones_of(problem)]

    def planned(drones: Data, ends: list[Data], visits: list[Data], times: list[float]) -> Planned:
        energy = drones.get("energy", {})
        climb = energy.get("climb", {})
        launch, recovery = [places[stop["kind"], stop["id"]] for stop in ends]
        return Planned(
            times[0], times[2],
            [launch, *(places["customer", visit["id"]] for visit in visits), recovery],
            [visit["departure"] - visit["arrival"] for visit in visits],
            climb.get("up_seconds", 0) + climb.get("down_seconds", 0), energy.get("lands", True),
            times[1], zones)

    for route in plan["routes"]:
        kind = kinds[route["type"]]
        if kind.get("flies"):
            for launch, *visits, landing in (trip["stops"] for trip in route["trips"]):
                yield planned(kind, [launch, landing], visits, [
                    launch["departure"], landing["arrival"], landing["departure"]])
            continue
        flown = [(trip, sortie) for trip in route["trips"] for sortie in trip["sorties"]]
        for trip, sortie in sorted(flown, key=lambda pair: float(pair[1]["launch_time"])):
            ends = [trip["stops"][sortie[end]] for end in ("launch_stop", "recovery_stop")]
            _hold_truck(sortie, *ends)
            met = sortie["recovery_time"] - kind["drones"]["recovery_duration"]
            yield planned(kind["drones"], ends, sortie["customers"], [
                sortie["launch_time"], met, sortie["recovery_time"]])


def _hold_truck(sortie: Data, launch: Data, recovery: Data) -> None:
    """Raise `Fault` if a truck isn't where it launches, or recovers, at that time."""
    for stop, time in ((launch, sortie["launch_time"]), (recovery, sortie["recovery_time"])):
        if not stop["arrival"] - 1e-3 <= time <= stop["departure"] + 1e-3:
            raise Fault(f"the truck is at {stop['id']} at another time than {time}")


def _zones_of(problem: Data) -> list[Polygon]:
    """Return all zones in degrees, as they are stated."""
    airspace = problem["airspace"]
    return [*map(Polygon, airspace["no_fly"]), *(
        Polygon(rings[0], rings[1:])
        for rings in (zone["data"]["coordinates"] for zone in airspace["zones"]))]


def _hold_fences(problem: Data, planned: list[Planned],
                 fences: list[list[Place]] | None) -> None:
    """Raise `Fault` unless the fences are zones, and all of those near a flight."""
    if fences is None:
        return
    zones = _zones_of(problem)
    around = union_all([LineString(each.places) for each in planned]).buffer(NEARBY)
    near = union_all([zone for zone in zones if zone.intersects(around)])
    told = union_all([Polygon(ring) for ring in fences])
    if told.difference(union_all(zones)).buffer(-INSIDE).area > 0:
        raise Fault("a fence is no zone")
    if near.difference(told).buffer(-INSIDE).area > 0:
        raise Fault("a zone nearby has no fence")


def _same(some: Any, others: Any) -> bool:
    return len(some) == len(others) and all(
        _metres(one, other) < SAME_PLACE_M for one, other in zip(some, others, strict=True))


def _metres(one: Place, other: Place) -> float:
    return float(GLOBE.inv(*one, *other)[2])


def main(
    cities: Annotated[int, typer.Option(help="Cities to plan.")] = 200,
    seed: Annotated[int, typer.Option(help="Seed of the first; later ones count on.")] = 0,
) -> None:
    """Read the flights of random plans back."""
    study, faults = tried(FlightStudy, range(seed, seed + cities), FlightStudy.try_city)
    typer.echo(f"{cities} cities, {study.checked} plans, {faults} faults; flights read: "
               f"{dict(study.read)}, {study.bent} of them with bends")
    raise typer.Exit(1 if faults else 0)


if __name__ == "__main__":
    typer.run(main)
