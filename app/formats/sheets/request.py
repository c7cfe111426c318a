"""Customers, a depot and a fleet -> a request of `POST /plan`; what is assumed is told."""

import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import Any

from pydantic_core import to_json

from app.formats.sheets.amounts import dimensions
from app.formats.sheets.cells import CellError, Doubt, MisreadError
from app.formats.sheets.columns import Column
from app.formats.sheets.customers import Entry, placed
from app.formats.sheets.fleet import Incomplete, fleet_of
from app.formats.sheets.geography import Pair, TableGeography, depot_pair, on_globe
from app.formats.sheets.headings import simple, without_unit
from app.formats.sheets.related import StatedRelation, price_others
from app.formats.sheets.rows import Row
from app.formats.sheets.schemas import ImportSettings
from app.formats.sheets.vans import Van
from app.formats.sheets.work import Import
from app.requests.reading import read_request
from app.requests.warnings.finding import warnings_of
from app.requests.warnings.warning import RequestWarning
from app.schemas.errors import InputError, InvalidRequestError

CELLS = {"id": ("name", "order"), "location": ("latitude", "point", "y"), "demand": ("demand",),
         "time_window": ("latest", "earliest", "window"), "time_windows": ("window",),
         "service_duration": ("service",), "release_time": ("ready",), "skills": ("skills",),
         "approach": ("approach",),
         "vehicles": ("vehicles", "forbidden_vehicles"), "unassigned_cost": ("unassigned_cost",),
         "vehicle_costs": ("vehicle_costs", "preference_cost", "preferred_vehicles"),
         "amount": ("demand",), "max_time_between": ("max_between",),
         "max_detour": ("max_detour",), "alternatives": ("alternative_cost", "name")}
"""Meanings of the columns that fields of a customer come from."""

_RELATION = re.compile(r"\$\.relations\[(\d+)\]")
_SHIPMENT = re.compile(
    r"\$\.shipments\[(\d+)\]\.?(?:(pickup|delivery)\.|pickups\[(\d+)\]\.)?(\w*)")
_PATH = re.compile(r"\$\.customers\[(\d+)\]\.?(\w*)")

LONGEST_NAME, LONGEST_UNIT = 200, 50
"""Letters of a dimension of the load."""

Data = dict[str, Any]


def request_of(work: Import, depots: Sequence[Row], ground: TableGeography,
               settings: ImportSettings) -> tuple[Data, list[Doubt]]:
    """Return a request and what was assumed for it.

    Raises
    ------
    Incomplete
        If a setting doesn't fit.
    """
    columns, served = work.columns, [*work.stops, *work.shipments]
    depot, doubts = _depots(served, depots, ground, settings)
    fairness = (work.fairness if settings.fairness is None
                else settings.fairness.model_dump(exclude_defaults=True))
    fleet, assumed = fleet_of(served, columns, settings, work.vans, fairness.get("min_vehicles", 1))
    assumed += with_crews(served, work.vans) + price_others(served, fleet, work.vans)
    unit: Data = {}
    if not ground.is_geographic:
        in_km = any(column.meaning == "x" and column.unit == "km" for column in columns)
        unit = {"planar_unit": 1000} if in_km else {}
        doubts.append(Doubt("PLANE", "x and y are taken for places on a plane, in "
                            f"{'kilometres' if in_km else 'metres'}.",
                            values={"case": "km" if in_km else "m"}))
    system = "geographic" if ground.is_geographic else "planar"
    currency = {"currency": settings.currency} if settings.currency else {}
    request: Data = {"coordinate_system": system, **unit, **currency, **_loads(columns),
                     "depots": depot,
                     "customers": [stop.customer for stop in work.stops], "fleet": fleet}
    if work.shipments:
        request["shipments"] = [shipment.customer for shipment in work.shipments]
    if fairness:
        request["fairness"] = fairness
    return request, [*doubts, *assumed]


def _loads(columns: Sequence[Column]) -> Data:
    """Return what amounts are called and counted in, by the headings of their columns."""
    amounts = dimensions(columns)
    if not amounts or any(not column.heading for column in amounts):
        return {}
    return {"load_dimensions": [{"name": without_unit(column.heading)[:LONGEST_NAME],
                                 **({"unit": column.unit[:LONGEST_UNIT]} if column.unit else {})}
                                for column in amounts]}


def look_over(request: Data, work: Import, relations: Sequence[StatedRelation],
              road_profiles: Collection[str]) -> tuple[
                  list[CellError], tuple[RequestWarning, ...]]:
    """Return what planning doesn't take, at the cells where it comes from, and what looks wrong."""
    try:
        read = read_request(to_json(request), policies=None)
    except InvalidRequestError as error:
        return [CellError(item.code, item.message, _cell(item, work, relations))
                for item in error.errors], ()
    return [], warnings_of(read, road_profiles)


