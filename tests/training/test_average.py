"""Averages of checkpoints."""

from pathlib import Path

import pytest
import torch

from training.average import average, main
from training.policies import POLICIES

pytestmark = pytest.mark.slow


def checkpoint(seed: int, step: int) -> dict[str, object]:
    """Return the part of a checkpoint that matters here."""
    torch.manual_seed(seed)
    return {"config": {"policy": "attention"}, "step": step,
            "policy": POLICIES["attention"]().state_dict()}


def test_average_lies_in_the_middle_and_can_be_loaded(tmp_path: Path) -> None:
    contents = [checkpoint(seed, step) for seed, step in ((1, 10), (2, 20))]
    paths = [tmp_path / f"{number}.pt" for number in range(2)]
    for content, path in zip(contents, paths, strict=True):
        torch.save(content, path)
    main(paths, tmp_path / "average.pt")
    found = torch.load(tmp_path / "average.pt", weights_only=False)
    assert found["step"] == 20
    POLICIES["attention"]().load_state_dict(found["policy"])
    for name, value in found["policy"].items():
        one, other = (content["policy"][name] for content in contents)  # type: ignore[index]
        assert torch.allclose(value, (one + other) / 2)


def test_whole_numbers_are_the_lasts() -> None:
    found = average([{"seen": torch.tensor(3)}, {"seen": torch.tensor(8)}])
    assert found["seen"] == 8


def test_weights_of_different_networks_are_refused() -> None:
    one, longer = {"a": torch.zeros(2)}, {"a": torch.zeros(3)}
    for weights in ([], [one, longer], [one, {}]):
        with pytest.raises(ValueError, match="same network"):
            average(weights)
