"""What published rules ask of drones: the numbers that `drones.preset` names, and their sources.

`docs/use/permits.md` tells what else they ask, which nothing here looks at.
"""

from typing import Literal, NamedTuple

from pydantic import BaseModel

RuleName = Literal["eu-pdra-g01", "eu-pdra-g02", "us-part-107"]


class Rule(NamedTuple):
    """The numbers of a rule; None where it has none."""

    max_airborne: int  # for each pilot, taken as each truck
    truck_waits: bool
    max_range: float | None  # metres
    altitude: float | None  # metres above ground, at most
    source: str


RULES: dict[RuleName, Rule] = {
    "eu-pdra-g01": Rule(
        1, True, 1000.0, 150.0,
        "EASA, AMC2 to Article 11 of Regulation (EU) 2019/947, PDRA-G01 version 1.3 (ED Decision "
        "2023/012/R), Table PDRA-G01.1: one aircraft a pilot (1.2), not from a moving vehicle "
        "(1.3), within 1 km without airspace observers (UA range limit), below 150 m (flight "
        "height limit)"),
    "eu-pdra-g02": Rule(
        1, True, None, None,
        "EASA, AMC3 to Article 11 of Regulation (EU) 2019/947, PDRA-G02 version 1.2 (ED Decision "
        "2023/012/R), Table PDRA-G02.1: one aircraft a pilot (1.2), not from a moving vehicle "
        "(1.3); range and height are those of the radio link and of the reserved airspace"),
    "us-part-107": Rule(
        1, True, None, 121.92,
        "14 CFR Part 107: one aircraft a pilot (107.35), not from a moving vehicle with other "
        "people's property for hire (107.25(b)), at most 400 ft above ground (107.51(b)); in sight "
        "(107.31), for which it has no number"),
}


def fill_in(flyer: BaseModel, preset: RuleName | None) -> None:
    """Give what flies the numbers of the rule that it names, where it states none. In place."""
    if preset is None:
        return
    for name in ("max_range", "altitude"):
        number = getattr(RULES[preset], name)
        if number is not None and name not in flyer.model_fields_set:
            object.__setattr__(flyer, name, number)
