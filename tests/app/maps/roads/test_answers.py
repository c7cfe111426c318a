"""Which answers of servers can be right."""

import numpy as np
import pytest

from app.maps.roads.answers import BlockAnswer, Snap, joined, snapped_at
from app.maps.roads.engine import RoadsAnswerError, RoadTable, whole

pytestmark = pytest.mark.slow

PLACES = np.array([[24.94, 60.17], [24.940001, 60.17]])


def answered(seconds: float, metres: float) -> RoadTable:
    durations, distances = np.array([[0, seconds], [1, 0]]), np.array([[0, metres], [1, 0]])
    (block,) = whole(2)
    return joined(PLACES, [(block, BlockAnswer(durations, distances, PLACES, PLACES))])


def test_less_than_nothing_between_places_close_together_is_nothing() -> None:
    table = answered(-0.1, -0.1)
    assert table.durations_s.tolist() == table.distances_m.tolist() == [[0, 0], [1, 0]]


def test_much_less_than_nothing_can_not_be_right() -> None:
    with pytest.raises(RoadsAnswerError):
        answered(-1.0, 0.0)
    with pytest.raises(RoadsAnswerError):
        answered(0.0, -10.0)


@pytest.mark.parametrize("place", [(-170.0, -80.0), (180.0, 0.0), (-180.0, 90.0)])
def test_a_place_at_the_other_end_of_the_globe_may_be_measured_on_a_plane(
        place: tuple[float, float]) -> None:
    snap = Snap(location=(24.94, 60.17), distance=30_000_000.0)
    assert snapped_at([snap], np.array([place])).tolist() == [[24.94, 60.17]]


@pytest.mark.parametrize(("place", "stated"), [((24.95, 60.17), 3000.0), ((-170.0, -80.0), 90.0)])
def test_a_distance_of_another_place_is_none_of_this(
        place: tuple[float, float], stated: float) -> None:
    with pytest.raises(RoadsAnswerError, match="other places"):
        snapped_at([Snap(location=(24.94, 60.17), distance=stated)], np.array([place]))
