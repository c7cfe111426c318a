"""What every source of roads hands out, and how one fails."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from app.maps.remote.asking import ShouldStop
from app.maps.remote.errors import (
    SourceAnswerError, SourceError, SourceKind, SourceStoppedError, SourceUnavailableError,
)
from app.schemas.fields import Avoided
from model.problem import BoolArray, FloatArray, IntArray


class RoadsError(SourceError):
    """No roads this time. Says nothing of addresses and keys: clients may read it."""


class RoadsUnavailableError(RoadsError, SourceUnavailableError):
    """The source is down, too slow or too busy, or its setting is wrong."""


class RoadsAnswerError(RoadsError, SourceAnswerError):
    """The source answered what can't be right, or that it can't answer this."""


class NoWayError(RoadsAnswerError):
    """No road leads from one of a route's points to its next."""


class UnknownDrivingError(RoadsAnswerError):
    """The source can't drive as it is asked to: to avoid that, or to a place's side of the street.
    """


class RoadsStoppedError(RoadsError, SourceStoppedError):
    """The caller said stop before there was an answer."""


ROADS = SourceKind("server of roads", RoadsUnavailableError, RoadsAnswerError, RoadsStoppedError)


@dataclass(frozen=True)
class RoadTable:
    """Drives from each place to each; rows are origins."""

    durations_s: FloatArray  # (place, place), nan: no way
    distances_m: FloatArray  # (place, place), nan: no way
    snapped: FloatArray  # (place, 2) longitude and latitude on the road, nan: none near
    snap_m: FloatArray  # (place,) metres from the place to there, nan: none near


@dataclass(frozen=True, eq=False)
class Block:
    """Part of a table: from these places to those."""

    origins: IntArray
    destinations: IntArray


@dataclass(frozen=True, eq=False)
class Driving:
    """How one drives on the roads of a profile.

    Parameters
    ----------
    avoid
        What is never driven on.
    curb
        (place,) of the places asked about, which are reached with the place on the side of the
        street where one stops, and left in the same direction. None: no place.
    """

    avoid: tuple[Avoided, ...] = ()
    curb: BoolArray | None = None

    def among(self, places: IntArray | slice) -> "Driving":
        """Return the same for some of the places asked about."""
        return self if self.curb is None else replace(self, curb=self.curb[places])

    def require_usual(self, source: str) -> None:
        """Refuse all but the usual way to drive, for a source that knows no other.

        Raises
        ------
        UnknownDrivingError
            If it is another.
        """
        if self.avoid or self.curb is not None:
            raise UnknownDrivingError(f"{source} is asked neither to avoid anything nor for sides "
                                      "of streets.")


USUAL = Driving()


def whole(count: int) -> tuple[Block, ...]:
    """Return all legs between so many places."""
    places = np.arange(count)
    return (Block(places, places),)


@dataclass(frozen=True)
class RoadRoute:
    """A drive along points in their order. Lines are encoded polylines of six decimals."""

    geometry: str
    legs: tuple[str, ...]
    distances_m: FloatArray  # (leg,)
    durations_s: FloatArray  # (leg,)


class RoadEngine(Protocol):
    """A source of roads for one profile. May be asked by several threads at once."""

    @property
    def name(self) -> str:
        """What replies call it, such as `osrm`."""
        ...

    def build(self) -> str:
        """Return what tells one state of its map from another; empty: it doesn't say."""
        ...

    def table(self, lon_lat: FloatArray, until: float,
              should_stop: ShouldStop = lambda: False,
              wanted: Sequence[Block] | None = None,
              driving: Driving = USUAL) -> RoadTable:
        """Return the drives between (place, 2) longitudes and latitudes, whole or not at all.

        Parameters
        ----------
        until
            When to have ended at the latest, on `time.perf_counter`.
        wanted
            The legs to ask for, each place in one of them; all others are nan. None: all.
        driving
            How one drives, and to which side of each place.

        Raises
        ------
        RoadsError
            If there is no answer that can be relied on by then.
        """
        ...

    def route(self, lon_lat: FloatArray, until: float, driving: Driving = USUAL) -> RoadRoute:
        """Return the drive along (point, 2) longitudes and latitudes; raises as `table` does."""
        ...

    def close(self) -> None:
        """Let go of connections."""
        ...
