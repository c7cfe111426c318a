"""The policies that can be trained, by name."""

from collections.abc import Callable

from model.policy_attention import AttentionConfig, AttentionPolicy
from model.policy_pointer import PointerConfig, PointerPolicy

AnyPolicy = PointerPolicy | AttentionPolicy

POLICIES: dict[str, Callable[[], AnyPolicy]] = {
    "pointer": lambda: PointerPolicy(PointerConfig()),
    "attention": lambda: AttentionPolicy(AttentionConfig()),
}
