"""The policies that can be trained, by name."""

from collections.abc import Callable

from model.policy.attention import AttentionConfig, AttentionPolicy
from model.policy.pointer import PointerConfig, PointerPolicy

AnyPolicy = PointerPolicy | AttentionPolicy

POLICIES: dict[str, Callable[[], AnyPolicy]] = {
    "pointer": lambda: PointerPolicy(PointerConfig()),
    "attention": lambda: AttentionPolicy(AttentionConfig()),
}
