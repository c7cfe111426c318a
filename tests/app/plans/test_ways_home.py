"""Ways home on days under way: past breaks of vehicles that broke down, and where there is none."""

import httpx
import pytest

from tests.app.plans.test_going_on import Request, plan_of, replanned, street, times

__all__ = ["street"]

LUNCH = {"id": "lunch", "duration": 600, "start": {"earliest": 400, "latest": 460},
         "at": "anywhere"}


@pytest.mark.parametrize(("now", "home"), [
    (350, 480),  # before it begins
    (420, 1080),  # while it lasts
    (1040, 1080), (1060, 1080)])
def test_break_on_the_way_home_takes_its_time_though_the_van_breaks_down(
        searching: httpx.Client, street: Request, now: float, home: float) -> None:
    van = {"breaks": [LUNCH], "costs": {"per_hour": 3600}}
    request = street | {"customers": [{"id": "d", "location": [4, 0], "demand": [1]}],
                        "fleet": [street["fleet"][0] | van]}
    tour = plan_of(("depot", "hub", 0, 0), ("customer", "d", 240, 240),
                   ("break", "lunch", 400, 1000), ("depot", "hub", 1080, 1080))
    plan = replanned(searching, request, tour, now, unavailable=["van-1"])
    assert times(plan, "van-1")[-1] == ("hub", home, home)
    assert plan["cost"]["time"] == pytest.approx(home)


NAP = {"id": "nap", "duration": 60, "start": {"earliest": 150, "latest": 215}}
RESTING: dict[str, Request] = {
    "stop": {"breaks": [NAP]}, "anywhere": {"breaks": [NAP | {"at": "anywhere"}]},
    "rest": {"driving_rules": {"max_driving": 80, "break_duration": 60}}}


@pytest.mark.thorough_after(6)
@pytest.mark.parametrize("kind", RESTING)
@pytest.mark.parametrize("way", [30, 60, 90])  # seconds to b, and home 60
@pytest.mark.parametrize(("rested", "is_taken"), [(-10, False), (0, True), (20, True), (120, True)])
def test_break_on_arrival_takes_its_time_though_the_van_breaks_down_there(
        searching: httpx.Client, street: Request, rested: float, is_taken: bool, way: float,
        kind: str) -> None:
    street["fleet"][0] |= RESTING[kind] | {"costs": {"per_hour": 3600}}
    street["customers"] = street["customers"][:2]
    street["customers"][1] |= {"location": [1 + way / 60, 0], "time_window": {"earliest": 400}}
    begin, name = 120 + way, "rest" if kind == "rest" else "nap"
    taken = (name, begin, begin + 60)
    tour = plan_of(("depot", "hub", 0, 0), ("customer", "a", 60, 120), ("break", *taken),
                   ("customer", "b", begin + 60, 460), ("depot", "hub", 520 + way, 520 + way))
    tour["routes"][0]["trips"][0]["stops"][3]["service_start"] = 400
    now = begin + rested
    plan = replanned(searching, street, tour, now, unavailable=["van-1"])
    home = max(now, begin + 60, 240) if is_taken else max(now, 180)
    assert times(plan, "van-1")[2:] == [*[taken] * is_taken, ("hub", home, home)]
    assert plan["routes"][0]["working_duration"] == home
    again = replanned(searching, street, plan, now + 5, unavailable=["van-1"])
    assert times(again, "van-1")[:3] == times(plan, "van-1")[:3]


@pytest.mark.parametrize("now", [0, 50, 100, 150, 250])
def test_truck_drives_on_as_planned_where_no_way_leads_home_from_its_next_stop(
        searching: httpx.Client, now: float) -> None:
    # From a home there is no way but by b.
    table = [[0, 100, 300, 100], [None, 0, 100, 500], [100, 300, 0, 500], [100, 500, 500, 0]]
    request = {"depots": [{"id": "d", "location_index": 0}],
               "matrices": {"truck": {"durations": table, "distances": table}},
               "customers": [{"id": name, "location_index": place, "demand": [1]}
                             for place, name in enumerate("abe", 1)],
               "fleet": [{"id": "van", "count": 2, "capacity": [2], "costs": {"per_hour": 36}}],
               "options": {"time_limit": 60, "search_iterations": 40}}
    plan = plan_of(("depot", "d", 0, 0), ("customer", "a", 100, 100), ("customer", "b", 200, 200),
                   ("depot", "d", 300, 300))
    found = replanned(searching, request, plan, now)
    assert times(found, "van-1") == [("d", 0, 0), ("a", 100, 100), ("b", 200, 200), ("d", 300, 300)]
    assert found["unassigned"] == []
