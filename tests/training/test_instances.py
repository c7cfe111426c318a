"""Tests of the random problems."""

import dataclasses

import numpy as np
import pytest

from model.problem import (
    FULL_SPEED,
    MM_PER_KM,
    MS_PER_HOUR,
    UNLIMITED,
    Customer,
    Problem,
    Shipment,
    VehicleType,
)
from model.engine.instance import pack
from model.search.improve import SearchConfig, improve
from model.solution import Solution
from training.instances import (
    ALL,
    SHARES,
    VALIDATED,
    InstanceConfig,
    generate,
    sample_variant,
    validation_set,
)
from training.orders import Reach, open_orders, with_appointments
from training.variants import solomon_vrptw, uniform_vrptw

pytestmark = pytest.mark.slow

SOUND = InstanceConfig(spoiled=0.0)


def draw(variant: str, num_customers: int = 30, draws: int = 40,
         config: InstanceConfig = SOUND) -> list[Problem]:
    return [generate(np.random.default_rng((7, index)), num_customers, variant, config)
            for index in range(draws)]


def is_trip_legal(customer: Customer, kind: VehicleType, out: int, back: int, length: int,
                  service: int, handling: tuple[int, int] = (0, 0)) -> bool:
    """Judge a trip to one customer, at the slowest hours of the type."""
    slowest = min(kind.speed_profile.factors) if kind.speed_profile else FULL_SPEED
    out = -(-out * FULL_SPEED // slowest) + customer.setup_duration
    if customer.max_time_aboard is not None and out > customer.max_time_aboard:
        return False
    out += handling[0]
    back = -(-back * FULL_SPEED // slowest) + handling[1]
    arrival = max(kind.earliest, customer.release_time) + out
    start = max(arrival, customer.earliest)
    start = max([start, *(opens for closes, opens in customer.gaps if closes < start)])
    home, working = start + service + back, out + service + back
    return ((customer.late_cost_per_hour is not None or arrival <= customer.latest)
            and home <= kind.latest
            and (kind.max_working_duration is None or working <= kind.max_working_duration)
            and (kind.max_trip_distance is None or length <= kind.max_trip_distance))


def is_served_by_type(problem: Problem, node: int, kind: VehicleType) -> bool:
    """Judge whether a truck of the type, or its drone in a loop, can serve a customer alone."""
    customer, first, last = problem.customer_at(node), kind.begins_at, kind.ends_at
    fits = all(max(amounts) <= room for *amounts, room
               in zip(customer.demand, customer.taken_in, kind.capacity, strict=True))
    if not fits or not customer.skills <= kind.skills or kind.max_stops == 0:
        return False
    if kind.pickups == "last" and any(customer.pickup) and not any(customer.demand):
        return False
    road = problem.travel[kind.travel]
    if customer.served_by != "drone":
        return is_trip_legal(customer, kind, int(road.duration[first, node]),
                             int(road.duration[node, last]),
                             int(road.distance[first, node] + road.distance[node, last]),
                             kind.service_at(customer))
    drones = kind.drones
    if drones is None or any(amount > room for amount, room
                             in zip(customer.demand, drones.capacity, strict=True)):
        return False
    flight = problem.travel[drones.travel].duration
    service = drones.service_at(customer)
    hubs = [first] + [hub for hub in range(problem.num_depots, problem.num_nodes)
                     if hub != node and problem.customer_at(hub).served_by != "drone"
                     and customer.latest == UNLIMITED]
    loops = [int(flight[hub, node] + flight[node, hub]) + service for hub in hubs]
    last = first if problem.is_nowhere(last) else last
    return min(loops) <= drones.endurance and is_trip_legal(
        customer, dataclasses.replace(kind, speed_profile=None), int(flight[first, node]),
        int(flight[node, last]), 0, service, (drones.launch_duration, drones.recovery_duration))


def comes_behind(problem: Problem, node: int) -> bool:
    """Judge whether a customer is served behind another who is delivered to, or not at all."""
    return (not any(problem.customer_at(node).demand)
            and all(kind.pickups == "last" for kind in problem.vehicle_types)
            and any(any(customer.demand) for customer in problem.customers))


def servable(problem: Problem) -> list[bool]:
    return [any(is_served_by_type(problem, node, kind) and problem.allows(index, node)
                for index, kind in enumerate(problem.vehicle_types))
            or comes_behind(problem, node)
            for node in range(problem.num_depots, problem.num_nodes)]


@pytest.mark.thorough_after(12)
@pytest.mark.parametrize("num_customers", [1, 6, 40])
@pytest.mark.parametrize("variant", ALL)
def test_each_customer_can_be_served_alone(variant: str, num_customers: int) -> None:
    for problem in draw(variant, num_customers):
        assert problem.num_customers == num_customers
        assert all(servable(problem))


def test_mixed_holds_a_few_unservable_customers() -> None:
    problems = draw("mixed", draws=150, config=InstanceConfig())
    share = np.mean([np.mean(servable(problem)) for problem in problems])
    assert 0.95 < share < 0.999


@pytest.mark.parametrize("variant", ALL)
def test_same_stream_gives_same_problem(variant: str) -> None:
    first, second = (generate(np.random.default_rng(3), 12, variant) for _ in range(2))
    assert first.customers == second.customers
    assert first.vehicle_types == second.vehicle_types
    assert first.unassigned_cost == second.unassigned_cost
    for mine, other in zip(first.travel, second.travel, strict=True):
        assert (mine.duration[:] == other.duration[:]).all()
        assert (mine.distance[:] == other.distance[:]).all()


@pytest.mark.parametrize("variant", ALL)
def test_leaving_out_costs_more_than_a_trip_alone(variant: str) -> None:
    for problem in draw(variant, 20, 10):
        for kind in problem.vehicle_types:
            road = problem.travel[kind.travel]
            trip = (kind.fixed_cost
                    + 2 * int(road.distance[:].max()) / MM_PER_KM * kind.cost_per_km
                    + 2 * int(road.duration[:].max()) / MS_PER_HOUR * kind.cost_per_hour)
            assert problem.unassigned_cost > 5 * trip > 0


def test_cvrp_fits_5_to_20_customers_a_trip() -> None:
    for problem in draw("cvrp", 50):
        kind, demand = problem.vehicle_types[0], [c.demand[0] for c in problem.customers]
        assert 4.9 < kind.capacity[0] / np.mean(demand) < 20.1
        assert kind.count == 50


def test_uniform_vrptw_matches_the_published_distribution() -> None:
    for index in range(20):
        problem = uniform_vrptw(np.random.default_rng(index), 50, SOUND)
        kind, crossing = problem.vehicle_types[0], problem.vehicle_types[0].latest / 4.6
        width = [(c.latest - c.earliest) / crossing for c in problem.customers]
        service = [c.service_duration / crossing for c in problem.customers]
        assert kind.capacity == (40_000,)
        assert min(width) >= 0.1799
        assert max(width) <= 0.2001
        assert min(service) >= 0.1499
        assert max(service) <= 0.1801


def test_solomon_vrptw_leaves_some_customers_without_a_window() -> None:
    open_shares = []
    for index in range(40):
        problem = solomon_vrptw(np.random.default_rng(index), 50, SOUND)
        assert all(c.late_cost_per_hour is None for c in problem.customers)
        open_shares.append(np.mean([c.earliest == 0 for c in problem.customers]))
    assert min(open_shares) == 0
    assert max(open_shares) > 0.5


def test_appointed_serves_long_at_times_of_a_plan() -> None:
    problems = draw("appointed", num_customers=50)
    service = [p.customers[0].service_duration / p.vehicle_types[0].latest for p in problems]
    assert min(service) < 0.01
    assert max(service) > 0.05
    shares = [np.mean([c.earliest > 0 for c in p.customers]) for p in problems]
    assert min(shares) < 0.4
    assert max(shares) > 0.9


def test_appointments_lie_about_their_times_where_a_vehicle_can_meet_them() -> None:
    hours = 3_600_000
    orders = open_orders(np.ones((4, 1), dtype=np.int64), np.full(4, hours))
    leg = np.full(4, hours)
    made = with_appointments(np.random.default_rng(0), orders, Reach(0, 10 * hours, leg, leg), 1.0,
                             np.array([0, 3, 5, 12]) * hours, 2.0 * hours)
    assert (made.earliest / hours).tolist() == [1, 2, 4, 8]
    assert (made.latest / hours).tolist() == [3, 4, 6, 8]


def test_soft_has_late_and_early_costs() -> None:
    problems = draw("soft")
    assert all(any(c.late_cost_per_hour for c in p.customers) for p in problems)
    assert any(any(c.early_cost_per_hour for c in p.customers) for p in problems)
    assert any(any(c.late_cost_per_hour is None for c in p.customers) for p in problems)


def test_hetero_mixes_types_skills_and_dimensions() -> None:
    problems = draw("hetero", draws=80)
    assert {len(p.vehicle_types) for p in problems} == {2, 3, 4}
    assert {p.num_dimensions for p in problems} == {1, 2, 3}
    assert any(c.skills for p in problems for c in p.customers)
    assert any(len(p.travel) > 1 for p in problems)


def test_multitrip_draws_every_rule() -> None:
    problems = draw("multitrip")
    kinds = [p.vehicle_types[0] for p in problems]
    assert {kind.max_trips for kind in kinds} == {1, 2, 3}
    assert any(kind.max_working_duration is not None for kind in kinds)
    assert any(kind.max_trip_distance is not None for kind in kinds)
    assert any(kind.speed_profile is not None for kind in kinds)
    assert any(c.release_time > 0 for p in problems for c in p.customers)


def test_drone_reserves_customers_and_varies_the_objective() -> None:
    problems = draw("drone")
    kinds = [p.vehicle_types[0] for p in problems]
    modes = {c.served_by for p in problems for c in p.customers}
    assert {kind.drones.count for kind in kinds if kind.drones} == {1, 2}
    assert modes == {"truck", "drone", "either"}
    assert any(kind.cost_per_km == 0 for kind in kinds)


@pytest.mark.parametrize("num_customers", [25, 100])
def test_table1_packs_tightly(num_customers: int) -> None:
    for problem in draw("table1", num_customers):
        kind = problem.vehicle_types[0]
        modes = [c.served_by for c in problem.customers]
        load = sum(c.demand[0] for c in problem.customers) / (kind.count * kind.capacity[0])
        assert kind.count == num_customers // 25
        assert modes.count("drone") == modes.count("truck") == round(num_customers / 10)
        assert 0.82 < load <= 0.985


def test_mixed_draws_every_rule() -> None:
    problems = draw("mixed", draws=120)
    kinds = [kind for p in problems for kind in p.vehicle_types]
    assert {p.num_depots for p in problems} == {1, 2}
    assert {len(p.vehicle_types) for p in problems} == {1, 2, 3}
    assert any((p.travel[0].duration[:] != p.travel[0].duration[:].T).any() for p in problems)
    assert any(kind.drones and kind.speed_profile and kind.max_trips > 1 for kind in kinds)
    assert any(c.late_cost_per_hour for p in problems for c in p.customers)


def test_pickups_come_in_all_ways() -> None:
    problems = draw("pickups", draws=80)
    kinds = [p.vehicle_types[0] for p in problems]
    both = [all(any(c.demand) for c in p.customers) for p in problems]
    assert 0.3 < np.mean(both) < 0.7
    assert any(any(c.pickup > c.demand for c in p.customers) for p in problems)
    assert {kind.pickups for kind in kinds} == {"any", "last"}
    assert any(kind.cost_per_load_km > 0 for kind in kinds)
    assert any(kind.max_trip_distance is not None for kind in kinds)
    assert {p.is_nowhere(kind.ends_at) for p, kind in zip(problems, kinds, strict=True)} == {
        False, True}


def test_various_draws_every_rule() -> None:
    problems = draw("various", draws=120)
    kinds = [kind for p in problems for kind in p.vehicle_types]
    drones = [kind.drones for kind in kinds if kind.drones is not None]
    customers = [c for p in problems for c in p.customers]
    assert {p.num_dimensions for p in problems} == set(range(1, 9))
    assert {sum(d.kind == "depot" for d in p.depots) for p in problems} == {1, 2, 3}
    assert any(kind.start not in (None, kind.depot) and kind.end not in (None, kind.depot)
               for kind in kinds)
    assert any(kind.reload_depots and kind.max_trips > 1 for kind in kinds)
    assert any(p.is_nowhere(kind.ends_at) for p in problems for kind in p.vehicle_types)
    for name in ("overtime", "max_stops", "max_sorties"):
        assert any(getattr(kind, name) is not None for kind in kinds)
    assert any(kind.cost_per_stop and kind.cost_per_load_km for kind in kinds)
    assert {kind.pickups for kind in kinds} == {"any", "last"}
    assert {d.energy.lands for d in drones if d.energy is not None} == {False, True}
    assert any(d.energy is not None and d.endurance < UNLIMITED for d in drones)
    assert {len(c.gaps) for c in customers} == {0, 1, 2, 3}
    assert any(c.unassigned_cost is not None and any(c.pickup) for c in customers)
    assert any(p.may_serve is not None and not p.may_serve.all() for p in problems)


def test_particular_draws_every_rule() -> None:
    problems = draw("particular", draws=120)
    kinds = [kind for p in problems for kind in p.vehicle_types]
    drones = [kind.drones for kind in kinds if kind.drones is not None]
    customers = [c for p in problems for c in p.customers]
    shared = [p for p in problems if any(c.site is not None for c in p.customers)]
    assert any(p.setup_between(p.num_depots + 1, p.num_depots) == 0 for p in shared
               if p.customers[0].setup_duration and p.customers[0].site == p.customers[1].site)
    assert any(c.gaps and c.setup_duration for c in customers)
    assert any(c.max_time_aboard is not None and c.setup_duration for c in customers)
    assert {each.scope for p in problems for each in p.incompatible_goods} == {"trip", "vehicle"}
    assert any(kind.service_durations for kind in kinds)
    assert any(each.service_durations and each.swap_duration for each in drones)
    assert {each.batteries is None for each in drones} == {False, True}
    assert any(each.energy is not None and each.energy.charge for each in drones)
    assert any(kind.more_drones and kind.num_drones > 2 for kind in kinds)


def test_shipments_leave_room_for_each_alone() -> None:
    problems = draw("shipments", 20)
    legs = [each for p in problems for each in p.shipments]
    assert {each.max_detour is None for each in legs} == {False, True}
    assert any(len(p.shipments) == 10 for p in problems)
    assert any(0 < len(p.shipments) < 10 for p in problems)
    alone = [replace_all_but(p, each) for p in problems[:12] for each in p.shipments[:3]]
    assert all(nobody_is_left_out(p) for p in alone)


def replace_all_but(problem: Problem, each: Shipment) -> Problem:
    """Return the problem of one shipment alone."""
    nodes = [*range(problem.num_depots), each.pickup, each.delivery]
    source = np.array(nodes)
    return dataclasses.replace(
        problem, customers=tuple([problem.customer_at(node) for node in nodes[-2:]]),
        coordinates=problem.coordinates[source], shipments=problem.shipments_among(nodes),
        travel=tuple([legs.among(source) for legs in problem.travel]))


def nobody_is_left_out(problem: Problem) -> bool:
    """Tell whether a few turns of the search serve everybody."""
    found = improve(problem, pack([problem], legs=False), Solution((), ()), SearchConfig(turns=5))
    return not found.solution.unassigned


def test_chosen_draws_places_and_prices() -> None:
    problems = draw("chosen", 20)
    assert {len(places) for p in problems for places in p.choices} == {2, 3, 4}
    assert {p.vehicle_costs is None for p in problems} == {False, True}


def test_related_draws_every_relation() -> None:
    relations = [each for p in draw("related", 20) for each in p.relations]
    assert {(each.kind, each.scope) for each in relations} == {
        (kind, scope) for kind in ("together", "apart", "before") for scope in ("trip", "vehicle")}
    assert any(each.min_lag and each.max_lag is not None for each in relations)


def test_resting_draws_every_rule() -> None:
    kinds = [kind for p in draw("resting", 20) for kind in p.vehicle_types]
    assert {len(kind.breaks) for kind in kinds} == {0, 1, 2, 3}
    assert {each.anywhere for kind in kinds for each in kind.breaks} == {False, True}
    assert any(kind.max_travel_duration is not None for kind in kinds)
    assert any(kind.driving is not None and kind.driving.split for kind in kinds)


def test_sides_span_orders_of_magnitude() -> None:
    spans = [float(np.ptp(p.coordinates, axis=0).max()) for p in draw("cvrp", draws=60)]
    assert min(spans) < 1
    assert max(spans) > 100


def test_variants_come_by_their_shares() -> None:
    rng = np.random.default_rng(0)
    names = [sample_variant(rng) for _ in range(4000)]
    assert sum(SHARES.values()) == pytest.approx(1.0)
    for name, share in SHARES.items():
        assert names.count(name) / len(names) == pytest.approx(share, abs=0.03)


def test_validation_set_is_fixed_and_balanced() -> None:
    problems, prefix = validation_set(), validation_set(16)
    names = [name for name, _ in problems]
    sizes = [problem.num_customers for _, problem in problems]
    assert len(set(names)) == 200
    assert [sizes.count(size) for size in (20, 50, 100)] == [80, 80, 40]
    assert all(sum(name.startswith(f"{variant}-") for name in names) == 25
               for variant in VALIDATED)
    for (name, problem), (same_name, same) in zip(problems, prefix, strict=False):
        assert name == same_name
        assert problem.customers == same.customers


def test_unknown_variant_is_refused() -> None:
    with pytest.raises(ValueError, match="sailing"):
        generate(np.random.default_rng(0), 5, "sailing")


def test_empty_problem_is_refused() -> None:
    with pytest.raises(ValueError, match="num_customers"):
        generate(np.random.default_rng(0), 0, "cvrp")
