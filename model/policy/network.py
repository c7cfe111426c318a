"""What every policy network offers: one signature for training, export and decoding."""

from typing import Protocol

import torch
from torch import Tensor

MASKED = -1e9
"""Logit of what is not a candidate; finite, so that it exports and never gives NaN."""


def take(memory: Tensor, token: Tensor) -> Tensor:
    """Return the rows of tokens: (*problem, token, width) and (*problem, ...) to (..., width)."""
    if memory.dim() == 2:
        return memory[token]
    offset = torch.arange(len(memory), device=token.device) * memory.shape[1]
    flat = token + offset.view(-1, *(1,) * (token.dim() - 1))
    return memory.flatten(0, 1).index_select(0, flat.flatten()).view(*token.shape, -1)


class PolicyNetwork(Protocol):
    """A policy. `*problem` is nothing for one problem, or one axis of several side by side."""

    hidden_size: int  # 0 for a policy that remembers nothing between decisions

    def encode(self, node: Tensor, kind: Tensor, pair: Tensor,
               token_mask: Tensor | None) -> Tensor:
        """Embed nodes and vehicle types, once per problem.

        Parameters
        ----------
        node
            (problem, node, NUM_NODE_FEATURES).
        kind
            (problem, type, NUM_TYPE_FEATURES).
        pair
            (problem, node, node, NUM_PAIR_FEATURES).
        token_mask
            (problem, node + type) True = a token, False = padding; None: there is no padding.

        Returns
        -------
        (problem, node + type, memory width), whatever `score` reads.
        """

    def advance(self, memory: Tensor, here: Tensor, hidden: Tensor) -> Tensor:
        """Take note of the present place.

        Parameters
        ----------
        memory
            (*problem, token, memory width).
        here
            (*problem, rollout) token.
        hidden
            (*problem, rollout, hidden_size), zero before the first decision.
        """

    def remember(self, memory: Tensor, here: Tensor) -> Tensor:
        """Take note of whole rollouts.

        (*problem, rollout, step) to (*problem, rollout, step, hidden_size).
        """

    def score(self, memory: Tensor, here: Tensor, candidate: Tensor, feature: Tensor,
              allowed: Tensor, glob: Tensor, hidden: Tensor) -> Tensor:
        """Score the candidates of each decision.

        Parameters
        ----------
        memory
            (*problem, token, memory width).
        here
            (*problem, decision) token of the present place.
        candidate
            (*problem, decision, candidate) token.
        feature
            (*problem, decision, candidate, NUM_ACTION_FEATURES).
        allowed
            (*problem, decision, candidate) True = a candidate, False = padding.
        glob
            (*problem, decision, NUM_GLOBAL_FEATURES).
        hidden
            (*problem, decision, hidden_size) after `advance`.

        Returns
        -------
        (*problem, decision, candidate) logits, MASKED where not allowed.
        """
