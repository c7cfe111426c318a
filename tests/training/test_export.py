"""Exported graphs say what the network says, at sizes they were not traced at."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import onnx
import onnxruntime as ort
import pytest
import torch

from model.policy.decision_features import empty_observation
from model.policy.rolling import (
    ACTION_WIDTH, CLIP, SHAPES, SHARE, STEP_WEIGHTS, candidate_scores, read_weights,
)
from training.export import WEIGHTS, Encoder, Step, example_inputs, export
from tests.conftest import made_once
from training.policies import POLICIES, AnyPolicy
from training.widen import main as widen

pytestmark = pytest.mark.slow

STEP_INPUTS = ("here", "candidate", "feature", "allowed", "glob", "hidden")


@pytest.fixture(scope="module", params=[
    pytest.param(name, marks=() if name == "attention" else pytest.mark.thorough)
    for name in POLICIES])
def exported(request: pytest.FixtureRequest, shared_folder: Path) -> tuple[str, Path]:
    torch.manual_seed(2)
    folder = shared_folder / f"exported-{request.param}"
    with made_once(folder) as unfinished:
        if unfinished is not None:
            export(POLICIES[request.param](), unfinished, {"note": "untrained"})
    return request.param, folder


def compare(name: str, folder: Path, sizes: tuple[int, int, int, int]) -> None:
    """Compare a policy of the weights kept with its graphs, at sizes as in `example_inputs`."""
    policy = POLICIES[name]()
    policy.load_state_dict(torch.load(folder / WEIGHTS, weights_only=True))
    policy.eval()
    encoder_inputs, step_inputs = example_inputs(policy, *sizes, seed=9)
    with torch.no_grad():
        memory = Encoder(policy)(*encoder_inputs)
        logits, hidden = Step(policy)(memory, *step_inputs)
    encoder = ort.InferenceSession(str(folder / "encoder.onnx"))
    step = ort.InferenceSession(str(folder / "step.onnx"))
    got_memory, = encoder.run(None, dict(zip(("node", "type", "pair"),
                                             (x.numpy() for x in encoder_inputs), strict=True)))
    np.testing.assert_allclose(got_memory, memory.numpy(), atol=1e-4, rtol=1e-4)
    fed = {key: x.numpy() for key, x in zip(STEP_INPUTS, step_inputs, strict=True)}
    # A policy that is older than the last features has no weights for them.
    known, = (entry.shape[2] for entry in step.get_inputs() if entry.name == "feature")
    fed["feature"] = fed["feature"][..., :known]
    got_logits, got_hidden = step.run(None, {"memory": got_memory, **fed})
    np.testing.assert_allclose(got_logits, logits.numpy(), atol=1e-4, rtol=1e-4)
    np.testing.assert_allclose(got_hidden, hidden.numpy(), atol=1e-4, rtol=1e-4)


@pytest.mark.parametrize(("nodes", "types", "rollouts", "candidates"),
                         [(2, 1, 1, 1), (3, 2, 2, 2), (21, 4, 1, 30), (101, 1, 64, 50),
                          (301, 2, 3, 170)])
def test_torch_and_onnx_agree(exported: tuple[str, Path], nodes: int, types: int, rollouts: int,
                              candidates: int) -> None:
    compare(*exported, (nodes, types, rollouts, candidates))


@pytest.mark.parametrize("name", POLICIES)
def test_weights_committed_for_training_are_those_of_the_graphs(name: str) -> None:
    folder = Path(__file__).parents[2] / "model" / "weights" / name
    compare(name, folder, (9, 2, 3, 7))


def test_a_policy_that_is_widened_is_exported_with_nothing_for_what_is_new(
        tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    exported: list[tuple[AnyPolicy, Path, dict[str, Any]]] = []
    monkeypatch.setattr("training.widen.export", lambda *given: exported.append(given))
    weights, column = POLICIES["pointer"]().state_dict(), "node_convolution.weight"
    (tmp_path / "old").mkdir()
    (tmp_path / "old" / "card.json").write_text('{"policy": "pointer"}')
    torch.save({**weights, column: weights[column][:, :-1]}, tmp_path / "old" / WEIGHTS)
    widen("old", tmp_path)
    (policy, folder, card), = exported
    assert (folder, card) == (tmp_path / "old", {"policy": "pointer"})
    found = policy.state_dict()
    assert not found[column][:, -1].any()
    weights[column][:, -1] = 0
    assert all(torch.equal(found[name], weight) for name, weight in weights.items())


@pytest.mark.parametrize(("nodes", "types", "candidates"), [(2, 1, 1), (21, 4, 30), (301, 2, 170)])
def test_step_of_attention_in_the_engine_agrees_with_its_graph(
        exported: tuple[str, Path], nodes: int, types: int, candidates: int) -> None:
    name, folder = exported
    assert (folder / STEP_WEIGHTS).exists() == (name == "attention")
    if name != "attention":
        return
    policy = POLICIES[name]()
    _, step_inputs = example_inputs(policy, nodes, types, 3, candidates, seed=4)
    here, candidate, feature, _, glob, hidden = (x.numpy() for x in step_inputs)
    everyone = np.ones(candidate.shape, np.bool_)
    memory = np.random.default_rng(5).standard_normal((nodes + types, SHARE + ACTION_WIDTH),
                                                      np.float32)
    session = ort.InferenceSession(str(folder / "step.onnx"))
    logits, _ = session.run(None, dict(zip(
        ("memory", *STEP_INPUTS), (memory, here, candidate, feature, everyone, glob, hidden),
        strict=True)))
    seen = empty_observation(3, nodes, types)._replace(
        count=np.full(3, candidates), token=candidate, feature=feature, glob=glob, here=here)
    weights = read_weights(folder / STEP_WEIGHTS)
    for r in range(3):
        clipped = CLIP * np.tanh(candidate_scores(weights, memory, seen, r) * 2 / CLIP)
        np.testing.assert_allclose(clipped, logits[r], atol=1e-4, rtol=1e-4)


@pytest.mark.parametrize("spoil", [{"action": None}, {"globe_bias": np.zeros(7, np.float32)}])
def test_step_weights_of_another_shape_are_refused(tmp_path: Path,
                                                   spoil: dict[str, Any]) -> None:
    arrays: dict[str, Any] = {name: np.zeros(shape) for name, shape in SHAPES.items()} | spoil
    np.savez(tmp_path / STEP_WEIGHTS,
             **{name: array for name, array in arrays.items() if array is not None})
    with pytest.raises(ValueError, match=next(iter(spoil))):
        read_weights(tmp_path / STEP_WEIGHTS)


def test_card_and_graphs_are_complete_and_tell_no_paths(exported: tuple[str, Path]) -> None:
    name, folder = exported
    card = json.loads((folder / "card.json").read_text())
    assert card["hidden_size"] == POLICIES[name]().hidden_size
    assert card["note"] == "untrained"
    for part in ("encoder", "step"):
        onnx.checker.check_model(onnx.load(folder / f"{part}.onnx"))
        assert b".py" not in (folder / f"{part}.onnx").read_bytes()
