"""The study's report: text around tables and pictures, `docs/develop/study.md`."""

import json
import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from app.requests.conversion.problem import to_problem
from benchmarks.rows import append_rows
from benchmarks.study import figures, findings, tables
from benchmarks.study.cases import request_of
from benchmarks.study.printed import GroupRow, broken_rules, groups, measured, visits
from benchmarks.study.tasks import Planned, TripRow

PLAN = "table1_plan.json"
"""File of the best plan of Table 1 that can be made again."""

TABLES = "tables.md"
"""File of the tables that are too long for the page."""

SENTENCE_END = re.compile(r"(?<=[.?]) (?=[A-Z`])")
"""Where a line of text ends."""

CHOICES = """\
## What the paper doesn't give

Table 1 has places, demands and who may serve whom. Everything else is a choice of ours.

- **All sections.** The first case is taken from Table 1, with 100 customers all of it. Places of
  other cases are whole, each once, within Table 1's x and y. Their demands are drawn from Table 1's
  of the same kind (DC, FC, TC).
- **2 and 6.** A unit of length costs 1, for trucks and drones. Each truck has one drone, of payload
  10 and endless endurance; there are no times. In 6, trucks of 400 are as few as Table 1's
  tightness (97.5 %) allows.
- **3 and 4.** Trucks alone serve, DC too: Tables 3 to 5 tell of no drones. Trucks of 100, 110, 150
  and 200 cost 10, 11, 15 and 20 each, and 0.9, 0.92, 1.0 and 1.1 a km. They drive 30 km/h without
  service or reloading, so 8 h are 240 km. Each makes up to three trips, and as many drive as are
  wanted. In 3 a day has 8 hours.
- **5.** Trucks of 400 are two more than twice what the load needs, from 6:00 to 18:00. They cost 50
  each, 1 a km and 20 an hour of work, drones 0.25 a km. Drones have payload 10, 60 km/h, 30 min of
  endurance, and 1 min each to launch and recover. Service takes 5 min, by truck or drone; trucks
  may serve DC customers too. Four fifths have windows, of 1, 2 or 4 h; soft ones cost 30 an hour.
  Trucks drive 40 km/h; by time of day it is 25 from 7:00 to 9:00 and from 16:00 to 18:00."""

HEAD = """\
# The paper's study, made again

A paper of 2025 plans a hundred customers by trucks with drones: "Research on unmanned delivery
path optimization strategy based on reinforcement learning in intelligent logistics system". It
compares fleets, and varies working hours and capacity. Tandem plans the same here, beside what
the paper prints. `make study` makes this page and its pictures again. In `runs/study/` it leaves a
row for each plan and trip, and the longer tables."""


@dataclass(frozen=True)
class Study:
    """All plans, and the trips of those that compare fleets."""

    rows: list[Planned]
    trips: list[TripRow]

    def of(self, section: str) -> list[Planned]:
        """Return the plans of a section."""
        return [row for row in self.rows if row.section == section]


def write_report(study: Study, page: Path, runs: Path) -> None:
    """Write the page, its pictures into a folder of its name, and tables beside the CSVs."""
    folder = page.with_suffix("")
    folder.mkdir(parents=True, exist_ok=True)
    plan = json.loads((runs / PLAN).read_text("utf-8"))
    _draw(study, plan, folder)
    (runs / TABLES).write_text(_longer_tables(study), encoding="utf-8")
    recomputed = runs / "table2.csv"
    recomputed.unlink(missing_ok=True)
    append_rows(recomputed, GroupRow, map(measured, groups()))
    parts = [HEAD, _made(study), CHOICES, _table1(), _routes(study, plan), _fleets(study),
             _hours(study), _drones(study), _policies(study)]
    text = "\n\n".join(map(_by_sentence, "\n\n".join(parts).split("\n\n")))
    page.write_text(text.replace("](study/", f"]({folder.name}/") + "\n", encoding="utf-8")


def _by_sentence(part: str) -> str:
    """Return a paragraph or list with a line a sentence; tables and pictures stay as they are."""
    if part[0] in "|!#":
        return part
    if part.startswith("- "):
        return SENTENCE_END.sub("\n  ", part)
    return SENTENCE_END.sub("\n", part.replace("\n", " "))


