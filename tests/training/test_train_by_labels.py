"""Learning from judged decisions: pairs come into the right order, runs go on."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import torch

from training.examples import make_lesson
from training.export import WEIGHTS
from training.train_by_labels import (
    LabelConfig, LabelsLeg, LabelsRun, compare, learn, logits_of, right_order, train,
)
from training.labels import (
    NEWEST, Actor, Labelled, Origin, label, label_by_trials, read, read_policy, write,
)

pytestmark = pytest.mark.slow

EXPORTED = Path(__file__).parents[2] / "model" / "weights" / "attention"

CONFIG = LabelConfig(plans=3, problems=3, rollouts=2, learning_rate=3e-4, warm_up=1,
                      reinforce_every=3, calm=0.3)


@pytest.fixture(scope="module")
def labels(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("labels")
    actor = Actor(EXPORTED / WEIGHTS)
    write(folder / "001-00000.npz",
          [label(actor, Origin("vrptw", 14, 20 * seed + 1), 0.3)[0] for seed in range(5)])
    return folder


def plans_of(labels: Path) -> list[Labelled]:
    return read(labels / "001-00000.npz")


@pytest.mark.thorough
def test_pairs_come_into_the_right_order(labels: Path) -> None:
    plans = plans_of(labels)
    policy, old = read_policy(EXPORTED / WEIGHTS), read_policy(EXPORTED / WEIGHTS)
    optimizer = torch.optim.Adam(policy.parameters(), lr=1e-3)
    losses, before = [], right_order(policy, plans)[0]
    for _ in range(8):
        lesson = make_lesson(plans, np.random.default_rng(0), symmetric=False)
        assert lesson is not None
        loss, seen = learn(policy, old, lesson, CONFIG)
        losses.append(seen.loss)
        optimizer.zero_grad()
        loss.backward()
        optimizer.step()
    assert losses[-1] < 0.7 * losses[0]
    assert right_order(policy, plans)[0] > before + 0.3


@pytest.mark.thorough
def test_cheapest_choices_come_to_be_preferred() -> None:
    actor = Actor(EXPORTED / WEIGHTS)
    plans = [label_by_trials(actor, Origin("vrptw", 14, seed), 0.3) for seed in range(5)]
    policy = read_policy(EXPORTED / WEIGHTS)
    optimizer = torch.optim.Adam(policy.parameters(), lr=1e-3)
    losses, before = [], right_order(policy, plans)[1]
    for _ in range(12):
        lesson = make_lesson(plans, np.random.default_rng(0), symmetric=False)
        assert lesson is not None
        loss, saved = compare(logits_of(policy, lesson), lesson)
        losses.append(float(loss.detach()))
        optimizer.zero_grad()
        loss.backward()
        optimizer.step()
    assert losses[-1] < 0.5 * losses[0]
    assert before < saved <= 1
    assert right_order(policy, plans)[1] > before


def test_where_no_others_were_tried_none_are_compared(labels: Path) -> None:
    lesson = make_lesson(plans_of(labels), np.random.default_rng(0))
    assert lesson is not None
    logits = logits_of(read_policy(EXPORTED / WEIGHTS), lesson)
    assert lesson.rise.isnan().all()
    assert compare(logits, lesson)[0] == 0


def test_old_policy_is_at_no_distance_from_itself(labels: Path) -> None:
    policy = read_policy(EXPORTED / WEIGHTS)
    lesson = make_lesson(plans_of(labels), np.random.default_rng(0))
    assert lesson is not None
    assert bool(lesson.calm.any())
    assert bool(lesson.shown.any())
    assert learn(policy, policy, lesson, CONFIG)[1].calm == pytest.approx(0.0, abs=1e-5)
    logits = logits_of(policy, lesson)
    assert torch.isfinite(logits[lesson.inputs[3]]).all()


@pytest.mark.thorough
def test_resumed_run_equals_an_uninterrupted_one(labels: Path, tmp_path: Path) -> None:
    for folder, stops in (("whole", (4,)), ("parted", (2, 4))):
        for steps in stops:
            train(LabelsLeg(tmp_path / folder, labels, CONFIG, EXPORTED, max_steps=steps,
                            validate_every=2))
    first, second = (torch.load(tmp_path / folder / "checkpoint.pt", weights_only=False)
                     for folder in ("whole", "parted"))
    assert first["step"] == second["step"] == 4
    for part in ("policy", "last"):
        for name, value in first[part].items():
            assert torch.equal(value, second[part][name]), name
    rows = (tmp_path / "parted" / "log.csv").read_text().splitlines()
    assert rows[0].startswith("step,seconds,plans,loss")
    assert len(rows) == 4


def test_mean_of_weights_follows_the_policy(labels: Path, tmp_path: Path) -> None:
    run: LabelsRun = train(LabelsLeg(tmp_path, labels, CONFIG, EXPORTED, max_steps=3))
    old, mean, last = (network.state_dict()["here.weight"]
                       for network in (run.old, run.average, run.policy))
    assert 0 < (mean - old).norm() < (last - old).norm()


def test_pointer_learns_from_the_same_labels(labels: Path, tmp_path: Path) -> None:
    run = train(LabelsLeg(tmp_path, labels, replace(CONFIG, policy="pointer"),
                          EXPORTED.parent / "pointer", max_steps=4))
    assert run.policy.hidden_size > 0
    assert not (labels / NEWEST).exists()
    for mine, before in zip(run.policy.parameters(), run.old.parameters(), strict=True):
        assert torch.isfinite(mine).all()
        assert not torch.equal(mine, before)


def test_no_labels_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="labels"):
        train(LabelsLeg(tmp_path, tmp_path, CONFIG, EXPORTED, max_steps=1))
