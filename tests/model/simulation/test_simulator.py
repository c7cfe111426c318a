"""Tests of the decision process: legal plans, an exact mask."""

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import astuple, dataclass, field, replace

import numpy as np
import pytest

from model.judge.check import check
from model.engine.instance import pack
from model.problem import UNLIMITED, Customer, Depot, DroneType, Problem, Travel, VehicleType
from model.simulation.actions import (
    DRIVE, LAUNCH, NUM_KINDS, OPEN, RETURN, apply, encode_action, reset,
)
from model.policy.extract import extract
from model.solution import Route
from tests.model.mask_oracle import MINUTE, Vehicle, after, judge, legal_codes
from tests.model.rollouts import choose, legal, random_problems, roll
from tests.model.fliers import from_few_batteries, with_fliers, without_taken
from tests.model.permits import (
    fliers_in_closed_zones, with_closings, with_few_airborne, with_ranges, with_storms,
)
from tests.model.tiny import (
    draw_tiny, with_beginnings, with_charging, with_dimensions, with_drone_types, with_drones,
    with_duty, with_energy, with_gaps, with_goods, with_limits_aboard, with_open_ends,
    with_open_reloads, with_own_costs, with_own_durations, with_pickups, with_places, with_reloads,
    with_setups, with_table, with_turnaround,
)
from tests.model.tiny_choices import with_choices
from tests.model.tiny_company import companions, with_order, with_relations
from tests.model.tiny_hours import with_closing_hubs, with_hours, with_hours_apart
from tests.model.tiny_legs import with_other_legs
from tests.model.tiny_launches import with_few_launch_places, with_launch_sites
from tests.model.tiny_prices import with_vehicle_costs
from tests.model.tiny_shipments import with_shipments
from tests.seeds import often, seeds

pytestmark = pytest.mark.slow

Change = Callable[[np.random.Generator, Problem], Problem]


@dataclass
class Position:
    """Where a rollout stands, as the oracle sees it."""

    used: list[int]
    vehicle: Vehicle | None = None
    served: set[int] = field(default_factory=set)
    closed: list[Route] = field(default_factory=list)
    actions: list[int] = field(default_factory=list)
    opened: int = 0  # how many actions before the open vehicle

    def advance(self, problem: Problem, code: int) -> None:
        """Do an action. In place."""
        kind, target = code % NUM_KINDS, code // NUM_KINDS
        self.actions.append(code)
        if kind == OPEN:
            self.opened = len(self.actions) - 1
            if self.vehicle is not None:
                self.closed.append(judge(problem, self.vehicle, None)[0])
            self.vehicle = Vehicle(target, self.used[target])
            self.used[target] += 1
            return
        assert self.vehicle is not None
        self.vehicle = after(problem, self.vehicle, kind, target)
        if kind != RETURN:
            self.served.update(problem.places_of(target))


def walk(problem: Problem, rng: np.random.Generator) -> Iterator[tuple[list[int], Position]]:
    """Yield the legal actions along a random rollout, none at its end, and where it stands."""
    instance = pack([problem])
    state = reset(instance, np.zeros(1, np.int64))
    position = Position([0] * len(problem.vehicle_types))
    while codes := legal(problem, instance, state):
        yield codes, position
        code = codes[choose(rng, codes)]
        apply(instance, state, 0, code)
        position.advance(problem, code)
    yield [], position


def test_random_rollouts_pass_the_checker_at_the_cost_it_finds() -> None:
    problems = random_problems(seed=17, count=often(400))
    for first in range(0, len(problems), 50):
        group = problems[first : first + 50]
        for problem, rollout in zip(group, roll(group, seed=first).rollouts, strict=True):
            solution = extract(problem, pack([problem]), rollout.actions)
            evaluation = check(problem, solution)
            assert evaluation.violations == ()
            terms = astuple(evaluation.cost)[:-1]  # the judge alone knows of changes
            assert rollout.cost.tolist() == pytest.approx(terms, rel=1e-9, abs=1e-9)


def test_random_rollouts_of_all_rules_at_once_pass_the_checker() -> None:
    for seed in seeds(300):
        problem = draw_tiny(np.random.default_rng(seed), drone_share=0.7)
        rollout = roll([problem], seed).rollouts[0]
        evaluation = check(problem, extract(problem, pack([problem]), rollout.actions))
        assert evaluation.violations == (), f"seed {seed}"
        assert rollout.cost.sum() == pytest.approx(evaluation.cost.total, rel=1e-9)


def begun_with_pickups(rng: np.random.Generator, problem: Problem) -> Problem:
    return with_pickups(rng, with_beginnings(rng, problem))


def many_dimensions(rng: np.random.Generator, problem: Problem) -> Problem:
    return with_dimensions(rng, with_pickups(rng, problem) if rng.random() < 0.5 else problem)


