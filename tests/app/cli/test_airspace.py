"""`tandem airspace`, and files of zones that hold for all requests."""

import json
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from app.cli.airspace import airspace_cli
from app.cli.file_errors import EXIT_BAD_INPUT
from app.maps.roads.opening import opened_roads
from app.maps.roads.setting import SettingError
from app.plans.task import task_of
from app.requests.reading import read_request
from app.serving.settings import Settings
from tests.app.maps.airspace.published import circle, ed269, volume, zone
from tests.app.plans.test_closures import BEHIND, STRAIGHT_M, asked


def _written(folder: Path, *zones: dict[str, Any]) -> Path:
    path = folder / "zones.json"
    path.write_text(json.dumps(ed269(*zones)["data"]), "utf-8")
    return path


def test_check_tells_what_a_file_holds(tmp_path: Path) -> None:
    path = _written(
        tmp_path, zone(volume(), volume(upperLimit=None)),
        zone(volume(upperVerticalReference="AMSL"), restriction="CONDITIONAL",
             applicability=[{"permanent": "NO", "endDateTime": "2030-01-01T00:00:00Z"}]))
    result = CliRunner().invoke(airspace_cli, ["check", str(path)])
    assert result.exit_code == 0
    assert result.output.splitlines() == [
        f"{path}: ED-269, 2 zones with 3 volumes", "  PROHIBITED: 1", "  CONDITIONAL: 1",
        "  at certain times: 1", "  volumes without an upper limit: 1", "  limits above the sea: 1"]


def test_check_tells_what_can_not_be_read(tmp_path: Path) -> None:
    path = _written(tmp_path, zone(), zone(circle(2e6)))
    result = CliRunner().invoke(airspace_cli, ["check", str(path)])
    assert result.exit_code == EXIT_BAD_INPUT
    assert "1 zone with 1 volume" in result.output
    assert "$.features[1].geometry[0].horizontalProjection: A radius of 2e+06 m" in result.output


def test_check_tells_what_is_no_file(tmp_path: Path) -> None:
    result = CliRunner().invoke(airspace_cli, ["check", str(tmp_path / "none")])
    assert result.exit_code == EXIT_BAD_INPUT
    assert "No such file" in result.output


def test_zones_of_the_service_hold_for_all_requests(tmp_path: Path) -> None:
    path = _written(tmp_path, zone(circle(400, BEHIND)))
    request = read_request(json.dumps(asked()).encode(), None)
    free = task_of(request).problem.travel[1].arrays()[1][0, 1]
    assert free / 1000 == pytest.approx(STRAIGHT_M, rel=1e-3)
    with opened_roads(Settings(airspace=(path,), data_dir=tmp_path)) as roads:
        task = task_of(request, roads=roads)
    assert task.problem.travel[1].arrays()[1][0, 1] > 1e12
    assert task.closures is not None
    around, = task.closures.around("behind")
    assert (around["name"], around["identifier"]) == ("Harbour", "FIN0001")


def test_a_service_does_not_start_with_zones_that_can_not_be_read(tmp_path: Path) -> None:
    path = _written(tmp_path, zone(circle(2e6)))
    with pytest.raises(SettingError, match=r"TANDEM_AIRSPACE: .*zones\.json: 1 of its zones"):
        opened_roads(Settings(airspace=(path,), data_dir=tmp_path)).__enter__()
