"""Ways to decode `attention` side by side on fresh problems.

`python -m benchmarks.quality.decodings` prints, for uniform VRPTW of 50 and 100 customers and for
each class of training, by how much greedy plans and the best of 128 samples are dearer than greedy
plans from one view, in %, with the standard error, and how far all are above a long search.
`--policy pointer` does so for the other policy. Problems come from the seed: take another to
confirm what was chosen by one.
"""

from functools import cache, partial
from itertools import product
from typing import Annotated

import typer

from app.serving.settings import Settings
from benchmarks.quality.policies import cheapest_insertion
from benchmarks.quality.weights import CLASSES, Case, costs_by_class, judged_costs, print_table
from model.engine.instance import pack
from model.policy.decode import DecodeConfig, Policy, decode, load_policy, prepare
from model.search.improve import SearchConfig, improve
from model.policy.extract import extract

WAYS = {"greedy, one view": DecodeConfig(most_views=1), "greedy": DecodeConfig(),
        "128 samples": DecodeConfig("sample", 128)}


@cache
def _policy(name: str) -> Policy:
    return load_policy(Settings().weights_dir / name)


def plan_costs(case: Case, policy: str, turns: int) -> tuple[float, ...]:
    """Return what a plan costs by each of the `WAYS`, and by a search of so many turns a customer.

    Raises
    ------
    ValueError
        If a plan breaks a rule.
    """
    problem = case.problem()
    instance = pack([problem])
    scene = prepare(problem, instance)
    plans = [extract(problem, instance, decode(_policy(policy), scene, config).actions)
             for config in WAYS.values()]
    if turns:
        config = SearchConfig(turns=turns * problem.num_customers, seed=case.number)
        plans.append(improve(problem, instance, cheapest_insertion(problem), config).solution)
    return judged_costs(case, problem, plans)


def main(
    problems: Annotated[int, typer.Option(help="of each class")] = 100,
    classes: Annotated[str, typer.Option(help="comma-separated")] = ",".join(CLASSES),
    turns: Annotated[int, typer.Option(help="of the search, a customer; 0: no search")] = 1000,
    policy: str = "attention", seed: int = 1, processes: int = 2,
) -> None:
    """Print the table in Markdown."""
    found = costs_by_class(partial(plan_costs, policy=policy, turns=turns),
                           [Case(name, seed, number)
                            for name, number in product(classes.split(","), range(problems))],
                           processes)
    print_table(found, list(WAYS))


if __name__ == "__main__":
    typer.run(main)
