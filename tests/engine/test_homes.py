"""Each rule stands in one file of `engine/rules`, and nobody else applies it."""

import re
from pathlib import Path

import pytest

ENGINE = Path(__file__).parents[2] / "engine"

HOMES = {
    "rules/start.h": {"begun", "busy_until"},
    "rules/shift.h": {"max_sorties", "max_stops", "overtime", "usual_end", "usual_working"},
    "rules/rates.h": {"drone_distance", "drone_time"},
    "rules/window.h": {"arrival_limit", "drone_variant", "service_duration", "variant",
                       "window_earliest", "window_latest"},
    "rules/flight.h": {"endurance", "launch_duration", "recovery_duration", "relaunch_duration",
                       "waiting_counts"},
    "rules/energy.h": {"battery", "charge", "climb_duration", "cruise", "descent_duration",
                       "first_charge", "hover", "lands", "points"},
    "rules/load.h": {"capacity", "demand", "payload", "pickup_order"},
    "rules/clock.h": {"setup_duration", "site", "speed_changes"},
    "rules/drone_types.h": {"drone_row"},
    "rules/leg.h": {"law", "nowhere", "pace", "stated"},
}
"""Which fields nobody can apply a rule without, by the file that reads them."""

ELSEWHERE = {
    "rules/leg.cpp": HOMES["rules/leg.h"] | {"setup_duration", "site"},
    "rules/drone_types.h": {"drones"},
    "policy/features.cpp": {"capacity", "drone_distance", "drone_time"},
    "simulation/aboard.cpp": {"demand"},
}
"""What states a limit but applies none, shows it to a network for example, or calls so what is its
own."""


def fields_of(text: str) -> set[str]:
    """Return the names of the fields that C++ reads or writes."""
    code = re.sub(r"//.*", "", text)
    return set(re.findall(r"(?:\.|->)([a-z_]+)\b(?!\(\))", code))


@pytest.mark.parametrize("home", HOMES)
def test_a_rule_has_one_home(home: str) -> None:
    elsewhere = {}
    for path in (*ENGINE.rglob("*.h"), *ENGINE.rglob("*.cpp")):
        name = path.relative_to(ENGINE).as_posix()
        if name != home and not name.startswith(("include/", "problem/", "tests/")):
            applied = fields_of(path.read_text()) & HOMES[home] - ELSEWHERE.get(name, set())
            if applied:
                elsewhere[name] = applied
    assert elsewhere == {}


@pytest.mark.parametrize("applied", [
    "if (arrival > place[0].arrival_limit) return;", "flight <= data.type[k].endurance",
    "type->capacity[0] - load", "legs.stated(m, here, there, 0)",
])
def test_a_rule_applied_outside_its_home_is_found(applied: str) -> None:
    assert fields_of(applied) & set.union(*HOMES.values())
