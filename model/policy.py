"""What every policy network offers: one signature for training, export and decoding."""

from typing import Protocol

from torch import Tensor

MASKED = -1e9
"""Logit of what is not a candidate; finite, so that it exports and never gives NaN."""


class PolicyNetwork(Protocol):
    """A policy. Token indices run over all tokens of all problems of a batch."""

    hidden_size: int  # 0 for a policy that remembers nothing between decisions

    def encode(self, node: Tensor, kind: Tensor, pair: Tensor, token_mask: Tensor) -> Tensor:
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
            (problem, node + type) True = a token, False = padding.

        Returns
        -------
        (problem, node + type, memory width), whatever `score` reads.
        """

    def advance(self, memory: Tensor, here: Tensor, hidden: Tensor) -> Tensor:
        """Take note of the present place.

        Parameters
        ----------
        memory
            (token, memory width) of all problems.
        here
            (rollout,) token.
        hidden
            (rollout, hidden_size), zero before the first decision.
        """

    def remember(self, memory: Tensor, here: Tensor) -> Tensor:
        """Take note of whole rollouts: (rollout, step) to (rollout, step, hidden_size)."""

    def score(self, memory: Tensor, here: Tensor, candidate: Tensor, feature: Tensor,
              allowed: Tensor, glob: Tensor, hidden: Tensor) -> Tensor:
        """Score the candidates of each rollout.

        Parameters
        ----------
        memory
            (token, memory width).
        here
            (rollout,) token of the present place.
        candidate
            (rollout, candidate) token.
        feature
            (rollout, candidate, NUM_ACTION_FEATURES).
        allowed
            (rollout, candidate) True = a candidate, False = padding.
        glob
            (rollout, NUM_GLOBAL_FEATURES).
        hidden
            (rollout, hidden_size) after `advance`.

        Returns
        -------
        (rollout, candidate) logits, MASKED where not allowed.
        """
