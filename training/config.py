"""What a training run is: one dataclass, saved with its checkpoint."""

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class TrainConfig:
    """A run. Steps are gradient steps; a leg may change what its checkpoint allows."""

    policy: Literal["pointer", "attention"] = "pointer"
    baseline: Literal["critic", "shared"] = "critic"
    seed: int = 0
    sizes: tuple[tuple[int, int], ...] = ((0, 20), (4000, 50))  # first step, customers
    size_mix: float = 0.3  # share of batches at a smaller size of the curriculum, or in between
    num_problems: int = 64  # a batch at 20 customers; fewer at larger sizes
    num_rollouts: int = 8  # of each problem
    learning_rate: float = 1e-3
    warm_up: int = 100  # steps
    decay: tuple[int, int] = (10**9, 10**9)  # steps between which the rate falls to a hundredth
    critic_rate: float = 1e-3
    gradient_clip: float = 1.0
    kept: float = 0.2  # share of the decisions that the gradient is computed from
    unassigned_weight: float = 0.4  # of the true penalty, lest one drop outweigh a whole plan
    max_candidates: int = 60_000  # in one chunk of the gradient pass
    variants: tuple[str, ...] = ()  # of the problems, evenly; none: all by their shares
    only_new: bool = False  # weights of features alone that those it begins with lack

    def learning_rate_at(self, step: int) -> float:
        """Return the rate of a step: warm-up, constant, linear decay."""
        rate = self.learning_rate * min(1.0, (step + 1) / self.warm_up)
        first, last = self.decay
        if step >= first:
            rate *= max(0.01, 1 - 0.99 * (step - first) / max(1, last - first))
        return rate

    def size_at(self, step: int) -> int:
        """Return the number of customers that the curriculum has reached."""
        return max(size for first, size in self.sizes if first <= step)

    def problems_at(self, num_customers: int) -> int:
        """Return how many problems of a size make a batch of about equal work."""
        smallest = self.sizes[0][1]
        return max(4, round(self.num_problems * min(1.0, (smallest / num_customers) ** 1.3)))
