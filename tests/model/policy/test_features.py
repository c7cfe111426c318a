"""Tests of what a policy sees."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from model.engine.instance import pack
from model.policy.decision_features import (
    ACTION, NUM_ACTION_FEATURES, VEHICLE_STATE, Observation, Rollouts, Scene,
)
from model.policy.problem_features import NODE, TYPE, Float32Array, Tokens, scales, tokens
from model.problem import (
    Break, DrivingRules, IncompatibleGoods, Overtime, Problem, Relation, Shipment,
)
from model.simulation.actions import DRIVE, OPEN, RETURN, apply, encode_action
from tests.conftest import MINUTE
from tests.model.rollouts import Batch, Units, in_other_units, random_problems, roll
from tests.model.tiny import draw_tiny, with_energy
from tests.seeds import often
from training.instances import ALL, generate

pytestmark = pytest.mark.slow

TOLERANCE = 1e-5
SIGNED = {
    "detour",  # may be a short cut where the triangle inequality fails
    "next_excess",  # the way to the next customer may be shorter than the way from here
    "detour_before",
}
SIGNED_STATE = {"spare_reserve"}  # the capacity left may fall short of the demand left


@pytest.fixture(scope="module")
def problems() -> list[Problem]:
    return random_problems(seed=33, count=often(160), variants=ALL)


@pytest.fixture(scope="module")
def alone(problems: list[Problem]) -> list[Batch]:
    return [roll([problem], seed=4) for problem in problems]


def test_tokens_are_finite_and_bounded(alone: list[Batch]) -> None:
    for batch in alone:
        assert np.isfinite(batch.tokens.node).all()
        signed = np.isin(NODE.names or (), ("x", "y", "partner_x", "partner_y"))
        assert (np.abs(batch.tokens.node[..., signed]) <= 1).all()
        others = batch.tokens.node[..., ~signed]
        assert ((others >= 0) & (others <= 2)).all()
        assert ((batch.tokens.type >= 0) & (batch.tokens.type <= 2)).all()


def test_features_are_finite_and_bounded(alone: list[Batch]) -> None:
    steps = [step for batch in alone for step in batch.rollouts[0].steps]
    action = np.concatenate([step.feature for step in steps])
    state = np.stack([step.glob for step in steps])
    for values, kind, signed in ((action, ACTION, SIGNED), (state, VEHICLE_STATE, SIGNED_STATE)):
        assert (np.abs(values) <= 5).all()
        rows = values.view(kind)
        for name in set(kind.names or ()) - signed:
            assert (rows[name] >= 0).all(), name


def test_every_action_feature_tells_actions_apart(alone: list[Batch]) -> None:
    action = np.concatenate([step.feature for batch in alone for step in batch.rollouts[0].steps])
    assert action.shape[1] == NUM_ACTION_FEATURES
    assert (action.std(axis=0) > 0.01).all()


def test_each_action_has_one_kind_and_its_token(problems: list[Problem],
                                                alone: list[Batch]) -> None:
    for problem, batch in zip(problems, alone, strict=True):
        for step in batch.rollouts[0].steps:
            codes = np.array(step.codes)
            assert (step.feature[:, :4].argmax(axis=1) == codes % 4).all()
            assert (step.feature[:, :4].sum(axis=1) == 1).all()
            offset = np.where(codes % 4 == OPEN, problem.num_nodes, 0)
            assert (np.array(step.token) == codes // 4 + offset).all()


@pytest.mark.thorough_after(2)
@pytest.mark.parametrize("units", [Units(length=2), Units(time=4), Units(amount=8),
                                   Units(money=0.25)], ids=str)
def test_features_are_free_of_units(problems: list[Problem], alone: list[Batch],
                                    units: Units) -> None:
    for problem, batch in zip(problems, alone, strict=True):
        if units.time > 1 and (problem.limits_time_between or any(
                kind.speed_profile or (kind.drones and kind.drones.energy)
                for kind in problem.vehicle_types)):
            continue  # legs, detours and how long a battery lasts are rounded to a millisecond
        other = roll([in_other_units(problem, units)], seed=4)
        np.testing.assert_allclose(other.tokens.node, batch.tokens.node, atol=TOLERANCE)
        np.testing.assert_allclose(other.tokens.type, batch.tokens.type, atol=TOLERANCE)
        assert other.rollouts[0].actions == batch.rollouts[0].actions
        for step, same in zip(batch.rollouts[0].steps, other.rollouts[0].steps, strict=True):
            assert step.codes == same.codes
            np.testing.assert_allclose(same.feature, step.feature, atol=TOLERANCE)
            np.testing.assert_allclose(same.glob, step.glob, atol=TOLERANCE)


def test_padding_has_no_effect(problems: list[Problem], alone: list[Batch]) -> None:
    for first in range(0, len(problems), 16):
        together = roll(problems[first : first + 16], seed=4)
        width = together.instance.node.shape[2]
        for row, one in enumerate(alone[first : first + 16]):
            nodes, kinds = one.tokens.node.shape[1], one.tokens.type.shape[1]
            np.testing.assert_array_equal(together.tokens.node[row, :nodes], one.tokens.node[0])
            np.testing.assert_array_equal(together.tokens.type[row, :kinds], one.tokens.type[0])
            assert not together.tokens.node[row, nodes:].any()
            assert not together.tokens.type[row, kinds:].any()
            assert not together.tokens.mask[row, nodes:width].any()
            assert together.tokens.mask[row].sum() == nodes + kinds
            same, alone_steps = together.rollouts[row], one.rollouts[0]
            assert same.actions == alone_steps.actions
            np.testing.assert_array_equal(same.cost, alone_steps.cost)
            for step, packed in zip(alone_steps.steps, same.steps, strict=True):
                assert packed.codes == step.codes
                assert packed.here == step.here
                np.testing.assert_array_equal(packed.feature, step.feature)
                np.testing.assert_array_equal(packed.glob, step.glob)


def test_company_is_the_unserved_customers_nearby(tiny_problem, customers, truck) -> None:
    problem = tiny_problem(*customers, truck=truck, places=(0.0, 1.0, 2.0, 4.0, 8.0))
    instance = pack([problem])
    scale = scales(instance)
    assert scale.near[0] == 2 * 2 * MINUTE  # neighbours are 1, 1, 2, 4 km away, 2 minutes a km
    types = tokens(instance, scale, problem.coordinates[None]).type
    rollouts = Rollouts(Scene(instance, scale, types), np.zeros(1, np.int64))
    seen = rollouts.seen
    for action in (encode_action(OPEN, 0), encode_action(DRIVE, 2)):
        apply(instance, rollouts.state, 0, action)
    rollouts.observe()
    names = ("next_way", "third_way", "next_excess")
    of_node = {int(code) // 4: [seen.described[name][0, index] for name in names] for index, code
               in enumerate(seen.action[0, :seen.count[0]]) if code % 4 == DRIVE}
    # From 2 km: customer 1 has 4 km (3 away) next and nobody third but 8 km (7 away).
    np.testing.assert_allclose(of_node[1], [3 / 5, 7 / 9, (3 - 1) / 2 / 3], rtol=1e-6)
    np.testing.assert_allclose(of_node[3], [3 / 5, 4 / 6, (3 - 2) / 2 / 3], rtol=1e-6)
    np.testing.assert_allclose(of_node[4], [4 / 6, 7 / 9, (4 - 6) / 2 / 3], rtol=1e-6)


def test_a_battery_is_seen_as_how_long_it_lasts() -> None:
    rng = np.random.default_rng(4)
    problem = with_energy(rng, draw_tiny(rng, drone_share=1.0))
    kind = problem.vehicle_types[0]
    assert kind.drones is not None
    assert kind.drones.energy is not None
    lasts = kind.drones.energy.available // kind.drones.energy.cruise[0]
    enduring = replace(kind.drones, energy=None, endurance=min(lasts, kind.drones.endurance))
    other = replace(problem, vehicle_types=(replace(kind, drones=enduring),
                                            *problem.vehicle_types[1:]))
    seen = [tokens(instance, scales(instance), problem.coordinates[None]).type
            for instance in (pack([problem]), pack([other]))]
    assert (seen[0][0, 0] == seen[1][0, 0]).all()


def mirrored(problem: Problem) -> Problem:
    """Return the problem in which everything that was to be delivered is picked up."""
    return replace(problem, customers=tuple([
        replace(customer, demand=(0,) * len(customer.demand), pickup=customer.demand)
        for customer in problem.customers]))


def test_what_is_picked_up_is_seen_as_what_is_delivered_and_told_apart() -> None:
    rng = np.random.default_rng(3)
    for variant in ("cvrp", "hetero", "multitrip"):
        problem = generate(rng, 12, variant)
        one, other = (roll([each], seed=5) for each in (problem, mirrored(problem)))
        apart = (one.tokens.node != other.tokens.node).any(axis=(0, 1))
        assert np.array(NODE.names)[apart].tolist() == ["pickup_share"]
        np.testing.assert_array_equal(one.tokens.type, other.tokens.type)
        steps, mirror = one.rollouts[0].steps, other.rollouts[0].steps
        assert [step.codes for step in steps] == [step.codes for step in mirror]
        for step, same in zip(steps, mirror, strict=True):
            np.testing.assert_array_equal(step.feature, same.feature)
            np.testing.assert_array_equal(step.glob, same.glob)


def tokens_of(problem: Problem) -> Tokens:
    """Return what the encoder sees."""
    instance = pack([problem])
    return tokens(instance, scales(instance), problem.coordinates[None])


def column(tokens: Float32Array, kind: np.dtype[np.record], name: str) -> Float32Array:
    """Return a feature of all tokens of the first problem."""
    found: Float32Array = tokens[0].view(kind)[name][:, 0]
    return found


def told_apart(one: Problem, other: Problem) -> tuple[dict[str, list[int]], list[str]]:
    """Return the features that differ, of nodes with the nodes where they do, and of types."""
    seen, also = tokens_of(one), tokens_of(other)
    np.testing.assert_array_equal(seen.pair, also.pair)
    node, kind = seen.node[0] != also.node[0], seen.type[0] != also.type[0]
    return ({name: np.flatnonzero(node[:, column]).tolist()
             for column, name in enumerate(NODE.names or ()) if node[:, column].any()},
            [name for column, name in enumerate(TYPE.names or ()) if kind[:, column].any()])


@pytest.mark.parametrize(("asked", "name"), [
    ({"unassigned_cost": 7.0}, "unassigned_cost"),
    ({"pickup": (500,)}, "pickup_share"),
    ({"gaps": ((20 * MINUTE, 40 * MINUTE),)}, "between_windows"),
    ({"max_time_aboard": 30 * MINUTE}, "max_time_aboard"),
], ids=lambda asked: "-".join(asked) if isinstance(asked, dict) else "")
def test_what_few_customers_ask_for_is_seen_of_them_alone(
        tiny_problem, customers, truck, asked: dict[str, Any], name: str) -> None:
    windowed = [replace(each, latest=60 * MINUTE) for each in customers]
    others = replace(windowed[1], **asked), *windowed[2:]
    one = tiny_problem(*windowed, truck=truck)
    other = tiny_problem(windowed[0], *others, truck=truck)
    assert told_apart(one, other) == ({name: [2]}, [])


def test_goods_kept_apart_are_seen(tiny_problem, customers, truck) -> None:
    goods = ("food", "paint", "food", "soap")
    problem = tiny_problem(*[replace(each, goods=frozenset({name}))
                             for each, name in zip(customers, goods, strict=True)], truck=truck)
    entry = IncompatibleGoods(frozenset({"food", "paint"}))
    apart = replace(problem, incompatible_goods=(entry,))
    assert told_apart(problem, apart) == ({"barred": [1, 2, 3]}, [])
    barred = column(tokens_of(apart).node, NODE, "barred")
    assert barred[1:] == pytest.approx([1 / 4, 2 / 4, 1 / 4, 0])


def test_setups_are_seen(tiny_problem, customers, truck) -> None:
    a, *others = customers
    problem = tiny_problem(replace(a, setup_duration=10 * MINUTE), *others, truck=truck)
    nodes = column(tokens_of(problem).node, NODE, "setup")
    assert nodes[1] > 0
    assert not nodes[2:].any()


@pytest.mark.parametrize(("given", "names"), [
    ({"end": 1}, ["way_back"]),
    ({"overtime": Overtime(5.0, 40 * MINUTE)}, ["overtime_price", "overtime"]),
    ({"cost_per_stop": 2.0}, ["per_stop"]),
    ({"cost_per_load_km": 0.1}, ["per_load"]),
    ({"max_stops": 3}, ["max_stops"]),
    ({"max_sorties": 2}, ["max_sorties"]),
    ({"pickups": "last"}, ["pickup_order"]),
    ({"reload_depots": (1,), "max_trips": 2}, ["max_trips", "other_depots"]),
], ids=lambda given: "-".join(given) if isinstance(given, dict) else "")
def test_what_few_vehicles_are_given_is_seen(
        tiny_problem, customers, truck, drones, given: dict[str, Any],
        names: list[str]) -> None:
    kind = replace(truck, latest=300 * MINUTE, cost_per_km=1.0, drones=drones)
    one, other = (tiny_problem(*customers, truck=each, num_depots=2, places=(0, 9, 1, 2, 3, 4))
                  for each in (kind, replace(kind, **given)))
    assert told_apart(one, other) == ({}, names)


def test_where_a_vehicle_begins_is_seen(tiny_problem, customers, truck) -> None:
    one, other = (tiny_problem(*customers, truck=each, num_depots=2, places=(0, 9, 1, 2, 3, 4))
                  for each in (truck, replace(truck, start=1)))
    begin, elsewhere = (column(tokens_of(problem).type, TYPE, "way_out")[0]
                        for problem in (one, other))
    assert begin != elsewhere


def test_handling_of_drones_is_seen(tiny_problem, customers, truck, drones) -> None:
    one, other = (tiny_problem(*customers, truck=replace(truck, drones=each))
                  for each in (drones, replace(drones, swap_duration=3 * MINUTE)))
    assert told_apart(one, other) == ({}, ["handling"])


def test_overtime_is_seen_as_no_longer_shift() -> None:
    problem = generate(np.random.default_rng(8), 12, "multitrip")
    longer = replace(problem, vehicle_types=tuple([
        replace(kind, overtime=Overtime(1.0)) for kind in problem.vehicle_types]))
    assert told_apart(problem, longer) == ({}, ["overtime_price", "overtime"])


def seen_after(problem: Problem, *visited: int) -> Observation:
    """Return what is seen once the first vehicle has been opened and has driven to some."""
    instance = pack([problem])
    scale = scales(instance)
    types = tokens(instance, scale, problem.coordinates[None]).type
    rollouts = Rollouts(Scene(instance, scale, types), np.zeros(1, np.int64))
    for action in (encode_action(OPEN, 0), *(encode_action(DRIVE, node) for node in visited)):
        apply(instance, rollouts.state, 0, action)
    rollouts.observe()
    return rollouts.seen


def described(seen: Observation, kind: int, name: str) -> dict[int, float]:
    """Return a feature of all candidates of a kind, by their target."""
    return {int(code) // 4: float(seen.described[name][0, index]) for index, code
            in enumerate(seen.action[0, :seen.count[0]]) if code % 4 == kind}


def first_drives(problem: Problem, name: str) -> list[float]:
    """Return a feature of the drives of the first vehicle, which has just been opened."""
    return list(described(seen_after(problem), DRIVE, name).values())


def test_time_aboard_and_stops_are_seen_as_slack_and_load(tiny_problem, customers, truck) -> None:
    a, *others = customers
    fresh = replace(a, max_time_aboard=3 * MINUTE)
    # Places are 5 minutes away in the mean; a is served after 2.
    scale, first = 5 * MINUTE, first_drives(tiny_problem(fresh, *others, truck=truck),
                                            "window_slack")[0]
    assert first == pytest.approx(MINUTE / (MINUTE + scale), rel=1e-6)
    few = tiny_problem(*customers, truck=replace(truck, max_stops=3))
    assert first_drives(few, "load_share") == pytest.approx([1 / 3] * 4)
    assert first_drives(few, "capacity_share") == pytest.approx([1 / 3] * 4)


def with_one_shipment(problem: Problem, pickup: int, delivery: int, **limits: int) -> Problem:
    """Return a problem two of whose customers are a shipment's ends."""
    customers = list(problem.customers)
    for node in (pickup, delivery):
        customers[node - 1] = replace(customers[node - 1], demand=(0,), unassigned_cost=(
            0.0 if node == delivery else None))
    return replace(problem, customers=tuple(customers),
                   shipments=(Shipment("s", pickup, delivery, (500,), **limits),))


