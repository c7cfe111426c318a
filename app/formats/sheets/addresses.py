"""Rows that have addresses and no coordinates: looked up, and what is doubtful about that."""

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from statistics import median

from app.formats.sheets.cells import CellError, Doubt, MisreadError
from app.formats.sheets.customers import address_of
from app.formats.sheets.fleet import Incomplete
from app.formats.sheets.geography import Pair, TableGeography, depot_pair
from app.formats.sheets.rows import Row
from app.formats.sheets.schemas import FoundReply, ImportSettings, LookUpReply
from app.maps.addresses.addresses import NO_ADDRESSES, Addresses, LookedUp
from app.maps.addresses.distances import metres_between
from app.maps.addresses.far_off import far_places
from app.maps.addresses.geocoder import Candidate, Candidates
from app.maps.addresses.words import in_words, listed

CELLS = ("address", "street", "town", "postcode", "name")

NEARER = 5.0
"""How many times nearer to the other customers a place is that is taken for the one meant."""


def nobody(known: int, asked: int) -> None:
    """Tell nobody."""


@dataclass(frozen=True)
class Finder:
    """Where addresses are looked up, for how long, and who is told how far it is."""

    addresses: Addresses = NO_ADDRESSES
    seconds: float = 0.0
    told: Callable[[int, int], None] = nobody

    @property
    def finds(self) -> bool:
        """Whether there is a geocoder."""
        return bool(self.addresses.names)

    def look_up(self, texts: Sequence[str]) -> LookedUp:
        """Return what addresses may mean, as far as there is time."""
        count = 0

        def tell() -> None:
            nonlocal count
            count += 1
            self.told(count, len(texts))

        return self.addresses.look_up(texts, time.perf_counter() + self.seconds, told=tell)


NO_FINDER = Finder()


@dataclass
class LocatedRows:
    """Where rows with addresses are, and what is to be said of that."""

    places: dict[int, Pair] = field(default_factory=dict)  # by row
    unplaced: dict[int, str] = field(default_factory=dict)  # addresses that are kept, by row
    doubts: list[Doubt] = field(default_factory=list)
    errors: list[CellError] = field(default_factory=list)
    reply: LookUpReply | None = None
    pending: frozenset[int] = frozenset()


def with_depot(settings: ImportSettings, finder: Finder) -> tuple[ImportSettings, list[Doubt]]:
    """Return settings whose depot is no address, and what is doubtful about where it is.

    Raises
    ------
    Incomplete
        If it isn't found.
    """
    if settings.depot is None or not finder.finds or _is_pair(settings.depot):
        return settings, []
    looked_up = replace(finder, told=nobody).look_up([settings.depot])
    found = looked_up.candidates.get(settings.depot)
    if found is None:
        raise Incomplete("GEOCODER", f"The depot can't be looked up now: {looked_up.error}")
    if not found:
        raise Incomplete("DEPOT", f"The depot {settings.depot!r} is not found: correct it, or "
                         "write its latitude and longitude.",
                         {"case": "lost", "depot": settings.depot})
    doubt = in_words(settings.depot, found)
    return (settings.model_copy(update={"depot": f"{found[0].lat:.7f}, {found[0].lon:.7f}"}),
            [Doubt("DEPOT_FOUND", f"The depot is {found[0].label}"
                   + (f": {doubt}." if doubt else "."), values={"place": found[0].label})])


def locate(rows: Sequence[Row], ground: TableGeography, finder: Finder, *,
           keeps: bool = False) -> LocatedRows:
    """Look up the rows that state no coordinates. In place.

    Parameters
    ----------
    keeps
        Whether rows that aren't found keep their addresses; else they are refused.
    """
    lacking = {row.number: row for row in rows
               if ground.pair(row) is None and not row.errors and address_of(row)}
    if not ground.is_geographic or not lacking:
        return LocatedRows()
    if not finder.finds:
        return _by_hand(lacking) if keeps else LocatedRows()
    asked = {number: address_of(row) for number, row in lacking.items()}
    looked_up = finder.look_up(list(dict.fromkeys(asked.values())))
    known = {number: looked_up.candidates[text] for number, text in asked.items()
             if text in looked_up.candidates}
    stated = [pair for row in rows if (pair := ground.pair(row)) is not None]
    middle = _middle(stated + [(found[0].lon, found[0].lat) for found in known.values()
                               if len(found) == 1])
    located = LocatedRows(pending=frozenset(asked.keys() - known.keys()))
    chosen: dict[int, Candidates] = {}
    for number, found in known.items():
        row, best = lacking[number], _nearest(found, middle)
        if best is None:
            _leave(located, row, asked[number], found, keeps and not row.is_depot)
        else:
            chosen[number] = best
            located.places[number] = best[0].lon, best[0].lat
    far = far_places([*stated, *located.places.values()])
    far_rows = {number for place, number in enumerate(chosen, len(stated)) if place in far}
    replies = []
    for number, found in chosen.items():
        doubt = _doubt(asked[number], found, known[number], number in far_rows)
        cell = lacking[number].cell(*CELLS)
        if doubt is not None:
            located.doubts.append(Doubt(doubt[0], f"{cell}: {doubt[1]}.", cell=cell, values={
                "address": asked[number], "place": found[0].label}))
        replies.append(_reply(cell, asked[number], found[0], doubt[1] if doubt else None))
    located.reply = LookUpReply(asked=len(asked), known=len(known), places=replies)
    if located.pending:
        located.errors.append(CellError(
            "ADDRESSES_PENDING", f"{len(known)} of {len(asked)} addresses are looked up so far: "
            f"{looked_up.error} Import the file again to go on.",
            values={"known": len(known), "asked": len(asked)}))
    return located


