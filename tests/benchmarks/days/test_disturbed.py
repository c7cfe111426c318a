"""What is told of days with disturbances."""

from pathlib import Path

from benchmarks.days.disturbed_report import draw, table

FOUND = {
    name: [{"cost": cost, "served": 10, "kept": kept, "wanted": 20, "changes": changes}
           for cost, kept, changes in days]
    for name, days in {"hourly": [(100.0, 9, 1), (120.0, 10, 3)],
                       "never": [(40.0, 2, 0), (60.0, 3, 0)]}.items()}


def test_table_has_a_row_for_each_way() -> None:
    assert table(FOUND).splitlines()[2:] == [
        "| hourly | 110 | 11.00 | 50.0 | 47.5 | 2.0 |", "| never | 50 | 5.00 | 50.0 | 12.5 | 0.0 |"]


def test_picture_of_the_same_days_is_the_same(tmp_path: Path) -> None:
    paths = [tmp_path / "one.svg", tmp_path / "two.svg"]
    for path in paths:
        draw(FOUND, path)
    one, two = (path.read_text() for path in paths)
    assert one == two
    assert all(word in one for word in ("hourly", "never", "promises kept, %"))
