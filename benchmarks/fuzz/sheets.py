"""How sheets drawn from a seed are read: rightly or wrongly, and marked or unseen.

    python -m benchmarks.fuzz.sheets --count 3000

What a sheet means is known. A reading is *right* or *wrong*, and *quiet* or *marked*: by an error,
a question without an answer, or a doubt about what it is made of. A wrong one that is quiet is the
danger; headings come from `sheet_words.toml`, not from the words that the reader knows.
"""

import argparse
from collections import Counter
from typing import Any

from app.formats.sheets.importing import import_file
from app.formats.sheets.schemas import ImportReply, ImportSettings
from benchmarks.fuzz.drawn_sheets import DAY, Drawn, drawn, words

NOTES = ("RIDES_BACK", "MIDNIGHT", "TOTAL_LEFT_OUT", "ENCODING_GUESSED", "OTHER_DAYS", "NO_AMOUNTS",
         "ROWS_JOINED", "FLEET_NAMED")
"""Doubts that tell what was done, and are no mark."""

READINGS = ("right, quiet", "right, marked", "wrong, marked", "wrong, quiet")


def read(sheet: Drawn) -> ImportReply:
    """Return how a drawn sheet is read, with nothing stated but fleet and depot."""
    lat, lon = words()[sheet.language]["near"]
    return import_file(sheet.content, ImportSettings.model_validate({
        "depot": f"{lat}, {lon}", "shift": "5:00-22:00",
        "day": DAY.isoformat()}))


def marks_of(reply: ImportReply) -> list[str]:
    """Return what a reading marks: errors, open questions, doubts."""
    marks = [f"error {error.code}" for error in reply.errors]
    marks += [f"question {asked.id}" for asked in reply.questions if not asked.is_answered
              and asked.kind not in ("column", "total_rows")]
    marks += [f"doubt {doubt.code}" for doubt in reply.doubts if doubt.code not in NOTES
              and not doubt.code.endswith("_ASSUMED")]
    return marks + [f"column {column.certainty} {column.heading}" for column in reply.columns
                    if column.certainty in ("doubtful", "open")]


def wrongs_of(sheet: Drawn, reply: ImportReply) -> list[str]:
    """Return what of a reading is wrong, in words."""
    if reply.request is None:
        return ["nothing is planned"]
    made = [*map(_customer, reply.request["customers"]),
            *map(_shipment, reply.request.get("shipments", ()))]
    if len(made) != len(sheet.truth):
        return [f"{len(made)} in place of {len(sheet.truth)}"]
    return [f"{what}: {found.get(what)} in place of {value}"
            for truth, found in zip(sheet.truth, made, strict=True)
            for what, value in truth.items() if found.get(what) != value][:3]


def _customer(stated: dict[str, Any]) -> dict[str, Any]:
    lon, lat = stated["location"]
    return {"name": stated["id"], "place": (lat, lon), "demand": stated["demand"],
            "window": _window(stated), "service": stated.get("service_duration", 0),
            "crew": stated.get("vehicles", {}).get("allowed", [])}


def _shipment(stated: dict[str, Any]) -> dict[str, Any]:
    ends = {end: stated[end] for end in ("pickup", "delivery")}
    made: dict[str, Any] = {end: tuple(reversed(place["location"])) for end, place in ends.items()}
    begins, until = (_window(place) for place in ends.values())
    return made | {"amount": stated["amount"], "pickup_from": begins and begins[0],
                   "delivery_by": until and until[1]}


def _window(stated: dict[str, Any]) -> tuple[float, float | None] | None:
    windows = stated.get("time_windows") or [stated.get("time_window")]
    if windows[0] is None:
        return None
    return windows[0].get("earliest", 0), windows[-1].get("latest")


def reading_of(sheet: Drawn) -> tuple[str, list[str], list[str]]:
    """Return which of `READINGS` a sheet gets, what is wrong, and what is marked."""
    reply = read(sheet)
    marks, wrongs = marks_of(reply), wrongs_of(sheet, reply)
    if sheet.is_half:
        wrongs = [] if reply.request is None else ["half a pair is planned"]
        return READINGS[1 if not wrongs else 2 if marks else 3], wrongs, marks
    place = (1 if marks else 0) if not wrongs else (2 if marks else 3)
    return READINGS[place], wrongs, marks


def main() -> None:
    """Print how many sheets are read how, and those that are wrong."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=3000)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--show", default="wrong", help="readings that are listed")
    options = parser.parse_args()
    counts: Counter[str] = Counter()
    causes: Counter[str] = Counter()
    for seed in range(options.first, options.first + options.count):
        sheet = drawn(seed)
        reading, wrongs, marks = reading_of(sheet)
        counts[reading] += 1
        causes.update(set(marks) if reading == READINGS[1] else ())
        if options.show in reading:
            print(f"{seed} {sheet.language} {sheet.layout}: {reading}; {wrongs}; {marks[:4]}; "
                  f"{list(zip(sheet.roles, sheet.headings, strict=True))}")
    for cause, times in causes.most_common(25):
        print(f"{times:5} {cause}")
    for reading in READINGS:
        print(f"{reading:14} {counts[reading]:5} {counts[reading] / options.count:7.2%}")


if __name__ == "__main__":
    main()