def _by_hand(lacking: Mapping[int, Row]) -> LocatedRows:
    """Return what becomes of rows whose addresses nobody looks up, where they are kept."""
    customers = {number: row for number, row in lacking.items() if not row.is_depot}
    located = LocatedRows(unplaced={number: address_of(row) for number, row in customers.items()})
    if customers:
        cell = next(iter(customers.values())).cell(*CELLS)
        located.doubts.append(Doubt(
            "PLACED_BY_HAND", f"{len(customers)} rows have an address and no coordinates, such as "
            f"{cell}: addresses are not looked up here, so that they are to be placed by hand.",
            cell=cell, values={"count": len(customers)}))
    for row in lacking.values():
        if row.is_depot:
            cell = row.cell(*CELLS)
            located.doubts.append(Doubt(
                "DEPOT_BY_HAND", f"{cell}: the depot's address is not looked up here: state where "
                "it is.", cell=cell))
    return located


def _is_pair(text: str) -> bool:
    try:
        depot_pair(text)
    except MisreadError:
        return False
    return True


def _middle(places: Sequence[Pair]) -> Pair | None:
    if not places:
        return None
    return median(lon for lon, _ in places), median(lat for _, lat in places)


def _nearest(found: Candidates, middle: Pair | None) -> Candidates | None:
    """Return the one of several places that is near the others, alone; None: none surely is."""
    if len(found) < 2:
        return found or None
    if middle is None:
        return None
    by_distance = sorted(found, key=lambda place: metres_between(*middle, place.lon, place.lat))
    first, second = (metres_between(*middle, place.lon, place.lat) for place in by_distance[:2])
    return (by_distance[0],) if first * NEARER < second else None


def _leave(located: LocatedRows, row: Row, address: str, found: Candidates, keeps: bool) -> None:
    """Keep the address of a row that isn't found, or refuse the row. In place."""
    code, message = _not_found(address, found)
    if keeps:
        cell = row.cell(*CELLS)
        located.unplaced[row.number] = address
        located.doubts.append(Doubt(code, f"{cell}: {message}", cell=cell,
                                    values={"address": address}))
    else:
        row.refuse(code, message, *CELLS, values={"address": address})


def _not_found(address: str, found: Candidates) -> tuple[str, str]:
    """Return the code and words of an address that isn't found, or may be several places."""
    if found:
        return ("ADDRESS_AMBIGUOUS", f"{address!r} may mean {listed(found)}: add the town or "
                "the postcode, or latitude and longitude.")
    return ("ADDRESS_NOT_FOUND", f"{address!r} is not found: correct it, or add latitude "
            "and longitude.")


def _doubt(address: str, chosen: Candidates, known: Candidates,
           is_far: bool) -> tuple[str, str] | None:
    if len(known) > 1:
        return ("ADDRESS_NEAREST", f"{address!r} may mean {listed(known)}; that nearest to the "
                f"others is taken, {chosen[0].label}")
    if is_far:
        return "ADDRESS_FAR", f"{address!r} is far from all others: {chosen[0].label}"
    words = in_words(address, chosen)
    return None if words is None else ("ADDRESS_INEXACT", words)


def _reply(cell: str, address: str, place: Candidate, doubt: str | None) -> FoundReply:
    return FoundReply(cell=cell, address=address, location=(place.lon, place.lat),
                      label=place.label, quality=place.quality, by=place.by, doubt=doubt)
