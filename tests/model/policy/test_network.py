"""Both networks: padding and order of candidates change nothing, masks hold."""

import pytest
import torch
from torch import Tensor

from model.policy.network import MASKED
from training.export import example_inputs
from training.policies import POLICIES, AnyPolicy

NODES, TYPES, ROLLOUTS, CANDIDATES = 9, 2, 4, 6


@pytest.fixture(params=POLICIES)
def policy(request: pytest.FixtureRequest) -> AnyPolicy:
    torch.manual_seed(4)
    return POLICIES[request.param]().eval()


@pytest.fixture
def memory(policy: AnyPolicy) -> Tensor:
    (node, kind, pair), _ = example_inputs(policy, NODES, TYPES, ROLLOUTS, CANDIDATES)
    with torch.no_grad():
        return policy.encode(node, kind, pair, torch.ones(1, NODES + TYPES, dtype=torch.bool))[0]


@torch.no_grad()
def test_padding_candidates_changes_nothing(policy: AnyPolicy, memory: Tensor) -> None:
    _, (here, candidate, feature, allowed, glob, hidden) = example_inputs(
        policy, NODES, TYPES, ROLLOUTS, CANDIDATES)
    short = policy.score(memory, here, candidate, feature, allowed, glob, hidden)
    longer = policy.score(
        memory, here, torch.cat([candidate, candidate], 1), torch.cat([feature, feature], 1),
        torch.cat([allowed, torch.zeros_like(allowed)], 1), glob, hidden)
    torch.testing.assert_close(longer[:, :CANDIDATES], short)
    assert (longer[:, CANDIDATES:] == MASKED).all()


@torch.no_grad()
def test_order_of_candidates_changes_nothing(policy: AnyPolicy, memory: Tensor) -> None:
    _, (here, candidate, feature, allowed, glob, hidden) = example_inputs(
        policy, NODES, TYPES, ROLLOUTS, CANDIDATES)
    order = torch.tensor([3, 0, 5, 1, 4, 2])
    straight = policy.score(memory, here, candidate, feature, allowed, glob, hidden)
    shuffled = policy.score(memory, here, candidate[:, order], feature[:, order],
                            allowed[:, order], glob, hidden)
    torch.testing.assert_close(shuffled, straight[:, order])


@torch.no_grad()
def test_padding_tokens_changes_nothing(policy: AnyPolicy, memory: Tensor) -> None:
    (node, kind, pair), _ = example_inputs(policy, NODES, TYPES, ROLLOUTS, CANDIDATES)
    node = torch.cat([node, torch.zeros(1, 3, node.shape[2])], dim=1)
    pair = torch.nn.functional.pad(pair, (0, 0, 0, 3, 0, 3))
    is_token = torch.ones(1, NODES + 3 + TYPES, dtype=torch.bool)
    is_token[0, NODES:NODES + 3] = False
    padded = policy.encode(node, kind, pair, is_token)[0]
    torch.testing.assert_close(padded[is_token[0]], memory, rtol=1e-4, atol=1e-5)


@torch.no_grad()
def test_attention_sees_pairs(memory: Tensor) -> None:
    torch.manual_seed(4)
    policy = POLICIES["attention"]().eval()
    (node, kind, pair), _ = example_inputs(policy, NODES, TYPES, ROLLOUTS, CANDIDATES)
    mask = torch.ones(1, NODES + TYPES, dtype=torch.bool)
    assert not torch.allclose(policy.encode(node, kind, pair, mask),
                              policy.encode(node, kind, 1 - pair, mask), atol=1e-4)


@torch.no_grad()
def test_pointer_remembers_the_way_step_by_step_as_at_once() -> None:
    torch.manual_seed(4)
    policy = POLICIES["pointer"]().eval()
    memory = torch.randn(11, 64)
    path = torch.randint(11, (3, 5))
    at_once = policy.remember(memory, path)
    hidden = torch.zeros(3, policy.hidden_size)
    for step in range(5):
        hidden = policy.advance(memory, path[:, step], hidden)
        torch.testing.assert_close(hidden[:, :64], at_once[:, step, :64], rtol=1e-4, atol=1e-5)