def test_ends_of_shipments_are_seen(tiny_problem, customers, truck) -> None:
    plain = tiny_problem(*customers, truck=truck)
    problem = with_one_shipment(plain, 1, 3)
    nodes = tokens_of(problem).node
    assert column(nodes, NODE, "is_pickup").tolist() == [0, 1, 0, 0, 0]
    assert column(nodes, NODE, "is_delivery").tolist() == [0, 0, 0, 1, 0]
    x, away = column(nodes, NODE, "x"), column(nodes, NODE, "partner_x")
    assert away[[1, 3]] == pytest.approx([(x[3] - x[1]) / 2, (x[1] - x[3]) / 2])
    assert (column(nodes, NODE, "share_of_demand") <= 1).all()
    # Customers 1 and 3 are 2 km, so 4 minutes, apart; places are 5 minutes away in the mean.
    way = described(seen_after(problem), DRIVE, "delivery_way")
    assert way == pytest.approx({1: 4 / 9, 2: 0, 4: 0})
    later = seen_after(problem, 1)
    assert described(later, DRIVE, "delivers") == {2: 0, 3: 1, 4: 0}
    assert later.vehicle["aboard"][0] == pytest.approx(0.5 / (truck.capacity[0] / 1000))


def test_time_under_way_is_seen_as_slack(tiny_problem, customers, truck) -> None:
    problem = with_one_shipment(tiny_problem(*customers, truck=truck), 1, 3,
                                max_time_between=9 * MINUTE)
    # 4 of 9 minutes are driven; 5 are left, as long as the scale.
    assert described(seen_after(problem), DRIVE, "delivery_hurry")[1] == pytest.approx(0.5)
    assert described(seen_after(problem, 1), DRIVE, "window_slack")[3] == pytest.approx(0.5)


