from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from model.judge.check import check
from model.judge.timing import RouteDecision, SortieDecision, TripDecision, schedule
from model.problem import UNREACHABLE, Overtime, SpeedProfile, Travel
from model.solution import Route, Solution, Sortie, Stop, Trip, Visit

MINUTE = 60_000
KM = 1_000_000

# to a (arrival 2, departure 7), b (9, 14), back at 18; 4 km
A_THEN_B = TripDecision((0, 1, 2, 0), start=0)
# the same, c by drone: take-off 3, at c 5 to 10, at b 11, recovered 12
C_BY_DRONE = TripDecision((0, 1, 2, 0), (SortieDecision((3,), 1, 2),), start=0)


def plan(problem, *trips):
    """One route of these trips; all other customers are unassigned."""
    route = schedule(problem, RouteDecision(0, 0, trips))
    served = {node for trip in trips
              for node in (*trip.nodes, *(n for sortie in trip.sorties for n in sortie.nodes))}
    return Solution((route,), tuple(sorted(set(range(1, problem.num_nodes)) - served)))


def codes(problem, solution):
    return [violation.code for violation in check(problem, solution).violations]


def with_trip(solution, trip):
    return replace(solution, routes=(replace(solution.routes[0], trips=(trip,)),))


@pytest.mark.parametrize(("code", "kept", "broken"), [
    ("CAPACITY", {"capacity": (2000,)}, {"capacity": (1999,)}),
    ("SHIFT", {"latest": 18 * MINUTE}, {"latest": 18 * MINUTE - 1}),
    ("SHIFT", {"earliest": 0}, {"earliest": 1}),
    ("WORKING_DURATION", {"max_working_duration": 18 * MINUTE},
     {"max_working_duration": 18 * MINUTE - 1}),
    ("TRIP_DISTANCE", {"max_trip_distance": 4 * KM}, {"max_trip_distance": 4 * KM - 1}),
    ("DISTANCE", {"max_distance": 4 * KM}, {"max_distance": 4 * KM - 1}),
    ("TRAVEL_DURATION", {"max_travel_duration": 480_000}, {"max_travel_duration": 479_999}),
    ("MAX_STOPS", {"max_stops": 2}, {"max_stops": 1}),
    ("SHIFT", {"latest": 10 * MINUTE, "overtime": Overtime(1.0, 8 * MINUTE)},
     {"latest": 10 * MINUTE, "overtime": Overtime(1.0, 8 * MINUTE - 1)}),
    ("WORKING_DURATION", {"max_working_duration": 10 * MINUTE, "overtime": Overtime(1.0)},
     {"max_working_duration": 10 * MINUTE, "overtime": Overtime(1.0, 8 * MINUTE - 1)}),
])
def test_limits_of_a_truck(code, kept, broken, tiny_problem, customers, truck):
    solution = plan(tiny_problem(*customers, truck=truck), A_THEN_B)
    assert codes(tiny_problem(*customers, truck=replace(truck, **kept)), solution) == []
    assert codes(tiny_problem(*customers, truck=replace(truck, **broken)), solution) == [code]


@pytest.mark.parametrize(("code", "kept", "broken"), [
    ("TIME_WINDOW", {"latest": 9 * MINUTE}, {"latest": 9 * MINUTE - 1}),
    ("SKILLS", {"skills": frozenset({"lift"})}, {"skills": frozenset({"lift", "crane"})}),
    ("SERVED_BY", {"served_by": "truck"}, {"served_by": "drone"}),
    ("RELEASE", {"release_time": 0}, {"release_time": 1}),
])
def test_demands_of_a_customer_on_a_truck(code, kept, broken, tiny_problem, customers, truck):
    a, b = customers[:2]
    truck = replace(truck, skills=frozenset({"lift"}))
    solution = plan(tiny_problem(a, b, truck=truck), A_THEN_B)
    assert codes(tiny_problem(a, replace(b, **kept), truck=truck), solution) == []
    assert codes(tiny_problem(a, replace(b, **broken), truck=truck), solution) == [code]


