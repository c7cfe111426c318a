"""The planner's problem means what the request does: the same costs, the same rules."""

import json
import random
from typing import Any

import pytest

from app.formats.vroom.places import find_places
from app.formats.vroom.schemas import VroomRequest
from app.formats.vroom.translate import translate
from app.schemas.limits import MAX_LEGS
from model.dialects.vroom.checking import route_faults
from model.dialects.vroom.convert import Converter
from model.dialects.vroom.errors import RefusedError, TooLargeError
from model.dialects.vroom.models import Model, Routes
from model.dialects.vroom.places import Sites
from model.dialects.vroom.timing import COST_SCALE, RouteTimer
from model.dialects.vroom.work import LegLimit
from model.judge.check import check
from tests.app.formats.vroom.sampling import sample_request
from tests.seeds import seeds

Data = dict[str, Any]


class Case:
    """A request with its model."""

    def __init__(self, request: Data, max_legs: int = MAX_LEGS) -> None:
        stated = VroomRequest.model_validate_json(json.dumps(request))
        self.request = translate(stated)
        self.places: Sites = find_places(stated, {"car": 36.0})
        self.converter = Converter(self.request, self.places, LegLimit(max_legs, "MOST"))
        self.model: Model = self.converter.model(range(len(self.request.jobs)))

    def vehicle(self, kind: int) -> int:
        return self.converter.kinds[kind].vehicles[0]

    def keeps_rules(self, routes: Routes) -> bool:
        return not any(
            list(route_faults(self.request, self.places, self.vehicle(kind), jobs))
            for kind, its_routes in routes.items() for jobs in its_routes)

    def cost(self, routes: Routes) -> float:
        timed = [RouteTimer(self.request, self.places, self.vehicle(kind)).drive(jobs)
                 for kind, its_routes in routes.items() for jobs in its_routes]
        return sum(route.cost for route in timed if route is not None) / COST_SCALE


def draw_routes(draw: random.Random, case: Case) -> Routes:
    jobs = list(range(len(case.request.jobs)))
    draw.shuffle(jobs)
    routes: dict[int, list[list[int]]] = {}
    for index, kind in enumerate(case.converter.kinds):
        for _ in kind.vehicles:
            taken = [jobs.pop() for _ in range(min(len(jobs), draw.randint(0, 3)))]
            if taken:
                routes.setdefault(index, []).append(taken)
    return routes


@pytest.mark.thorough_after(20)
@pytest.mark.parametrize("seed", seeds(300))
def test_plans_that_pass_the_planners_check_keep_vrooms_rules_at_vrooms_cost(seed: int) -> None:
    draw = random.Random(seed)
    case = Case(sample_request(draw))
    for _ in range(10):
        routes = draw_routes(draw, case)
        solution = case.model.solution(routes)
        evaluation = check(case.model.problem, solution)
        if evaluation.violations:
            continue
        assert case.keeps_rules(routes)
        assert case.model.routes(solution) == routes
        cost = evaluation.cost.total - evaluation.cost.unassigned
        assert cost == pytest.approx(case.cost(routes), abs=0.01)


@pytest.mark.thorough_after(20)
@pytest.mark.parametrize("seed", seeds(300))
def test_plans_that_keep_vrooms_rules_pass_the_planners_check(seed: int) -> None:
    draw = random.Random(seed)
    request = sample_request(draw)
    ends = [each[kind] for each in request.get("shipments", ()) for kind in ("pickup", "delivery")]
    for job in [*request["jobs"], *ends]:
        if "time_windows" in job:
            job.pop("setup", None)
            job.pop("setup_per_type", None)
    for vehicle in request["vehicles"]:
        for each in vehicle.get("breaks", ()):
            del each["time_windows"][1:]
    case = Case(request)
    for _ in range(10):
        routes = draw_routes(draw, case)
        if case.keeps_rules(routes):
            assert check(case.model.problem, case.model.solution(routes)).violations == ()


@pytest.fixture
def street() -> Data:
    """Return four jobs and two vehicles on a street, 100 s and 1,000 m from place to place."""
    seconds = [[100 * abs(i - j) for j in range(5)] for i in range(5)]
    metres = [[10 * second for second in row] for row in seconds]
    return {"vehicles": [{"id": 1, "start_index": 0, "end_index": 0},
                         {"id": 2, "start_index": 0, "end_index": 0}],
            "jobs": [{"id": number, "location_index": number} for number in range(1, 5)],
            "matrices": {"car": {"durations": seconds, "distances": metres}}}


def test_vehicles_that_are_alike_are_one_type(street: Data) -> None:
    (kind,) = Case(street).converter.kinds
    assert kind.vehicles == (0, 1)
    street["vehicles"][1]["max_tasks"] = 3
    assert len(Case(street).converter.kinds) == 2


def test_vehicles_that_differ_only_by_cost_share_their_matrices(street: Data) -> None:
    street["vehicles"][1]["costs"] = {"per_hour": 7200}
    assert len(Case(street).model.problem.travel) == 1


def test_limits_that_cant_be_exceeded_are_left_out(street: Data) -> None:
    street["vehicles"][0] |= {"max_distance": 100_000, "max_travel_time": 10_000}
    assert all(kind.max_trip_distance is None for kind in Case(street).model.problem.vehicle_types)


def test_both_limits_are_kept_where_hours_cost(street: Data) -> None:
    street["vehicles"][0] |= {"max_distance": 5000, "max_travel_time": 700}
    street["vehicles"][0]["time_window"] = [0, 5000]
    model = Case(street).model
    kind = model.problem.vehicle_types[0]
    assert (kind.max_trip_distance, kind.limited, kind.max_distance) == (700_000, 1, 5_000_000)


