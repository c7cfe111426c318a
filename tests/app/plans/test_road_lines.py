"""Lines of drives: door to door, straight where no road leads, null where roads don't answer."""

from itertools import pairwise

import polyline
import pytest

from app.maps.roads.engine import USUAL, Driving, NoWayError, RoadRoute, RoadsUnavailableError
from app.maps.roads.roads import Roads
from app.plans.road_lines import RoadLines
from model.problem import FloatArray
from tests.app.maps.roads.fake import StatedRoads, table_of

A, B, ISLAND = (24.94, 60.17), (24.95, 60.18), (24.96, 60.16)
Place = tuple[float, float]


class BendingRoads(StatedRoads):
    """Drives by a corner a little beside each place; no road leads to the island."""

    def __init__(self) -> None:
        super().__init__(table_of([[0]]))
        self.is_up = True

    def route(self, lon_lat: FloatArray, until: float, driving: Driving = USUAL) -> RoadRoute:
        self.asked.append(lon_lat)
        if not self.is_up:
            raise RoadsUnavailableError("down")
        if ISLAND in [tuple(place) for place in lon_lat]:
            raise NoWayError("an island")
        legs = tuple(
            polyline.encode([(lat + 0.001, lon), (lat + 0.001, end), (end_lat + 0.001, end)], 6)
            for (lon, lat), (end, end_lat) in pairwise(lon_lat))
        return RoadRoute("", legs, lon_lat[1:, 0], lon_lat[1:, 1])


def decoded(line: str | None) -> list[Place]:
    assert line is not None
    return [(lon, lat) for lat, lon in polyline.decode(line, 6)]


@pytest.fixture
def engine() -> BendingRoads:
    return BendingRoads()


@pytest.fixture
def lines(engine: BendingRoads) -> RoadLines:
    return RoadLines(Roads({"truck": engine}), {"truck"})


def test_drives_lead_from_door_to_door(lines: RoadLines) -> None:
    there, back = lines.along("truck", [A, B, A], 0.0)
    assert decoded(there) == [A, (24.94, 60.171), (24.95, 60.171), (24.95, 60.181), B]
    assert decoded(back)[0] == B
    assert decoded(back)[-1] == A


def test_only_where_no_road_leads_are_lines_straight(lines: RoadLines) -> None:
    drives = lines.along("truck", [A, B, ISLAND, A], 0.0)
    assert [len(decoded(line)) for line in drives] == [5, 2, 2]


def test_drives_are_asked_for_once(lines: RoadLines, engine: BendingRoads) -> None:
    first = lines.along("truck", [A, B], 0.0)
    assert lines.along("truck", [A, B], 0.0) == first
    assert len(engine.asked) == 1


def test_roads_that_do_not_answer_are_asked_again(lines: RoadLines, engine: BendingRoads) -> None:
    engine.is_up = False
    assert lines.along("truck", [A, B, A], 0.0) == [None, None]
    engine.is_up = True
    assert len(decoded(lines.along("truck", [A, B, A], 0.0)[0])) == 5
