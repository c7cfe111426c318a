"""Public sets whose instances have rules that few solvers know, as their READMEs state them.

Several depots, working durations, customers only some vehicles may serve or nobody need serve,
several windows, amounts to deliver and to pick up, routes that end with their last customer.
`python -m benchmarks.peers.rule_sets` judges the best known plans.
"""

import math
from dataclasses import dataclass, replace
from itertools import groupby
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from numpy.typing import ArrayLike
from vrplib import read_instance  # type: ignore[import-untyped]

from app.requests.conversion.rounding import rounded
from benchmarks.peers.answers import judge, stated_cost
from benchmarks.peers.published import (
    NO_LIMIT, Convention, Gaps, Published, PublishedVehicle, best_known_beside, read_routes,
    routes_of_types, to_problem,
)
from model.problem import FloatArray, IntArray

Fields = dict[str, Any]

MOST_VEHICLES = 25
"""Of the instances with several windows, as their reference was found."""


@dataclass(frozen=True)
class RuleSet:
    """How a set counts and what its files don't say."""

    convention: Convention
    suffix: str = ".vrp"
    fleet_is_free: bool = False  # VEHICLES is no bound
    is_open: bool = False
    pickups_last: bool = False
    reference: str = "best_known"  # column of its table


_THOUSANDTHS = Convention(scale=1000, rounding="exact", divisor=1000)

RULE_SETS = {
    "mdvrptw": RuleSet(_THOUSANDTHS),
    "sdvrptw": RuleSet(_THOUSANDTHS),
    "pcvrptw": RuleSet(Convention(scale=10, rounding="dimacs", divisor=10)),
    "vrpmtw": RuleSet(_THOUSANDTHS, ".txt", reference="own_reference"),
    "ovrp": RuleSet(_THOUSANDTHS, is_open=True),
    "vrpb": RuleSet(Convention(scale=1, rounding="round", divisor=1), fleet_is_free=True,
                    pickups_last=True),
    "vrpspd": RuleSet(Convention(scale=10_000, rounding="exact", divisor=10_000), ".vrpspd",
                      fleet_is_free=True),
}
"""By folder name."""

def rule_set(data: Path, set_name: str) -> list[Published]:
    """Return all instances of a set, sorted by name.

    Raises
    ------
    ValueError
        If it has no files, or a file holds no instance as its set has them.
    """
    paths = sorted((data / set_name).glob(f"*{RULE_SETS[set_name].suffix}"))
    if not paths:
        raise ValueError(f"set: {set_name!r} has no files in {data}")
    return [read_rule_instance(path, set_name) for path in paths]


def read_rule_instance(path: Path, set_name: str) -> Published:
    """Return an instance; its best known cost is from the table beside it."""
    rules = RULE_SETS[set_name]
    read = _read_windows_file(path, rules) if path.suffix == ".txt" else _read_vrplib(path, rules)
    return replace(read, set_name=set_name, best_known=best_known_beside(path, rules.reference))


def _units(values: ArrayLike, scale: int) -> IntArray:
    return np.rint(np.asarray(values, np.float64) * scale).astype(np.int64)


def _travel(coordinates: FloatArray, convention: Convention) -> IntArray:
    x, y = coordinates.T
    straight = np.sqrt((x[:, None] - x) ** 2 + (y[:, None] - y) ** 2)
    return _units(rounded(straight, convention.rounding), convention.scale)


def _read_vrplib(path: Path, rules: RuleSet) -> Published:
    fields: Fields = read_instance(path, compute_edge_weights=False)
    size, scale = fields["dimension"], rules.convention.scale
    num_depots = np.size(fields.get("depot", 0))
    if np.ravel(fields.get("depot", 0)).tolist() != list(range(num_depots)):
        raise ValueError(f"{path}: depots come first")
    coordinates = np.asarray(fields.get("node_coord", np.zeros((size, 2))), np.float64)
    # Where all legs are stated, they are in the set's unit.
    travel = (np.asarray(fields["edge_weight"], np.int64) if "edge_weight" in fields
              else _travel(coordinates, rules.convention))
    service = np.broadcast_to(_units(fields.get("service_time", 0), scale), size).copy()
    service[:num_depots] = 0
    windows = fields.get("time_window")
    read = Published(
        path.stem, "", coordinates, _delivered(fields, size),
        earliest=np.zeros(size, np.int64) if windows is None else _units(windows[:, 0], scale),
        latest=np.full(size, NO_LIMIT) if windows is None else _units(windows[:, 1], scale),
        service=service, release=np.zeros(size, np.int64), travel=travel,
        vehicles=_vehicles(fields, rules, size - num_depots), max_trips=1,
        has_windows=windows is not None, divisor=rules.convention.divisor, best_known=math.nan,
        num_depots=num_depots,
        prize=_units(fields["prize"], scale) if "prize" in fields else None,
        pickup=_picked_up(fields), pickups_last=rules.pickups_last)
    return _open_ended(read) if rules.is_open else read


