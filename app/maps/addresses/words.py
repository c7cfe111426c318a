"""What is doubtful about an answer, in words."""

from app.maps.addresses.geocoder import Candidate, Candidates, Quality

FOUND: dict[Quality, str] = {
    "house": "", "interpolated": "is put between the houses next to it",
    "street": "is found by its street alone", "town": "is found by its town or area alone",
}


def in_words(address: str, found: Candidates) -> str | None:
    """Say what is doubtful about where an address was found; None: nothing is."""
    best = found[0]
    if len(found) > 1:
        return f"{address!r} may mean {listed(found)}; the first is taken"
    if best.unmatched:
        return (f"{address!r} is taken for {best.label!r}, where "
                f"{', '.join(map(repr, best.unmatched[:5]))} does not fit")
    return None if best.quality == "house" else f"{address!r} {FOUND[best.quality]}: {best.label}"


def listed(found: Candidates) -> str:
    """List places that an address may mean."""
    return "; ".join(f"{place.label} ({_shown(place)})" for place in found)


def _shown(place: Candidate) -> str:
    return f"{place.lat:.5f}, {place.lon:.5f}"
