"""Ways around areas, against a plain search over all corners, and how they may be ended."""

import itertools
import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from model.engine.pausing import Pause
from model.problem import FloatArray
from model.travel import airspace as module
from model.travel.airspace import Airspace, Flights, Ring, flight_legs, invalid_polygon_reason
from model.travel.matrices import planar_distances
from model.travel.obstacles import Obstacles, count_nearby, edges_of
from model.travel.ways import Ways, find_ways

SPEED = 36.0  # km/h, 10 m/s
MARGIN_M = 0.0005
SQUARE: Ring = ((0.0, 0.0), (100.0, 0.0), (100.0, 100.0), (0.0, 100.0))
COORDINATE = st.integers(-6, 6).map(lambda number: 50.0 * number)
CORNERS = st.lists(st.tuples(COORDINATE, COORDINATE), min_size=3, max_size=7)
AREAS = st.lists(CORNERS.filter(lambda ring: invalid_polygon_reason(ring) is None).map(tuple),
                 min_size=1, max_size=4)
PLACES = st.lists(st.tuples(COORDINATE, COORDINATE), min_size=2, max_size=5)


def circle(corners: int, radius: float = 1000.0, x: float = 0.0) -> Ring:
    angles = [2 * math.pi * corner / corners for corner in range(corners)]
    return tuple((x + radius * math.cos(angle), radius * math.sin(angle)) for angle in angles)


def shortest(places: FloatArray, rings: list[Ring]) -> FloatArray:
    """Return the (place, place) distances around areas, by all corners of all boundaries."""
    areas = shapely.union_all([shapely.Polygon(ring) for ring in rings])
    closed = areas.buffer(MARGIN_M, join_style="mitre").buffer(-2 * MARGIN_M, join_style="mitre")
    points = np.concatenate([places, shapely.get_coordinates(areas)])
    distance = np.full((len(points), len(points)), np.inf)
    for one, other in itertools.combinations_with_replacement(range(len(points)), 2):
        if not shapely.LineString([points[one], points[other]]).intersects(closed):
            length = math.dist(points[one], points[other])
            distance[one, other] = distance[other, one] = length
    for middle in range(len(points)):
        distance = np.minimum(distance, distance[:, middle, None] + distance[middle])
    return distance[:len(places), :len(places)]


@given(PLACES, AREAS)
@settings(max_examples=60, deadline=None)
def test_ways_are_those_of_a_plain_search(places: list[tuple[float, float]],
                                          areas: list[Ring]) -> None:
    points = np.array(places)
    flown = flight_legs(points, Airspace(tuple(areas)), SPEED).distance
    assert flown == pytest.approx(shortest(points, areas), abs=1e-3)


def test_ways_between_corners_may_lead_exactly_northwest() -> None:
    rings: list[Ring] = [((0.0, 0.0), (0.0, 50.0), (150.0, 200.0)),
                         ((0.0, 0.0), (0.0, 100.0), (300.0, 50.0)),
                         ((0.0, 0.0), (0.0, 300.0), (50.0, 0.0))]
    points = np.array([(0.0, -200.0), (100.0, 150.0)])
    flown = flight_legs(points, Airspace(tuple(rings)), SPEED).distance
    assert flown == pytest.approx(shortest(points, rings), abs=1e-3)


@pytest.mark.thorough_after(2)
@pytest.mark.parametrize("seed", range(4))
def test_ways_past_many_areas_are_those_of_a_plain_search(seed: int) -> None:
    rng = np.random.default_rng(seed)
    rings: list[Ring] = [tuple(map(tuple, place + (circle(5, size) @ np.diag(stretch))))
                         for place, size, stretch in zip(
                             rng.uniform(-1000, 1000, (30, 2)), rng.uniform(5, 150, 30),
                             rng.uniform(0.1, 2, (30, 2)), strict=True)]
    points = rng.uniform(-1200, 1200, (6, 2))
    flown = flight_legs(points, Airspace(tuple(rings)), SPEED).distance
    assert flown == pytest.approx(shortest(points, rings), abs=1e-3)


