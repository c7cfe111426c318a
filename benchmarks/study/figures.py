"""The study's pictures, as SVG; the same rows make the same picture."""

import statistics
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from app.plans.pictures.colours import BLACK, GREY, INK, VEHICLES, VERMILLION
from benchmarks.study.cases import HOUR, example
from benchmarks.study.printed import Group
from benchmarks.study.tables import REFERENCE, over_seeds, surface_of, way_of
from benchmarks.study.tasks import DRONES, FLEETS, MIXED, SINGLE, SPEEDS, WINDOWS, Planned, TripRow

KINDS = {"drone": (VEHICLES[1], "^", "DC: drone only"), "either": (VEHICLES[0], "o", "FC: either"),
         "truck": (VEHICLES[2], "s", "TC: truck only")}

Point = tuple[float, float]


def places() -> dict[str, Point]:
    """Return where Table 1's depot and customers are, by id."""
    data = example("table1")
    return {entry["id"]: (entry["location"][0], entry["location"][1])
            for entry in [*data["depots"], *data["customers"]]}


def draw_nodes(path: Path) -> None:
    """Figure 4: the nodes of Table 1."""
    figure = Figure(figsize=(8.4, 6.4), layout="constrained")
    axes = figure.subplots()
    customers = example("table1")["customers"]
    for kind, (colour, marker, label) in KINDS.items():
        mine = [customer for customer in customers if customer["served_by"] == kind]
        xs, ys = zip(*(customer["location"] for customer in mine), strict=True)
        axes.scatter(xs, ys, s=[18 + 4 * customer["demand"][0] for customer in mine],
                     color=colour, marker=marker, label=label, alpha=0.85)
        for customer in mine:
            axes.annotate(customer["id"], customer["location"], xytext=(4, 3), fontsize=6,
                          textcoords="offset points", color=INK)
    _draw_depot(axes)
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False, fontsize=8)
    _as_map(axes)
    _save(figure, path)


def _draw_depot(axes: Axes) -> None:
    x, y = places()["100"]
    axes.plot([x], [y], marker="s", markersize=10, color=BLACK, linestyle="none", label="depot",
              zorder=6)


def _as_map(axes: Axes) -> None:
    axes.set(xlabel="km east", ylabel="km north", aspect="equal")
    axes.grid(alpha=0.3)


def draw_windows(path: Path) -> None:
    """Figure 5: the windows, a line for each customer, in the order in which they open."""
    figure = Figure(figsize=(7.2, 6.0), layout="constrained")
    axes = figure.subplots()
    stated = [(customer["time_window"], customer["id"])
              for customer in example("table1_windows")["customers"] if "time_window" in customer]
    stated.sort(key=lambda pair: (pair[0]["earliest"], pair[0]["latest"]))
    for soft, colour, label in ((False, VEHICLES[0], "hard"), (True, VEHICLES[1], "soft")):
        rows = [(row, window) for row, (window, _) in enumerate(stated)
                if (window.get("late_cost_per_hour") is not None) == soft]
        axes.hlines([row for row, _ in rows],
                    [window["earliest"] / HOUR for _, window in rows],
                    [window["latest"] / HOUR for _, window in rows], colors=colour, linewidth=2,
                    label=label)
    axes.set(xlabel="hour of the day", yticks=[], ylim=(-1, len(stated)),
             ylabel=f"{len(stated)} customers with a window, by its opening")
    axes.legend(frameon=False)
    axes.grid(axis="x", alpha=0.3)
    _save(figure, path)


def draw_routes(printed: Sequence[Group], plan: Mapping[str, Any], path: Path) -> None:
    """Figure 6: the printed plan and ours, both drawn as they are stated."""
    figure = Figure(figsize=(13.0, 6.4), layout="constrained")
    left, right = figure.subplots(1, 2, sharex=True, sharey=True)
    _draw_plan(left, [group.path for group in printed],
               [list(group.flights) for group in printed])
    visited = {name for group in printed for name in group.path}
    visited |= {customer for group in printed for _, customer, _ in group.flights}
    _draw_points(left, visited)
    left.set_title("printed; crosses: never visited")
    paths, flights = [], []
    for route in plan["routes"]:
        stops = [[stop["id"] for stop in trip["stops"]] for trip in route["trips"]]
        paths.append([name for trip in stops for name in trip])
        flights.append([(names[sortie["launch_stop"]], *(one["id"] for one in sortie["customers"]),
                         names[sortie["recovery_stop"]])
                        for names, trip in zip(stops, route["trips"], strict=True)
                        for sortie in trip["sorties"]])
    _draw_plan(right, paths, flights)
    _draw_points(right, set(places()))
    right.set_title(f"planned, cost {plan['cost']['total']:.2f}")
    _save(figure, path)


