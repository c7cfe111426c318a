"""Breaks and driving rules of wild problems."""

import random
from typing import Any

Data = dict[str, Any]

LONGEST = 10**9


def let_rest(rng: random.Random, request: Data) -> None:
    """Let drivers have breaks, or rest by rules. In place."""
    for kind in request["fleet"]:
        if kind.get("flies"):
            continue
        if rng.random() < 0.5:
            kind["breaks"] = [_break(rng, number, len(kind["capacity"]))
                              for number in range(rng.randint(1, 3))]
            if rng.random() < 0.7:
                continue
        kind["driving_rules"] = _rules(rng)


def _break(rng: random.Random, number: int, dimensions: int) -> Data:
    earliest = rng.choice((0, 600, 7200, 14400, LONGEST)) + 3600 * number
    width = rng.choice((None, 0, 600, 3600, LONGEST))
    return {"id": f"b{number}", "duration": rng.choice((0, 1e-3, 600, 1800, 2700, LONGEST)),
            "start": {"earliest": min(earliest, LONGEST),
                      "latest": None if width is None else min(earliest + width, LONGEST)},
            "after_departure": rng.random() < 0.3, "at": rng.choice(("stop", "anywhere")),
            "paid": rng.random() < 0.7,
            "max_load": (None if rng.random() < 0.7 else
                         [rng.choice((0, 1, 5, 100)) for _ in range(dimensions)])}


def _rules(rng: random.Random) -> Data:
    if rng.random() < 0.4:
        return {"preset": rng.choice(("eu-561", "eu-561+2002-15", "us-hos")),
                **({"max_driving": rng.choice((0.5, 1800, 7200))} if rng.random() < 0.5 else {})}
    return {"max_driving": rng.choice((None, 1e-3, 60, 600, 3600, 16_200, LONGEST)),
            "break_duration": rng.choice((1e-3, 60, 900, 2700, LONGEST)),
            "split": rng.choice((None, None, [60, 300], [900, 1800], [1800, 1e-3])),
            "max_driving_per_day": rng.choice((None, None, 1, 7200, 32_400)),
            "max_work_before_break": rng.choice((None, None, 1, 1800, 7200, 21_600)),
            "driven_before": rng.choice((0, 0, 600, 1e5)),
            "worked_before": rng.choice((0, 0, 600, 1e5)),
            "while_drones_fly": rng.random() < 0.7}