@pytest.mark.parametrize("trip", [A_THEN_B, C_BY_DRONE])
def test_the_table_says_whom_a_type_may_serve(trip, tiny_problem, customers, truck, drones):
    problem = tiny_problem(*customers[:3], truck=replace(truck, drones=drones),
                           more_types=(truck,))
    solution = plan(problem, trip)
    served = len(trip.nodes) - 2 + len(trip.sorties)
    table = np.array([[True] * 3, [False] * 3])
    assert codes(replace(problem, may_serve=table), solution) == []
    violations = check(replace(problem, may_serve=~table), solution).violations
    assert [violation.code for violation in violations] == ["VEHICLE"] * served
    assert violations[0].message == "truck may not serve customer a"
    assert violations[0].path == "routes[0].trips[0].stops[1]"


def test_message_and_path_name_the_offender(tiny_problem, customers, truck):
    late = replace(customers[1], latest=8 * MINUTE)
    problem = tiny_problem(customers[0], late, truck=truck)
    (violation,) = check(problem, plan(problem, A_THEN_B)).violations
    assert violation.path == "routes[0].trips[0].stops[2]"
    assert violation.message == "customer b is reached at 540 s, after 480 s"


def test_all_violations_come_at_once(tiny_problem, customers, truck):
    strict = replace(truck, capacity=(1,), max_trip_distance=1, latest=1)
    problem = tiny_problem(*customers, truck=strict)
    assert codes(problem, plan(problem, A_THEN_B)) == ["CAPACITY", "TRIP_DISTANCE", "SHIFT"]


def test_each_dimension_has_its_capacity(tiny_problem, customers, truck):
    a, b = (replace(customer, demand=(1000, 2000, 0)) for customer in customers[:2])
    problem = tiny_problem(a, b, truck=replace(truck, capacity=(4000, 4000, 0)))
    evaluation = check(problem, plan(problem, A_THEN_B))
    assert evaluation.violations == ()
    trip = evaluation.routes[0].trips[0]
    assert (trip.load, trip.load_rate) == ((2000, 4000, 0), 1.0)
    assert trip.stop_loads == ((2000, 4000, 0), (1000, 2000, 0), (0, 0, 0), (0, 0, 0))
    full = tiny_problem(a, b, truck=replace(truck, capacity=(4000, 3999, 0)))
    assert codes(full, plan(full, A_THEN_B)) == ["CAPACITY"]


def test_reloading_takes_its_time(tiny_problem, customers, truck):
    twice = replace(truck, max_trips=2, reload_duration=10 * MINUTE)
    problem = tiny_problem(*customers[:2], truck=twice)
    to_a = TripDecision((0, 1, 0))  # back at 9
    solution = plan(problem, to_a, TripDecision((0, 2, 0), start=19 * MINUTE))
    assert codes(problem, solution) == []
    assert check(problem, solution).routes[0].working_duration == 32 * MINUTE  # back 19 + 13
    hasty = plan(problem, to_a, TripDecision((0, 2, 0), start=19 * MINUTE - 1))
    assert codes(problem, hasty) == ["RELOAD"]


def test_trips_are_limited(tiny_problem, customers, truck):
    trips = (TripDecision((0, 1, 0)), TripDecision((0, 2, 0)))
    problem = tiny_problem(*customers, truck=replace(truck, max_trips=2))
    assert codes(problem, plan(problem, *trips)) == []
    problem = tiny_problem(*customers, truck=truck)
    assert codes(problem, plan(problem, *trips)) == ["MAX_TRIPS"]


def test_load_resets_between_trips(tiny_problem, customers, truck):
    small = replace(truck, max_trips=2, capacity=(1000,))
    problem = tiny_problem(*customers, truck=small)
    solution = plan(problem, TripDecision((0, 1, 0)), TripDecision((0, 2, 0)))
    assert codes(problem, solution) == []


