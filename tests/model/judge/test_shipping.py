"""Shipments and stacks, by hand-computed cases: a at km 1, b at km 2, c to fly to, d at km 4."""

from dataclasses import replace

import pytest

from model.counsel.explain import POSSIBLE, explain
from model.judge.check import check
from model.judge.timing import (
    Operation, RouteDecision, SortieDecision, TripDecision, schedule,
)
from model.problem import Part, Shipment
from model.solution import Route, Solution
from tests.model.judge.test_loads import codes, judged

FLOWN = (Shipment("x", 1, 3, (1000,)),)
DIRECT = (Shipment("x", 1, 2, (1000,)), Shipment("y", 3, 4, (1000,)))
C_FROM_A = SortieDecision((3,), 1, 2)


@pytest.mark.parametrize(("nodes", "broken"), [
    ((0, 1, 3, 4, 2, 0), []), ((0, 1, 2, 3, 4, 0), []), ((0, 1, 3, 2, 4, 0), ["LIFO"])])
def test_what_was_loaded_last_is_unloaded_first(tiny_problem, customers, truck, nodes, broken):
    ends = [replace(each, demand=(0,), served_by="either") for each in customers]
    stack = tiny_problem(*ends, truck=replace(truck, lifo=True))
    assert codes(judged(replace(stack, shipments=DIRECT), TripDecision(nodes, start=0))) == broken
    free = replace(tiny_problem(*ends, truck=truck), shipments=DIRECT)
    assert codes(judged(free, TripDecision(nodes, start=0))) == []


@pytest.mark.parametrize(("nodes", "broken", "stacked"), [
    ((0, 3, 1, 2, 4, 0), [], []), ((0, 1, 3, 2, 4, 0), [], ["LIFO"]),
    ((0, 2, 1, 4, 3, 0), ["PAIR"], []),  # the last part comes too late
    ((0, 1, 2, 4, 0), ["PAIR"], [])])  # one lacks
def test_a_shipment_has_several_pickups(tiny_problem, customers, truck, nodes, broken, stacked):
    ends = [replace(each, demand=(0,), served_by="truck") for each in customers]
    parts = (Shipment("x", 1, 4, (1000,), more=(Part(2, (2000,)), Part(3, (500,)))),)
    problem = replace(tiny_problem(*ends, truck=truck), shipments=parts)
    assert codes(judged(problem, TripDecision(nodes, start=0))) == broken
    other = (replace(parts[0], more=parts[0].more[:1]),)
    stack = tiny_problem(*ends, truck=replace(truck, lifo=True))
    # Who is at 3 has something to be picked up, which stays on top of what came before.
    stack = replace(stack, shipments=other, customers=(
        *stack.customers[:2], replace(stack.customers[2], pickup=(1,)), *stack.customers[3:]))
    assert codes(judged(stack, TripDecision(nodes, start=0))) == stacked


def test_the_first_of_several_pickups_counts(tiny_problem, customers, truck):
    ends = [replace(each, demand=(0,), served_by="truck") for each in customers]
    problem = tiny_problem(*ends, truck=truck)
    leg = problem.travel[0].duration.item(2, 3)
    for nodes, spare in ((0, 1, 2, 3, 0), 1), ((0, 1, 2, 3, 0), 0), ((0, 2, 1, 3, 0), 0):
        limit = leg + problem.travel[0].duration.item(1, 2) + ends[1].service_duration
        parts = Shipment("x", 1, 3, (1000,), limit - 1 + spare, more=(Part(2, (0,)),))
        trip = TripDecision(nodes, start=0)
        late = codes(judged(replace(problem, shipments=(parts,)), trip))
        assert late == ([] if spare else ["TIME_BETWEEN"]), nodes
    with pytest.raises(ValueError, match="amount"):
        replace(problem, shipments=(replace(parts, more=(Part(2, (0, 0)),)),))


@pytest.mark.parametrize(("demand", "pickup", "nodes", "broken"), [
    (1, 0, (0, 1, 2, 3, 0), ["LIFO"]),  # below the shipment
    (1, 0, (0, 2, 1, 3, 0), []),
    (0, 1, (0, 1, 2, 3, 0), ["LIFO"]),  # on it
    (0, 1, (0, 2, 1, 3, 0), []), (0, 1, (0, 1, 3, 2, 0), []),
    (0, 0, (0, 1, 2, 3, 0), [])])  # nothing is moved
def test_customers_parcels_and_pickups_are_on_the_stack(
        tiny_problem, customers, truck, demand, pickup, nodes, broken):
    a, b, c = (replace(each, demand=(0,), served_by="either") for each in customers[:3])
    b = replace(b, demand=(demand,), pickup=(pickup,))
    problem = replace(tiny_problem(a, b, c, truck=replace(truck, lifo=True)),
                      shipments=(Shipment("x", 1, 3, (1000,)),))
    assert codes(judged(problem, TripDecision(nodes, start=0))) == broken


