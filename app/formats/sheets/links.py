"""Links to maps -> the places that they show."""

import re
from urllib.parse import parse_qsl, unquote, urlsplit

STARTS = ("http://", "https://", "geo:", "www.", "maps.google.", "google.", "comgooglemaps:")

IN_QUERY = ("q", "query", "ll", "daddr", "destination", "sll", "center", "cp", "near", "point",
            "pin", "coordinate", "to", "loc", "where1", "marker")
"""Parameters with latitude and longitude, the place that is meant before what the map shows."""

SPLIT = (("mlat", "mlon"), ("lat", "lon"), ("lat", "lng"), ("latitude", "longitude"))

_PIN = re.compile(r"!3d(-?\d{1,2}\.\d{1,20})!4d(-?\d{1,3}\.\d{1,20})")
_PAIR = re.compile(r"(?<![\d.])(-?\d{1,2}\.\d{1,20})[,~/ +]{1,3}(-?\d{1,3}\.\d{1,20})(?![\d.])")
_WHOLE = re.compile(r"(-?\d{1,2}(?:\.\d{1,20})?),(-?\d{1,3}(?:\.\d{1,20})?)")


def is_link(text: str) -> bool:
    """Tell whether a text is a link, or the address of a place by its coordinates."""
    return text.lower().startswith(STARTS)


def place_of(link: str) -> tuple[str, str] | None:
    """Return latitude and longitude of a map's link; None: it has none, as short links have."""
    if link.lower().startswith("geo:"):
        found = _WHOLE.match(link[4:])
        return (found[1], found[2]) if found else None
    try:
        parts = urlsplit(link)
        query = dict(parse_qsl(parts.query, max_num_fields=50))
    except ValueError:
        return None
    path = unquote(parts.path)
    if pins := _PIN.findall(path):
        return pins[-1][0], pins[-1][1]
    for first, second in SPLIT:
        if first in query and second in query:
            return query[first].strip(), query[second].strip()
    texts = (*(query[name] for name in IN_QUERY if name in query), path, unquote(parts.fragment))
    return next(((found[1], found[2]) for text in texts if (found := _PAIR.search(text))), None)
