"""A table of roads -> the legs of a request by it, or which of its places have none."""

import time
from dataclasses import dataclass, replace
from functools import partial
from typing import Protocol

import numpy as np

from app.maps.roads.engine import (
    Driving, RoadsError, RoadsStoppedError, RoadsUnavailableError, RoadTable,
    UnknownDrivingError,
)
from app.maps.roads.nearness import Nearness, estimated, nearness
from app.maps.roads.roads import Roads
from app.requests.conversion.far_legs import Ask, FarLegs
from app.requests.conversion.places import Path, PlacedRequest, avoided
from app.requests.conversion.preparing import Preparing, StoppedError
from app.schemas.errors import InputError, InvalidRequestError, NoRoadsError, json_path
from app.schemas.fields import Avoided
from app.schemas.request import RoadsInput
from model.problem import BoolArray, FloatArray

LONGEST_WALK_M = 2000.0
"""A place farther from any road is off the roads: an extract of another town, or the sea."""

FALLBACK_SHARE = 0.5
"""Of the time left before the search, in which roads may answer where a request can do without."""

ON_DEMAND = ("Of so many places, legs to far ones were estimated in the search; those that the "
             "plan drives are of roads.")

WALKED_METRES = 3.6
"""Metres that one walks in a second at one km/h, the other way round."""


class Straight(Protocol):
    """Where places are, on the globe."""

    @property
    def locations(self) -> FloatArray:
        """(place, 2) longitudes and latitudes."""
        ...

    @property
    def distances_m(self) -> FloatArray:
        """(place, place) metres on great circles."""
        ...


@dataclass(frozen=True)
class RoadLegs:
    """Legs on roads from each place to each, ways from and to the road included."""

    durations_s: FloatArray  # nan: to be estimated
    distances_m: FloatArray  # nan: to be estimated
    engine: str
    farthest_m: float | None  # from a place to the road
    estimated: int = 0  # legs that vehicles may drive and no road tells
    note: str | None = None
    far: FarLegs | None = None  # those that are estimated until a plan drives them


def road_legs(roads: Roads, profile: str, avoid: tuple[Avoided, ...], placed: PlacedRequest,
              ground: Straight, preparing: Preparing) -> RoadLegs:
    """Return a request's legs by the roads of a profile, without some.

    Of many places only legs to near ones are asked for, and the others are estimated; a plan that
    goes on from another has all of them.

    Raises
    ------
    NoRoadsError
        If there is no answer.
    InvalidRequestError
        If places are off the roads and the request states no fallback, the roads can't be driven
        as it asks, or time is over before there are legs.
    StoppedError
        If the work is to end.
    """
    with preparing.waiting() as latest:
        return _legs_by(roads, profile, Driving(avoid, placed.curb), placed, ground, preparing,
                        latest)


def _legs_by(roads: Roads, profile: str, driving: Driving, placed: PlacedRequest,
             ground: Straight, preparing: Preparing, latest: float) -> RoadLegs:
    """Return the legs that roads tell until an instant; arguments and errors of `road_legs`."""
    request = placed.request
    stated = request.roads if isinstance(request.roads, RoadsInput) else RoadsInput()
    engine, lon_lat = roads.engine_name(profile), ground.locations
    parts = None
    if len(lon_lat) > roads.full_up_to and request.replan is None:
        parts = nearness(lon_lat, range(len(lon_lat) - len(request.customers)))
    now = time.perf_counter()
    until = _until(now, latest, stated)
    try:
        table = (roads.table(profile, lon_lat, until, preparing.should_stop, driving)
                 if parts is None else
                 roads.near_legs(profile, lon_lat, parts, until, preparing.should_stop, driving))
    except UnknownDrivingError as error:
        raise _unknown_driving(profile, driving, placed, error) from error
    except RoadsStoppedError as error:
        raise StoppedError("The work was stopped before there was a plan: try again.") from error
    except RoadsError as error:
        if stated.fallback is None and _is_late(error):
            raise _too_slow(profile, len(lon_lat), latest - now, preparing) from error
        if stated.fallback is None:
            raise NoRoadsError(f"The roads of {profile!r}: {error} Try again, or state "
                               "roads.fallback.") from error
        size = len(lon_lat)
        nothing = np.where(np.eye(size, dtype=bool), 0.0, np.nan)
        return RoadLegs(nothing, nothing, engine, None, size * (size - 1),
                        f"All legs are estimated: {error}")
    legs = _Legs(placed, profile, driving, engine, stated, table,
                 None if parts is None else parts.asked())
    if parts is None:
        return legs.legs()
    return legs.with_far_ones(parts, ground.distances_m, partial(roads.some_legs, profile), lon_lat)


def _unknown_driving(profile: str, driving: Driving, placed: PlacedRequest,
                     error: UnknownDrivingError) -> InvalidRequestError:
    """Return what can't be had of roads, where the request first asks for it."""
    request = placed.request
    path: Path
    if driving.avoid:
        path = ("fleet", next(index for index, kind in enumerate(request.fleet)
                              if (kind.profile, avoided(kind)) == (profile, driving.avoid)),
                "avoid")
        what = f"avoid {' and '.join(driving.avoid)}"
    else:
        path = placed.curb_path
        what = "lead to one side of the street"
    return InvalidRequestError([InputError(
        code="ROADS_WITHOUT_THAT", path=json_path(path),
        message=f"The roads of {profile!r} can't {what}: {error} Leave it out, or have whoever "
        "runs the service prepare the roads of an extract again (tandem roads build).")])


def _is_late(error: RoadsError) -> bool:
    return isinstance(error, RoadsUnavailableError) and error.is_late


