"""The policies that can be trained, by name."""

from collections.abc import Callable

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
