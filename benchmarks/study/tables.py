"""The study's tables in Markdown."""

import statistics
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import pairwise
from typing import Any

from benchmarks.study.printed import GroupRow, printed_rows
from benchmarks.study.tasks import (
    DRONES, FLEETS, MIXED, NOBODY, SAMPLED, SINGLE, SPEEDS, WINDOWS, Planned, TripRow,
)

Lines = list[str]

REFERENCE = 710.53
"""Cost of the best plan known for Table 1 before, from a long search by other means."""


def markdown(header: Sequence[str], rows: Iterable[Sequence[str]], words: int = 1) -> Lines:
    """Return a table whose first columns are words, all others numbers."""
    marks = ["---" if column < words else "---:" for column in range(len(header))]
    return [f"| {' | '.join(cells)} |" for cells in (header, marks, *rows)]


def percent(part: float, digits: int = 1) -> str:
    """Return a share in percent."""
    return f"{100 * part:.{digits}f}"


def spread(values: Sequence[float]) -> float:
    """Return the standard deviation; 0 of a single value."""
    return statistics.stdev(values) if len(values) > 1 else 0.0


def over_seeds(rows: Sequence[Planned], value: Callable[[Planned], float]) -> tuple[float, float]:
    """Return the mean over all, and how much the means of each seed spread."""
    seeds = sorted({row.seed for row in rows})
    means = [statistics.fmean(value(row) for row in rows if row.seed == seed) for seed in seeds]
    return statistics.fmean(means), spread(means)


def turns_table(rows: Sequence[Planned]) -> Lines:
    """Table 1 by more and more turns."""
    lines = []
    for turns in dict.fromkeys(row.turns for row in rows):
        group = [row for row in rows if row.turns == turns]
        costs = [row.cost for row in group]
        median = statistics.median(costs)
        lines.append([f"{turns:,}", str(len(costs)),
                      f"{min(costs):.2f}", f"{median:.2f}", f"{max(costs):.2f}",
                      f"{100 * (median / REFERENCE - 1):+z.2f}",
                      f"{statistics.fmean(row.cpu_s for row in group):.2g}"])
    return markdown(["turns", "seeds", "least", "median", "most",
                     f"median to {REFERENCE}, %", "seconds of processor time"], lines)


def printed_table(rows: Sequence[GroupRow]) -> Lines:
    """The printed plan beside what was recomputed."""
    return markdown(
        ["truck", "customers", "length", "flights", "of them from and to own stops",
         "flown", "demand, printed", "demand, recomputed", "load, printed %",
         "load, recomputed %"],
        [[str(row.group), str(row.customers), f"{row.truck_length:.1f}", str(row.flights),
          str(row.flights_of_own_stops), f"{row.drone_length:.1f}", f"{row.printed_demand:g}",
          f"{row.demand:g}", percent(row.printed_load_rate), percent(row.load_rate)]
         for row in rows])


def paths_table(plan: Mapping[str, Any]) -> Lines:
    """Planned routes in the form of Table 2."""
    lines = []
    for number, route in enumerate(plan["routes"], 1):
        for trip in route["trips"]:
            stops = [stop["id"] for stop in trip["stops"]]
            lines.append([f"Truck {number}", "→".join(stops), f"{trip['load'][0]:g}",
                          percent(trip["load_rate"]), f"{trip['distance'] / 1000:.1f}"])
            flights = [[stops[sortie["launch_stop"]], *(one["id"] for one in sortie["customers"]),
                        stops[sortie["recovery_stop"]]] for sortie in trip["sorties"]]
            length = sum(sortie["distance"] for sortie in trip["sorties"]) / 1000
            lines.append([f"Drone {number}", ", ".join("→".join(flight) for flight in flights), "",
                          "", f"{length:.1f}"])
    return markdown(["vehicle", "path", "demand, drone's included", "load, %", "length"], lines,
                    words=2)


def fleets_table(rows: Sequence[Planned], trips: Sequence[TripRow]) -> Lines:
    """Means of each size and fleet."""
    lines = []
    for size in sorted({row.customers for row in rows}):
        for fleet in FLEETS:
            group = [row for row in rows if (row.customers, row.fleet) == (size, fleet)]
            rates = [trip.load_rate for trip in trips
                     if (trip.customers, trip.fleet) == (size, fleet)]
            working = [trip.working_rate for trip in trips if trip.trip == 1
                       and (trip.customers, trip.fleet) == (size, fleet)]
            cost, deviation = over_seeds(group, lambda row: row.cost)
            lines.append([
                str(size), fleet, _mean(group, lambda row: row.vehicles),
                _mean(group, lambda row: row.trips), percent(statistics.fmean(rates)),
                percent(min(rates)), _mean(group, lambda row: row.driven),
                percent(statistics.fmean(working)),
                f"{cost:.1f} ± {deviation:.2f}"])
    return markdown(["customers", "capacity", "trucks", "trips", "load, mean %", "load, least %",
                     "course, km", "working rate, %", "total"],
                    lines, words=0)