def stated_depot(settings: ImportSettings) -> Pair | None:
    """Return the two numbers of the depot that the settings state.

    Raises
    ------
    Incomplete
        If they are none.
    """
    if settings.depot is None:
        return None
    try:
        return depot_pair(settings.depot)
    except MisreadError as error:
        raise Incomplete("DEPOT", f"The depot can't be read: {error}.") from error


def _cell(error: InputError, work: Import, relations: Sequence[StatedRelation]) -> str | None:
    """Return the cell that an error of the request is about; None: it is about none."""
    if related := _RELATION.match(error.path):
        return relations[int(related[1])].cell
    if sent := _SHIPMENT.match(error.path):
        shipment = work.shipments[int(sent[1])]
        row = next((row for row in shipment.rows if row.side == sent[2]), shipment.rows[-1])
        if sent[3] is not None:
            row = shipment.heads[int(sent[3])]
        return row.cell(*CELLS.get(sent[4], ("shipment", "order", "name")))
    found = _PATH.match(error.path)
    if found is None:
        return None
    row = work.stops[int(found[1])].rows[0]
    # Of several columns that may state it, the one that does.
    return row.cell(*sorted(CELLS.get(found[2], ("name",)), key=lambda name: not row.get(name)))


def _depots(stops: Sequence[Entry], rows: Sequence[Row], ground: TableGeography,
            settings: ImportSettings) -> tuple[list[Data], list[Doubt]]:
    stated = stated_depot(settings)
    if stated is not None:
        place = (stated[1], stated[0]) if ground.is_geographic else stated
        if ground.is_geographic and not on_globe(place):
            raise Incomplete("DEPOT", f"The depot {settings.depot!r} is not on the globe: write "
                             "its latitude first, as maps show it.")
        return [{"id": "depot", "location": list(place)}], []
    known = [(row, pair) for row in rows if (pair := ground.pair(row)) is not None]
    if known:
        names = ", ".join(row.cell("name", "kind") for row, _ in known)
        single = len(known) == 1
        return ([{"id": "depot" if single else f"depot-{number}", "location": list(pair)}
                 for number, (_, pair) in enumerate(known, 1)],
                [Doubt("DEPOT_IN_FILE", f"{names} {'is' if single else 'are'} taken for the depot"
                       f"{'' if single else 's'}, not for customers.",
                       values={"count": len(known), "cells": names})])
    places = [pair for _, pair in placed(stops)]
    if stops and not places:
        raise Incomplete("DEPOT", "No depot is stated, and no customer's place is known: state "
                         "the depot, latitude first.")
    middle = [round(sum(pair[axis] for pair in places) / max(len(places), 1), 6)
              for axis in (0, 1)]
    shown = ", ".join(f"{number:.10g}"
                      for number in (middle[::-1] if ground.is_geographic else middle))
    return [{"id": "depot", "location": middle}], [Doubt(
        "DEPOT_ASSUMED", f"No depot is stated: the middle of the customers is taken, {shown}.",
        values={"place": shown})]


_SIZE = re.compile(r"(\d{1,2}) ?([a-z]*)")


def with_crews(served: Iterable[Entry], vans: Sequence[Van]) -> list[Doubt]:
    """Have who asks for a crew, such as `2 men`, served by the vehicles with one. In place."""
    crews = {van.name: simple(van.texts["crew"]) for van in vans if "crew" in van.texts}
    asked: dict[str, str] = {}
    for entry in served:
        allowed = entry.customer.get("vehicles", {}).get("allowed", ())
        named = [name for crew in allowed if crew not in crews for name in _having(crew, crews)]
        if named:
            kept = [name for name in allowed if name in crews]
            entry.customer["vehicles"] = {"allowed": list(dict.fromkeys([*kept, *named]))}
            asked.setdefault(allowed[0], entry.rows[0].cell("vehicles"))
    if not asked:
        return []
    return [Doubt("CREWS", f"Who asks for {', '.join(list(asked)[:10])} is served by vehicles "
                  "with that crew, or more of it.", cell=next(iter(asked.values())),
                  values={"names": list(asked)[:10]})]


def _having(crew: str, crews: Mapping[str, str]) -> list[str]:
    """Return the vehicles that have a crew: the same, or as many people or more."""
    wanted = _SIZE.fullmatch(simple(crew))
    if wanted is None:
        return [name for name, own in crews.items() if own == simple(crew)]
    sizes = {name: _SIZE.fullmatch(own) for name, own in crews.items()}
    return [name for name, own in sizes.items()
            if own and own[2] == wanted[2] and int(own[1]) >= int(wanted[1])]