def test_a_stack_has_pickups_on_what_leaves_later(tiny_problem, customers, truck):
    a, b = (replace(each, pickup=(1000,)) for each in customers[:2])
    problem = tiny_problem(a, b, truck=replace(truck, lifo=True))
    assert codes(judged(problem, TripDecision((0, 1, 2, 0), start=0))) == ["LIFO"]
    behind = replace(b, demand=(0,))
    assert codes(judged(tiny_problem(a, behind, truck=replace(truck, lifo=True)),
                        TripDecision((0, 1, 2, 0), start=0))) == []


def test_drones_parcels_are_on_their_trucks_stack(tiny_problem, customers, truck, drones):
    a, b, c, d = (replace(each, demand=(0,)) for each in customers)
    carrier = replace(truck, lifo=True, drones=drones)
    shipped = (Shipment("x", 1, 2, (1000,)),)
    for parcel in {"demand": (1000,)}, {"pickup": (1000,)}:
        problem = replace(tiny_problem(a, b, replace(c, **parcel), d, truck=carrier),
                          shipments=shipped)
        assert codes(judged(problem, TripDecision((0, 1, 2, 0), (C_FROM_A,), start=0))) == []
    for parcel in {"demand": (1000,)}, {"pickup": (1000,)}:
        problem = replace(tiny_problem(a, b, replace(c, **parcel), d, truck=carrier),
                          shipments=(Shipment("x", 1, 4, (1000,)),))
        flown = SortieDecision((3,), 2, 2)
        assert codes(judged(problem, TripDecision((0, 1, 2, 4, 0), (flown,), start=0))) == ["LIFO"]


@pytest.mark.parametrize(("nodes", "sortie", "broken"), [
    ((0, 1, 2, 0), SortieDecision((3,), 2, 2), []), ((0, 1, 2, 0), SortieDecision((3,), 2, 3), []),
    ((0, 2, 1, 0), SortieDecision((3,), 1, 2), ["PAIR"]),
    ((0, 2, 0), SortieDecision((3,), 1, 2), ["PAIR"]),  # never
    ((0, 2, 3, 0), SortieDecision((1,), 1, 2), ["PAIR"]),  # as it comes aboard it should leave
    ((0, 3, 2, 0), SortieDecision((1,), 0, 1), ["PAIR"])])
def test_drones_deliver_what_is_aboard(tiny_problem, customers, truck, drones, nodes, sortie,
                                       broken):
    a, b, c = (replace(each, demand=(0,), served_by="either") for each in customers[:3])
    problem = replace(tiny_problem(a, b, c, truck=replace(truck, drones=drones)), shipments=FLOWN)
    trip = TripDecision(nodes, (sortie,), start=0)
    evaluation = judged(problem, trip)
    assert sorted({code for code in codes(evaluation) if code == "PAIR"}) == broken
    if not broken:
        measured = evaluation.routes[0].trips[0]
        assert codes(evaluation) == []
        assert measured.stop_loads == ((0,), (1000,), (0,), (0,))
        assert measured.sorties[0].loads == ((1000,), (0,))
        weak = replace(drones, capacity=(999,))
        few = tiny_problem(a, b, c, truck=replace(truck, drones=weak))
        assert codes(judged(replace(few, shipments=FLOWN), trip)) == ["PAYLOAD"]
        timed = (replace(FLOWN[0], max_time_between=1),)
        assert codes(judged(replace(problem, shipments=timed), trip)) == ["TIME_BETWEEN"]


@pytest.mark.parametrize(("nodes", "sortie", "loads"), [
    ((0, 2, 3, 0), SortieDecision((1,), 0, 1), [0, 1, 0, 0]),
    ((0, 2, 3, 0), SortieDecision((1,), 1, 1), [0, 1, 0, 0]),
    ((0, 3, 0), SortieDecision((1,), 0, 0), [1, 0, 0])])
def test_what_drones_fetch_is_aboard_once_they_are_recovered(tiny_problem, customers, truck, drones,
                                                             nodes, sortie, loads):
    a, b, c = (replace(each, demand=(0,), served_by="either") for each in customers[:3])
    problem = replace(tiny_problem(a, b, c, truck=replace(truck, drones=drones)), shipments=FLOWN)
    trip = TripDecision(nodes, (sortie,), start=0)
    evaluation = judged(problem, trip)
    measured = evaluation.routes[0].trips[0]
    assert {code for code in codes(evaluation) if code != "UNSERVED"} == set()
    assert [load for load, in measured.stop_loads] == [1000 * load for load in loads]
    assert measured.sorties[0].loads == ((0,), (1000,))
    weak = replace(drones, capacity=(999,))
    few = tiny_problem(a, b, c, truck=replace(truck, drones=weak))
    assert "PAYLOAD" in codes(judged(replace(few, shipments=FLOWN), trip))
    small = tiny_problem(a, b, c, truck=replace(truck, drones=drones, capacity=(999,)))
    assert "CAPACITY" in codes(judged(replace(small, shipments=FLOWN), trip))
    timed = (replace(FLOWN[0], max_time_between=1),)
    assert "TIME_BETWEEN" in codes(judged(replace(problem, shipments=timed), trip))