def _draw_plan(axes: Axes, paths: Iterable[Sequence[str]],
               flights: Iterable[Iterable[Sequence[str]]]) -> None:
    where = places()
    for index, (path, flown) in enumerate(zip(paths, flights, strict=True)):
        colour = VEHICLES[index % len(VEHICLES)]
        axes.plot(*zip(*(where[name] for name in path), strict=True), color=colour, linewidth=1.2)
        for flight in flown:
            axes.plot(*zip(*(where[name] for name in flight), strict=True), color=colour,
                      linewidth=1.0, linestyle="--")


def _draw_points(axes: Axes, visited: set[str]) -> None:
    for name, (x, y) in places().items():
        if name in visited:
            axes.plot([x], [y], marker="o", markersize=3, color=INK, linestyle="none")
        else:
            axes.plot([x], [y], marker="X", markersize=8, color=VERMILLION, linestyle="none")
    _draw_depot(axes)
    _as_map(axes)


def draw_turns(rows: Sequence[Planned], path: Path) -> None:
    """Costs of Table 1 over turns of the search, each seed a dot."""
    figure = Figure(figsize=(6.0, 3.4), layout="constrained")
    axes = figure.subplots()
    axes.plot([row.turns for row in rows], [row.cost for row in rows], "o", alpha=0.6,
              color=VEHICLES[0])
    limits = sorted({row.turns for row in rows})
    axes.plot(limits, [statistics.median(row.cost for row in rows if row.turns == limit)
                       for limit in limits], color=VEHICLES[0], label="median")
    axes.axhline(REFERENCE, color=GREY, linestyle="--", label=f"reference, {REFERENCE}")
    axes.set(xscale="log", xlabel="turns", ylabel="cost")
    axes.set_xticks(limits, [f"{limit:,}" for limit in limits])
    axes.minorticks_off()
    axes.legend(frameon=False)
    axes.grid(alpha=0.3)
    _save(figure, path)


def draw_fleets(rows: Sequence[Planned], trips: Sequence[TripRow], path: Path) -> None:
    """Costs of fleets, and the load rates of all their trips."""
    sizes = sorted({row.customers for row in rows})
    figure = Figure(figsize=(3.6 * len(sizes) + 0.6, 6.4), layout="constrained")
    panels = figure.subplots(2, len(sizes), squeeze=False, sharex=True)
    for column, size in enumerate(sizes):
        upper, lower = panels[0, column], panels[1, column]
        for index, fleet in enumerate(FLEETS):
            mine = [row for row in rows if (row.customers, row.fleet) == (size, fleet)]
            fixed, _ = over_seeds(mine, lambda row: row.fixed)
            total, deviation = over_seeds(mine, lambda row: row.cost)
            upper.bar(index, fixed, color=GREY, label="fixed" if not index else None)
            upper.bar(index, total - fixed, bottom=fixed, yerr=deviation, color=VEHICLES[0],
                      label="transport" if not index else None)
            rates = sorted(100 * trip.load_rate for trip in trips
                           if (trip.customers, trip.fleet) == (size, fleet))
            lower.scatter(index + np.linspace(-0.3, 0.3, len(rates)), rates, s=3,
                          color=VEHICLES[0], alpha=0.5)
            lower.plot([index - 0.35, index + 0.35], [statistics.fmean(rates)] * 2,
                       color=VERMILLION, label="mean" if not index else None)
        upper.set(title=f"{size} customers", ylabel="" if column else "total cost")
        lower.set(ylabel="" if column else "load of each trip, %", ylim=(0, 105))
        lower.set_xticks(range(len(FLEETS)), FLEETS, fontsize=8)
        for panel in (upper, lower):
            panel.grid(axis="y", alpha=0.3)
    panels[0, 0].margins(y=0.2)
    panels[0, 0].legend(frameon=False, loc="upper left", ncols=2)
    panels[1, 0].legend(frameon=False, loc="lower left")
    _save(figure, path)


def draw_trips(trips: Sequence[TripRow], path: Path) -> None:
    """Loads of the trips of one plan of each size: single and mixed fleet."""
    sizes = sorted({trip.customers for trip in trips})
    figure = Figure(figsize=(3.6 * len(sizes) + 0.6, 5.0), layout="constrained")
    panels = figure.subplots(2, len(sizes), squeeze=False)
    for column, size in enumerate(sizes):
        for line, fleet in enumerate((SINGLE, MIXED)):
            panel = panels[line, column]
            mine = [trip for trip in trips if (trip.customers, trip.fleet) == (size, fleet)]
            names = [f"{trip.vehicle}-{trip.trip}" for trip in mine]
            panel.bar(names, [trip.capacity for trip in mine], fill=False, edgecolor=GREY)
            panel.bar(names, [trip.demand for trip in mine], color=VEHICLES[line])
            panel.set(title=f"{size} customers, {fleet}", ylabel="" if column else "demand")
            panel.tick_params(axis="x", rotation=90, labelsize=7)
    _save(figure, path)