def _draw(study: Study, plan: Mapping[str, Any], folder: Path) -> None:
    figures.draw_nodes(folder / "nodes.svg")
    figures.draw_windows(folder / "windows.svg")
    figures.draw_routes(groups(), plan, folder / "routes.svg")
    figures.draw_turns(study.of("table1"), folder / "turns.svg")
    figures.draw_fleets(study.of("fleets"), study.trips, folder / "fleets.svg")
    figures.draw_trips(findings.shown_trips(study.of("fleets"), study.trips),
                       folder / "trips.svg")
    figures.draw_hours(study.of("hours"), folder / "hours.svg")
    figures.draw_drones(study.of("drones"), folder / "drones.svg")
    figures.draw_policies(study.of("policies"), folder / "policies.svg")


def _made(study: Study) -> str:
    rows = study.rows
    dates = " to ".join(sorted({min(row.date for row in rows), max(row.date for row in rows)}))
    return (
        f"Made on {dates}, {'; '.join(sorted({row.machine for row in rows}))}, beside other work. "
        f"The {len(rows):,} plans took {sum(row.cpu_s for row in rows) / 60:.1f} minutes of "
        "processor time, one thread each. Tandem's checker shares no code with search or policies. "
        "It judged all plans and found no rule broken. Searches end after so many turns, so the "
        "same version makes the same plans again. What a time limit brings stands in "
        "[benchmarks](benchmarks.md).")


def _table1() -> str:
    return """\
## 1. Table 1 and its windows

A depot and 100 customers, with a demand of 1560 in all. Drones alone may serve 10 (DC), trucks
alone 10 (TC), either 80 (FC). Four trucks of 400 hold 1600, so 97.5 % of all capacity is needed.

![Nodes of Table 1 by who may serve them, larger with their demand](study/nodes.svg)

The paper draws its windows (Figure 5) without a number. These are ours, of
`examples/table1_windows.json`: drawn at random around the arrivals of a plan that keeps them all.

![Windows, by their opening](study/windows.svg)"""


def _routes(study: Study, plan: Mapping[str, Any]) -> str:
    rows, table1 = study.of("table1"), groups()
    counted, seen = broken_counts(study), visits(table1)
    flights = sum(len(group.flights) for group in table1)
    stated = sum(len(group.stated) for group in table1)
    rates = [trip["load_rate"] for route in plan["routes"] for trip in route["trips"]]
    least = min(row.cost for row in rows)
    return "\n".join([
        "## 2. Planned routes", "",
        f"The least cost found is {least:.2f}, {_beside(least)}. All 100 customers are served by "
        f"four trucks loaded {findings.words_of([100 * rate for rate in rates], '.1f')} %. "
        "The paper says 2135 for its plan.", "",
        "![Cost of Table 1 over turns](study/turns.svg)", "",
        "The best of the plans that can be made again, as Table 2 prints routes (length in km):",
        "", *tables.paths_table(plan), "",
        "### The printed plan is infeasible", "",
        "Recomputed from Table 1, with straight lines:", "",
        *tables.printed_table([measured(group) for group in table1]), "",
        f"Of its {flights} flights, {flights - stated} can't be stated: they begin or end where "
        f"their truck never halts. Without these the checker finds {sum(counted.values())} broken "
        f"rules: {', '.join(f'{count} {code}' for code, count in counted.most_common())}. With all "
        f"flights counted, {sum(not times for times in seen.values())} customers are never "
        f"visited, and {sum(times > 1 for times in seen.values())} more than once. Customer 91 "
        "(trucks only, demand 31) is flown. Its demands add up to 1574 of 1560. No load rate is "
        "demand over 400. Its routes alone are "
        f"{sum(measured(group).truck_length for group in table1):.0f} long, though the plan is "
        "said to cost 2135.", "",
        "![The printed routes beside planned ones](study/routes.svg)"])


def _num_cases(rows: Sequence[Planned]) -> str:
    """Return how many cases there are of each size, in words."""
    return f"{max(row.case for row in rows)} cases of each size"


