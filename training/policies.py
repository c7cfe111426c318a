"""The policies that can be trained, by name."""

from collections.abc import Callable

import torch
from torch import Tensor
from torch.nn.functional import pad

from model.policy.attention import AttentionConfig, AttentionPolicy
from model.policy.pointer import PointerConfig, PointerPolicy

AnyPolicy = PointerPolicy | AttentionPolicy

POLICIES: dict[str, Callable[[], AnyPolicy]] = {
    "pointer": lambda: PointerPolicy(PointerConfig()),
    "attention": lambda: AttentionPolicy(AttentionConfig()),
}


def widened(policy: AnyPolicy, weights: dict[str, Tensor]) -> dict[str, Tensor]:
    """Return weights for a policy that sees more than theirs did; what is new begins at zero.

    Features come after those that were there, as columns of a layer, so it plans as they do.
    """
    own = policy.state_dict()
    return {name: value if name not in own or value.dim() < 2 else
            pad(value, (0, 0) * (value.dim() - 2)
                + (0, max(0, own[name].shape[1] - value.shape[1])))
            for name, value in weights.items()}


def train_new_alone(policy: AnyPolicy, known: dict[str, int]) -> None:
    """Let nothing be learnt but weights of features behind those that are known. In place.

    `known` tells how many columns each layer had that has more now. So problems that state none of
    what is new are planned as before.
    """
    for name, parameter in policy.named_parameters():
        parameter.requires_grad_(name in known)
        if name in known:
            is_new = torch.arange(parameter.shape[1], device=parameter.device) >= known[name]
            is_new = is_new.view(1, -1, *(1,) * (parameter.dim() - 2))
            parameter.register_hook(lambda gradient, is_new=is_new: gradient * is_new)