def totals_table(rows: Sequence[Planned]) -> Lines:
    """Mean total cost of each size by fleet, and how much it spreads over seeds."""
    lines = []
    for size in sorted({row.customers for row in rows}):
        totals = [over_seeds([row for row in rows if (row.customers, row.fleet) == (size, fleet)],
                             lambda row: row.cost) for fleet in FLEETS]
        lines.append([str(size), *(f"{cost:.1f} ± {deviation:.2f}" for cost, deviation in totals)])
    return markdown(["customers", *FLEETS], lines, words=0)


def _mean(rows: Sequence[Planned], value: Callable[[Planned], float]) -> str:
    return f"{statistics.fmean(value(row) for row in rows):.1f}"


def best_costs(rows: Sequence[Planned], size: int, fleet: str) -> dict[int, float]:
    """Return the cost of the best seed, by case."""
    best: dict[int, float] = {}
    for row in rows:
        if (row.customers, row.fleet) == (size, fleet):
            best[row.case] = min(row.cost, best.get(row.case, row.cost))
    return best


def differences(rows: Sequence[Planned], size: int, fleet: str) -> list[float]:
    """Return how much dearer the mixed fleet is than another, case by case, as a share."""
    mixed, other = best_costs(rows, size, MIXED), best_costs(rows, size, fleet)
    return [mixed[case] / other[case] - 1 for case in mixed]


def against_table(rows: Sequence[Planned]) -> Lines:
    """The mixed fleet against each of one capacity."""
    lines = []
    for size in sorted({row.customers for row in rows}):
        for fleet in FLEETS:
            if fleet != MIXED:
                shares = differences(rows, size, fleet)
                lines.append([
                    str(size), fleet,
                    f"{100 * statistics.fmean(shares):+z.2f} ± {100 * spread(shares):.2f}",
                    f"{100 * max(shares):+z.2f}",
                    f"{sum(share > 1e-9 for share in shares)} of {len(shares)}"])
    return markdown(["customers", "capacity", "mixed fleet's total to it, %", "worst case, %",
                     "mixed fleet dearer"], lines, words=0)


def trips_table(trips: Sequence[TripRow]) -> Lines:
    """The trips of one plan by single and one by mixed fleet, in the form of Tables 3 to 5."""
    columns = [_trip_cells([trip for trip in trips if trip.fleet == fleet])
               for fleet in (SINGLE, MIXED)]
    height = max(map(len, columns))
    blank = [""] * 5
    lines = [[*(columns[0][line] if line < len(columns[0]) else blank),
              *(columns[1][line] if line < len(columns[1]) else blank)] for line in range(height)]
    names = ["demand", "load, %", "course", "working, %"]
    return markdown(["single (150)", *names, "mixed", *names], lines)


def _trip_cells(trips: Sequence[TripRow]) -> list[list[str]]:
    cells = []
    for trip in trips:
        first = trip.trip == 1
        cells.append([
            f"{trip.vehicle}-{trip.trip} ({trip.capacity:g})", f"{trip.demand:g}",
            percent(trip.load_rate), f"{trip.vehicle_course:.0f}" if first else "",
            percent(trip.working_rate) if first else ""])
    return cells


def printed_fleets_table() -> Lines:
    """Tables 3 to 5 as printed, with the load rates that their demands and capacities make."""
    lines = []
    for table, size in ((3, 25), (4, 50), (5, 100)):
        for fleet in ("single", "heterogeneous"):
            rows = [row for row in printed_rows(table) if row["fleet"] == fleet]
            printed = [float(row["loading_rate_printed"].rstrip("%")) for row in rows]
            demands = [float(row["total_demand"]) for row in rows]
            rates = rates_of_demands(table, fleet)
            lines.append([str(size), fleet, str(len({row["vehicle"] for row in rows})),
                          str(len(rows)), f"{sum(demands):g}", f"{statistics.fmean(printed):.1f}",
                          f"{min(printed):.1f}", f"{statistics.fmean(rates):.1f}",
                          f"{min(rates):.1f}"])
    return markdown(["customers", "fleet", "trucks", "trips", "demand", "load, printed mean %",
                     "least %", "load, recomputed mean %", "least %"], lines, words=2)


def rates_of_demands(table: int, fleet: str) -> list[float]:
    """Return the load rates of the trips in a printed table, by its demands, in percent."""
    return [100 * float(row["total_demand"]) / float(row["capacity"])
            for row in printed_rows(table) if row["fleet"] == fleet]


