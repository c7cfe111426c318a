"""Pictures of jobs have the zones that hold for all requests."""

import json
from pathlib import Path

import pytest

from app.serving.settings import Settings
from tests.app.maps.airspace.published import circle, ed269, zone
from tests.app.records.jobs.conftest import serving
from tests.app.records.jobs.stepping import ended, request_of, submit

pytestmark = pytest.mark.slow


def test_zones_for_all_requests_are_drawn(tmp_path: Path) -> None:
    path = tmp_path / "zones.json"
    path.write_text(json.dumps(ed269(zone(circle(400, [25.0, 60.1]), name="Harbour"))["data"]))
    request = request_of(0) | {"coordinate_system": "geographic", "planar_unit": 1.0}
    for place in (*request["depots"], *request["customers"]):
        place["location"] = [25 + place["location"][0] / 100, 60.11]
    request["fleet"][0]["drones"] = {"count": 1, "capacity": [1]}
    with serving(Settings(data_dir=tmp_path, role="all", airspace=(path,))) as jobs:
        job = submit(jobs, request)
        ended(jobs, job)
        picture = jobs.get(f"/jobs/{job}/plan.svg")
    assert picture.status_code == 200, picture.text
    assert "Harbour" in picture.text
    assert "flying is prohibited" in picture.text