def _too_slow(profile: str, count: int, seconds: float,
              preparing: Preparing) -> InvalidRequestError:
    message = (f"The roads of {profile!r} didn't tell the legs between {count} places within "
               f"{seconds:.1f} s, as long as may be spent on them by "
               f"{preparing.limit}: state a longer time_limit, or submit a job (POST /jobs), whose "
               "time begins when its legs are there. Legs that were told are kept: the same "
               "places are quick from then on.")
    return InvalidRequestError([InputError(code="TOO_MUCH_WORK", path="$.options.time_limit",
                                           message=message)])


def _until(now: float, latest: float, stated: RoadsInput) -> float:
    if stated.fallback is None or latest == float("inf"):
        return latest
    return now + FALLBACK_SHARE * (latest - now)


class _Legs:
    """A table with all places of a request, some of which may be off the roads."""

    def __init__(self, placed: PlacedRequest, profile: str, driving: Driving, engine: str,
                 stated: RoadsInput, table: RoadTable, asked: BoolArray | None) -> None:
        self._placed = placed
        self._profile = profile
        self._driving = driving
        self._engine = engine
        self._stated = stated
        self._table = table
        self._asked = asked  # None: all
        self._is_near = table.snap_m <= LONGEST_WALK_M

    def legs(self) -> RoadLegs:
        """Return the legs; raises as `road_legs` does."""
        off = ~self._is_reached()
        # Whom only drones serve needs no road: nobody drives there.
        missing = np.flatnonzero(off & ~self._is_flown_to())
        if len(missing) and self._stated.fallback is None:
            raise InvalidRequestError([self._error(node) for node in missing.tolist()])
        durations, distances = self._whole(off)
        walks = self._walks_s(off)
        durations = durations + walks[:, None] + walks[None, :]
        np.fill_diagonal(durations, 0.0)
        size, count = len(off), len(missing)
        estimated = size * (size - 1) - (size - count) * (size - count - 1)
        walked = self._table.snap_m[~off]
        places = "1 place" if count == 1 else f"{count} places"
        note = f"Legs to and from {places} off the roads are estimated." if count else None
        return RoadLegs(durations, distances, self._engine,
                        round(float(walked.max()), 1) if len(walked) else None, estimated, note)

    def _walks_s(self, off: BoolArray) -> FloatArray:
        """Return how long one walks between each place and the road."""
        return np.where(off, 0.0, self._table.snap_m) * WALKED_METRES / self._stated.walking_kmh

    def with_far_ones(self, parts: Nearness, straight_m: FloatArray, ask: Ask,
                      lon_lat: FloatArray) -> RoadLegs:
        """Return the legs, and estimates of those that weren't asked for."""
        legs, off, table = self.legs(), ~self._is_reached(), self._table
        unknown = ~parts.asked() & ~off[:, None] & ~off
        durations = estimated(straight_m, legs.durations_s, parts)
        distances = estimated(straight_m, legs.distances_m, parts)
        for numbers in (durations, distances):
            numbers[off, :] = numbers[:, off] = np.nan
            np.fill_diagonal(numbers, 0.0)
        far = FarLegs(ask, lon_lat, self._driving, table.snapped, self._walks_s(off), unknown,
                      (table.durations_s[:, 0], table.distances_m[:, 0]),
                      (table.durations_s[0], table.distances_m[0]))
        return replace(legs, durations_s=durations, distances_m=distances, far=far,
                       note=" ".join(filter(None, (legs.note, ON_DEMAND))))

    def _is_reached(self) -> BoolArray:
        """Tell which places have ways to and from the first depot, by any roads."""
        ways = np.isfinite(self._table.durations_s) & np.isfinite(self._table.distances_m)
        return self._is_near & self._is_near[0] & ways[0] & ways[:, 0]

    def _is_flown_to(self) -> BoolArray:
        customers = self._placed.request.customers
        first = len(self._placed.places) - len(customers)
        return np.array([False] * first + [customer.served_by == "drone"
                                           for customer in customers])

    def _whole(self, off: BoolArray) -> tuple[FloatArray, FloatArray]:
        """Return what is driven, nan to and from places that are off the roads.

        Where no way is known between two others, there is that by the first depot.
        """
        tables = []
        unknown = ~np.isfinite(self._table.durations_s)
        if self._asked is not None:
            unknown &= self._asked
        for table in (self._table.durations_s, self._table.distances_m):
            whole = np.where(unknown, table[:, :1] + table[:1, :], table)
            whole[off, :] = np.nan
            whole[:, off] = np.nan
            np.fill_diagonal(whole, 0.0)
            tables.append(whole)
        return tables[0], tables[1]

    def _error(self, node: int) -> InputError:
        away = self._table.snap_m[node]
        if not np.isfinite(away):
            found = f"No road for {self._profile!r} is near"
        elif not self._is_near[node]:
            found = (f"The nearest road for {self._profile!r} is {away:.0f} m away, and at most "
                     f"{LONGEST_WALK_M:.0f} m are walked")
        elif not self._is_near[0]:
            found = "The first depot is off the roads, so no way leads here"
        else:
            without = (f" without {' and '.join(self._driving.avoid)}" if self._driving.avoid
                       else "")
            found = (f"The nearest road for {self._profile!r}, {away:.0f} m away, has no way to "
                     f"or from the first depot{without}")
        return InputError(
            code="PLACE_OFF_ROADS", path=json_path(self._placed.paths[node]),
            message=f"{found}: correct the location, have drones serve it (served_by), check that "
            "the map covers it, or state roads.fallback.")