def test_clock_runs_on_across_trips(tiny_problem, customers, truck):
    for limit, expected in ((22 * MINUTE, []), (22 * MINUTE - 1, ["WORKING_DURATION"])):
        strict = replace(truck, max_trips=2, max_working_duration=limit)
        problem = tiny_problem(*customers, truck=strict)
        solution = plan(problem, TripDecision((0, 1, 0)), TripDecision((0, 2, 0)))  # 9 + 13
        assert codes(problem, solution) == expected


@pytest.mark.parametrize(("vehicles", "expected"), [
    ((0, 1), []), ((0, 2), ["COUNT"]), ((0, -1), ["COUNT"]), ((1, 1), ["COUNT"]),
])
def test_each_route_has_its_vehicle(vehicles, expected, tiny_problem, customers, truck):
    problem = tiny_problem(*customers[:2], truck=truck)
    routes = tuple(
        schedule(problem, RouteDecision(0, vehicle, (TripDecision((0, node, 0)),)))
        for node, vehicle in enumerate(vehicles, 1)
    )
    assert codes(problem, Solution(routes)) == expected


def test_each_type_has_its_home_depot(tiny_problem, customers, truck):
    problem = tiny_problem(customers[0], truck=truck, more_types=(replace(truck, depot=1),),
                           places=(0, 2, 1), num_depots=2)
    away = schedule(problem, RouteDecision(1, 0, (TripDecision((1, 2, 1)),)))
    assert codes(problem, Solution((away,))) == []
    lost = schedule(problem, RouteDecision(1, 0, (TripDecision((1, 2, 0)),)))
    assert codes(problem, Solution((lost,))) == ["DEPOT"]


@pytest.mark.parametrize(("code", "kept", "broken"), [
    ("PAYLOAD", {"capacity": (1000,)}, {"capacity": (999,)}),
    ("ENDURANCE", {"endurance": 8 * MINUTE}, {"endurance": 8 * MINUTE - 1}),
])
def test_limits_of_a_drone(code, kept, broken, tiny_problem, customers, truck, drones):
    def problem(**changes):
        carrier = replace(truck, drones=replace(drones, **changes))
        return tiny_problem(*customers, truck=carrier)

    solution = plan(problem(), C_BY_DRONE)
    assert codes(problem(**kept), solution) == []
    assert codes(problem(**broken), solution) == [code]


@pytest.mark.parametrize(("code", "kept", "broken"), [
    ("TIME_WINDOW", {"latest": 5 * MINUTE}, {"latest": 5 * MINUTE - 1}),
    ("SKILLS", {"skills": frozenset()}, {"skills": frozenset({"crane"})}),
    ("SERVED_BY", {"served_by": "drone"}, {"served_by": "truck"}),
    ("RELEASE", {"release_time": 0}, {"release_time": 1}),
    ("CAPACITY", {"demand": (3000,)}, {"demand": (3001,)}),
])
def test_demands_of_a_customer_on_a_drone(
    code, kept, broken, tiny_problem, customers, truck, drones
):
    a, b, c = customers[:3]
    carrier = replace(truck, capacity=(5000,), drones=drones)
    solution = plan(tiny_problem(a, b, c, truck=carrier), C_BY_DRONE)
    assert codes(tiny_problem(a, b, replace(c, **kept), truck=carrier), solution) == []
    assert codes(tiny_problem(a, b, replace(c, **broken), truck=carrier), solution) == [code]