def swapping_among_all(rng: np.random.Generator, problem: Problem) -> Problem:
    return with_turnaround(rng, with_energy(rng, with_gaps(rng, with_places(rng, problem))))


def charging_often(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem of one trip a vehicle, on which drones could serve all at any time."""
    customers = tuple(replace(customer, served_by="drone" if rng.random() < 0.5 else "either",
                              latest=UNLIMITED, demand=(0,) * len(customer.demand))
                      for customer in problem.customers)
    kinds = tuple(replace(kind, max_trips=1) for kind in problem.vehicle_types)
    return with_charging(rng, replace(problem, customers=customers, vehicle_types=kinds))


def charging_among_all(rng: np.random.Generator, problem: Problem) -> Problem:
    return with_charging(rng, with_pickups(rng, with_gaps(rng, with_places(rng, problem))))


def charging_drone_types(rng: np.random.Generator, problem: Problem) -> Problem:
    return charging_often(rng, with_drone_types(rng, problem))


def drone_types_among_all(rng: np.random.Generator, problem: Problem) -> Problem:
    problem = with_drone_types(rng, problem)
    return with_some(rng, problem, with_gaps, with_energy, with_turnaround, with_duty, with_places,
                     with_beginnings)


def storms_among_all(rng: np.random.Generator, problem: Problem) -> Problem:
    return with_storms(rng, few_airborne_among_all(rng, with_ranges(rng, problem)))


def few_airborne_among_all(rng: np.random.Generator, problem: Problem) -> Problem:
    return with_few_airborne(rng, drone_types_among_all(rng, problem))


def fliers_in_range(rng: np.random.Generator, problem: Problem) -> Problem:
    return with_ranges(rng, with_fliers(rng, problem))


def fliers_in_storms(rng: np.random.Generator, problem: Problem) -> Problem:
    return with_storms(rng, with_some(rng, with_fliers(rng, problem), with_gaps, with_duty))


def few_airborne_in_no_time(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem in which launches and recoveries take no time, and happen at once."""
    problem = with_few_airborne(rng, problem)
    return replace(problem, vehicle_types=tuple(
        with_drones(kind, lambda drones: replace(drones, launch_duration=0, recovery_duration=0))
        for kind in problem.vehicle_types))


def ranges_among_all(rng: np.random.Generator, problem: Problem) -> Problem:
    return drone_types_among_all(rng, with_ranges(rng, problem))


def few_launch_places_among_all(rng: np.random.Generator, problem: Problem) -> Problem:
    problem = with_some(rng, problem, with_gaps, with_energy, with_drone_types, with_reloads)
    return with_few_launch_places(rng, problem)


def few_at_hubs_among_all(rng: np.random.Generator, problem: Problem) -> Problem:
    problem = with_some(rng, problem, with_pickups, with_gaps, with_duty, with_reloads)
    return from_few_batteries(rng, problem)


def fliers_among_all(rng: np.random.Generator, problem: Problem) -> Problem:
    return with_some(rng, with_fliers(rng, problem), with_pickups, with_gaps, with_duty,
                     with_places)


@pytest.mark.thorough_after(8)
@pytest.mark.parametrize("change", [
    with_table, with_places, with_beginnings, with_gaps, with_energy, with_open_ends, with_reloads,
    with_open_reloads, with_duty, with_own_durations, with_goods, with_setups, with_limits_aboard,
    with_other_legs, with_turnaround, swapping_among_all, charging_often, charging_among_all,
    with_drone_types, charging_drone_types, drone_types_among_all, with_ranges, ranges_among_all,
    with_few_airborne, few_airborne_among_all, with_few_launch_places,
    few_launch_places_among_all, with_fliers, fliers_among_all, from_few_batteries,
    few_at_hubs_among_all, with_storms, with_closings, fliers_in_closed_zones, storms_among_all,
    fliers_in_range, fliers_in_storms, with_launch_sites, few_airborne_in_no_time,
    with_vehicle_costs, with_relations, with_order, with_hours_apart, with_closing_hubs])
def test_the_table_other_windows_and_how_vehicles_begin_decide_what_is_legal(
        change: Change) -> None:
    for seed in seeds(28):
        rng = np.random.default_rng(seed)
        problem = change(rng, draw_tiny(rng))
        assert_exact(problem, rng, seed)


def test_a_trip_is_held_until_its_drones_last_again() -> None:
    rng = np.random.default_rng(924)
    problem = drone_types_among_all(rng, draw_tiny(rng, drone_share=1.0))
    assert_exact(problem, rng, 924)


def test_an_order_bounds_how_late_a_vehicle_may_leave() -> None:
    rng = np.random.default_rng(143)
    assert_exact(with_order(rng, draw_tiny(rng)), rng, 143)


def with_pickups_and_all_else(rng: np.random.Generator, problem: Problem) -> Problem:
    return with_pickups(rng, with_duty(rng, with_open_reloads(rng, with_gaps(rng, problem))))


def with_some(rng: np.random.Generator, problem: Problem, *changes: Change) -> Problem:
    for change in (*changes, with_own_durations, with_goods, with_setups, with_limits_aboard,
                   with_relations, with_order):
        if rng.random() < 0.6:
            problem = change(rng, problem)
    return problem


def with_times_and_all_else(rng: np.random.Generator, problem: Problem) -> Problem:
    return with_some(rng, problem, with_pickups_and_all_else, with_beginnings)


def with_times_on_batteries(rng: np.random.Generator, problem: Problem) -> Problem:
    return with_some(rng, problem, with_gaps, with_energy, with_duty)


def flown_both_ways(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem in which what drones pick up weighs, in any dimension."""
    problem = with_pickups(rng, problem)
    return with_energy(rng, with_dimensions(rng, problem) if rng.random() < 0.5 else problem)


@pytest.mark.parametrize("change", [
    with_pickups, begun_with_pickups, many_dimensions, with_pickups_and_all_else,
    with_times_and_all_else, with_times_on_batteries, flown_both_ways])
def test_what_is_aboard_at_each_stop_decides_what_is_legal(change: Change) -> None:
    for seed in seeds(28):
        rng = np.random.default_rng((seed, 5))
        problem = change(rng, draw_tiny(rng))
        assert_exact(problem, rng, seed)


def shipments_both_ways(rng: np.random.Generator, problem: Problem) -> Problem:
    return with_shipments(rng, with_pickups_and_all_else(rng, problem))


def shipments_among_all(rng: np.random.Generator, problem: Problem) -> Problem:
    return with_shipments(rng, with_some(rng, problem, with_gaps, with_places, with_beginnings,
                                         with_table, with_fliers, with_drone_types))


def test_one_place_of_a_customer_is_used() -> None:
    elsewhere = 0
    for seed in seeds(60):
        rng = np.random.default_rng((seed, 77))
        problem = with_choices(rng, with_some(rng, draw_tiny(rng), with_gaps, with_places,
                                              with_setups, with_pickups, with_duty))
        assert_exact(problem, rng, seed)
        targets = {code // NUM_KINDS for code in roll([problem], seed).rollouts[0].actions
                   if code % NUM_KINDS in (DRIVE, LAUNCH)}
        elsewhere += bool(targets & problem.other_nodes)
    assert elsewhere > often(20)


@pytest.mark.thorough_after(1)
@pytest.mark.parametrize("change", [with_shipments, shipments_both_ways, shipments_among_all])
def test_shipments_are_picked_up_exactly_if_they_can_be_delivered(change: Change) -> None:
    delivered = 0
    for seed in seeds(90):
        rng = np.random.default_rng((seed, 9))
        problem = change(rng, draw_tiny(rng))
        assert_exact(problem, rng, seed)
        actions = set(roll([problem], seed).rollouts[0].actions)
        delivered += any(encode_action(kind, each.delivery) in actions
                         for each in problem.shipments for kind in (DRIVE, LAUNCH))
    assert delivered > often(15)


def assert_exact(problem: Problem, rng: np.random.Generator, seed: int) -> None:
    """Compare the mask with the oracle's along a random rollout, and another with the checker."""
    for codes, position in walk(problem, rng):
        gone = [node for route in position.closed for node in route.served]
        expected = list(legal_codes(without_taken(problem, position.closed), position.vehicle,
                                    position.served | companions(problem, gone), position.used))
        assert sorted(codes) == sorted(expected), f"seed {seed}"
    rollout = roll([problem], seed).rollouts[0]
    evaluation = check(problem, extract(problem, pack([problem]), rollout.actions))
    assert evaluation.violations == (), f"seed {seed}"
    assert rollout.cost.sum() == pytest.approx(evaluation.cost.total, rel=1e-9)


def test_rollouts_count_what_leaving_out_each_customer_costs() -> None:
    left_out = 0
    for seed in seeds(200):
        rng = np.random.default_rng(seed)
        problem = with_hours(rng, with_own_costs(rng, draw_tiny(rng)))
        rollout = roll([problem], seed).rollouts[0]
        evaluation = check(problem, extract(problem, pack([problem]), rollout.actions))
        assert evaluation.violations == (), f"seed {seed}"
        assert rollout.cost.sum() == pytest.approx(evaluation.cost.total, rel=1e-9)
        left_out += evaluation.cost.unassigned > 0
    assert left_out > often(50)


def test_random_rollouts_use_every_kind_of_action() -> None:
    kinds = Counter(code % NUM_KINDS for problem in random_problems(seed=18, count=often(160))
                    for code in roll([problem], seed=1).rollouts[0].actions)
    assert min(kinds[kind] for kind in (DRIVE, LAUNCH, RETURN, OPEN)) > often(50)


def test_a_trip_under_way_may_always_return() -> None:
    for problem in random_problems(seed=19, count=often(300)):
        is_under_way = False
        for step in roll([problem], seed=2).rollouts[0].steps:
            assert is_under_way == (RETURN in [code % NUM_KINDS for code in step.codes])
            is_under_way = step.codes[step.choice] % NUM_KINDS in (DRIVE, LAUNCH)


def test_a_finished_rollout_has_no_legal_action() -> None:
    for problem in random_problems(seed=20, count=40):
        batch = roll([problem], seed=3)
        assert batch.state.done[0]
        assert legal(problem, batch.instance, batch.state) == []


@pytest.mark.parametrize("drone_share", [0.0, 0.5, 1.0])
def test_an_action_is_legal_exactly_if_the_vehicle_could_go_home_after_it(
        drone_share: float) -> None:
    kinds: Counter[int] = Counter()
    for seed in seeds(270):
        rng = np.random.default_rng(seed)
        problem = draw_tiny(rng, drone_share)
        for codes, position in walk(problem, rng):
            expected = legal_codes(problem, position.vehicle, position.served, position.used)
            assert sorted(codes) == sorted(expected), f"seed {seed}"
            kinds.update(code % NUM_KINDS for code in codes)
    assert min(kinds[kind] for kind in (DRIVE, RETURN, OPEN)) > often(300)
    assert drone_share == 0 or kinds[LAUNCH] > often(300)


def test_no_departure_at_all_makes_a_forbidden_action_legal_if_windows_are_hard() -> None:
    for seed in seeds(85):
        rng = np.random.default_rng(seed)
        problem = draw_tiny(rng, drone_share=0.0)
        problem = replace(problem, customers=tuple(
            replace(customer, late_cost_per_hour=None) for customer in problem.customers))
        for codes, position in walk(problem, rng):
            expected = legal_codes(problem, position.vehicle, position.served, position.used,
                                   any_start=True)
            assert sorted(codes) == sorted(expected), f"seed {seed}"


def test_the_distance_of_a_trip_begins_at_zero_when_the_trip_begins_with_a_launch(
        tiny_problem, customers, truck, drones) -> None:
    truck = replace(truck, count=1, max_trips=2, max_trip_distance=4_000_000, drones=drones)
    problem = tiny_problem(*customers, truck=truck)
    instance = pack([problem])
    state = reset(instance, np.zeros(1, np.int64))
    for kind, target in ((OPEN, 0), (DRIVE, 1), (RETURN, 0), (LAUNCH, 3), (DRIVE, 2)):
        assert encode_action(kind, target) in legal(problem, instance, state)
        apply(instance, state, 0, encode_action(kind, target))
    assert np.flatnonzero(state.served[0]).tolist() == [1, 2, 3]


def test_drones_that_queue_to_be_recovered_count_against_the_working_duration() -> None:
    # Launched 13 minutes later, both drones would still be back as early, but the first would
    # have to wait for the second's launch, and the truck for both.
    legs = np.array([[30 if 4 in (i, j) and i != j else int(i != j) for j in range(5)]
                     for i in range(5)]) * MINUTE
    by_drone = Customer("", (1,), served_by="drone")
    customers = (Customer("", (1,), earliest=40 * MINUTE),
                 replace(by_drone, earliest=20 * MINUTE), replace(by_drone, earliest=25 * MINUTE),
                 Customer("", (1,)))
    drones = DroneType(2, (9,), 1, endurance=25 * MINUTE, launch_duration=5 * MINUTE,
                       recovery_duration=10 * MINUTE)
    drive_on = encode_action(DRIVE, 4)
    for limit in range(85, 97):
        truck = VehicleType("", 1, (9,), 0, max_working_duration=limit * MINUTE, drones=drones)
        problem = Problem((Depot(""),), customers, (truck,), (Travel(legs, legs),) * 2,
                          np.zeros((5, 2)), 1.0)
        instance = pack([problem])
        state = reset(instance, np.zeros(1, np.int64))
        for kind, target in ((OPEN, 0), (DRIVE, 1), (LAUNCH, 2), (LAUNCH, 3)):
            apply(instance, state, 0, encode_action(kind, target))
        assert (drive_on in legal(problem, instance, state)) == (limit >= 91)


def test_before_a_vehicle_opens_every_row_looks_the_same() -> None:
    problem = draw_tiny(np.random.default_rng(5))
    state = reset(pack([problem]), np.zeros(3, np.int64))
    for name in ("served", "num_unserved", "used", "done", "cost"):
        rows = getattr(state, name)[:3]
        assert (rows == rows[0]).all(), name
