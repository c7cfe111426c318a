"""Small days with one break, each with the cost that enumeration finds."""

import json
from pathlib import Path
from typing import Any

import httpx
import pytest

DAYS = json.loads(Path(__file__).with_suffix("").with_name("break_days.json").read_text("utf-8"))


@pytest.mark.parametrize("day", DAYS, ids=[day["what"] for day in DAYS])
def test_breaks_and_departure_are_chosen_together(service: httpx.Client,
                                                  day: dict[str, Any]) -> None:
    reply = service.post(day["path"], json=day["body"]).json()
    assert reply["cost"]["total"] == pytest.approx(day["total"], abs=1e-3)
    if day["path"] == "/plan":
        assert reply["unassigned"] == []
    else:
        assert reply["feasible"], reply["violations"]
