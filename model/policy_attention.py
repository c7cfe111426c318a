"""`attention`: a transformer over depots, customers and vehicle types, a pointer over actions.

The encoder attends over all tokens with a learned bias from pairs of nodes (how far, and how their
windows follow each other). A decision queries the candidates by multi-head attention, then scores
them by a clipped dot product and a small network over what the simulator says of each.
"""

import math
from dataclasses import dataclass

import torch
from torch import Tensor, nn
from torch.nn.functional import pad, silu

from model.features import NUM_ACTION_FEATURES, NUM_GLOBAL_FEATURES
from model.policy import MASKED
from model.tokens import NUM_NODE_FEATURES, NUM_PAIR_FEATURES, NUM_TYPE_FEATURES


@dataclass(frozen=True)
class AttentionConfig:
    """Sizes of the network."""

    width: int = 128
    num_heads: int = 8
    num_layers: int = 5
    inner: int = 256  # width of the feed-forward gate
    action_width: int = 64  # width of the network over action features
    clip: float = 10.0


class EncoderLayer(nn.Module):
    """Pre-norm attention with a bias from pairs, then a gated feed-forward."""

    def __init__(self, config: AttentionConfig) -> None:
        super().__init__()
        self.num_heads = config.num_heads
        self.attention_norm = nn.LayerNorm(config.width)
        self.query_key_value = nn.Linear(config.width, 3 * config.width, bias=False)
        self.pair_bias = nn.Linear(NUM_PAIR_FEATURES, config.num_heads, bias=False)
        self.output = nn.Linear(config.width, config.width, bias=False)
        self.gate_norm = nn.LayerNorm(config.width)
        self.gate = nn.Linear(config.width, 2 * config.inner)
        self.down = nn.Linear(config.inner, config.width)

    def forward(self, x: Tensor, pair: Tensor, mask: Tensor) -> Tensor:
        """(problem, token, width) to the same; mask (problem, token) True = a token."""
        query, key, value = (
            part.unflatten(2, (self.num_heads, -1)).transpose(1, 2)
            for part in self.query_key_value(self.attention_norm(x)).chunk(3, dim=2))
        score = query @ key.transpose(2, 3) / math.sqrt(query.shape[3])
        score = score + self.pair_bias(pair).permute(0, 3, 1, 2)
        score = score.masked_fill(~mask[:, None, None, :], MASKED)
        mixed = torch.softmax(score, dim=3).to(value.dtype) @ value
        x = x + self.output(mixed.transpose(1, 2).flatten(2))
        gate, up = self.gate(self.gate_norm(x)).chunk(2, dim=2)
        return x + self.down(silu(gate) * up)


class AttentionPolicy(nn.Module):
    """Transformer encoder and attention pointer, a `PolicyNetwork`."""

    hidden_size = 0

    def __init__(self, config: AttentionConfig) -> None:
        super().__init__()
        self.config = config
        width = config.width
        self.node_embedding = nn.Linear(NUM_NODE_FEATURES, width)
        self.type_embedding = nn.Linear(NUM_TYPE_FEATURES, width)
        self.layers = nn.ModuleList(EncoderLayer(config) for _ in range(config.num_layers))
        self.norm = nn.LayerNorm(width)
        self.here = nn.Linear(width, width, bias=False)
        self.graph = nn.Linear(width, width, bias=False)
        self.key_value_pointer = nn.Linear(width, 3 * width + config.action_width, bias=False)
        self.globe = nn.Sequential(nn.Linear(NUM_GLOBAL_FEATURES, width), nn.SiLU(),
                                   nn.Linear(width, width))
        self.action = nn.Linear(NUM_ACTION_FEATURES, config.action_width)
        self.action_query = nn.Linear(width, config.action_width, bias=False)
        self.glimpse_bias = nn.Linear(config.action_width, config.num_heads, bias=False)
        self.glimpse_output = nn.Linear(width, width, bias=False)
        self.action_score = nn.Sequential(
            nn.SiLU(), nn.Linear(config.action_width, config.action_width), nn.SiLU(),
            nn.Linear(config.action_width, 1, bias=False))

    def encode(self, node: Tensor, kind: Tensor, pair: Tensor, token_mask: Tensor) -> Tensor:
        """Return (problem, node + type, 4 * width + action_width).

        That is what queries read of the present place, then keys, values, pointer keys, and the
        candidate's share of the network over actions.
        """
        types = kind.shape[1]
        pair = pad(pair, (0, 0, 0, types, 0, types))
        x = torch.cat([self.node_embedding(node), self.type_embedding(kind)], dim=1)
        for layer in self.layers:
            x = layer(x, pair, token_mask)
        x = self.norm(x)
        weight = token_mask[..., None].to(x.dtype)
        mean = (x * weight).sum(dim=1, keepdim=True) / weight.sum(dim=1, keepdim=True)
        return torch.cat([self.here(x) + self.graph(mean), self.key_value_pointer(x)], dim=2)

    def advance(self, memory: Tensor, here: Tensor, hidden: Tensor) -> Tensor:
        """Return `hidden`, of no size: this policy remembers nothing between decisions."""
        return hidden

    def remember(self, memory: Tensor, here: Tensor) -> Tensor:
        """Return nothing remembered, (rollout, step, 0)."""
        return memory.new_zeros(*here.shape, 0)

    def score(self, memory: Tensor, here: Tensor, candidate: Tensor, feature: Tensor,
              allowed: Tensor, glob: Tensor, hidden: Tensor) -> Tensor:
        """Attend to the candidates, then score them by dot product and action network."""
        width, heads = self.config.width, self.config.num_heads
        query = memory[:, :width].index_select(0, here) + self.globe(glob)
        seen = memory[:, width:].index_select(0, candidate.flatten()).unflatten(0, candidate.shape)
        key, value, pointer, share = seen.split([width, width, width, self.config.action_width],
                                                dim=2)
        action = share + self.action(feature)
        similarity = (query[:, None] * key).unflatten(2, (heads, -1)).sum(dim=3)
        similarity = similarity / math.sqrt(width // heads) + self.glimpse_bias(silu(action))
        similarity = similarity.masked_fill(~allowed[..., None], MASKED)
        weight = torch.softmax(similarity, dim=1).to(value.dtype)
        mixed = (weight[..., None] * value.unflatten(2, (heads, -1))).sum(dim=1).flatten(1)
        query = query + self.glimpse_output(mixed)
        dot = (query[:, None] * pointer).sum(dim=2) / math.sqrt(width)
        extra = self.action_score(action + self.action_query(query)[:, None])[..., 0]
        logits = self.config.clip * torch.tanh((dot + extra) / self.config.clip * 2)
        return logits.masked_fill(~allowed, MASKED)
