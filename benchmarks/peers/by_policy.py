"""A policy alone as one of the solvers compared, without any search."""

import time
from functools import lru_cache

from app.serving.settings import Settings
from benchmarks.peers.answers import PeerAnswer
from benchmarks.peers.published import Published
from benchmarks.peers.tandem import plan_to_answer, problem_of
from model.engine.instance import pack
from model.planner import decoding_seconds
from model.policy.decode import DecodeConfig, Policy, decode, load_policy, prepare
from model.policy.extract import extract

SAMPLES_FOR_GREEDY = {"attention": 25, "pointer": 11}
"""How many samples cost as much as the greedy plan; those of `attention` plan only a part anew."""


@lru_cache
def _policy(name: str) -> Policy:
    return load_policy(Settings().weights_dir / name)


def config(instance: Published, seconds: float, seed: int, policy: str) -> DecodeConfig:
    """Return how many plans to draw in about `seconds`; a single one is the greedy plan."""
    greedy = decoding_seconds(instance.num_customers, None)
    samples = int(SAMPLES_FOR_GREEDY[policy] * (seconds / greedy - 1))
    return DecodeConfig("sample", samples, seed=seed) if samples > 1 else DecodeConfig(most_views=1)


def solve(instance: Published, seconds: float, seed: int, policy: str) -> PeerAnswer:
    """Plan an instance by a policy in about `seconds`, but at least greedily."""
    problem = problem_of(instance)
    loaded = _policy(policy)
    began = time.perf_counter()
    packed = pack([problem])
    scene = prepare(problem, packed)
    decoded = decode(loaded, scene, config(instance, seconds, seed, policy))
    solution = extract(problem, packed, decoded.actions)
    return plan_to_answer(solution, time.perf_counter() - began)
