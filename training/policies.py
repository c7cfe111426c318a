"""The policies that can be trained, by name."""

from collections.abc import Callable

from torch import nn

from model.policy_attention import AttentionConfig, AttentionPolicy
from model.policy_pointer import PointerConfig, PointerPolicy

POLICIES: dict[str, Callable[[], PointerPolicy | AttentionPolicy]] = {
    "pointer": lambda: PointerPolicy(PointerConfig()),
    "attention": lambda: AttentionPolicy(AttentionConfig()),
}


def num_parameters(policy: nn.Module) -> int:
    """Count the weights of a network."""
    return sum(parameter.numel() for parameter in policy.parameters())
