"""What it takes to refuse nonsense, at every route of the API's description."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from app.main import create_app
from app.serving.settings import Settings
from tests.app.serving.load.nonsense import HELD_UP, PROCESSOR, Taken
from tests.conftest import made_once
from tests.seeds import SHARE

pytestmark = [pytest.mark.slow, pytest.mark.thorough]

EACH = 12 * SHARE
"""Of so many kinds one is sent to a route, and another one to the next."""

GROWN = 300 * 2**20
"""Bytes."""


@pytest.fixture(scope="module")
def taken(shared_folder: Path) -> list[Taken]:
    """Return what every kind of nonsense took at every route."""
    told = shared_folder / "nonsense"
    with made_once(told) as unfinished:
        if unfinished is not None:
            with unfinished.open("w") as output:
                subprocess.run([sys.executable, "-m", "tests.app.serving.load.nonsense", str(EACH)],
                               cwd=Path(__file__).parents[4], check=True, stdout=output)
    return [Taken(**json.loads(line)) for line in told.read_text().splitlines()]


def test_all_nonsense_is_refused(taken: list[Taken]) -> None:
    operations = [(method, operation) for path in create_app(Settings()).openapi()["paths"].values()
                  for method, operation in path.items()]
    assert len({each.route for each in taken}) == sum(
        "requestBody" in operation for _, operation in operations)
    for each in taken:
        assert 400 <= each.status < 500, each


def test_refusing_nonsense_takes_a_second_and_little_memory(taken: list[Taken]) -> None:
    for each in taken:
        assert each.processor < PROCESSOR, each
        assert each.grown < GROWN, each


def test_health_is_told_while_nonsense_is_refused(taken: list[Taken]) -> None:
    for each in taken:
        assert each.health < HELD_UP, each