def test_other_places_and_prices_by_vehicle_are_seen(tiny_problem, customers, truck) -> None:
    a, b, *others = customers
    plain = tiny_problem(replace(a, unassigned_cost=40.0), replace(b, unassigned_cost=0.0), *others,
                         truck=replace(truck, cost_per_km=2.0))
    problem = replace(plain, choices=((1, 2),), vehicle_costs=np.array([[0.0, 5.0, 0.0, 0.0]]))
    nodes = tokens_of(problem).node
    assert column(nodes, NODE, "other_places").tolist() == [0, 0.5, 0.5, 0, 0]
    left_out = column(nodes, NODE, "unassigned_cost")
    assert left_out[1] == left_out[2] > 0
    # To drive to a customer costs 5 in the mean.
    assert column(nodes, NODE, "price").tolist() == [0, 0, 0.5, 0, 0]
    assert described(seen_after(problem), DRIVE, "price") == {1: 0, 2: 0.5, 3: 0, 4: 0}


def test_company_is_seen_of_who_is_kept_with_somebody(tiny_problem, customers, truck) -> None:
    plain = tiny_problem(*customers, truck=truck)
    problem = replace(plain, relations=(Relation("together", (1, 3)), Relation("before", (2, 4))))
    nodes = tokens_of(problem).node
    assert column(nodes, NODE, "kept") == pytest.approx([0, 0.25, 0.25, 0.25, 0.25])
    # Who serves 4 first serves 2 no more.
    assert described(seen_after(problem), DRIVE, "forsaken") == pytest.approx(
        {1: 0, 2: 0, 3: 0, 4: 1 / 3})
    seen = seen_after(problem, 1)
    assert described(seen, DRIVE, "joins") == {2: 0, 3: 1, 4: 0}
    assert list(described(seen, RETURN, "forsaken").values()) == pytest.approx([1 / 3])
    assert seen.vehicle["bound"][0] == pytest.approx(1 / 3)