@pytest.mark.parametrize(("includes_waiting", "endurance", "expected"), [
    (True, 6, []), (True, 5, ["ENDURANCE"]), (False, 3, []), (False, 2, ["ENDURANCE"]),
])
def test_waiting_for_the_truck_counts_unless_told_otherwise(
    includes_waiting, endurance, expected, tiny_problem, customers, truck, drones
):
    # take-off 3, back over b at 6, the truck comes at 9
    quick = replace(drones, service_duration=0, endurance=endurance * MINUTE,
                    endurance_includes_waiting=includes_waiting)
    problem = tiny_problem(*customers, truck=replace(truck, drones=quick))
    assert codes(problem, plan(problem, C_BY_DRONE)) == expected


def test_sortie_size(tiny_problem, customers, truck, drones):
    both = TripDecision((0, 1, 0), (SortieDecision((2, 3), 1, 2),))
    for size, expected in ((2, []), (1, ["SORTIE_SIZE"])):
        carrier = replace(truck, drones=replace(drones, max_customers_per_sortie=size))
        problem = tiny_problem(*customers, truck=carrier)
        assert codes(problem, plan(problem, both)) == expected
    nobody = TripDecision((0, 1, 0), (SortieDecision((), 1, 2),))
    assert codes(problem, plan(problem, nobody)) == ["SORTIE_SIZE"]


def test_payload_counts_all_customers_of_a_sortie(tiny_problem, customers, truck, drones):
    both = TripDecision((0, 1, 0), (SortieDecision((2, 3), 1, 2),))
    for capacity, expected in ((2000, []), (1999, ["PAYLOAD"])):
        larger = replace(drones, max_customers_per_sortie=2, capacity=(capacity,))
        problem = tiny_problem(*customers, truck=replace(truck, drones=larger))
        assert codes(problem, plan(problem, both)) == expected


def test_drone_flies_one_sortie_at_a_time(tiny_problem, customers, truck, drones):
    carrier = replace(truck, drones=replace(drones, count=2))
    problem = tiny_problem(*customers, truck=carrier)
    for second, expected in ((1, []), (0, ["DRONE_BUSY"])):
        sorties = (SortieDecision((3,), 0, 2, 0), SortieDecision((4,), 1, 2, second))
        solution = plan(problem, TripDecision((0, 1, 2, 0), sorties))
        assert codes(problem, solution) == expected


def test_drone_flies_again_after_recovery_at_a_stop(tiny_problem, customers, truck, drones):
    problem = tiny_problem(*customers, truck=replace(truck, drones=drones))
    sorties = (SortieDecision((3,), 0, 1), SortieDecision((4,), 1, 2))
    assert codes(problem, plan(problem, TripDecision((0, 1, 2, 0), sorties))) == []


def test_drones_are_counted(tiny_problem, customers, truck, drones):
    carrier = replace(truck, drones=drones)
    problem = tiny_problem(*customers, truck=carrier)
    sortie = SortieDecision((3,), 1, 2, drone=1)
    assert codes(problem, plan(problem, TripDecision((0, 1, 2, 0), (sortie,)))) == ["COUNT"]
    without = tiny_problem(*customers, truck=truck)
    assert codes(without, plan(problem, C_BY_DRONE)) == ["COUNT"]


@pytest.mark.parametrize(("leg", "expected"), [((3, 1), []), ((1, 3), ["UNREACHABLE"])])
def test_flights_keep_out_of_closed_airspace(leg, expected, tiny_problem, customers, truck, drones):
    problem = tiny_problem(*customers, truck=replace(truck, drones=drones))
    solution = plan(problem, C_BY_DRONE)
    closed = problem.travel[1].duration[:].copy()
    closed[leg] = UNREACHABLE
    travel = (problem.travel[0], Travel(closed, problem.travel[1].distance))
    assert codes(replace(problem, travel=travel), solution) == expected


@pytest.mark.parametrize(("launch", "recovery"), [(1, 4), (2, 1), (-1, 1)])
def test_sorties_begin_and_end_at_stops_of_their_trip(
    launch, recovery, tiny_problem, customers, truck, drones
):
    problem = tiny_problem(*customers, truck=replace(truck, drones=drones))
    solution = plan(problem, C_BY_DRONE)
    trip = solution.routes[0].trips[0]
    sortie = replace(trip.sorties[0], launch_stop=launch, recovery_stop=recovery)
    assert codes(problem, with_trip(solution, replace(trip, sorties=(sortie,)))) == ["SORTIE_STOPS"]


