"""VROOM itself, by its package pyvroom."""

import json
from importlib import import_module
from typing import Any

import pytest

Data = dict[str, Any]


def solve(request: Data, exploration: int = 2) -> Data:
    """Return VROOM's reply to a request without geometry."""
    vroom = import_module("vroom")
    problem = vroom.Input()
    problem._from_json(json.dumps(request), False)
    solution = problem.solve(exploration_level=exploration, nb_threads=1)
    solution._distances = any("distances" in matrices
                              for matrices in request.get("matrices", {}).values())
    reply: Data = solution.to_dict()
    return reply


def error(request: Data) -> str:
    """Return what VROOM says is wrong with a request."""
    vroom = import_module("vroom")
    with pytest.raises(vroom._vroom.VroomInputException) as caught:
        solve(request)
    return str(caught.value)


def check(request: Data) -> Data | None:
    """Return VROOM's reply that times the routes in `steps`; None if it finds no times."""
    vroom = import_module("vroom")
    problem = vroom.Input()
    problem._from_json(json.dumps(request), False)
    try:
        solution = problem.check(1)
    except vroom._vroom.VroomInputException:
        return None
    reply: Data = solution.to_dict()
    return reply