@pytest.mark.parametrize("recovery", [1, 2])
def test_a_drone_leaves_with_what_is_picked_up_at_its_stop(tiny_problem, customers, truck, drones,
                                                           recovery):
    """It does so as service ends there; another is launched as the truck arrives."""
    a, b, c, d = (replace(each, demand=(0,), served_by="either") for each in customers)
    two = replace(truck, drones=replace(drones, count=2, launch_duration=60_000))
    problem = replace(tiny_problem(a, b, c, d, truck=two), shipments=FLOWN)
    decision = TripDecision((0, 1, 2, 0), (
        SortieDecision((3,), 1, recovery), SortieDecision((4,), 1, 2, 1)), (
            (), (Operation(1, True), Operation(0, True), *(
                (Operation(0, False),) if recovery == 1 else ())),
            (*((Operation(0, False),) if recovery == 2 else ()), Operation(1, False)), ()), 0)
    evaluation = judged(problem, decision)
    assert codes(evaluation) == []
    assert evaluation.routes[0].trips[0].stop_loads == ((0,),) * 4
    trip = schedule(problem, RouteDecision(0, 0, (decision,))).trips[0]
    served = trip.stops[1].service_start + a.service_duration
    assert trip.sorties[0].launch_time == served + 60_000
    assert trip.sorties[1].launch_time == trip.stops[1].arrival + 60_000
    sooner = replace(trip, sorties=(replace(
        trip.sorties[0], launch_time=served + 59_999), trip.sorties[1]))
    stated = check(problem, Solution((Route(0, 0, (sooner,)),)))
    assert "TIME_MISMATCH" in codes(stated)


def test_it_is_known_that_a_drone_could_leave_from_the_pickup(tiny_problem, customers, truck,
                                                              drones):
    """No truck comes to the delivery, and from the depots it is too far to be flown to in time."""
    a, b = (replace(each, demand=(0,), served_by=by, service_duration=0) for each, by
            in zip(customers[1:3], ("truck", "drone"), strict=True))
    far = tiny_problem(a, b, truck=truck).travel[1].duration
    leg, from_depot = far.item(1, 2), far.item(0, 2)
    assert leg < from_depot
    for endurance, is_possible in ((2 * leg, True), (2 * leg - 1, False)):
        flying = replace(truck, drones=replace(drones, endurance=endurance))
        problem = replace(tiny_problem(a, b, truck=flying),
                          shipments=(Shipment("x", 1, 2, (1000,)),))
        reason, = explain(problem, Solution((), (1, 2)), 1)
        assert (reason.code in POSSIBLE) == is_possible


@pytest.mark.parametrize(("order", "broken"), [([(0, False), (1, True)], set()),
                                               ([(1, True), (0, False)], {"PAIR"})])
def test_a_drone_leaves_with_what_another_has_brought(tiny_problem, customers, truck, drones,
                                                      order, broken):
    a, b, c = (replace(each, demand=(0,), served_by="either") for each in customers[:3])
    two = replace(truck, drones=replace(drones, count=2, recovery_duration=60_000))
    problem = replace(tiny_problem(a, b, c, truck=two), shipments=FLOWN)
    sorties = SortieDecision((1,), 0, 1), SortieDecision((3,), 1, 2, 1)
    evaluation = judged(problem, TripDecision((0, 2, 0), sorties, (
        (Operation(0, True),), tuple(Operation(*each) for each in order),
        (Operation(1, False),)), 0))
    assert set(codes(evaluation)) == broken


def test_no_drone_serves_an_end_whose_other_is_nowhere(tiny_problem, customers, truck, drones):
    a, b, c = (replace(each, demand=(0,), served_by="either") for each in customers[:3])
    problem = replace(tiny_problem(a, b, c, truck=replace(truck, drones=drones)), shipments=FLOWN)
    trip = TripDecision((0, 2, 0), (SortieDecision((1,), 0, 1),), start=0)
    assert "PAIR" in codes(judged(problem, trip))


def test_a_sortie_serves_both_ends(tiny_problem, customers, truck, drones):
    a, b, c = (replace(each, demand=(0,), served_by="either") for each in customers[:3])
    drones = replace(drones, max_customers_per_sortie=3, capacity=(1000,))
    truck = replace(truck, drones=drones, capacity=(0,))
    problem = replace(tiny_problem(a, b, c, truck=truck), shipments=FLOWN)
    for flown, broken in ((1, 3), set()), ((3, 1), {"PAIR"}), ((1, 2, 3), set()):
        nodes = (0, 0) if 2 in flown else (0, 2, 0)
        evaluation = judged(problem, TripDecision(
            nodes, (SortieDecision(flown, 0, len(nodes) - 1),), start=0))
        assert {*codes(evaluation)} & {"PAIR", "CAPACITY", "PAYLOAD"} == broken
        if not broken:
            measured = evaluation.routes[0].trips[0]
            assert {*measured.stop_loads} == {(0,)}
            assert measured.sorties[0].loads == (
                (0,), *((1000,) for _ in flown[1:]), (0,))
            timed = (replace(FLOWN[0], max_time_between=1),)
            assert "TIME_BETWEEN" in codes(judged(replace(problem, shipments=timed), TripDecision(
                nodes, (SortieDecision(flown, 0, len(nodes) - 1),), start=0)))
