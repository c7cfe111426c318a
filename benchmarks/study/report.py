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
from benchmarks.study.tables import markdown
from benchmarks.study.tasks import Planned, TripRow

PLAN = "table1_plan.json"
"""File of the best plan of Table 1 that can be made again."""

SENTENCE_END = re.compile(r"(?<=[.?]) (?=[A-Z`])")
"""Where a line of text ends."""

CHOICES = (
    ("all", "places of other cases", "whole, each once, within Table 1's x and y"),
    ("all", "demands of other cases", "drawn from Table 1's of the same kind (DC, FC, TC)"),
    ("all", "first case", "taken from Table 1 itself, with 100 customers all of it"),
    ("2, 6", "cost", "1 per unit of length, for trucks and drones"),
    ("2, 6", "drones", "one on each truck, payload 10, no limit of endurance; no times"),
    ("6", "trucks", "of 400, as few as Table 1's tightness (97.5 %) allows"),
    ("3, 4", "who serves", "trucks alone, DC too: Tables 3 to 5 tell of no drones"),
    ("3, 4", "fixed cost of a truck of 100 / 110 / 150 / 200", "10 / 11 / 15 / 20"),
    ("3, 4", "cost per km of the same", "0.9 / 0.92 / 1.0 / 1.1"),
    ("3, 4", "speed", "30 km/h, no service or reloading: 8 h are 240 km, 4 h 120 km"),
    ("3, 4", "trips", "up to 3 a truck; trucks as many as wanted"),
    ("3", "hours", "8"),
    ("5", "trucks", "of 400, twice as many as the load needs and 2; shift 6:00 to 18:00"),
    ("5", "cost", "50 a truck, 1 per km, 20 per hour of work; drones 0.25 per km"),
    ("5", "drones", "payload 10, 60 km/h, endurance 30 min, 1 min each to launch and recover"),
    ("5", "service", "5 min, by truck or drone; DC customers may be served by trucks too"),
    ("5", "windows", "80 % of the customers, 1, 2 or 4 h; soft: lateness costs 30 an hour"),
    ("5", "speeds", "40 km/h; by time of day: 25 km/h from 7:00 to 9:00 and 16:00 to 18:00"),
)
"""Section, input, value: what the paper doesn't give."""

HEAD = """\
# The paper's study, made again

"Research on unmanned delivery path optimization strategy based on reinforcement learning in
intelligent logistics system" (2025) plans a hundred customers by trucks with drones, compares
fleets, and varies working hours and capacity. Here its experiments are planned by Tandem, beside
what it prints. `make study` makes this report, its pictures and CSVs (in `study/`) anew."""


@dataclass(frozen=True)
class Study:
    """All plans, and the trips of those that compare fleets."""

    rows: list[Planned]
    trips: list[TripRow]

    def of(self, section: str) -> list[Planned]:
        """Return the plans of a section."""
        return [row for row in self.rows if row.section == section]


def write_report(study: Study, page: Path) -> None:
    """Write the page, and the pictures and what was recomputed beside the CSVs."""
    folder = page.with_suffix("")
    folder.mkdir(parents=True, exist_ok=True)
    plan = json.loads((folder / PLAN).read_text("utf-8"))
    _draw(study, plan, folder)
    recomputed = folder / "table2.csv"
    recomputed.unlink(missing_ok=True)
    append_rows(recomputed, GroupRow, map(measured, groups()))
    parts = [HEAD, _made(study), _inputs(), _table1(), _routes(study, plan), _fleets(study),
             _hours(study), _drones(study), _policies(study), _files()]
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
        f"Made on {dates}, {'; '.join(sorted({row.machine for row in rows}))}, beside other work: "
        f"{len(rows):,} plans in {sum(row.cpu_s for row in rows) / 60:.1f} minutes of processor "
        "time, one thread each. Tandem's checker, which shares no code with search or policies, "
        f"judged all {len(rows):,} and found no rule broken. All end after so many turns of the "
        "search, or have none: the same version makes the same plans again. What a time limit "
        "brings stands in [benchmarks.md](benchmarks.md).")


def _inputs() -> str:
    return "\n".join([
        "## What the paper doesn't give", "",
        "Table 1 has places, demands and who may serve whom. Everything else is a choice of ours:",
        "", *markdown(["section", "input", "value"], CHOICES, words=3)])


