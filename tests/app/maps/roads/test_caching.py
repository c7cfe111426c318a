from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from app.maps.remote.asking import ShouldStop
from app.maps.roads.caching import TableCache, part_of
from app.maps.roads.engine import (
    USUAL, Block, Driving, RoadRoute, RoadTable, RoadsUnavailableError, whole,
)
from app.maps.roads.roads import Roads
from model.problem import FloatArray
from tests.app.maps.roads.fake import StatedRoads, table_of

pytestmark = pytest.mark.slow

NO_TIME = 0.0


def places(count: int, seed: int = 0) -> FloatArray:
    return np.round(np.random.default_rng(seed).uniform(24.0, 25.0, (count, 2)), 6)


def random_table(count: int, seed: int = 0) -> RoadTable:
    rng = np.random.default_rng(seed)
    seconds = rng.uniform(0, 1000, (count, count))
    seconds[rng.random((count, count)) < 0.1] = np.nan
    return RoadTable(seconds, 10 * seconds, rng.uniform(24, 25, (count, 2)),
                     rng.uniform(0, 9, count))


def assert_same(table: RoadTable | None, other: RoadTable) -> None:
    assert table is not None
    for name in ("durations_s", "distances_m", "snapped", "snap_m"):
        np.testing.assert_array_equal(getattr(table, name), getattr(other, name))


def test_a_table_is_asked_for_once() -> None:
    engine = StatedRoads(random_table(5))
    roads = Roads({"car": engine})
    first = roads.table("car", places(5), NO_TIME)
    assert_same(roads.table("car", places(5) + 4e-7, NO_TIME), first)  # half a decimetre away
    assert len(engine.asked) == 1
    roads.table("car", places(5) + 1e-5, NO_TIME)
    assert len(engine.asked) == 2


def test_another_map_or_profile_has_tables_of_its_own() -> None:
    engine, other = StatedRoads(random_table(5)), StatedRoads(random_table(5, 1))
    roads = Roads({"car": engine, "truck": other})
    roads.table("car", places(5), NO_TIME)
    assert_same(roads.table("truck", places(5), NO_TIME), random_table(5, 1))
    engine.map = "2"
    roads.table("car", places(5), NO_TIME)
    assert len(engine.asked) == 2


def test_another_server_has_tables_of_its_own(tmp_path: Path) -> None:
    engine, other = StatedRoads(random_table(5)), StatedRoads(random_table(5, 1))
    before = Roads({"car": engine}, TableCache(tmp_path), {"car": "http://a"})
    before.table("car", places(5), NO_TIME)
    roads = Roads({"car": other}, TableCache(tmp_path), {"car": "http://b"})
    assert_same(roads.table("car", places(5), NO_TIME), random_table(5, 1))


def test_a_map_of_unknown_state_is_asked_again_some_time(monkeypatch: pytest.MonkeyPatch) -> None:
    engine = StatedRoads(random_table(5), build="")
    roads = Roads({"car": engine})
    monkeypatch.setattr("app.maps.roads.roads.time.time", lambda: 7200.0)
    roads.table("car", places(5), NO_TIME)
    roads.table("car", places(5), NO_TIME)
    assert len(engine.asked) == 1
    monkeypatch.setattr("app.maps.roads.roads.time.time", lambda: 10800.0)
    roads.table("car", places(5), NO_TIME)
    assert len(engine.asked) == 2


def test_what_failed_is_not_kept() -> None:
    engine = StatedRoads(RoadsUnavailableError("down"))
    roads = Roads({"car": engine})
    with pytest.raises(RoadsUnavailableError):
        roads.table("car", places(5), NO_TIME)
    engine.answer = random_table(5)
    assert_same(roads.table("car", places(5), NO_TIME), random_table(5))


def test_some_places_of_a_table_are_known_in_any_order() -> None:
    cache, table = TableCache(), random_table(6)
    cache.put("a", places(6), table)
    rows = [4, 0, 5, 0]
    found = cache.get("a", places(6)[rows])
    assert_same(found, RoadTable(table.durations_s[np.ix_(rows, rows)],
                                 table.distances_m[np.ix_(rows, rows)],
                                 table.snapped[rows], table.snap_m[rows]))
    assert cache.get("b", places(6)[rows]) is None
    assert cache.get("a", np.concatenate((places(6), places(1, 9)))) is None


def test_other_processes_find_tables_in_files(tmp_path: Path) -> None:
    TableCache(tmp_path / "roads").put("a", places(7), random_table(7))
    assert_same(TableCache(tmp_path / "roads").get("a", places(7)), random_table(7))
    assert TableCache(tmp_path / "roads").get("a", places(6)) is None
    assert TableCache(tmp_path / "other").get("a", places(7)) is None


