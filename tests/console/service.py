"""Serves as `tandem serve` does, but what may be searched for a second is searched for a few turns.

Nearly all tests ask for such plans, few look at how good they are, and a search goes on when
whoever asked is gone. No example is searched for longer than a second here.
"""

import json
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from unittest.mock import patch

from app.cli.commands import main
from app.plans import explaining, fitting, task
from app.records.jobs import worker
from app.schemas import openapi
from model.planner import Planner, PlanOptions, PlanResult
from model.problem import Problem

SECOND = 1.0

TURNS, PATIENCE = 300, 30.0
"""What is made instead of a second's search, and the seconds that it may take: a busy machine comes
as far as an idle one, which takes a twentieth of a second for a hundred customers."""

POLLING = {"POLLING": 0.5, "STUDY_POLLING": 2.0, "PATIENT_POLLING": 10.0}
"""Seconds between looks into queues, most of which are empty in tests: looking at them as often as
others do takes a tenth of a core for as long as a service is there."""

plan_in_time = Planner.plan


def plan_hurriedly(planner: Planner, problem: Problem, options: PlanOptions, *given: Any,
                   **named: Any) -> PlanResult:
    """Plan a problem as `Planner.plan` does, or sooner."""
    if 0 < options.time_limit <= SECOND and options.search_iterations is None:
        options = replace(options, time_limit=PATIENCE, search_iterations=TURNS)
    return plan_in_time(planner, problem, options, *given, **named)


def hurry_examples(given: Path, folder: Path) -> None:
    """Write the examples to a folder, none of which is searched for longer than a second."""
    for path in given.glob("*.json"):
        request = json.loads(path.read_text("utf-8"))
        options = request.get("options") or {}
        if options.get("time_limit", 0) > SECOND:
            options["time_limit"] = SECOND
        (folder / path.name).write_text(json.dumps(request), "utf-8")


# Processes that plan import this module, too: they begin as the one does that serves.
for place, name, value in (
        (Planner, "plan", plan_hurriedly),
        # However busy the machine, replies say why somebody is left out and where one fits.
        (task, "EXPLAINING", PATIENCE), (explaining, "REASONS_SECONDS", PATIENCE),
        (fitting, "LEAST_TRYING", PATIENCE),
        *((worker, name, seconds) for name, seconds in POLLING.items())):
    setattr(place, name, value)

if __name__ == "__main__":
    with TemporaryDirectory() as examples:
        hurry_examples(openapi.EXAMPLES_DIR, Path(examples))
        with patch.object(openapi, "EXAMPLES_DIR", Path(examples)):
            main()
