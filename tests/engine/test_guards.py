"""No exception leaves the engine: each of its functions returns what went wrong as a code."""

import re
from pathlib import Path

ENGINE = Path(__file__).resolve().parents[2] / "engine"

FUNCTION = re.compile(r"^(?:extern \"C\" )?(?:int|void) (tandem_\w+)\([^;{]*\) \{\n(.*?)^\}",
                      re.MULTILINE | re.DOTALL)


def functions() -> dict[str, str]:
    """Return what the functions of the C interface do, by name."""
    return {found[1]: found[2] for path in ENGINE.rglob("*.cpp") if "tests" not in path.parts
            for found in FUNCTION.finditer(path.read_text("utf-8"))}


DECLARED = re.compile(r"^int (tandem_\w+)\(", re.MULTILINE)


def test_all_functions_of_the_interface_are_guarded() -> None:
    declared = DECLARED.findall((ENGINE / "include" / "tandem.h").read_text("utf-8"))
    written = functions()
    assert len(declared) > 40
    assert [name for name in declared if "guarded(" not in written[name]] == []
