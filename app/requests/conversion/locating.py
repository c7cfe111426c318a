"""A request whose places are addresses -> one whose places are coordinates."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from pydantic import BaseModel

from app.maps.addresses.addresses import Addresses
from app.maps.addresses.far_off import far_places
from app.maps.addresses.geocoder import Candidate, Candidates, GeocoderStoppedError
from app.maps.addresses.words import in_words, listed
from app.requests.conversion.places import PlacedRequest
from app.requests.conversion.preparing import Preparing, StoppedError
from app.schemas.errors import (
    ErrorCode, InputError, InvalidRequestError, NoGeocoderError, json_path,
)
from app.schemas.fields import AddressInput, Location, point_of
from app.schemas.plan import PlanInput
from app.schemas.request import PlanRequest


@dataclass(frozen=True)
class FoundAddress:
    """Where an address of a request is."""

    path: str
    address: str
    location: Location
    label: str
    quality: str
    by: str
    doubt: str | None  # in words
    code: str | None  # of the doubt


@dataclass(frozen=True)
class Located:
    """A request without addresses, and where these are."""

    placed: PlacedRequest
    found: tuple[FoundAddress, ...] = ()

    def replies(self) -> list[dict[str, Any]]:
        """Return what a reply says of them."""
        told = [asdict(each) for each in self.found]
        for each in told:
            del each["code"]
        return told


def located(placed: PlacedRequest, addresses: Addresses, preparing: Preparing) -> Located:
    """Return a request with coordinates in place of addresses.

    Raises
    ------
    InvalidRequestError
        If addresses can't be looked up here, aren't found, or may mean several places.
    NoGeocoderError
        If the geocoder doesn't answer in time.
    StoppedError
        If the work is to end.
    """
    asked = {json_path(path): place.location.address
             for path, place in zip(placed.paths, placed.places, strict=True)
             if isinstance(place.location, AddressInput)}
    if not asked:
        return Located(placed)
    if not addresses.names:
        raise InvalidRequestError([InputError(
            code="NO_GEOCODER", path=path, message="Addresses are not looked up here: state "
            "[longitude, latitude], or have the service set up with a geocoder (TANDEM_GEOCODER).")
            for path in asked])
    candidates = _candidates(asked, addresses, preparing)
    accept = placed.request.addresses.accept
    errors = [InputError(code=wrong[0], path=path, message=wrong[1])
              for path, address in asked.items()
              if (wrong := _refusal(address, candidates[address], accept))]
    if errors:
        raise InvalidRequestError(errors)
    chosen = {path: candidates[address][0] for path, address in asked.items()}
    points = {path: (best.lon, best.lat) for path, best in chosen.items()}
    there = PlacedRequest(with_locations(placed.request, points))
    far = _far_off(there)
    return Located(there, tuple(
        _found(path, asked[path], candidates[asked[path]], path in far) for path in chosen))


def at_addresses(request: PlanRequest, plan: PlanInput) -> PlanRequest:
    """Return a request with coordinates where the plan for it says that addresses are."""
    return with_locations(request, {each.path: each.location for each in plan.addresses or ()})


def with_locations(request: PlanRequest, points: Mapping[str, Location]) -> PlanRequest:
    """Return a request with coordinates in place of the addresses at some paths."""
    def placed(entry: Any, *path: str | int, field: str = "location") -> Any:
        if not isinstance(getattr(entry, field), AddressInput):
            return entry
        point = points.get(json_path((*path, field)))
        return entry if point is None else entry.model_copy(update={field: tuple(point)})

    def ended(kind: Any, index: int) -> Any:
        end = kind.end
        if isinstance(end, BaseModel):
            end = placed(end, "fleet", index, "end")
        return kind if end is kind.end else kind.model_copy(update={"end": end})

    return request.model_copy(update={
        "depots": [placed(depot, "depots", index)
                   for index, depot in enumerate(request.depots)],
        "customers": [placed(customer, "customers", index)
                      for index, customer in enumerate(request.customers)],
        "launch_sites": [placed(site, "launch_sites", index)
                         for index, site in enumerate(request.launch_sites)],
        "fleet": [ended(placed(kind, "fleet", index, field="start_location"), index)
                  for index, kind in enumerate(request.fleet)],
    })


def _candidates(asked: Mapping[str, str], addresses: Addresses,
                preparing: Preparing) -> Mapping[str, Candidates]:
    texts = set(asked.values())
    with preparing.waiting() as until:
        looked_up = addresses.look_up(asked.values(), until, preparing.should_stop)
    missing = texts - looked_up.candidates.keys()
    if not missing:
        return looked_up.candidates
    if isinstance(looked_up.error, GeocoderStoppedError):
        raise StoppedError("The work was stopped before there was a plan: try again.")
    raise NoGeocoderError(
        f"{len(texts) - len(missing)} of {len(texts)} addresses are known so far: "
        f"{looked_up.error} What is known is kept, so try again, allow more time, or look "
        "addresses up first (POST /addresses).")


def _refusal(address: str, found: Candidates, accept: str) -> tuple[ErrorCode, str] | None:
    """Say why an address isn't found as well as a request accepts, if so."""
    if not found:
        return ("ADDRESS_NOT_FOUND", f"{address!r} is not found: correct it, or state "
                "[longitude, latitude].")
    if accept == "any":
        return None
    if len(found) > 1:
        return ("ADDRESS_AMBIGUOUS", f"{address!r} may mean {listed(found)}: state the town or "
                "the postcode, or [longitude, latitude].")
    best = found[0]
    if best.unmatched:
        return ("ADDRESS_NOT_FOUND", f"{in_words(address, found)}: correct it, or take that "
                "with addresses.accept 'any'.")
    if best.quality == "town" or (accept == "house" and best.quality != "house"):
        return ("ADDRESS_INEXACT", f"{in_words(address, found)}: correct it, or allow more with "
                "addresses.accept.")
    return None


def _found(path: str, address: str, candidates: Candidates, is_far: bool) -> FoundAddress:
    best: Candidate = candidates[0]
    doubt, code = in_words(address, candidates), "ADDRESS_INEXACT"
    if doubt is None and is_far:
        doubt, code = f"{address!r} is far from all other places", "ADDRESS_FAR"
    return FoundAddress(path, address, (best.lon, best.lat), best.label, best.quality, best.by,
                        None if doubt is None else f"{doubt}.", code if doubt else None)


def _far_off(placed: PlacedRequest) -> set[str]:
    """Return the paths of places that are far from most others."""
    points = [point_of(place.location) for place in placed.places]
    paths = [json_path(path) for path in placed.paths]
    known = [(path, point) for path, point in zip(paths, points, strict=True) if point]
    return {known[place][0] for place in far_places([point for _, point in known])}