def test_rests_are_seen(tiny_problem, customers, truck) -> None:
    rules = DrivingRules(max_driving=5 * MINUTE, rest=2 * MINUTE)
    resting = tiny_problem(*customers, truck=replace(truck, driving=rules))
    # Of 5 minutes, 2 are driven to the first; 4 lie before the third.
    seen = seen_after(resting, 1)
    assert seen.vehicle["rest_due"][0] == pytest.approx(5 / 8)
    assert described(seen, DRIVE, "rest") == pytest.approx({2: 0, 3: 2 / 7, 4: 2 / 7})
    pause = Break("lunch", 3 * MINUTE, 0, 12 * MINUTE)
    pausing = tiny_problem(*customers, truck=replace(truck, breaks=(pause,)))
    assert seen_after(pausing, 1).vehicle["rest_due"][0] == pytest.approx(0.5)
    assert told_apart(resting, pausing) == ({}, ["breaks", "driving_limit"])


def test_long_legs_are_seen_as_long_work(tiny_problem, customers, truck) -> None:
    plain, limited = (tiny_problem(*customers, truck=replace(truck, max_travel_duration=limit))
                      for limit in (None, 9 * MINUTE))
    assert told_apart(plain, limited) == ({}, ["usual_working"])
    assert described(seen_after(limited), DRIVE, "working_slack")[1] == pytest.approx(0.5)
