"""Has problems that mix all rules planned and judged: `python -m benchmarks.fuzz.mixed`.

Requests that are refused aren't counted. Each other is planned, its plan checked by `POST /check`
and by what can be read from the reply alone, and half of the days go on as wild ones do. What came
of each stands in a file, and the next run goes on from there.
"""

import json
import random
import tempfile
import time
from collections import Counter
from dataclasses import asdict, dataclass
from itertools import chain
from pathlib import Path
from typing import Annotated, Any

import httpx
import typer

from benchmarks.fuzz.api import service
from benchmarks.fuzz.mixed_problems import mixed_request, stated_in
from benchmarks.fuzz.plain_facts import faults_of, met_in
from benchmarks.fuzz.problems import Fault, Study, client_of

Data = dict[str, Any]


@dataclass(frozen=True)
class Outcome:
    """What came of one problem."""

    seed: int
    is_refused: bool = False
    stated: tuple[str, ...] = ()  # rules of a day
    met: tuple[str, ...] = ()  # those of them that show in the plan
    orders: int = 0
    served: int = 0
    fault: str | None = None


class MixedStudy(Study):
    """What came of mixed problems."""

    plan: Data | None = None  # of the problem at hand, before its day goes on

    def planned(self, request: Data) -> Data | None:
        """Return the plan of a request, found sound; None if it is refused. In place."""
        plan = super().planned(request)
        if plan is not None and "replan" not in request:
            self.plan = plan
            for fault in faults_of(request, plan):
                raise Fault(fault)
        return plan

    def outcome_of(self, seed: int) -> Outcome:
        """Return what came of a seed's problem. In place."""
        rng = random.Random(seed)
        request, self.plan, fault = mixed_request(rng), None, None
        try:
            self.go_on(rng, request)
        except (Fault, httpx.TransportError) as found:
            fault = f"{type(found).__name__}: {found}"
        if self.plan is None:
            return Outcome(seed, is_refused=fault is None, fault=fault)
        summary, stated = self.plan["summary"], stated_in(request)
        return Outcome(seed, False, tuple(sorted(stated)),
                       tuple(sorted(met_in(request, self.plan) & stated)),
                       summary["customers"], summary["served"], fault)


def outcomes_in(log: Path) -> list[Outcome]:
    """Return what is known so far."""
    log.touch()
    return [Outcome(**json.loads(line)) for line in log.read_text("utf-8").splitlines()]


def go_on(log: Path, problems: int, first: int, seconds: float) -> None:
    """Try the seeds that come next until so many problems are planned, or the time is over."""
    known = outcomes_in(log)
    left = problems - sum(not each.is_refused for each in known)
    seed = max([each.seed + 1 for each in known], default=first)
    end = time.monotonic() + seconds
    with (tempfile.TemporaryDirectory() as name, service(Path(name)) as target,
          client_of(target) as client, log.open("a", encoding="utf-8") as file):
        study = MixedStudy(client)
        while left > 0 and time.monotonic() < end:
            outcome = study.outcome_of(seed)
            file.write(json.dumps(asdict(outcome)) + "\n")
            left -= not outcome.is_refused
            seed += 1


def told(outcomes: list[Outcome]) -> str:
    """Return what came of all problems, in lines."""
    planned = [each for each in outcomes if not each.is_refused]
    lines = [f"{len(planned)} problems planned, {len(outcomes) - len(planned)} refused; "
             f"{sum(each.served for each in planned)} of {sum(each.orders for each in planned)} "
             f"customers served",
             f"rules of a day stated: {_spread([each.stated for each in planned])}",
             f"rules of a day met: {_spread([each.met for each in planned])}",
             f"stated: {_counts([each.stated for each in planned])}",
             f"met: {_counts([each.met for each in planned])}"]
    faults = [each for each in outcomes if each.fault is not None]
    return "\n".join([*lines, *(f"seed {each.seed}: {each.fault}" for each in faults),
                      f"{len(faults)} faults"])


def _spread(names: list[tuple[str, ...]]) -> str:
    """Return how many problems have how many names."""
    counts = Counter(map(len, names))
    return ", ".join(f"{number}: {times}" for number, times in sorted(counts.items()))


def _counts(names: list[tuple[str, ...]]) -> str:
    return ", ".join(f"{name} {times}" for name, times in Counter(chain(*names)).most_common())


def main(
    problems: Annotated[int, typer.Option(help="Problems to plan; refused ones aren't counted.")]
    = 10_000,
    log: Annotated[Path, typer.Option(help="File of what came of each, to go on from.")]
    = Path("build/mixed.jsonl"),
    seed: Annotated[int, typer.Option(help="Seed of the first; later ones count on.")] = 0,
    seconds: Annotated[float, typer.Option(help="When to stop, to be gone on from.")] = 1e9,
) -> None:
    """Have mixed problems planned and judged."""
    go_on(log, problems, seed, seconds)
    outcomes = outcomes_in(log)
    typer.echo(told(outcomes))
    raise typer.Exit(1 if any(each.fault for each in outcomes) else 0)


if __name__ == "__main__":
    typer.run(main)