@pytest.mark.parametrize("kept", [0, 10, 200, 400])
def test_a_file_cut_off_is_as_good_as_none(tmp_path: Path, kept: int) -> None:
    TableCache(tmp_path).put("a", places(7), random_table(7))
    file = next(tmp_path.glob("*.npy"))
    file.write_bytes(file.read_bytes()[:kept])
    assert TableCache(tmp_path).get("a", places(7)) is None


def test_files_not_used_for_longest_make_room(tmp_path: Path) -> None:
    cache = TableCache(tmp_path, disk_bytes=5000)
    for number in range(12):
        cache.put("a", places(10, number), random_table(10, number))
    sizes = [path.stat().st_size for path in tmp_path.iterdir()]
    assert 0 < len(sizes) < 12
    assert sum(sizes) <= 5000
    assert_same(TableCache(tmp_path).get("a", places(10, 11)), random_table(10, 11))
    assert TableCache(tmp_path).get("a", places(10, 0)) is None


def test_memory_is_bounded_too() -> None:
    cache = TableCache(memory_bytes=5000)
    for number in range(12):
        cache.put("a", places(10, number), random_table(10, number))
    known = [number for number in range(12) if cache.get("a", places(10, number)) is not None]
    assert known == [9, 10, 11]


def test_without_a_place_for_files_there_are_none(tmp_path: Path) -> None:
    TableCache(tmp_path / "roads", disk_bytes=0).put("a", places(3), random_table(3))
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_cannot_be_written_is_no_error(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    cache = TableCache(tmp_path / "file" / "roads")
    cache.put("a", places(3), random_table(3))
    assert_same(cache.get("a", places(3)), random_table(3))


def test_what_is_kept_cannot_be_changed() -> None:
    roads = Roads({"car": StatedRoads(table_of([[0, 1], [1, 0]]))})
    roads.table("car", places(2), NO_TIME)
    with pytest.raises(ValueError, match="read-only"):
        roads.table("car", places(2), NO_TIME).durations_s[0, 1] = 0


class Known:
    """Answers from a table of places that it knows, only what is asked for; counts the legs."""

    name = "known"

    def __init__(self, count: int) -> None:
        self.places, self.whole, self.legs = places(count), random_table(count), 0
        for numbers in (self.whole.durations_s, self.whole.distances_m):
            np.fill_diagonal(numbers, 0.0)

    def build(self) -> str:
        return "1"

    def table(self, lon_lat: FloatArray, until: float,
              should_stop: ShouldStop = lambda: False,
              wanted: Sequence[Block] | None = None,
              driving: Driving = USUAL) -> RoadTable:
        rows = np.array([np.flatnonzero((self.places == place).all(axis=1))[0]
                         for place in lon_lat])
        table = part_of(self.whole, rows)
        asked = np.eye(len(rows), dtype=bool)
        for block in whole(len(rows)) if wanted is None else wanted:
            asked[np.ix_(block.origins, block.destinations)] = True
            self.legs += len(block.origins) * len(block.destinations)
        return RoadTable(np.where(asked, table.durations_s, np.nan),
                         np.where(asked, table.distances_m, np.nan), table.snapped, table.snap_m)

    def route(self, lon_lat: FloatArray, until: float, driving: Driving = USUAL) -> RoadRoute:
        raise RoadsUnavailableError("Nobody asks this one for lines.")

    def close(self) -> None:
        self.legs = 0


def test_of_places_that_are_known_but_for_some_only_these_are_asked_for() -> None:
    engine = Known(30)
    roads, mixed = Roads({"car": engine}), np.random.default_rng(1).permutation(30)
    roads.table("car", engine.places[:20], NO_TIME)
    assert engine.legs == 20 * 20
    # Four more, and five of the others gone, in another order.
    asked = mixed[np.isin(mixed, [*range(5, 24)])]
    table = roads.table("car", engine.places[asked], NO_TIME)
    assert engine.legs == 20 * 20 + 4 * 19 + 15 * 4
    assert_same(table, part_of(engine.whole, asked))
    roads.table("car", engine.places[asked][::-1], NO_TIME)
    assert engine.legs == 20 * 20 + 4 * 19 + 15 * 4


def test_places_that_lie_elsewhere_among_others_are_asked_for_anew() -> None:
    engine = Known(12)
    roads = Roads({"car": engine})
    roads.table("car", engine.places[:10], NO_TIME)
    engine.whole.snapped[3] += 0.001
    table = roads.table("car", engine.places, NO_TIME)
    assert_same(table, engine.whole)


def test_little_that_is_known_helps_nobody() -> None:
    engine = Known(12)
    roads = Roads({"car": engine})
    roads.table("car", engine.places[:4], NO_TIME)
    roads.table("car", engine.places, NO_TIME)
    assert engine.legs == 4 * 4 + 12 * 12
