"""Each rule stands in one file of `engine/rules`, and nobody else applies it."""

import re
from collections import Counter
from pathlib import Path

import pytest

ENGINE = Path(__file__).parents[2] / "engine"

RULES = "tandem_vehicle_type", "tandem_rate", "tandem_node", "tandem_setup", "tandem_leg_law"
"""Structs of the header that state rules."""

ANYBODYS = {
    "begins_at", "carried", "changes_ends", "count", "depot", "distance", "drone_travel", "drones",
    "ends_at", "fixed", "home_travel", "load", "max_trips", "metres", "more", "release",
    "reload_duration", "rounding", "sets_up", "shift_earliest", "stop", "straight_travel", "table",
    "time", "travel"}
"""Their fields that forbid nothing and cost nothing by themselves, or whose names others have."""

SHOWN = {"policy/features.cpp": {"capacity", "drone_distance", "drone_time"},
         "simulation/aboard.cpp": {"demand"}}
"""Who shows a field to a network, or calls so what is its own."""

TWICE = {"setup_duration", "site"}
"""Setups are a part of legs, but where speeds change."""


def stated() -> set[str]:
    """Return the fields that state rules nobody can apply without them."""
    header = re.sub(r"/\*.*?\*/", "", (ENGINE / "include/tandem.h").read_text(), flags=re.DOTALL)
    bodies = [body for name, body in re.findall(
        r"typedef struct (\w+) \{(.*?)\} \1;", header, re.DOTALL) if name in RULES]
    assert len(bodies) == len(RULES)
    return set(re.findall(r"(\w+)(?:\[\d+\])?[,;]", "".join(bodies))) - ANYBODYS


def fields_of(text: str) -> set[str]:
    """Return the names of the fields that C++ reads or writes."""
    code = re.sub(r"//.*", "", text)
    return set(re.findall(r"(?:\.|->)([a-z_]+)\b(?!\(\))", code))


def sources() -> dict[str, set[str]]:
    """Return the fields that each file of the engine reads or writes."""
    return {path.relative_to(ENGINE).as_posix(): fields_of(path.read_text())
            for path in (*ENGINE.rglob("*.h"), *ENGINE.rglob("*.cpp"))
            if path.relative_to(ENGINE).parts[0] not in ("include", "tests")}


def test_a_type_has_its_name_to_itself() -> None:
    names = Counter(name for path in (*ENGINE.rglob("*.h"), *ENGINE.rglob("*.cpp"))
                    if path.relative_to(ENGINE).parts[0] not in ("include", "tests")
                    for name in re.findall(
                        r"^ *(?:struct|class|enum class) ([A-Z]\w*)(?!\w|<)[^;]*$",
                        path.read_text(), re.MULTILINE))
    assert [name for name, homes in names.items() if homes > 1] == []


def test_nobody_but_a_rule_reads_what_states_it() -> None:
    applied = {name: fields & stated() - SHOWN.get(name, set())
               for name, fields in sources().items() if not name.startswith("rules/")}
    assert {name: fields for name, fields in applied.items() if fields} == {}


def test_a_rule_has_one_home() -> None:
    rules = {name: fields for name, fields in sources().items() if name.startswith("rules/")}
    homes = {field: {Path(name).stem for name, fields in rules.items() if field in fields}
             for field in stated() - TWICE}
    assert {field: stems for field, stems in homes.items() if len(stems) != 1} == {}


@pytest.mark.parametrize("applied", [
    "if (arrival > place[0].arrival_limit) return;", "flight <= data.type[k].endurance",
    "type->battery - taken", "working > type.max_working_duration",
])
def test_a_rule_applied_outside_its_home_is_found(applied: str) -> None:
    assert fields_of(applied) & stated()