def draw_hours(rows: Sequence[Planned], path: Path) -> None:
    """Figure 7: mean total cost over hours and capacity, the least framed."""
    sizes = sorted({row.customers for row in rows})
    figure = Figure(figsize=(7.6, 2.3 * len(sizes)), layout="constrained")
    panels = figure.subplots(len(sizes), 1, squeeze=False)
    for panel, size in zip(panels.flat, sizes, strict=True):
        surface = surface_of(rows, size)
        capacities = sorted({capacity for capacity, _ in surface})
        hours = sorted({limit for _, limit in surface})
        cells = np.array([[surface[capacity, limit] for limit in hours]
                          for capacity in capacities])
        picture = panel.pcolormesh(cells, cmap="cividis_r", edgecolors="white", linewidth=0.5)
        for (row, column), cost in np.ndenumerate(cells):
            middle = (cells.min() + cells.max()) / 2
            panel.text(column + 0.5, row + 0.5, f"{cost:.0f}", ha="center", va="center",
                       fontsize=8, color="white" if cost > middle else BLACK)
        row, column = np.unravel_index(int(cells.argmin()), cells.shape)
        panel.add_patch(mpl.patches.Rectangle((float(column), float(row)), 1, 1, fill=False,
                                              edgecolor=VERMILLION, linewidth=2.5))
        panel.set_xticks(np.arange(len(hours)) + 0.5, [f"{limit:g} h" for limit in hours])
        panel.set_yticks(np.arange(len(capacities)) + 0.5, [str(one) for one in capacities])
        panel.set(title=f"{size} customers", ylabel="capacity")
        figure.colorbar(picture, ax=panel, label="total cost")
    _save(figure, path)


def draw_drones(rows: Sequence[Planned], path: Path) -> None:
    """Costs with no, one and two drones, by windows and speeds."""
    sizes = sorted({row.customers for row in rows})
    figure = Figure(figsize=(9.0, 3.2 * len(sizes)), layout="constrained")
    panels = figure.subplots(len(sizes), 1, squeeze=False)
    places_ = [(windows, speeds) for windows in WINDOWS for speeds in SPEEDS]
    for panel, size in zip(panels.flat, sizes, strict=True):
        for index, drones in enumerate(DRONES):
            means = [statistics.fmean(row.cost for row in rows if (
                row.customers, row.drones, row.windows, row.speeds) == (size, drones, *place))
                for place in places_]
            panel.bar(np.arange(len(places_)) + 0.27 * (index - 1), means, 0.25,
                      color=VEHICLES[index],
                      label="trucks alone" if not drones else f"drones on each: {drones}")
        panel.set_xticks(range(len(places_)),
                         [f"{windows},\n{speeds}" for windows, speeds in places_])
        panel.set(title=f"{size} customers; windows and speeds", ylabel="total cost")
        panel.grid(axis="y", alpha=0.3)
        panel.margins(y=0.2)
    panels.flat[0].legend(frameon=False, ncols=3, fontsize=8, loc="upper left")
    _save(figure, path)


def draw_policies(rows: Sequence[Planned], path: Path) -> None:
    """Mean cost of each way to plan above the cheapest plan found."""
    sizes = sorted({row.customers for row in rows})
    ways = list(dict.fromkeys(map(way_of, rows)))
    best: dict[tuple[int, int], float] = {}
    for row in rows:
        place = (row.customers, row.case)
        best[place] = min(row.cost, best.get(place, row.cost))
    figure = Figure(figsize=(8.4, 0.45 * len(ways) + 1.2), layout="constrained")
    axes = figure.subplots()
    for index, size in enumerate(sizes):
        gaps = [statistics.fmean([100 * (row.cost / best[size, row.case] - 1) for row in rows if
                                  way_of(row) == way and row.customers == size
                                  and not row.unassigned] or [0.0]) for way in ways]
        axes.barh(np.arange(len(ways)) + 0.27 * (index - (len(sizes) - 1) / 2), gaps, 0.25,
                  color=VEHICLES[index], label=f"{size} customers")
    axes.set_yticks(range(len(ways)), [f"{begun.replace('`', '')}; search: {search}"
                                       for begun, search in ways], fontsize=8)
    axes.invert_yaxis()
    axes.set(xlabel="cost above the cheapest plan found, %")
    axes.grid(axis="x", alpha=0.3)
    axes.legend(frameon=False, fontsize=8)
    _save(figure, path)


def _save(figure: Figure, path: Path) -> None:
    with mpl.rc_context({"svg.hashsalt": "study", "svg.fonttype": "none"}):
        figure.savefig(path, metadata={"Date": None})
