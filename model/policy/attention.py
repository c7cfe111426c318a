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

from model.policy.network import MASKED, take
from model.policy.decision_features import NUM_ACTION_FEATURES, NUM_GLOBAL_FEATURES
from model.policy.problem_features import NUM_NODE_FEATURES, NUM_PAIR_FEATURES, NUM_TYPE_FEATURES


@dataclass(frozen=True)
class AttentionConfig:
    """Sizes of the network."""

    width: int = 96
    num_heads: int = 6
    num_layers: int = 3
    inner: int = 192  # width of the feed-forward gate
    glimpse_heads: int = 4
    action_width: int = 48  # width of the network over action features
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

    def forward(self, x: Tensor, pair: Tensor, mask: Tensor | None) -> Tensor:
        """(problem, token, width) to the same.

        Pairs are (problem, feature, token, token); mask (problem, token) True = a token.
        """
        query, key, value = (
            part.unflatten(2, (self.num_heads, -1)).transpose(1, 2)
            for part in self.query_key_value(self.attention_norm(x)).chunk(3, dim=2))
        score = query @ key.transpose(2, 3) / math.sqrt(query.shape[3])
        score = score + (self.pair_bias.weight @ pair.flatten(2)).unflatten(2, pair.shape[2:])
        if mask is not None:
            score = score.masked_fill(~mask[:, None, None, :], MASKED)
        mixed = torch.softmax(score, dim=3).to(value.dtype) @ value
        x = x + self.output(mixed.transpose(1, 2).flatten(2))
        gate, up = self.gate(self.gate_norm(x)).chunk(2, dim=2)
        return x + self.down(silu(gate) * up)