def _open_ended(instance: Published) -> Published:
    """Return an instance whose routes end at one more depot, to which no leg takes anything."""
    at = instance.num_depots

    def widened(values: IntArray) -> IntArray:
        return np.insert(values, at, values[0])

    return replace(
        instance, is_open=True, num_depots=at + 1,
        coordinates=np.insert(instance.coordinates, at, instance.coordinates[0], axis=0),
        demand=widened(instance.demand), earliest=widened(instance.earliest),
        latest=widened(instance.latest), service=widened(instance.service),
        release=widened(instance.release),
        travel=np.insert(np.insert(instance.travel, at, 0, axis=0), at, 0, axis=1))


def _delivered(fields: Fields, size: int) -> IntArray:
    if "pickup_and_delivery" in fields:
        return _units(np.asarray(fields["pickup_and_delivery"])[:, 5], 1)
    return _units(np.broadcast_to(fields["demand"], size), 1)


def _picked_up(fields: Fields) -> IntArray | None:
    if "pickup_and_delivery" in fields:
        return _units(np.asarray(fields["pickup_and_delivery"])[:, 4], 1)
    return _units(fields["backhaul"], 1) if "backhaul" in fields else None


def _vehicles(fields: Fields, rules: RuleSet, num_customers: int) -> tuple[PublishedVehicle, ...]:
    """Return the types, equal vehicles that follow one another being one."""
    scale = rules.convention.scale
    count = num_customers if rules.fleet_is_free else fields["vehicles"]
    longest = fields.get("vehicles_max_duration", fields.get("distance", 0))
    homes = np.broadcast_to(fields.get("vehicles_depot", 1), count) - 1
    capacities = np.broadcast_to(_units(fields["capacity"], 1), count).tolist()
    tables = fields.get("vehicles_allowed_clients")
    served = [None] * count if tables is None else [
        tuple(int(node) - 1 for node in row) for row in tables]
    return tuple([
        PublishedVehicle(len(list(group)), capacity, 0, 1, home,
                         _units(longest, scale).item() if longest else None, serves)
        for (home, capacity, serves), group in groupby(
            zip(homes.tolist(), capacities, served, strict=True))])


def _read_windows_file(path: Path, rules: RuleSet) -> Published:
    """Return an instance of Belhaiza et al., whose customers have several windows each."""
    head, (_, capacity, *_), depot, *rows = [
        [float(word) for word in line.split()]
        for line in path.read_text(encoding="utf-8").splitlines() if line.strip()]
    if len(rows) != head[2]:
        raise ValueError(f"{path}: {len(rows)} customers, not {head[2]:g}")
    scale = rules.convention.scale
    nodes = np.array([depot[:5], *(row[:5] for row in rows)])
    # Behind how many there are; the depot's has no such number before it.
    windows = [_units(np.reshape(words, (-1, 2)), scale)
               for words in (depot[7:], *(row[8:8 + 2 * int(row[7])] for row in rows))]
    return Published(
        path.stem, "", nodes[:, 1:3], _units(nodes[:, 4], 1),
        earliest=np.array([each[0, 0] for each in windows]),
        latest=np.array([each[-1, 1] for each in windows]), service=_units(nodes[:, 3], scale),
        release=np.zeros(len(nodes), np.int64), travel=_travel(nodes[:, 1:3], rules.convention),
        vehicles=(PublishedVehicle(MOST_VEHICLES, int(capacity), 0, 1),), max_trips=1,
        has_windows=True, divisor=rules.convention.divisor, best_known=math.nan,
        gaps=tuple([_gaps(each) for each in windows]))


def _gaps(windows: IntArray) -> Gaps:
    return tuple(zip(windows[:-1, 1].tolist(), windows[1:, 0].tolist(), strict=True))


def main(
    data: Annotated[Path, typer.Option(help="folder of the published sets")]
    = Path("../shared/data"),
    sets: Annotated[str, typer.Option(help="comma-separated")] = ",".join(RULE_SETS),
) -> None:
    """Judge the best known plans: each must keep all rules, at the cost that is stated."""
    wrong = 0
    for set_name in sets.split(","):
        for instance in rule_set(data, set_name):
            plan = read_routes(data / set_name / f"{instance.name}.sol")
            routes = routes_of_types(instance, plan)
            verdict, stated = judge(to_problem(instance), routes), stated_cost(instance, routes)
            # Sums of exact lengths differ from those of rounded legs by half a unit each.
            most = 0.5 * len(instance.demand) / instance.divisor
            right = (verdict.counts and math.isclose(verdict.cost, stated, rel_tol=1e-9)
                     and abs(stated - instance.best_known) <= most)
            wrong += not right
            typer.echo(f"{set_name} {instance.name}: {'right' if right else 'WRONG'}, judged "
                       f"{verdict.cost:.4f}, counted {stated:.4f}, best known "
                       f"{instance.best_known:.4f}{'' if verdict.counts else ', breaks rules'}")
    raise typer.Exit(1 if wrong else 0)


if __name__ == "__main__":
    typer.run(main)
