"""Has far more customers planned than fleets can take: `python -m benchmarks.fuzz.crowds`.

Wild and mixed requests with ten to fifty times as many customers, most of whom are left out turn
after turn, so that searches hold all that their rows have room for. Plans are checked and planned
on from as those of `benchmarks.fuzz.problems`.
"""

import random
from typing import Annotated, Any

import typer

from benchmarks.fuzz.mixed_places import add_launch_sites
from benchmarks.fuzz.mixed_problems import mixed_request
from benchmarks.fuzz.problems import Study, tried
from benchmarks.fuzz.wild_problems import wild_request

Data = dict[str, Any]

FEWEST, MOST = 80, 500
"""Customers."""

LEAST_CROWD, DENSEST_CROWD = 10, 50
"""How many times as many customers as a fleet can take."""

MIXED, LAUNCHING = 0.6, 0.8
"""Shares of requests that make sense but for the crowd; of these that have launch sites."""

WITH_TABLES = 120
"""Customers up to whom legs may be stated: tables of more are megabytes."""


def crowded_request(rng: random.Random) -> Data:
    """Return a request, drawn from the generator passed."""
    number = rng.randint(FEWEST, MOST)
    if rng.random() < MIXED:
        request = mixed_request(rng, number, tables=number <= WITH_TABLES)
        if "launch_sites" not in request and "matrices" not in request and (
                rng.random() < LAUNCHING):
            add_launch_sites(rng, request)
    else:
        request = wild_request(rng, number, tables=number <= WITH_TABLES)
    _mend(request)
    _leave_few_vehicles(rng, request)
    request["options"] |= {"time_limit": rng.choice((0.05, 0.1, 0.3)), "search_iterations": None}
    return request


def _mend(request: Data) -> None:
    """Take out what is wrong of few customers, but of nearly all crowds. In place."""
    request.get("fairness", {}).pop("min_vehicles", None)
    for customer in request["customers"]:
        for name in {"demand", "pickup"} & customer.keys():
            customer[name] = [min(1000, round(amount)) for amount in customer[name]]
        for place in (customer, *customer.get("alternatives", ())):
            windows = place.get("time_windows") or [place.get("time_window", {})]
            times = [time for window in windows
                     for time in (window.get("earliest", 0), window.get("latest"))
                     if time is not None]
            if times != sorted(times):
                place.pop("time_windows", None)
                place.pop("time_window", None)


def _leave_few_vehicles(rng: random.Random, request: Data) -> None:
    """Let a fleet take so few of the customers. In place."""
    served = max(1, len(request["customers"]) // rng.randint(LEAST_CROWD, DENSEST_CROWD))
    kinds = request["fleet"]
    asked = [sum(customer["demand"][entry] for customer in request["customers"])
             / len(request["customers"]) for entry in range(len(kinds[0]["capacity"]))]
    for kind in kinds:
        kind["count"] = rng.choice((1, 1, 2, 3))
        vehicles = len(kinds) * kind["count"] * min(kind.get("max_trips", 1), 3)
        each = max(1, -(-served // vehicles))
        kind["capacity"] = [min(1e9, max(1.0, round(each * amount, 3))) for amount in asked]


class CrowdStudy(Study):
    """What came of crowds."""

    def try_problem(self, seed: int) -> None:
        """Have one crowd planned, checked and planned on. In place."""
        rng = random.Random(seed)
        self.go_on(rng, crowded_request(rng))


def main(
    problems: Annotated[int, typer.Option(help="Problems to send.")] = 3000,
    seed: Annotated[int, typer.Option(help="Seed of the first; later ones count on.")] = 0,
) -> None:
    """Fuzz plans of crowds."""
    study, faults = tried(CrowdStudy, range(seed, seed + problems), CrowdStudy.try_problem)
    typer.echo(f"{problems} crowds, {faults} faults; {study.checked} plans checked, "
               f"{study.replanned} planned on from; longest reply {study.longest:.2f} s; "
               f"{dict(sorted(study.statuses.items()))}")
    raise typer.Exit(1 if faults else 0)


if __name__ == "__main__":
    typer.run(main)
