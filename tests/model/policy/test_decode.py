"""Decoding by the committed policies."""

import os
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from model.judge.check import check
from model.engine.alarm import Alarm
from model.engine.instance import pack
from model.policy import rolling
from model.policy.decode import (
    BLOCK, SYMMETRIES, DecodeConfig, Policy, decode, disturbed, encode, laid_out, load_policy,
    prepare,
)
from model.policy.network import MASKED
from model.policy.rolling import CLIP, NOTHING, choose
from model.problem import Problem
from model.policy.extract import extract
from training.instances import VARIANTS, generate

WEIGHTS = Path(__file__).parents[3] / "model" / "weights"


@pytest.fixture(scope="module", params=sorted(folder.name for folder in WEIGHTS.iterdir()))
def policy(request: pytest.FixtureRequest) -> Policy:
    return load_policy(WEIGHTS / request.param)


@pytest.fixture(scope="module")
def problem() -> Problem:
    return generate(np.random.default_rng(8), 25, "drone")


def plan(policy: Policy, problem: Problem, config: DecodeConfig,
         deadline: float | None = None) -> tuple[tuple[int, ...], float]:
    decoded = decode(policy, prepare(problem, pack([problem])), config, deadline)
    return tuple(decoded.actions.tolist()), decoded.cost


def test_cost_of_the_rollout_is_the_checkers(policy: Policy, problem: Problem) -> None:
    for config in (DecodeConfig(), DecodeConfig("sample", 10)):
        actions, cost = plan(policy, problem, config)
        evaluation = check(problem, extract(problem, pack([problem]), actions))
        assert not evaluation.violations
        assert evaluation.cost.total == pytest.approx(cost, rel=1e-9)


def test_same_seed_gives_the_same_plan(policy: Policy, problem: Problem) -> None:
    config = DecodeConfig("sample", BLOCK + 3, seed=11)
    assert plan(policy, problem, config) == plan(policy, problem, config)


def test_other_seeds_give_other_plans(policy: Policy, problem: Problem) -> None:
    plans = {plan(policy, problem, DecodeConfig("sample", 1, seed=seed))[0] for seed in range(5)}
    assert len(plans) > 1


def test_more_samples_are_never_worse(policy: Policy, problem: Problem) -> None:
    costs = [plan(policy, problem, DecodeConfig("sample", blocks * BLOCK))[1] for blocks in (1, 2)]
    assert costs[1] <= costs[0]


def test_cold_samples_follow_the_greedy_plan(policy: Policy, problem: Problem) -> None:
    assert (plan(policy, problem, DecodeConfig("sample", 1, temperature=1e-4))
            == plan(policy, problem, DecodeConfig(most_views=1)))


@pytest.mark.thorough_after(1)
def test_views_and_routes_of_all_samples_make_plans_cheaper(policy: Policy) -> None:
    costs = np.zeros((6, 3))
    for number, row in enumerate(costs):
        problem = generate(np.random.default_rng(number), 30, "vrptw")
        scene = prepare(problem, pack([problem]))
        drawn = DecodeConfig("sample", 40)
        row[:] = [decode(policy, scene, config).cost
                  for config in (DecodeConfig(most_views=1), DecodeConfig(), drawn)]
        assert row[0] >= row[1] >= row[2]
    assert (np.diff(np.log(costs).mean(axis=0)) < -0.005).all()


def test_samples_are_drawn_less_widely_where_drones_fly(monkeypatch: pytest.MonkeyPatch) -> None:
    policy = load_policy(WEIGHTS / "attention")
    flown, driven = (generate(np.random.default_rng(5), 20, name) for name in ("drone", "cvrp"))
    both = [plan(policy, problem, DecodeConfig("sample", 20)) for problem in (flown, driven)]
    cooler = rolling.HOTTER_WITH_DRONES / rolling.HOTTER
    monkeypatch.setattr(rolling, "HOTTER_WITH_DRONES", rolling.HOTTER)
    assert plan(policy, flown, DecodeConfig("sample", 20)) != both[0]
    assert plan(policy, flown, DecodeConfig("sample", 20, temperature=cooler)) == both[0]
    assert plan(policy, driven, DecodeConfig("sample", 20)) == both[1]


@pytest.mark.parametrize("config", [DecodeConfig(), DecodeConfig("sample", 40)])
def test_nobody_is_served_where_nothing_can_be_carried(policy: Policy, problem: Problem,
                                                       config: DecodeConfig) -> None:
    small = replace(problem, vehicle_types=tuple(
        replace(kind, capacity=(0,) * len(kind.capacity)) for kind in problem.vehicle_types))
    decoded = decode(policy, prepare(small, pack([small])), config)
    assert len(decoded.actions) == 0
    assert decoded.cost == pytest.approx(small.num_customers * small.unassigned_cost)


def test_one_block_is_planned_even_past_the_deadline(policy: Policy, problem: Problem) -> None:
    late = time.perf_counter() - 1
    only_first = plan(policy, problem, DecodeConfig("sample", 3 * BLOCK), late)
    assert only_first[1] >= plan(policy, problem, DecodeConfig("sample", 3 * BLOCK))[1]


@pytest.mark.parametrize("config", [DecodeConfig("sample", 0),
                                    DecodeConfig("sample", 4, temperature=0.0)])
def test_meaningless_sampling_is_refused(policy: Policy, problem: Problem,
                                         config: DecodeConfig) -> None:
    with pytest.raises(ValueError, match="num_samples, temperature"):
        plan(policy, problem, config)