def test_working_time_begins_with_the_first_take_off(tiny_problem, customers, truck, drones):
    problem = tiny_problem(*customers, truck=replace(truck, drones=drones))
    loop = TripDecision((0, 0), (SortieDecision((3,), 0, 0),))  # take-off 1, recovered 13
    evaluation = check(problem, plan(problem, loop))
    assert evaluation.violations == ()
    assert evaluation.routes[0].working_duration == 12 * MINUTE
    assert evaluation.routes[0].trips[0].duration == 12 * MINUTE
    assert evaluation.makespan == 13 * MINUTE


def test_every_customer_is_in_the_plan_once(tiny_problem, customers, truck):
    problem = tiny_problem(*customers, truck=truck)
    solution = plan(problem, A_THEN_B)
    assert codes(problem, solution) == []
    assert codes(problem, replace(solution, unassigned=(3,))) == ["MISSING"]
    assert codes(problem, replace(solution, unassigned=(1, 3, 4))) == ["DUPLICATE"]
    assert codes(problem, replace(solution, unassigned=(3, 4, 5))) == ["UNKNOWN_NODE"]


@pytest.mark.parametrize(("nodes", "expected"), [
    ((0, 9, 0), "UNKNOWN_NODE"), ((0, -1, 0), "UNKNOWN_NODE"), ((0, 0, 0), "DEPOT"),
    ((0, 1), "DEPOT"), ((1, 0), "DEPOT"), ((0,), "DEPOT"), ((), "DEPOT"), ((0, 0), "EMPTY_TRIP"),
])
def test_trips_lead_from_depot_to_depot_by_customers(
    nodes, expected, tiny_problem, customers, truck
):
    problem = tiny_problem(*customers, truck=truck)
    trip = Trip(tuple(Stop(node, 0, 0, 0) for node in nodes))
    assert expected in codes(problem, Solution((Route(0, 0, (trip,)),), (1, 2, 3, 4)))


def test_routes_need_trips_and_a_known_type(tiny_problem, customers, truck):
    problem = tiny_problem(truck=truck)
    assert codes(problem, Solution((Route(0, 0, ()),))) == ["EMPTY_TRIP"]
    problem = tiny_problem(customers[0], truck=truck)
    route = replace(plan(problem, TripDecision((0, 1, 0))).routes[0], vehicle_type=1)
    assert codes(problem, Solution((route,))) == ["UNKNOWN_TYPE"]


def test_visits_are_customers(tiny_problem, customers, truck, drones):
    problem = tiny_problem(*customers, truck=replace(truck, drones=drones))
    solution = plan(problem, C_BY_DRONE)
    trip = solution.routes[0].trips[0]
    sortie = replace(trip.sorties[0], visits=(Visit(0, 0, 0, 0),))
    solution = replace(with_trip(solution, replace(trip, sorties=(sortie,))), unassigned=(3, 4))
    assert codes(problem, solution) == ["UNKNOWN_NODE"]


@pytest.mark.parametrize(("stop", "field"), [
    (1, "arrival"), (2, "service_start"), (2, "departure"), (3, "departure"), (0, "departure"),
])
def test_stated_times_are_recomputed(stop, field, tiny_problem, customers, truck):
    problem = tiny_problem(*customers, truck=truck)
    solution = plan(problem, A_THEN_B)
    stops = list(solution.routes[0].trips[0].stops)
    stops[stop] = replace(stops[stop], **{field: getattr(stops[stop], field) + 1})
    (violation,) = check(problem, with_trip(solution, Trip(tuple(stops)))).violations
    assert violation.code == "TIME_MISMATCH"
    assert violation.path == f"routes[0].trips[0].stops[{stop}]"


