"""`pointer`, the paper's policy: shared 1-D convolutions, fusion, LSTM, additive attention.

Customers' local state and the vehicle's global state each pass one shared 1-D convolution and a
ReLU and are fused by learned weights. An LSTM reads the places visited. Additive attention over
the fused candidates gives a context, an additive pointer on it the next action. What the rules
beyond the paper add enters as further channels of the two convolutions.
"""

from dataclasses import dataclass

import torch
from torch import Tensor, nn
from torch.nn.functional import linear

from model.policy.network import MASKED, take
from model.policy.decision_features import NUM_ACTION_FEATURES, NUM_GLOBAL_FEATURES
from model.policy.problem_features import NUM_NODE_FEATURES, NUM_TYPE_FEATURES

@dataclass(frozen=True)
class PointerConfig:
    """Sizes of the network."""

    width: int = 64


class PointerPolicy(nn.Module):
    """Actor of the paper, a `PolicyNetwork`."""

    def __init__(self, config: PointerConfig) -> None:
        super().__init__()
        width = config.width
        self.config = config
        self.hidden_size = 2 * width
        self.node_convolution = nn.Conv1d(NUM_NODE_FEATURES, width, 1)
        self.type_convolution = nn.Conv1d(NUM_TYPE_FEATURES, width, 1)
        # A convolution over concatenated channels is the sum of one over each part: the parts
        # that change at each step are added then.
        self.step_convolution = nn.Conv1d(NUM_ACTION_FEATURES, width, 1, bias=False)
        self.global_convolution = nn.Conv1d(NUM_GLOBAL_FEATURES, width, 1)
        self.local_weight = nn.Parameter(torch.ones(width))
        self.global_weight = nn.Parameter(torch.full((width,), 0.5))
        self.lstm = nn.LSTM(width, width, batch_first=True)
        self.attention_local = nn.Linear(width, width)
        self.attention_hidden = nn.Linear(width, width, bias=False)
        self.attention_score = nn.Linear(width, 1, bias=False)
        self.pointer_local = nn.Linear(width, width)
        self.pointer_context = nn.Linear(width, width, bias=False)
        self.pointer_score = nn.Linear(width, 1, bias=False)

    def encode(self, node: Tensor, kind: Tensor, pair: Tensor,
               token_mask: Tensor | None) -> Tensor:
        """Pass the local states through their convolution; the activation follows in `score`."""
        nodes = self.node_convolution(node.transpose(1, 2))
        kinds = self.type_convolution(kind.transpose(1, 2))
        return torch.cat([nodes, kinds], dim=2).transpose(1, 2)

    def advance(self, memory: Tensor, here: Tensor, hidden: Tensor) -> Tensor:
        """Let the LSTM read the present place; `hidden` holds its output and its cell."""
        output, cell = hidden.chunk(2, dim=-1)
        weight_in, weight_hidden, bias_in, bias_hidden = self.lstm.all_weights[0]
        gates = (torch.relu(take(memory, here)) @ weight_in.T + bias_in
                 + output @ weight_hidden.T + bias_hidden)
        enter, forget, new, out = gates.chunk(4, dim=-1)
        cell = torch.sigmoid(forget) * cell + torch.sigmoid(enter) * torch.tanh(new)
        return torch.cat([torch.sigmoid(out) * torch.tanh(cell), cell], dim=-1)

    def remember(self, memory: Tensor, here: Tensor) -> Tensor:
        """Let the LSTM read whole rollouts at once, with nothing in the place of its cell."""
        place = torch.relu(take(memory, here))
        output = self.lstm(place.flatten(0, -3))[0].view_as(place)
        return torch.cat([output, torch.zeros_like(output)], dim=-1)

    def score(self, memory: Tensor, here: Tensor, candidate: Tensor, feature: Tensor,
              allowed: Tensor, glob: Tensor, hidden: Tensor) -> Tensor:
        """Fuse local and global state, attend to a context, point from it."""
        output = hidden[..., : self.config.width]
        local = torch.relu(take(memory, candidate)
                           + feature @ self.step_convolution.weight[:, :, 0].T)
        globe = self.global_weight * torch.relu(linear(
            glob, self.global_convolution.weight[:, :, 0], self.global_convolution.bias))
        # The fused state of a candidate is local * local_weight + globe. Its linear maps are taken
        # apart, so that what all candidates share is computed once.
        shared = self.attention_local(globe) + self.attention_hidden(output)
        similarity = self.attention_score(torch.tanh(
            local @ (self.attention_local.weight * self.local_weight).T
            + shared.unsqueeze(-2)))[..., 0]
        weight = torch.softmax(similarity.masked_fill(~allowed, MASKED), dim=-1)
        context = (weight.unsqueeze(-2) @ local).squeeze(-2) * self.local_weight + globe
        shared = self.pointer_local(globe) + self.pointer_context(context)
        logits = self.pointer_score(torch.tanh(
            local @ (self.pointer_local.weight * self.local_weight).T
            + shared.unsqueeze(-2)))[..., 0]
        return logits.masked_fill(~allowed, MASKED)


class Critic(nn.Module):
    """Value network of the paper: 1-D convolution over the customers, two dense layers."""

    def __init__(self, width: int = 64) -> None:
        super().__init__()
        self.node_convolution = nn.Conv1d(NUM_NODE_FEATURES, width, 1)
        self.type_convolution = nn.Conv1d(NUM_TYPE_FEATURES, width, 1)
        self.dense = nn.Linear(3 * width + 1, width)
        self.value = nn.Linear(width, 1)

    def forward(self, node: Tensor, kind: Tensor, token_mask: Tensor) -> Tensor:
        """Estimate the cost of each problem, (problem,)."""
        num_nodes = node.shape[1]
        is_node = token_mask[:, None, :num_nodes].float()
        is_type = token_mask[:, None, num_nodes:].float()
        nodes = torch.relu(self.node_convolution(node.transpose(1, 2))) * is_node
        kinds = torch.relu(self.type_convolution(kind.transpose(1, 2))) * is_type
        size = is_node.sum(dim=2)
        pooled = torch.cat([nodes.sum(dim=2) / size, nodes.amax(dim=2),
                            kinds.sum(dim=2) / is_type.sum(dim=2), torch.log(size)], dim=1)
        return self.value(torch.relu(self.dense(pooled)))[:, 0]
