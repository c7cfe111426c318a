"""Which of the places found an address means."""

from collections.abc import Iterable
from typing import NamedTuple

from app.maps.addresses.distances import metres_between
from app.maps.addresses.geocoder import MOST_CANDIDATES, Candidate, Candidates, Quality

SAME_M: dict[Quality, float] = {
    "house": 300.0, "interpolated": 300.0, "street": 2_000.0, "town": 20_000.0,
}
"""Up to which two places are one: a house has several doors, a street many pieces."""


class Ranked(NamedTuple):
    """A candidate, and what it is ranked by: less is better."""

    rank: tuple[float, ...]
    candidate: Candidate


def likeliest(found: Iterable[Ranked]) -> Candidates:
    """Return the best candidates, which nothing but the place tells apart."""
    ordered = sorted(found, key=lambda ranked: ranked.rank)
    kept: list[Candidate] = []
    for rank, candidate in ordered:
        if rank == ordered[0].rank and all(_metres(candidate, other) > SAME_M[candidate.quality]
                                           for other in kept):
            kept.append(candidate)
    return tuple(kept[:MOST_CANDIDATES])


def _metres(candidate: Candidate, other: Candidate) -> float:
    return metres_between(candidate.lon, candidate.lat, other.lon, other.lat)