def _table1() -> str:
    return """\
## 1. Table 1 and its windows

A depot and 100 customers with a demand of 1560 in all: 10 for drones only (DC), 10 for trucks only
(TC), 80 for either (FC). Four trucks of 400 hold 1600, so 97.5 % of all capacity is needed.

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
        *tables.turns_table(rows), "",
        "![Cost of Table 1 over turns](study/turns.svg)", "",
        "The best of the plans that can be made again, as Table 2 prints routes (length in km, "
        f"`study/{PLAN}`):", "", *tables.paths_table(plan), "",
        "### The printed plan is infeasible", "",
        "Recomputed from Table 1, with straight lines:", "",
        *tables.printed_table([measured(group) for group in table1]), "",
        f"Of its {flights} flights, {flights - stated} can't be stated as a plan: they begin or "
        "end where their truck never halts. Without these, the checker finds "
        f"{sum(counted.values())} broken rules: "
        f"{', '.join(f'{count} {code}' for code, count in counted.most_common())}. With all "
        f"flights counted, {sum(not times for times in seen.values())} customers are never "
        f"visited and {sum(times > 1 for times in seen.values())} more than once, and customer 91 "
        "(trucks only, demand 31) is flown. Its demands add up to 1574 of 1560, no load "
        "rate is demand over 400, and its routes alone are "
        f"{sum(measured(group).truck_length for group in table1):.0f} long, more than the "
        "2135 that it is said to cost.", "",
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
    shown = findings.shown_trips(rows, trips)
    parts = []
    for size in sorted({row.customers for row in rows}):
        parts += [f"Case 1 of {size} customers, the best seed (as Table "
                  f"{findings.TABLE_OF_SIZE[size]}; course and working rate are the "
                  "truck's, all its trips together):", "",
                  *tables.trips_table([trip for trip in shown if trip.customers == size]), ""]
    return "\n".join([
        "## 3. Single and mixed fleets", "",
        "Trucks of 150 against as many as wanted of 100, 150 and 200, and of 100 or 200 alone. "
        f"Means over {_num_cases(rows)} and {max(row.seed for row in rows)} seeds, ± the standard "
        "deviation of the seeds' means; the working rate is that of each truck, over 8 h.", "",
        *tables.fleets_table(rows, trips), "", *findings.on_fleets(rows, trips), "",
        "![Total cost of each fleet, and the load of every trip](study/fleets.svg)", "",
        "The best seeds against each other, ± the standard deviation over cases:", "",
        *tables.against_table(rows), "", *findings.on_search(rows), "", *parts,
        "![Loads of these trips within their capacities](study/trips.svg)", "",
        "The paper prints, and its own demands and capacities make:", "",
        *tables.printed_fleets_table(), "",
        "Both columns of one case differ in total demand there, so that costs can't be compared; "
        "the total it gives is that of one fleet only."])


def _hours(study: Study) -> str:
    rows = study.of("hours")
    parts = []
    for size in sorted({row.customers for row in rows}):
        parts += [f"{size} customers:", "", *tables.hours_table(rows, size), ""]
    return "\n".join([
        "## 4. Working hours and capacity", "",
        f"One capacity at a time; mean total cost of {_num_cases(rows)}, one seed, the least in "
        "bold.", "",
        *parts, "![Mean total cost over hours and capacity](study/hours.svg)", "",
        *findings.on_hours(rows, study.trips)])


def _drones(study: Study) -> str:
    rows = study.of("drones")
    return "\n".join([
        "## 5. Drones, windows, speeds", "",
        "Total cost in % of trucks alone without windows at fixed speed, mean of "
        f"{_num_cases(rows)} ± their standard deviation. Columns are windows and speeds.", "",
        *tables.drones_table(rows), "", *findings.on_drones(rows), "",
        "![Total cost by drones, windows and speeds](study/drones.svg)", "",
        "Both speeds together:", "", *tables.drones_work_table(rows)])


def _policies(study: Study) -> str:
    rows = study.of("policies")
    return "\n".join([
        "## 6. Two policies", "",
        "`attention`, the default, beside `pointer`, the paper's: alone, and with a search that "
        "begins with their greedy plan or with nothing (insertion). One drone on each truck, "
        "distances only. Cost above the cheapest plan found of each case, mean ± standard "
        f"deviation over {_num_cases(rows)}, of plans that serve everybody. The service itself "
        "begins without a policy where each truck has one drone and there are 30 customers or "
        "more.", "",
        *tables.policies_table(rows), "", *findings.on_policies(rows), "",
        "![Cost of each way to plan](study/policies.svg)"])


def _files() -> str:
    return """\
## Files

`study/table1.csv`, `fleets.csv`, `hours.csv`, `drones.csv` and `policies.csv` have a row for each
plan with all that it depends on, its cost by term and the seconds it took; `trips.csv` a row for
each trip of section 3; `table2.csv` the printed plan recomputed."""