def _beside(cost: float) -> str:
    difference = 100 * (cost / tables.REFERENCE - 1)
    return (f"{abs(difference):.1f} % {'below' if difference < 0 else 'above'} the reference of "
            f"{tables.REFERENCE}")


def broken_counts(study: Study) -> Counter[str]:
    """Return how often the printed plan breaks each rule."""
    task = next(row.task for row in study.of("table1"))
    problem = to_problem(request_of(task))
    return Counter(violation.code for violation in broken_rules(problem, groups()))


def _fleets(study: Study) -> str:
    rows, trips = study.of("fleets"), study.trips
    return "\n".join([
        "## 3. Single and mixed fleets", "",
        "Trucks of 150 against as many as wanted of 100, 150 and 200, and of 100 or 200 alone. "
        f"Mean total cost of {_num_cases(rows)} and {max(row.seed for row in rows)} seeds, ± the "
        "standard deviation of the seeds' means.", "",
        *tables.totals_table(rows), "", *findings.on_fleets(rows, trips),
        *findings.on_search(rows), "",
        "![Total cost of each fleet, and the load of every trip](study/fleets.svg)", "",
        "Trips of the first case's best plans, as Tables 3 to 5 print them:", "",
        "![Loads of these trips within their capacities](study/trips.svg)", "",
        "The two fleets of a case differ in total demand in the paper, so their costs can't be "
        "compared. Its total is of one fleet only."])


def _hours(study: Study) -> str:
    rows = study.of("hours")
    return "\n".join([
        "## 4. Working hours and capacity", "",
        f"One capacity at a time, one seed; costs are means of {_num_cases(rows)}.", "",
        "![Mean total cost over hours and capacity](study/hours.svg)", "",
        *findings.on_hours(rows)])


def _drones(study: Study) -> str:
    rows = study.of("drones")
    return "\n".join([
        "## 5. Drones, windows, speeds", "",
        "Total cost in % of trucks alone without windows at fixed speed. Means of "
        f"{_num_cases(rows)}; columns are windows and speeds.", "",
        *tables.drones_table(rows), "", *findings.on_drones(rows), "",
        "![Total cost by drones, windows and speeds](study/drones.svg)"])


def _policies(study: Study) -> str:
    rows = study.of("policies")
    return "\n".join([
        "## 6. Two policies", "",
        "`attention`, the default, beside `pointer`, the paper's. Each plans alone, then a search "
        "begins with its greedy plan, or by insertion. One drone on each truck, distances only. "
        f"Cost above the cheapest plan found of each case, mean of {_num_cases(rows)}, of plans "
        "that serve everybody.", "",
        *tables.policies_table(rows), "", *findings.on_policies(rows), "",
        "![Cost of each way to plan](study/policies.svg)"])


def _longer_tables(study: Study) -> str:
    """Return the tables that the page has no room for."""
    fleets, hours, drones = (study.of(section) for section in ("fleets", "hours", "drones"))
    shown = findings.shown_trips(fleets, study.trips)
    parts = ["# The study's longer tables",
             "## Table 1 by turns", "\n".join(tables.turns_table(study.of("table1"))),
             "## Single and mixed fleets",
             "The working rate is each truck's, over 8 h.",
             "\n".join(tables.fleets_table(fleets, study.trips)),
             "## The mixed fleet beside others, by the best seeds",
             "Means over cases, ± their standard deviation.",
             "\n".join(tables.against_table(fleets)),
             "## Tables 3 to 5 as printed, and as their demands and capacities make them",
             "\n".join(tables.printed_fleets_table())]
    for size in findings.sizes_of(fleets):
        parts += [f"## Trips of case 1 with {size} customers, as Table "
                  f"{findings.TABLE_OF_SIZE[size]}",
                  "The best seed; course and working rate are the truck's, all its trips together.",
                  "\n".join(tables.trips_table(
                      [trip for trip in shown if trip.customers == size]))]
    for size in findings.sizes_of(hours):
        parts += [f"## Mean total cost of {size} customers, by capacity and hours",
                  "\n".join(tables.hours_table(hours, size))]
    parts += ["## Drones, windows: what is driven, flown and worked",
              "\n".join(tables.drones_work_table(drones))]
    return "\n\n".join(parts) + "\n"