@pytest.mark.parametrize("field", ["launch_time", "recovery_start", "recovery_time", "visits"])
def test_stated_times_of_sorties_are_recomputed(
    field, tiny_problem, customers, truck, drones
):
    problem = tiny_problem(*customers, truck=replace(truck, drones=drones))
    solution = plan(problem, C_BY_DRONE)
    trip = solution.routes[0].trips[0]
    sortie = trip.sorties[0]
    if field == "visits":
        wrong = (replace(sortie.visits[0], arrival=sortie.visits[0].arrival - 1),)
    else:
        wrong = getattr(sortie, field) + 1
    trip = replace(trip, sorties=(replace(sortie, **{field: wrong}),))
    assert codes(problem, with_trip(solution, trip)) == ["TIME_MISMATCH"]


def test_later_start_is_a_choice_but_later_departure_is_not(tiny_problem, customers, truck):
    problem = tiny_problem(*customers, truck=truck)
    assert codes(problem, plan(problem, replace(A_THEN_B, start=MINUTE))) == []
    solution = plan(problem, A_THEN_B)
    idle = tuple(
        replace(stop, arrival=stop.arrival + MINUTE * (index > 0),
                service_start=stop.service_start + MINUTE * (index > 0),
                departure=stop.departure + MINUTE)
        for index, stop in enumerate(solution.routes[0].trips[0].stops)
    )
    assert set(codes(problem, with_trip(solution, Trip(idle)))) == {"TIME_MISMATCH"}


def test_speed_profile_slows_the_truck(tiny_problem, customers, truck):
    halved = replace(truck, speed_profile=SpeedProfile((8 * MINUTE,), (1_000_000, 500_000)))
    problem = tiny_problem(*customers[:2], truck=halved)
    solution = plan(problem, A_THEN_B)
    # leaves a at 7, drives a minute, then the other takes two; leaves b at 15, drives 8
    times = [(stop.arrival, stop.departure) for stop in solution.routes[0].trips[0].stops]
    assert times == [(0, 0), (2 * MINUTE, 7 * MINUTE), (10 * MINUTE, 15 * MINUTE),
                     (23 * MINUTE, 23 * MINUTE)]
    assert codes(problem, solution) == []
    assert codes(tiny_problem(*customers[:2], truck=truck), solution) == ["TIME_MISMATCH"] * 2


numbers = st.integers(-2, 6)
visits = st.builds(Visit, numbers, numbers, numbers, numbers)
sorties = st.builds(Sortie, numbers, numbers, numbers, st.lists(visits, max_size=3).map(tuple),
                    numbers, numbers, numbers)
stops = st.builds(Stop, numbers, numbers, numbers, numbers)
depot_stops = st.builds(Stop, st.just(0), numbers, numbers, numbers)
trips = st.one_of(
    st.builds(Trip, st.lists(stops, max_size=4).map(tuple)),
    st.builds(lambda first, inner, last, flights: Trip((first, *inner, last), flights),
              depot_stops, st.lists(stops, max_size=2), depot_stops,
              st.lists(sorties, max_size=3).map(tuple)),
)
routes = st.builds(Route, st.integers(-1, 1), numbers, st.lists(trips, max_size=2).map(tuple))
solutions = st.builds(Solution, st.lists(routes, max_size=2).map(tuple),
                      st.lists(numbers, max_size=4).map(tuple))


@given(solution=solutions)
def test_malformed_plans_are_judged_not_raised(solution, tiny_problem, customers, truck, drones):
    problem = tiny_problem(*customers, truck=replace(truck, drones=drones))
    evaluation = check(problem, solution)
    assert evaluation.violations or solution.routes == ()
    assert len(evaluation.routes) == len(solution.routes)
    assert np.isfinite(evaluation.cost.total)