def hours_table(rows: Sequence[Planned], size: int) -> Lines:
    """Mean total cost of one size, the least in bold."""
    surface = surface_of(rows, size)
    least = min(surface.values())
    hours = sorted({limit for _, limit in surface})
    lines = [[str(capacity),
              *(f"**{surface[capacity, limit]:.1f}**" if surface[capacity, limit] == least
                else f"{surface[capacity, limit]:.1f}" for limit in hours)]
             for capacity in sorted({capacity for capacity, _ in surface})]
    return markdown(["capacity", *(f"{limit:g} h" for limit in hours)], lines, words=0)


def surface_of(rows: Sequence[Planned], size: int) -> dict[tuple[int, float], float]:
    """Return the mean total cost over cases, by capacity and hours."""
    costs: dict[tuple[int, float], list[float]] = {}
    for row in rows:
        if row.customers == size:
            costs.setdefault((int(row.fleet), row.hours), []).append(row.cost)
    return {place: statistics.fmean(found) for place, found in costs.items()}


def rises(rows: Sequence[Planned]) -> tuple[int, int, float]:
    """Return how often an hour more made a plan dearer, of how many, and by how much at most."""
    series: dict[tuple[int, int, str], list[tuple[float, float]]] = {}
    for row in rows:
        series.setdefault((row.customers, row.case, row.fleet), []).append((row.hours, row.cost))
    shares = [later / sooner - 1 for points in series.values()
              for (_, sooner), (_, later) in pairwise(sorted(points))]
    return sum(share > 1e-9 for share in shares), len(shares), max(shares)


def drones_table(rows: Sequence[Planned]) -> Lines:
    """Costs beside those of trucks alone without windows at fixed speed, in percent."""
    lines = []
    for size in sorted({row.customers for row in rows}):
        base = {row.case: row.cost for row in rows if (row.customers, row.drones, row.windows,
                                                       row.speeds) == (size, 0, "off", "fixed")}
        for drones in DRONES:
            cells = []
            for windows in WINDOWS:
                for speeds in SPEEDS:
                    shares = [100 * row.cost / base[row.case] for row in rows if (
                        row.customers, row.drones, row.windows, row.speeds) == (
                        size, drones, windows, speeds)]
                    cells.append(f"{statistics.fmean(shares):.1f}")
            lines.append([str(size), str(drones), *cells])
    header = [f"{windows}, {speeds}" for windows in WINDOWS for speeds in SPEEDS]
    return markdown(["customers", "drones", *header], lines, words=0)


def drones_work_table(rows: Sequence[Planned]) -> Lines:
    """What is driven, flown and worked."""
    lines = []
    for size in sorted({row.customers for row in rows}):
        for drones in DRONES:
            for windows in WINDOWS:
                group = [row for row in rows if (row.customers, row.drones, row.windows) == (
                    size, drones, windows)]
                lines.append([
                    str(size), str(drones), windows, _mean(group, lambda row: row.vehicles),
                    _mean(group, lambda row: row.driven), _mean(group, lambda row: row.flown),
                    _mean(group, lambda row: row.sorties),
                    _mean(group, lambda row: row.working_hours),
                    _mean(group, lambda row: row.lateness), _mean(group, lambda row: row.cost),
                    str(sum(row.unassigned for row in group))])
    return markdown(["customers", "drones", "windows", "trucks", "driven, km", "flown, km",
                     "sorties", "hours of work", "lateness", "total", "left out"], lines, words=0)


def policies_table(rows: Sequence[Planned]) -> Lines:
    """Costs above the cheapest plan found of each case, in percent."""
    best: dict[tuple[int, int], float] = {}
    for row in rows:
        place = (row.customers, row.case)
        best[place] = min(row.cost, best.get(place, row.cost))
    sizes = sorted({row.customers for row in rows})
    lines = []
    for way in dict.fromkeys(map(way_of, rows)):
        group = [row for row in rows if way_of(row) == way]
        cells = []
        for size in sizes:
            mine = [row for row in group if row.customers == size]
            shares = [100 * (row.cost / best[row.customers, row.case] - 1)
                      for row in mine if not row.unassigned]
            left_out = sum(row.unassigned for row in mine)
            text = f"{statistics.fmean(shares):.1f}" if shares else "none"
            cells.append(f"{text} ({left_out} left out)" if left_out else text)
        lines.append([*way, *cells])
    return markdown(["begun by", "search", *(f"{size} customers, %" for size in sizes)], lines,
                    words=2)


def way_of(row: Planned) -> tuple[str, str]:
    """Return how a plan of section `policies` was made, in words."""
    turns = f"{row.turns // row.customers} turns a customer" if row.turns else "none"
    if row.policy == NOBODY:
        return "insertion", turns
    how = "best of 128 samples" if row.decoding == SAMPLED else "greedy"
    return f"`{row.policy}`, {how}", turns
