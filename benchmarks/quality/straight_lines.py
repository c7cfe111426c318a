"""What straight lines promise and roads deliver, on the example of a city's day.

    tandem roads build examples/helsinki.osm.pbf --profile van
    tandem roads build examples/helsinki.osm.pbf --profile bicycle
    python -m benchmarks.quality.straight_lines

Plans with ten seconds of search, as the crow flies and on roads, and drives the first of these
plans on roads.
"""

import json
import time
from pathlib import Path

from app.maps.roads.opening import opened_roads
from app.plans.service import plan_options
from app.plans.task import Task, task_of
from app.requests.reading import read_request
from app.serving.settings import Settings
from model.judge.check import check
from model.judge.timing import RouteDecision, SortieDecision, TripDecision, schedule
from model.planner import Planner, PlanOptions, load_planner
from model.problem import MM_PER_KM, Problem
from model.solution import Route, Solution

EXAMPLES = Path(__file__).parents[2] / "examples"
EXTRACT = EXAMPLES / "helsinki.osm.pbf"
ROADS = f"van={EXTRACT},bicycle={EXTRACT}"

SEEDS = (0, 1, 2)
OPTIONS = {"time_limit": 10.0}

MS_PER_HOUR = 3_600_000


def main() -> None:
    """Print a line for each seed and way to plan."""
    settings = Settings(roads=ROADS)
    planner = load_planner(settings.weights_dir, settings.policies)
    stated = json.loads((EXAMPLES / "city_day.json").read_text("utf-8"))
    with opened_roads(settings) as roads:
        roads.start()
        for seed in SEEDS:
            body = json.dumps(stated | {"options": OPTIONS | {"seed": seed}}).encode()
            request = read_request(body, planner.policies)
            options = plan_options(request.options)
            straight, driven = task_of(request), task_of(request, roads=roads)
            promised = planned(planner, straight, options)
            tell(f"{seed} promised", straight.problem, promised)
            tell(f"{seed} delivered", driven.problem, driven_anew(driven.problem, promised))
            tell(f"{seed} on roads", driven.problem, planned(planner, driven, options))


def planned(planner: Planner, task: Task, options: PlanOptions) -> Solution:
    """Return a plan."""
    return task.plan(planner, options, time.perf_counter()).solution


def driven_anew(problem: Problem, plan: Solution) -> Solution:
    """Return a plan with the times that it has by the legs of another problem."""
    return Solution(tuple(schedule(problem, decided(route)) for route in plan.routes),
                    plan.unassigned)


def decided(route: Route) -> RouteDecision:
    """Return who goes where in a route, without its times."""
    trips = tuple(
        TripDecision(tuple(stop.node for stop in trip.stops), tuple(
            SortieDecision(tuple(visit.node for visit in sortie.visits), sortie.launch_stop,
                           sortie.recovery_stop, sortie.drone) for sortie in trip.sorties))
        for trip in route.trips)
    return RouteDecision(route.vehicle_type, route.vehicle, trips)


def tell(name: str, problem: Problem, plan: Solution) -> None:
    """Print what a plan costs and takes, and which rules it breaks."""
    evaluation = check(problem, plan)
    driven = sum(trip.distance for route in evaluation.routes for trip in route.trips)
    worked = sum(route.working_duration for route in evaluation.routes)
    broken = ", ".join(violation.code for violation in evaluation.violations) or "none"
    print(f"{name}: cost {evaluation.cost.total:.1f}, lateness {evaluation.cost.lateness:.1f}, "
          f"{driven / MM_PER_KM:.1f} km, {worked / MS_PER_HOUR:.2f} h, broken: {broken}")


if __name__ == "__main__":
    main()
