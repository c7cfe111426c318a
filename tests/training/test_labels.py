"""Labels say what is true, come back as they were written, and are replayed as they were made."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import torch

from model.policy.attention import AttentionConfig, AttentionPolicy
from model.simulation.actions import LAUNCH, NUM_KINDS, OPEN, RETURN
from training.completion import (
    CompletionSetting, complete, cost_of, open_type, to_actions, to_routes, what_is_left,
)
from training.deviations import go_on
from training.examples import make_lesson, places
from training.mistakes import LEAST_RISE, PATH
from training.train_by_labels import Buffer
from training.labels import (
    Labelled, Origin, Pair, draw_origin, label, label_by_trials, main, read, write, Actor, NONE,
)
from training.rollout import Simulation, make_batch

pytestmark = pytest.mark.slow

ORIGIN = Origin("uniform", 10, 3)


@pytest.fixture(scope="module")
def actor(tmp_path_factory: pytest.TempPathFactory) -> Actor:
    """Knows nothing, so that it errs often."""
    torch.manual_seed(1)
    path = tmp_path_factory.mktemp("weights") / "weights.pt"
    torch.save(AttentionPolicy(AttentionConfig()).state_dict(), path)
    return Actor(path)


@pytest.fixture(scope="module")
def labelled(actor: Actor) -> Labelled:
    return label(actor, ORIGIN)[0]


def completed(setting: CompletionSetting, actions: np.ndarray) -> float:
    """Return what a beginning is worth by a longer search from nothing."""
    rest = what_is_left(setting, actions)
    if rest is None:
        is_home = actions[-1] % NUM_KINDS == RETURN
        return cost_of(setting, actions if is_home else np.append(actions, RETURN))
    begun = open_type(actions)
    routes = complete(rest, [] if begun is None else to_routes(actions[:0], begun), 2000, 99)
    return cost_of(setting, np.concatenate([
        actions, to_actions(setting.problem, routes, begun is not None)]))


def test_better_choice_is_better(labelled: Labelled) -> None:
    setting = CompletionSetting.of(ORIGIN.problem())
    total = cost_of(setting, labelled.actions)
    assert len(labelled.pairs) > 2
    for pair in labelled.pairs:
        assert pair.rise > LEAST_RISE
        before = labelled.actions[:pair.step]
        assert pair.path[0] != labelled.actions[pair.step]
        better = completed(setting, np.append(before, pair.path[0]))
        chosen = completed(setting, labelled.actions[:pair.step + 1])
        assert chosen - better == pytest.approx(pair.rise * total, abs=0.01 * total)
        assert better < chosen


def test_lesson_sees_what_the_plan_saw(labelled: Labelled) -> None:
    lesson = make_lesson([labelled], np.random.default_rng(0), symmetric=False)
    assert lesson is not None
    batch = make_batch([ORIGIN.problem()], [""])
    simulation = Simulation(batch, range(1), 1, 1)
    choice, seen = np.zeros(1, np.int64), []
    for code in [*labelled.actions.tolist(), NONE]:
        count = simulation.step(choice)
        if code == NONE:
            break
        legal = simulation.seen.action[0, :count].tolist()
        choice[0] = legal.index(code)
        seen.append((simulation.seen.feature[0, :count].copy(), int(choice[0])))
    simulation.close()
    _, _, feature, allowed, _ = (tensor.numpy() for tensor in lesson.inputs)
    first = {pair.step: pair for pair in labelled.pairs}
    found = set[int]()
    for place in np.flatnonzero((lesson.weight[0] > 0).numpy()).tolist():
        count = int(allowed[0, place].sum())
        steps = [step for step in first if len(seen[step][0]) == count
                 and np.array_equal(seen[step][0], feature[0, place, :count])
                 and seen[step][1] == int(lesson.wrong[0, place])]
        assert len(steps) == 1
        found |= set(steps)
    assert found <= set(first)
    assert len(found) == int((lesson.weight[0] > 0).sum())


def test_choices_cost_what_they_come_to(actor: Actor) -> None:
    setting, judged = CompletionSetting.of(ORIGIN.problem()), 0
    plan = label_by_trials(actor, ORIGIN)
    for trial in plan.trials:
        before = plan.actions[:trial.step]
        for code, cost in zip(trial.codes.tolist(), trial.costs.tolist(), strict=True):
            if code != NONE and not np.isnan(cost) and code % NUM_KINDS != OPEN:
                longer = completed(setting, np.append(before, code))
                assert cost == pytest.approx(longer, rel=0.01)
                judged += 1
    assert judged > 2 * len(plan.trials) > 10


@pytest.mark.thorough
@pytest.mark.parametrize("variant", ["hetero", "drone"])
def test_types_to_open_and_flights_are_tried_too(actor: Actor, variant: str) -> None:
    trials = [trial for seed in range(4)
              for trial in label_by_trials(actor, Origin(variant, 12, seed)).trials]
    known = np.concatenate([trial.codes[~np.isnan(trial.costs)] for trial in trials])
    assert np.sum(known % NUM_KINDS == (OPEN if variant == "hetero" else LAUNCH)) > 5
    assert all(np.nanmin(trial.costs) > 0 for trial in trials)


def test_lesson_has_what_was_tried(actor: Actor) -> None:
    plan = label_by_trials(actor, ORIGIN)
    lesson = make_lesson([plan], np.random.default_rng(0), symmetric=False)
    assert lesson is not None
    assert not lesson.calm.any()
    assert not lesson.shown.any()
    found = sorted(tuple(sorted(rise[~rise.isnan()].tolist())) for rise in lesson.rise[0])
    costs = [trial.costs[~np.isnan(trial.costs)] for trial in plan.trials]
    told = sorted(tuple(sorted((cost / cost.min() - 1).tolist())) for cost in costs)
    assert len(found) == len(told)
    assert lesson.inputs[3].gather(2, lesson.tried).all()
    for one, other in zip(found, told, strict=True):
        assert one == pytest.approx(other, abs=1e-6)


@pytest.mark.parametrize("variant", ["mixed", "drone", "multitrip"])
def test_places_are_where_vehicles_decide(actor: Actor, variant: str) -> None:
    batch = make_batch([Origin(variant, 12, 5).problem()], [variant])
    actions = actor.plan(batch, 1.0, np.random.default_rng(2))
    simulation = Simulation(batch, range(1), 1, 1)
    choice, here = np.zeros(1, np.int64), []
    for code in actions.tolist():
        count = simulation.step(choice)
        choice[0] = simulation.seen.action[0, :count].tolist().index(code)
        here.append(int(simulation.seen.here[0]))
    simulation.close()
    assert here == places(batch.instance, 0, actions)[:-1].tolist()


def test_plans_are_read_as_they_were_written(actor: Actor, labelled: Labelled,
                                             tmp_path: Path) -> None:
    bare = replace(label_by_trials(actor, ORIGIN), origin=Origin("soft", 7, 8))
    write(tmp_path / "a.npz", [labelled, bare, labelled])
    plans = read(tmp_path / "a.npz")
    assert [plan.origin for plan in plans] == [ORIGIN, bare.origin, ORIGIN]
    for plan, other in zip(plans, (labelled, bare, labelled), strict=True):
        assert np.array_equal(plan.actions, other.actions)
        assert np.array_equal(plan.fine, other.fine)
        assert np.array_equal(plan.cuts, other.cuts)
        assert np.array_equal(plan.worth, other.worth)
        for mine, theirs in zip(plan.trials, other.trials, strict=True):
            assert mine.step == theirs.step
            assert np.array_equal(mine.codes, theirs.codes)
            assert np.array_equal(mine.costs, theirs.costs, equal_nan=True)
        for one, its in zip(plan.pairs, other.pairs, strict=True):
            assert one.step == its.step
            assert np.array_equal(one.path, its.path)
            assert one.rise == pytest.approx(its.rise)


def test_worth_of_beginnings_ends_at_what_the_plan_costs(labelled: Labelled) -> None:
    setting = CompletionSetting.of(ORIGIN.problem())
    assert labelled.cuts[0] == 0
    assert labelled.cuts[-1] == len(labelled.actions)
    assert labelled.worth[-1] == pytest.approx(cost_of(setting, labelled.actions))
    # What is decided can't make the best end of a plan cheaper, but for what a search misses.
    assert np.all(np.diff(labelled.worth) > -0.01 * labelled.worth[-1])
    longer = [completed(setting, labelled.actions[:cut]) for cut in labelled.cuts.tolist()]
    assert labelled.worth == pytest.approx(longer, rel=0.01)


def test_damaged_file_is_passed_over(labelled: Labelled, tmp_path: Path) -> None:
    for name in ("a", "b"):
        write(tmp_path / f"{name}.npz", [labelled])
    whole = (tmp_path / "a.npz").read_bytes()
    (tmp_path / "a.npz").write_bytes(whole[:len(whole) // 2])
    (tmp_path / "c.part").write_bytes(whole)
    buffer = Buffer(tmp_path, 10)
    buffer.refresh()
    assert len(buffer.plans) + len(buffer.held_out) == 1


@pytest.mark.thorough
def test_maker_goes_on_behind_what_is_there(tmp_path: Path) -> None:
    for _ in range(2):
        main(tmp_path, minutes=5.0, effort=0.1, max_plans=2)
    names = sorted(path.name for path in tmp_path.iterdir())
    assert names == ["001-00000.npz", "001-00001.npz"]
    first, second = (read(tmp_path / name) for name in names)
    assert {plan.origin for plan in first}.isdisjoint(plan.origin for plan in second)


def test_problems_are_of_all_sizes_and_classes() -> None:
    rng = np.random.default_rng(4)
    drawn = [draw_origin(rng) for _ in range(300)]
    assert {20 <= origin.size <= 100 for origin in drawn} == {True}
    assert len({origin.variant for origin in drawn}) == 13
    assert drawn[0].problem().num_customers == drawn[0].size


def test_path_ends_with_its_route(labelled: Labelled) -> None:
    pair: Pair = max(labelled.pairs, key=lambda pair: int((pair.path == NONE).sum()))
    codes = pair.path[pair.path != NONE]
    assert pair.path.shape == (PATH,)
    assert len(codes) > 0
    assert np.all(pair.path[len(codes):] == NONE)


def test_deviation_by_the_policy_is_better(actor: Actor) -> None:
    origin = Origin("drone", 8, 4)
    labelled = label(actor, origin)[0]
    problem = origin.problem()
    batch = make_batch([problem], [""])
    assert labelled.pairs
    for pair in labelled.pairs:
        before = labelled.actions[:pair.step]
        paths = [np.append(before, code) for code in (labelled.actions[pair.step], pair.path[0])]
        _, (chosen, better), _ = go_on(actor, batch, paths)
        assert better < chosen
