"""Let exported policies see what was added to the features; they plan as before.

Run with `python -m training.widen --name attention` behind a change of the features, which come
after those that were there. What is new to the weights begins at zero.
"""

import json
from pathlib import Path
from typing import Annotated

import torch
import typer

from training.export import WEIGHTS, export
from training.policies import POLICIES, widened


def main(
    name: Annotated[str, typer.Option(help="of the policy")],
    weights: Annotated[Path, typer.Option(help="parent of the policy's folder")]
    = Path("model/weights"),
) -> None:
    """Export a policy's weights anew, by as many features as there are now."""
    folder = weights / name
    card = json.loads((folder / "card.json").read_text())
    policy = POLICIES[card["policy"]]()
    stored = torch.load(folder / WEIGHTS, map_location="cpu", weights_only=True)
    policy.load_state_dict(widened(policy, stored))
    export(policy, folder, card)


if __name__ == "__main__":
    typer.run(main)