class _Slots:
    """The slots that hold a candidate, so that none is computed for padding but in an export."""

    def __init__(self, candidate: Tensor, allowed: Tensor) -> None:
        self.candidate = candidate
        self.allowed = allowed
        self.is_whole = torch.compiler.is_exporting()
        if not self.is_whole:
            self.slot = allowed.flatten().nonzero()[:, 0]
            self.decision = self.slot // allowed.shape[-1]

    def pick(self, x: Tensor) -> Tensor:
        """(*problem, decision, candidate, width) to (slot, width)."""
        return x if self.is_whole else x[self.allowed]

    def of_token(self, x: Tensor) -> Tensor:
        """(*problem, token, width) to (slot, width) of the candidate in each slot."""
        if self.is_whole:
            return take(x, self.candidate)
        token = self.candidate.reshape(-1)[self.slot]
        if x.dim() > 2:
            token = token + self.decision // self.allowed.shape[-2] * x.shape[-2]
        return x.flatten(0, -2).index_select(0, token)

    def of_decision(self, x: Tensor) -> Tensor:
        """(*problem, decision, width) to (slot, width) of the decision of each."""
        if self.is_whole:
            return x.unsqueeze(-2)
        return x.flatten(0, -2).index_select(0, self.decision)

    def fill(self, x: Tensor) -> Tensor:
        """(slot, width) to (*problem, decision, candidate, width), 0 where there is none."""
        if self.is_whole:
            return x
        whole = x.new_zeros(self.allowed.numel(), x.shape[-1])
        return whole.index_copy(0, self.slot, x).unflatten(0, self.allowed.shape)


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
        self.glimpse_bias = nn.Linear(config.action_width, config.glimpse_heads,
                                      bias=False)
        self.glimpse_output = nn.Linear(width, width, bias=False)
        self.action_mix = nn.Linear(config.action_width, config.action_width)
        self.action_score = nn.Linear(config.action_width, 1, bias=False)

    def encode(self, node: Tensor, kind: Tensor, pair: Tensor,
               token_mask: Tensor | None) -> Tensor:
        """Return (problem, node + type, 4 * width + action_width).

        That is what queries read of the present place, then keys, values, pointer keys, and the
        candidate's share of the network over actions.
        """
        types = kind.shape[1]
        # Features of pairs are fewer to move than the biases that are made of them.
        pair = pad(pair.movedim(3, 1), (0, types, 0, types))
        x = torch.cat([self.node_embedding(node), self.type_embedding(kind)], dim=1)
        for layer in self.layers:
            x = layer(x, pair, token_mask)
        x = self.norm(x)
        if token_mask is None:
            mean = x.sum(dim=1, keepdim=True) / x.shape[1]
        else:
            weight = token_mask[..., None].to(x.dtype)
            mean = (x * weight).sum(dim=1, keepdim=True) / weight.sum(dim=1, keepdim=True)
        return torch.cat([self.here(x) + self.graph(mean), self.key_value_pointer(x)], dim=2)

    def advance(self, memory: Tensor, here: Tensor, hidden: Tensor) -> Tensor:
        """Return `hidden`, of no size: this policy remembers nothing between decisions."""
        return hidden

    def remember(self, memory: Tensor, here: Tensor) -> Tensor:
        """Return nothing remembered, of no size."""
        return memory.new_zeros(*here.shape, 0)

    def score(self, memory: Tensor, here: Tensor, candidate: Tensor, feature: Tensor,
              allowed: Tensor, glob: Tensor, hidden: Tensor) -> Tensor:
        """Attend to the candidates, then score them by dot product and action network.

        Products run over all tokens, of which the candidates' are picked: that is cheaper than to
        gather keys and values for each candidate.
        """
        query, slots, action, pointer = self._ask(memory, here, candidate, feature, allowed, glob)
        dot = (query @ pointer.transpose(-1, -2)).gather(-1, candidate)
        asked = slots.of_decision(self.action_query(query))
        extra = slots.fill(self.action_score(torch.relu(self.action_mix(action) + asked)))[..., 0]
        score = dot / math.sqrt(self.config.width) + extra
        logits = self.config.clip * torch.tanh(score / self.config.clip * 2)
        return logits.masked_fill(~allowed, MASKED)

    def situation(self, memory: Tensor, here: Tensor, candidate: Tensor, feature: Tensor,
                  allowed: Tensor, glob: Tensor) -> Tensor:
        """Return what the policy makes of the present state, (*problem, decision, width)."""
        return self._ask(memory, here, candidate, feature, allowed, glob)[0]

    def _ask(self, memory: Tensor, here: Tensor, candidate: Tensor, feature: Tensor,
             allowed: Tensor, glob: Tensor) -> tuple[Tensor, _Slots, Tensor, Tensor]:
        """Return the query of each decision, and what it is compared with."""
        width, share_width = self.config.width, self.config.action_width
        place, key, value, pointer, share = memory.split([width] * 4 + [share_width], dim=-1)
        query = take(place, here) + self.globe(glob)
        slots = _Slots(candidate, allowed)
        action = torch.relu(slots.of_token(share) + self.action(slots.pick(feature)))
        glimpsed = self._glimpse(query, key, value, candidate,
                                 slots.fill(self.glimpse_bias(action)), allowed)
        return query + self.glimpse_output(glimpsed), slots, action, pointer

    def decision_weights(self) -> dict[str, Tensor]:
        """Return what `score` multiplies with, as `rollouts.StepWeights` names and lays it."""
        linear = {
            "globe": self.globe[0], "globe_output": self.globe[2], "action": self.action,
            "glimpse_output": self.glimpse_output, "action_query": self.action_query,
            "action_mix": self.action_mix}
        state = self.state_dict()
        return {
            **{name: layer.get_parameter("weight").T for name, layer in linear.items()},
            "globe_bias": state["globe.0.bias"], "globe_output_bias": state["globe.2.bias"],
            "action_bias": state["action.bias"], "action_mix_bias": state["action_mix.bias"],
            "glimpse_bias": state["glimpse_bias.weight"],
            "action_score": state["action_score.weight"][0],
        }

    def _glimpse(self, query: Tensor, key: Tensor, value: Tensor, candidate: Tensor,
                 bias: Tensor, allowed: Tensor) -> Tensor:
        """Attend to the candidates' tokens, (*problem, decision, width)."""
        heads = self.config.glimpse_heads
        query, key, value = (part.unflatten(-1, (heads, -1)).transpose(-2, -3)
                             for part in (query, key, value))
        similarity = query @ key.transpose(-1, -2) / math.sqrt(query.shape[-1])
        index = candidate.unsqueeze(-3).expand(*similarity.shape[:-1], -1)
        picked = similarity.gather(-1, index) + bias.movedim(-1, -3)
        weight = torch.softmax(picked.masked_fill(~allowed.unsqueeze(-3), MASKED), dim=-1)
        # A customer may be a candidate twice: to drive to and to fly to.
        on_token = torch.zeros_like(similarity).scatter_add(-1, index, weight.to(similarity.dtype))
        return (on_token @ value).transpose(-2, -3).flatten(-2)
