"""Training runs end to end in seconds and resumes exactly."""

import csv
import os
import signal
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest
import torch
import torch.distributed as dist

from tests.conftest import eventually, free_port
from training.config import TrainConfig
from training.heuristics import nearest_neighbour
from training.policies import POLICIES, widened
from training.train import TrainingLeg, processes, train, validation_batches

pytestmark = pytest.mark.slow

EXPORTED = Path(__file__).parents[2] / "model" / "weights" / "attention"

LOADED = 600.0
"""Seconds within which training begins, however slowly PyTorch is loaded."""

TINY = TrainConfig(sizes=((0, 6), (2, 8)), num_problems=4, num_rollouts=3, warm_up=2)


@pytest.mark.parametrize("policy", ["pointer", "attention"])
@pytest.mark.parametrize("baseline", ["critic", "shared"])
def test_training_runs_and_logs(policy: str, baseline: str, tmp_path: Path) -> None:
    config = TrainConfig(policy=policy, baseline=baseline, sizes=((0, 6),),  # type: ignore[arg-type]
                         num_problems=4, num_rollouts=3)
    ratios = train(TrainingLeg(tmp_path, config, max_steps=2, validation_size=8))
    assert set(ratios) > {"all", "cvrp", "vrptw", "mixed"}
    with (tmp_path / "log.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [int(row["step"]) for row in rows] == [1, 2]
    assert all(float(row["problems_per_second"]) > 0 for row in rows)
    assert list(tmp_path.glob("events.out.tfevents*"))


def test_resumed_run_equals_an_uninterrupted_one(tmp_path: Path) -> None:
    whole, parted = tmp_path / "whole", tmp_path / "parted"
    train(TrainingLeg(whole, TINY, max_steps=4, validation_size=8))
    train(TrainingLeg(parted, TINY, max_steps=2, validation_size=8))
    train(TrainingLeg(parted, TINY, max_steps=4, validation_size=8))
    first, second = (torch.load(folder / "checkpoint.pt", weights_only=False)
                     for folder in (whole, parted))
    assert first["step"] == second["step"] == 4
    for part in ("policy", "critic"):
        for name, value in first[part].items():
            assert torch.equal(value, second[part][name]), name


def test_a_policy_that_sees_more_begins_with_weights_that_saw_less() -> None:
    policy = POLICIES["attention"]()
    weights = policy.state_dict()
    fewer = {**weights, "node_embedding.weight": weights["node_embedding.weight"][:, :-2]}
    found = widened(policy, fewer)
    assert not found["node_embedding.weight"][:, -2:].any()
    for name, value in fewer.items():
        columns = value.shape[-1] if value.dim() else None
        assert torch.equal(found[name][..., :columns], value), name


def test_weights_of_new_features_are_learnt_alone(tmp_path: Path) -> None:
    old = torch.load(EXPORTED / "weights.pt", weights_only=True)
    fewer = {name: value[:, :-2] if name == "node_embedding.weight" else value
             for name, value in old.items()}
    (tmp_path / "fewer").mkdir()
    torch.save(fewer, tmp_path / "fewer" / "weights.pt")
    config = replace(TINY, policy="attention", baseline="shared", variants=("related",),
                     only_new=True)
    ratios = {}
    for steps in (1, 2):
        ratios = train(TrainingLeg(tmp_path, config, max_steps=steps, validation_size=2,
                                   begin_with=tmp_path / "fewer"))
    assert set(ratios) > {"all", "related"}
    learnt = torch.load(tmp_path / "checkpoint.pt", weights_only=False)["policy"]
    assert learnt["node_embedding.weight"][:, -2:].all(dim=0).any()
    for name, value in fewer.items():
        columns = value.shape[-1] if value.dim() else None
        assert torch.equal(learnt[name][..., :columns], value), name


def test_training_begins_with_an_exported_policy(tmp_path: Path) -> None:
    config = replace(TINY, policy="attention", baseline="shared")
    train(TrainingLeg(tmp_path, config, max_steps=0, validation_size=8, begin_with=EXPORTED))
    content = torch.load(tmp_path / "checkpoint.pt", weights_only=False)
    weights = torch.load(EXPORTED / "weights.pt", weights_only=True)
    assert weights.keys() == content["policy"].keys()
    for name, value in weights.items():
        assert torch.equal(value, content["policy"][name]), name


def test_another_policys_weights_are_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="begin_with"):
        train(TrainingLeg(tmp_path, TINY, max_steps=0, validation_size=8, begin_with=EXPORTED))


@pytest.mark.thorough
def test_several_processes_train_one_policy(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "torch.distributed.run", "--nproc-per-node=2",
               "--rdzv-backend=c10d", "--rdzv-endpoint=127.0.0.1:0", "-m", "training.train",
               "--folder", str(tmp_path), "--max-steps", "2", "--sizes", "0", "6",
               "--num-problems", "4", "--num-rollouts", "3", "--minutes", "5"]
    result = subprocess.run(command, capture_output=True, text=True, timeout=300, check=False,
                            env={**os.environ, "OMP_NUM_THREADS": "1"})
    assert result.returncode == 0, result.stderr
    assert torch.load(tmp_path / "checkpoint.pt", weights_only=False)["step"] == 2


def test_processes_part_whatever_ends_training(monkeypatch: pytest.MonkeyPatch) -> None:
    for name, value in (("RANK", 0), ("WORLD_SIZE", 1), ("MASTER_ADDR", "127.0.0.1"),
                        ("MASTER_PORT", free_port())):
        monkeypatch.setenv(name, str(value))

    def fail() -> None:
        with processes() as (rank, world):
            assert (rank, world) == (0, 1)
            raise KeyError

    with pytest.raises(KeyError):
        fail()
    assert not dist.is_initialized()


@pytest.mark.thorough
def test_terminated_run_saves_what_it_has(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "training.train", "--folder", str(tmp_path),
               "--sizes", "0", "6", "--num-problems", "4", "--num-rollouts", "3", "--minutes", "5"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                               env={**os.environ, "OMP_NUM_THREADS": "1"})
    log = tmp_path / "log.csv"
    eventually(lambda: log.exists() or process.poll() is not None, LOADED)
    assert process.poll() is None
    process.send_signal(signal.SIGTERM)
    process.communicate(timeout=120)
    assert process.returncode == 0
    assert torch.load(tmp_path / "checkpoint.pt", weights_only=False)["step"] >= 1


def test_curriculum_grows_and_rate_decays() -> None:
    config = TrainConfig(sizes=((0, 20), (10, 50)), warm_up=4, learning_rate=1.0, decay=(20, 30))
    assert [config.size_at(step) for step in (0, 9, 10, 99)] == [20, 20, 50, 50]
    assert config.learning_rate_at(0) == 0.25
    assert config.learning_rate_at(19) == 1.0
    assert config.learning_rate_at(25) == pytest.approx(0.505)
    assert config.learning_rate_at(1000) == 0.01
    assert config.problems_at(20) == 64
    assert config.problems_at(50) < 64


def test_validation_reference_is_the_nearest_neighbours_plan() -> None:
    (batch, reference), *_ = validation_batches(8)
    assert (reference > 0).all()
    assert (reference == nearest_neighbour(batch)).all()