def test_draws_follow_the_probabilities_and_never_what_is_masked() -> None:
    logits = np.log(np.array([[0.7, 0.3, 0.0]], np.float32) + 1e-30).repeat(20_000, axis=0)
    logits[:, 2] = MASKED
    noise = np.random.default_rng(0).standard_exponential(logits.shape, np.float32)
    noise[0] = [1.0, 1.0, 0.0]
    warmth = np.ones((len(logits), 1), np.float32)
    drawn = np.bincount(disturbed(logits, warmth, noise).argmax(axis=1), minlength=3)
    assert drawn[2] == 0
    assert drawn[0] / len(logits) == pytest.approx(0.7, abs=0.02)


@pytest.mark.thorough_after(3)
@pytest.mark.parametrize("temperature", [0.1, 0.5, 1.0, 3.0])
@pytest.mark.parametrize("count", [1, 3, 16, 40])
def test_draws_of_the_engine_follow_the_probabilities(count: int, temperature: float) -> None:
    scores = np.random.default_rng(3).normal(-1.0, 1.0, count).astype(np.float32)
    weight = np.exp(CLIP * np.tanh(scores.astype(np.float64) * 2 / CLIP) / temperature)
    random, number = np.array([7], np.uint64), 20_000
    drawn = [choose(scores, temperature, random) for _ in range(number)]
    share = np.bincount(drawn, minlength=count) / number
    assert share == pytest.approx(weight / weight.sum(), abs=0.015)


def test_nothing_is_drawn_without_temperature() -> None:
    random = np.array([7], np.uint64)
    assert choose(np.array([0.1, 2.0, 0.3, 2.0], np.float32), 0.0, random) == 1
    assert random[0] == 7


@pytest.mark.thorough_after(3)
@pytest.mark.parametrize("variant", VARIANTS)
def test_rollouts_of_the_engine_and_the_graph_plan_the_same(variant: str) -> None:
    policy = load_policy(WEIGHTS / "attention")
    assert policy.step_weights is not None
    by_graph, alone = replace(policy, step_weights=None), DecodeConfig(most_views=1)
    for seed in range(3):
        problem = generate(np.random.default_rng(seed), 15, variant)
        scene = prepare(problem, pack([problem]))
        for symmetry in range(len(SYMMETRIES)):
            seen = replace(scene, tokens=laid_out(scene.tokens, symmetry))
            one, other = (decode(each, seen, alone) for each in (policy, by_graph))
            assert one.actions.tolist() == other.actions.tolist()
            assert one.cost == other.cost


def test_encoder_sees_a_token_for_each_node_and_vehicle_type(policy: Policy,
                                                             problem: Problem) -> None:
    kinds = [replace(kind, more_drones=(replace(kind.drones, id="other"),))
             for kind in problem.vehicle_types if kind.drones is not None]
    several = replace(problem, vehicle_types=tuple(kinds))
    seen = prepare(several, pack([several])).tokens
    assert len(encode(policy, seen)) == problem.num_nodes + len(kinds)


def test_missing_policy_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="policy folder"):
        load_policy(tmp_path / "nothing")


def test_runtime_is_told_to_call_nobody_before_it_is_loaded() -> None:
    program = """
import os, sys
import model
assert "onnxruntime" not in sys.modules
assert os.environ["ORT_DISABLE_TELEMETRY"] == "1"
import model.policy.decode
assert "onnxruntime" in sys.modules
"""
    environment = {name: value for name, value in os.environ.items()
                   if name != "ORT_DISABLE_TELEMETRY"}
    subprocess.run([sys.executable, "-c", program], check=True, env=environment,
                   cwd=WEIGHTS.parents[1])


def test_best_sample_is_never_worse_than_the_greedy_plan(policy: Policy) -> None:
    for seed in range(5):
        problem = generate(np.random.default_rng(seed), 20, "mixed")
        greedy = plan(policy, problem, DecodeConfig())[1]
        assert plan(policy, problem, DecodeConfig("sample", 2, temperature=50.0))[1] <= greedy


def test_symmetries_show_the_same_plane_in_eight_ways(policy: Policy, problem: Problem) -> None:
    seen = prepare(problem, pack([problem])).tokens
    memories = [encode(policy, laid_out(seen, symmetry)) for symmetry in range(len(SYMMETRIES))]
    assert len({memory.tobytes() for memory in memories}) == 8
    swapped = problem.coordinates[:, ::-1] * [1, -1]
    same = prepare(replace(problem, coordinates=swapped), pack([problem])).tokens
    assert np.array_equal(encode(policy, same), memories[SYMMETRIES.index((True, 1, -1))])


@pytest.mark.parametrize("config", [DecodeConfig(), DecodeConfig("sample", 3 * BLOCK)])
def test_rollouts_end_at_an_alarm(policy: Policy, problem: Problem, config: DecodeConfig) -> None:
    scene = prepare(problem, pack([problem]))
    assert decode(policy, scene, config, alarm=Alarm(0.0).setting) is NOTHING


def test_rollouts_go_on_until_an_alarm(policy: Policy) -> None:
    problem = generate(np.random.default_rng(8), 300, "drone")
    scene = prepare(problem, pack([problem]))
    decode(policy, scene, DecodeConfig())
    began = time.thread_time()
    with Alarm(time.perf_counter() + 0.1) as alarm:
        decode(policy, scene, DecodeConfig("sample", 100_000), alarm=alarm.setting)
    assert time.thread_time() - began < 2.0