@pytest.mark.parametrize("corners", [30, 500])
def test_round_areas_are_flown_along_their_boundary(corners: int) -> None:
    areas = Airspace((circle(corners), circle(corners, 500.0)))
    legs = flight_legs(np.array([(-2000.0, 0.0), (2000.0, 0.0)]), areas, SPEED)
    # Two tangents of 60 degrees each and the arc of 60 degrees between them.
    assert legs.distance[0, 1] == pytest.approx(2 * math.sqrt(3) * 1000 + math.pi / 3 * 1000,
                                                rel=1e-3)


def test_a_way_bends_where_areas_touch() -> None:
    touching = ((100.0, 100.0), (200.0, 100.0), (200.0, 200.0), (100.0, 200.0))
    walls = ((0.0, 100.0), (0.0, 300.0), (-500.0, 300.0), (-500.0, 100.0)), (
        (200.0, 100.0), (200.0, -300.0), (600.0, -300.0), (600.0, 100.0))
    start, end = (40.0, 110.0), (190.0, 10.0)
    legs = flight_legs(np.array([start, end]), Airspace((SQUARE, touching, *walls)), SPEED)
    expected = math.dist(start, (100.0, 100.0)) + math.dist((100.0, 100.0), end)
    assert legs.distance[0, 1] == pytest.approx(expected)


def test_who_sees_whom_is_found_out_once_for_all_speeds(monkeypatch: pytest.MonkeyPatch) -> None:
    found = 0

    def note(points: FloatArray, obstacles: Obstacles, pause: Pause) -> Ways:
        nonlocal found
        found += 1
        return find_ways(points, obstacles, pause)

    monkeypatch.setattr(module, "find_ways", note)
    points = np.array([(-50.0, 50.0), (150.0, 60.0)])
    for wind in (0.0, 20.0):
        flights = Flights(points, Airspace((SQUARE,), wind), planar_distances(points))
        for speed in (40.0, 50.0, 60.0):
            flights.legs(speed)
    assert found == 2


def test_every_part_of_the_work_can_be_ended() -> None:
    points = np.random.default_rng(0).uniform(-3000, 3000, (300, 2))
    areas = Airspace((circle(300), circle(300, x=1500.0)))
    pauses = 0

    class EndedError(Exception):
        pass

    def count() -> None:
        nonlocal pauses
        pauses += 1

    Flights(points, areas, planar_distances(points), count).legs(SPEED)
    assert pauses > 4
    for last in range(1, pauses):
        left = iter(range(last))

        def end(left: object = left) -> None:
            if next(left, None) is None:  # type: ignore[call-overload]
                raise EndedError

        with pytest.raises(EndedError):
            Flights(points, areas, planar_distances(points), end).legs(SPEED)


def test_crossings_of_areas_are_counted_about() -> None:
    bars = [shapely.box(0, 10 * at, 1000, 10 * at + 5) for at in range(100)]
    across = [shapely.box(10 * at, 0, 10 * at + 5, 1000) for at in range(100)]
    assert count_nearby(edges_of([])) == 0
    assert count_nearby(edges_of([shapely.Polygon(circle(500))])) <= 2500
    assert 40_000 <= count_nearby(edges_of([*bars, *across])) <= 400_000


@given(PLACES, AREAS, st.sampled_from([0.0, 20.0]))
@settings(max_examples=60, deadline=None)
def test_bends_lie_on_the_way_that_legs_measure(
        places: list[tuple[float, float]], rings: list[Ring], wind_kmh: float) -> None:
    points = np.array(places)
    airspace = Airspace(tuple(rings), wind_kmh, 250.0)
    flights = Flights(points, airspace, planar_distances(points))
    legs, wind = flights.legs(SPEED), airspace.wind(SPEED)
    for start, end in itertools.permutations(range(len(points)), 2):
        if not flights.ways.blocked[start, end]:
            continue
        bends = airspace.obstacles.corners.place[flights.ways.bends(start, end, wind)]
        assert (len(bends) > 0) == np.isfinite(legs.distance[start, end])
        if len(bends):
            steps = np.diff(np.concatenate((points[[start]], bends, points[[end]])), axis=0)
            east, north = steps.T
            lengths = np.hypot(east, north)
            assert wind.durations(east, north, lengths).sum() == pytest.approx(
                legs.duration[start, end])
            assert wind_kmh > 0 or lengths.sum() == pytest.approx(legs.distance[start, end])
