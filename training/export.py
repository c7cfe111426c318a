"""Export a trained policy to ONNX: `encoder.onnx`, `step.onnx` and a card.

The weights of `attention`'s step go into `step.npz` too, for the engine's rollouts, and all into
`weights.pt`, for further training.

Run with `python -m training.export --checkpoint runs/pointer/checkpoint.pt --name pointer`.
"""

import json
import warnings
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import onnx
import torch
import typer
from torch import Tensor, nn

from model.policy.attention import AttentionPolicy
from model.policy.decision_features import NUM_ACTION_FEATURES, NUM_GLOBAL_FEATURES
from model.policy.rolling import STEP_WEIGHTS
from model.policy.problem_features import NUM_NODE_FEATURES, NUM_PAIR_FEATURES, NUM_TYPE_FEATURES
from training.policies import POLICIES, AnyPolicy

OPSET = 20

WEIGHTS = "weights.pt"
"""File in a policy's folder from which training can begin."""


class Encoder(nn.Module):
    """One problem's tokens, without padding, to the memory of all decisions."""

    def __init__(self, policy: AnyPolicy) -> None:
        super().__init__()
        self.policy = policy

    def forward(self, node: Tensor, kind: Tensor, pair: Tensor) -> Tensor:
        """Return the memory, (token, memory width)."""
        return self.policy.encode(node, kind, pair, None)[0]


class Step(nn.Module):
    """One decision of a batch of rollouts."""

    def __init__(self, policy: AnyPolicy) -> None:
        super().__init__()
        self.policy = policy

    def forward(self, memory: Tensor, here: Tensor, candidate: Tensor, feature: Tensor,
                allowed: Tensor, glob: Tensor, hidden: Tensor) -> tuple[Tensor, Tensor]:
        """Return logits (rollout, candidate) and the hidden state after the step."""
        after = self.policy.advance(memory, here, hidden)
        logits = self.policy.score(memory, here, candidate, feature, allowed, glob, after)
        return logits, after


def example_inputs(policy: AnyPolicy, nodes: int, types: int, rollouts: int,
                   candidates: int, seed: int = 0) -> tuple[tuple[Tensor, ...], tuple[Tensor, ...]]:
    """Return random inputs of encoder and step (the step's without memory)."""
    generator = torch.Generator().manual_seed(seed)
    encoder = (torch.rand(1, nodes, NUM_NODE_FEATURES, generator=generator),
               torch.rand(1, types, NUM_TYPE_FEATURES, generator=generator),
               torch.rand(1, nodes, nodes, NUM_PAIR_FEATURES, generator=generator))
    allowed = torch.rand(rollouts, candidates, generator=generator) < 0.8
    allowed[:, 0] = True
    step = (torch.randint(nodes, (rollouts,), generator=generator),
            torch.randint(nodes + types, (rollouts, candidates), generator=generator),
            torch.rand(rollouts, candidates, NUM_ACTION_FEATURES, generator=generator), allowed,
            torch.rand(rollouts, NUM_GLOBAL_FEATURES, generator=generator),
            torch.rand(rollouts, policy.hidden_size, generator=generator) - 0.5)
    return encoder, step


def export(policy: AnyPolicy, folder: Path, card: dict[str, Any]) -> None:
    """Write both graphs and the card.

    Parameters
    ----------
    policy
        A trained network, on the CPU.
    folder
        Receives the files.
    card
        What to say of the weights; `hidden_size` is added.
    """
    folder.mkdir(parents=True, exist_ok=True)
    policy.eval()
    encoder_inputs, step_inputs = example_inputs(policy, nodes=7, types=3, rollouts=5, candidates=6)
    with torch.no_grad():
        memory = Encoder(policy)(*encoder_inputs)
    dim = torch.export.Dim
    tokens, rollouts, candidates = dim("tokens"), dim("rollouts", min=1), dim("candidates", min=1)
    nodes = dim("nodes")
    _write(Encoder(policy), encoder_inputs, folder / "encoder.onnx", ["node", "type", "pair"],
           ["memory"], {"node": {1: nodes}, "kind": {1: dim("types", min=1)},
                        "pair": {1: nodes, 2: nodes}})
    _write(Step(policy), (memory, *step_inputs), folder / "step.onnx",
           ["memory", "here", "candidate", "feature", "allowed", "glob", "hidden"],
           ["logits", "hidden_after"],
           {"memory": {0: tokens}, "here": {0: rollouts}, "candidate": {0: rollouts, 1: candidates},
            "feature": {0: rollouts, 1: candidates}, "allowed": {0: rollouts, 1: candidates},
            "glob": {0: rollouts}, "hidden": {0: rollouts}})
    if isinstance(policy, AttentionPolicy):
        arrays: dict[str, Any] = {name: weight.detach().numpy()
                                  for name, weight in policy.decision_weights().items()}
        np.savez(folder / STEP_WEIGHTS, **arrays)
    torch.save(policy.state_dict(), folder / WEIGHTS)
    content = {**card, "hidden_size": policy.hidden_size}
    (folder / "card.json").write_text(json.dumps(content, indent=2) + "\n")


def _write(module: nn.Module, inputs: tuple[Tensor, ...], path: Path, input_names: list[str],
           output_names: list[str], shapes: dict[str, Any]) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        program = torch.onnx.export(module, inputs, dynamo=True, dynamic_shapes=shapes,
                                    input_names=input_names, output_names=output_names,
                                    opset_version=OPSET, verbose=False)
    if program is None:
        raise RuntimeError(f"export of {path.name} gave nothing")
    model = program.model_proto
    # Where the graph was traced from tells of the machine it was traced on.
    for node in model.graph.node:
        del node.metadata_props[:]
    del model.metadata_props[:]
    onnx.save(model, str(path))


def main(
    checkpoint: Annotated[Path, typer.Option(help="of training.train")],
    name: Annotated[str, typer.Option(help="of the policy")],
    weights: Annotated[Path, typer.Option(help="parent of the policy's folder")]
    = Path("model/weights"),
    card: Annotated[Path | None, typer.Option(help="JSON with more to say of the weights")] = None,
) -> None:
    """Export a checkpoint."""
    content = torch.load(checkpoint, map_location="cpu", weights_only=False)
    policy = POLICIES[content["config"]["policy"]]()
    policy.load_state_dict(content["policy"])
    more = json.loads(card.read_text()) if card else {}
    export(policy, weights / name, {
        "policy": content["config"]["policy"], "config": content["config"],
        "steps": content["step"], "training_seconds": round(content["seconds"]), **more})


if __name__ == "__main__":
    typer.run(main)
