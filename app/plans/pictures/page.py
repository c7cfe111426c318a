"""A plan as one HTML page that loads nothing: picture, costs, and the stops of each route."""

from collections.abc import Iterable, Iterator, Sequence
from html import escape

from app.plans.pictures.drawing import draw_svg
from app.plans.pictures.scene import DrawnPlan
from app.schemas.customer import CustomerInput, TimeWindowInput
from app.schemas.plan import RouteInput, SortieInput, StopInput, TripInput

_STYLE = """
body { font: 15px/1.5 system-ui, sans-serif; color: #222; background: #fff; margin: 2rem auto;
       max-width: 80rem; padding: 0 1rem; }
svg { width: 100%; height: auto; }
table { border-collapse: collapse; margin: 0.5rem 0 2rem; }
caption { text-align: left; font-weight: 600; padding: 0.3rem 0; }
th, td { padding: 0.15rem 0.9rem 0.15rem 0; text-align: left; border-bottom: 1px solid #ddd; }
.number { text-align: right; font-variant-numeric: tabular-nums; }
tr.drone td { color: #0b5d87; }
@media print { section { break-inside: avoid; } }
"""

_POLICY = "default-src 'none'; style-src 'unsafe-inline'"

STOP_COLUMNS = ("Trip", "Place", "Arrival", "Service", "Departure", "Window", "Late, min", "Demand",
                "By")
_NUMBERS = frozenset({0, 2, 3, 4, 6, 7})
"""Columns of numbers in a table of stops."""


def draw_page(scene: DrawnPlan) -> bytes:
    """Return a page in UTF-8."""
    svg = draw_svg(scene).decode()
    parts = (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n',
        f'<meta http-equiv="Content-Security-Policy" content="{_POLICY}">\n',
        '<meta name="viewport" content="width=device-width">\n',
        f"<title>Plan: {escape(scene.headline)}</title>\n<style>{_STYLE}</style>\n</head>\n",
        "<body>\n<h1>Plan</h1>\n",
        svg[svg.index("<svg"):],
        _cost_table(scene),
        *(_route_section(scene, route) for route in scene.plan.routes),
        _unassigned(scene),
        "</body>\n</html>\n",
    )
    return "".join(parts).encode()


def _cost_table(scene: DrawnPlan) -> str:
    terms = [*(term for term in scene.cost if term != "total"), "total"]
    rows = [(term.capitalize(), f"{scene.cost[term]:,.2f}") for term in terms]
    return _table("Cost", ("Term", "Cost"), rows, numbers={1})


def _route_section(scene: DrawnPlan, route: RouteInput) -> str:
    rows = [row for number, trip in enumerate(route.trips, 1)
            for row in _trip_rows(scene, number, trip)]
    table = _table(f"Stops of {scene.called(route.vehicle)}", STOP_COLUMNS, rows, _NUMBERS)
    return f"<section>{table}</section>\n"


def _trip_rows(scene: DrawnPlan, number: int, trip: TripInput) -> Iterator[Sequence[str]]:
    """Yield a row per stop, each followed by the sorties launched there."""
    for index, stop in enumerate(trip.stops):
        yield _stop_row(scene, number, stop)
        for sortie in trip.sorties:
            if sortie.launch_stop == index:
                yield from _sortie_rows(scene, number, trip, sortie)


def _stop_row(scene: DrawnPlan, number: int, stop: StopInput) -> Sequence[str]:
    if stop.kind in ("depot", "break"):
        return (str(number), stop.id, scene.clock(stop.arrival), "", scene.clock(stop.departure),
                "", "", "", "truck")
    return (str(number), stop.id, scene.clock(stop.arrival), scene.clock(stop.service_start),
            scene.clock(stop.departure), *_order(scene, stop.id, stop.ready), "truck")


def _sortie_rows(scene: DrawnPlan, number: int, trip: TripInput,
                 sortie: SortieInput) -> Iterator[Sequence[str]]:
    drone = sortie.drone.rpartition("/")[2]
    back = f"back at {trip.stops[sortie.recovery_stop].id} by {scene.clock(sortie.recovery_time)}"
    for visit in sortie.customers:
        yield (str(number), visit.id, scene.clock(visit.arrival), scene.clock(visit.service_start),
               scene.clock(visit.departure), *_order(scene, visit.id, visit.ready),
               f"{drone}, off at {scene.clock(sortie.launch_time)}, {back}")


def _order(scene: DrawnPlan, name: str, ready: float) -> tuple[str, str, str]:
    """Return a customer's windows, the minutes of lateness and the demand."""
    customer = scene.customers[name]
    latest = customer.windows[-1].latest
    late = 0.0 if latest is None else max(0.0, ready - latest)
    return (", ".join(filter(None, [_window(scene, each) for each in customer.windows])),
            f"{late / 60:.1f}" if late else "",
            _handed(customer))


def _handed(customer: CustomerInput) -> str:
    """Return what is delivered, and what is picked up."""
    picked_up = "" if customer.pickup is None else f", back {_amounts(customer.pickup)}"
    return _amounts(customer.demand) + picked_up


def _amounts(amounts: Sequence[float]) -> str:
    return ", ".join(f"{amount:g}" for amount in amounts)


def _window(scene: DrawnPlan, window: TimeWindowInput) -> str:
    latest = "" if window.latest is None else scene.clock(window.latest)
    if not (window.earliest or latest):
        return ""
    return f"{scene.clock(window.earliest)} to {latest}".strip()


def _unassigned(scene: DrawnPlan) -> str:
    if not scene.plan.unassigned:
        return ""
    rows = [(left_out.id, " ".join(str(reason.get("message", ""))
                                   for reason in left_out.reasons or ()))
            for left_out in scene.plan.unassigned]
    return _table("Unassigned", ("Customer", "Why"), rows, numbers=())


def _table(caption: str, columns: Sequence[str], rows: Iterable[Sequence[str]],
           numbers: Iterable[int]) -> str:
    aligned = frozenset(numbers)
    classes = [' class="number"' if index in aligned else "" for index in range(len(columns))]
    head = "".join(f'<th scope="col"{kind}>{escape(name)}</th>'
                   for kind, name in zip(classes, columns, strict=True))
    lines = [
        f"<table>\n<caption>{escape(caption)}</caption>\n<thead><tr>{head}</tr></thead>\n<tbody>"]
    for row in rows:
        mark = ' class="drone"' if row[-1].startswith("drone-") else ""
        cells = "".join(f"<td{kind}>{escape(text)}</td>"
                        for kind, text in zip(classes, row, strict=True))
        lines.append(f"<tr{mark}>{cells}</tr>")
    return "\n".join([*lines, "</tbody>\n</table>\n"])