def test_amounts_that_cant_fill_a_vehicle_are_no_dimension(street: Data) -> None:
    for vehicle in street["vehicles"]:
        vehicle["capacity"] = [10, 10, 3, 10]
    for job in street["jobs"]:
        job |= {"delivery": [1, 1, 1, 0], "pickup": [1, 1, 0, 0]}
    problem = Case(street).model.problem
    assert [kind.capacity for kind in problem.vehicle_types] == [(3,)]


def test_amounts_are_brought_or_taken(street: Data) -> None:
    for vehicle in street["vehicles"]:
        vehicle["capacity"] = [2, 3]
    street["jobs"][0] |= {"delivery": [2, 1], "pickup": [1, 2]}
    street["jobs"][1]["pickup"] = [1, 3]
    model = Case(street).model
    assert [(each.demand, each.pickup) for each in model.problem.customers[:3]] == [
        ((2, 1), (1, 2)), ((0, 0), (1, 3)), ((0, 0), ())]


def test_setup_and_service_are_as_long_as_the_type_of_vehicle_says(street: Data) -> None:
    for vehicle, name in zip(street["vehicles"], "ab", strict=True):
        vehicle |= {"type": name, "time_window": [0, 1000]}
    street["jobs"][1]["location_index"] = 1
    for job in street["jobs"]:
        job |= {"setup": 40, "service": 5, "setup_per_type": {"b": 60}}
    street["jobs"][3]["service_per_type"] = {"a": 7}
    problem = Case(street).model.problem
    first, second = problem.vehicle_types
    # Two jobs share a place, so that one of them needs no setup; the others' is service.
    assert [each.setup_duration for each in problem.customers] == [40_000, 40_000, 0, 0]
    assert [first.service_at(each) for each in problem.customers] == [5000, 5000, 45_000, 47_000]
    assert [second.service_at(each) for each in problem.customers] == [5000, 5000, 65_000, 65_000]
    legs = [problem.travel[kind.travel].duration for kind in (first, second)]
    assert legs[1][0, 1] == legs[0][0, 1] + 20_000 == 120_000
    assert legs[1][2, 1] == legs[0][2, 1] == 0


def test_more_binding_amounts_than_dimensions_are_refused(street: Data) -> None:
    for vehicle in street["vehicles"]:
        vehicle["capacity"] = [3] * 9
    for job in street["jobs"]:
        job["delivery"] = [1] * 9
    with pytest.raises(RefusedError, match="9 amounts may fill a vehicle"):
        Case(street)


def test_distance_limit_without_distances_is_refused(street: Data) -> None:
    del street["matrices"]["car"]["distances"]
    street["vehicles"][1]["max_distance"] = 100
    with pytest.raises(RefusedError, match=r"max_distance of vehicle 2 needs matrices\.car"):
        Case(street)


def test_jobs_out_of_reach_are_not_servable(street: Data) -> None:
    street["jobs"][0]["skills"] = [7]
    street["jobs"][1]["time_windows"] = [[0, 50], [1000, 2000]]
    for vehicle in street["vehicles"]:
        vehicle |= {"time_window": [200, 1500], "capacity": [2]}
    street["jobs"][2]["delivery"] = [3]
    assert Case(street).model.servable() == [1, 3]


def test_timestamps_are_as_good_as_seconds_from_now(street: Data) -> None:
    street["jobs"][0]["time_windows"] = [[1_700_000_100, 1_700_000_200]]
    model = Case(street).model
    assert model.problem.customers[0].latest - model.problem.customers[0].earliest == 100_000
    street["vehicles"][0]["time_window"] = street["vehicles"][1]["time_window"] = [
        1_700_000_000, 1_700_001_000]
    assert Case(street).model.problem.customers[0].earliest == 100_000


def test_windows_generations_apart_are_refused(street: Data) -> None:
    street["jobs"][0]["time_windows"] = [[0, 100]]
    street["jobs"][1]["time_windows"] = [[2_000_000_000, 2_000_000_100]]
    with pytest.raises(RefusedError, match="31 years"):
        Case(street)


def test_a_job_is_one_customer_whatever_its_windows(street: Data) -> None:
    street["jobs"][0]["time_windows"] = [[300, 400], [50, 60], [100, 100]]
    street["vehicles"][0]["time_window"] = street["vehicles"][1]["time_window"] = [80, 5000]
    first, *others = Case(street).model.problem.customers
    assert len(others) == 3
    assert (first.earliest, first.gaps, first.latest) == (20_000, ((20_000, 220_000),), 320_000)


def test_too_many_jobs_are_too_large(street: Data) -> None:
    street["jobs"] = [{"id": number, "location_index": 1} for number in range(40)]
    with pytest.raises(TooLargeError, match=r"41.*40 \(MOST\)"):
        Case(street, max_legs=41**2 - 1)


def test_too_many_unlike_vehicles_are_too_large(street: Data) -> None:
    nodes = len(Case(street).model.problem.coordinates)
    (one,) = Case(street, max_legs=nodes**2).model.problem.travel
    assert one.duration[:].size == nodes**2
    street["jobs"][0]["time_windows"] = [[0, 1000]]
    street["vehicles"][1]["speed_factor"] = 2.0
    assert len(Case(street, max_legs=2 * nodes**2).model.problem.travel) == 2
    with pytest.raises(TooLargeError, match="unlike each other"):
        Case(street, max_legs=2 * nodes**2 - 1)
