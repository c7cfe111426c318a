"""Average the weights of several checkpoints of one training.

Late in a training the weights wander around a good place rather than come to rest in it; their
mean plans better than each of them. Run with
`python -m training.average a.pt b.pt --output runs/attention/average.pt`, then export the result.

References
----------
Izmailov et al. (2018), averaging weights leads to wider optima and better generalization, UAI.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import torch
import typer
from torch import Tensor

Weights = dict[str, Tensor]


def average(weights: Sequence[Weights]) -> Weights:
    """Return the mean of each array; those of whole numbers are the last's.

    Raises
    ------
    ValueError
        If there are none, or they are not of the same network.
    """
    shapes = [{name: value.shape for name, value in one.items()} for one in weights]
    if not shapes or any(other != shapes[0] for other in shapes):
        raise ValueError("checkpoints: they are not of the same network")
    return {name: torch.stack([one[name] for one in weights]).mean(dim=0)
            if last.is_floating_point() else last for name, last in weights[-1].items()}


def main(
    checkpoints: Annotated[list[Path], typer.Argument(help="of training.train, the last one last")],
    output: Annotated[Path, typer.Option(help="checkpoint to write")],
) -> None:
    """Write a checkpoint with the average weights; all else is the last one's."""
    contents = [torch.load(path, map_location="cpu", weights_only=False) for path in checkpoints]
    torch.save({**contents[-1], "policy": average([one["policy"] for one in contents])}, output)


if __name__ == "__main__":
    typer.run(main)
