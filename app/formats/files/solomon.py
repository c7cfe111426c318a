"""Reads Solomon's text format, which Gehring and Homberger's instances have too.

The package vrplib reads it as well, but takes a decimal for -1.
"""

import numpy as np

from app.formats.files.instance import FileVehicles, InstanceFile, InstanceFileError

_HEADINGS = ("VEHICLE", "NUMBER", "CUSTOMER", "CUST")
"""What the second, third, fifth and sixth line begin with."""

_COLUMNS = 7
_DEMAND, _EARLIEST, _LATEST, _SERVICE = 3, 4, 5, 6


def is_solomon(text: str) -> bool:
    """Tell a Solomon file by its headings."""
    lines = _lines(text)
    headings = (*lines[1:3], *lines[4:6])
    return len(lines) > 6 and all(
        line.upper().startswith(heading)
        for line, heading in zip(headings, _HEADINGS, strict=True))


def read_solomon(text: str) -> InstanceFile:
    """Return the instance that a Solomon file holds; node 0 is the depot.

    Raises
    ------
    InstanceFileError
        If it is none.
    """
    if not is_solomon(text):
        raise InstanceFileError(
            "This is no Solomon file: it lacks the headings VEHICLE, NUMBER, CUSTOMER, CUST NO.")
    lines = _lines(text)
    count, capacity = _numbers(lines[3], 2)
    if count < 1 or not count.is_integer():
        raise InstanceFileError(f"{lines[3]!r} must state how many vehicles there are.")
    rows = [_numbers(line, _COLUMNS) for line in lines[6:]]
    for number, row in enumerate(rows):
        if row[0] != number:
            raise InstanceFileError(f"Customer {row[0]:g} stands where {number} is expected: "
                                    "number the lines from 0, in order.")
    table = np.array(rows, dtype=np.float64)
    if table[0, _DEMAND] or table[0, _SERVICE]:
        raise InstanceFileError("The depot, line 0, has a demand or a service time.")
    return InstanceFile(
        name=lines[0],
        depots=(0,),
        coordinates=table[:, 1:3],
        edge_weight="EUC_2D",
        explicit_weights=None,
        demand=table[:, _DEMAND],
        earliest=table[:, _EARLIEST],
        latest=table[:, _LATEST],
        service=table[:, _SERVICE],
        release=np.zeros(len(table)),
        vehicles=(FileVehicles(int(count), capacity),),
    )


def _lines(text: str) -> list[str]:
    return [stripped for line in text.splitlines() if (stripped := line.strip())]


def _numbers(line: str, count: int) -> list[float]:
    try:
        numbers = [float(word) for word in line.split()]
    except ValueError as error:
        raise InstanceFileError(f"{line!r} is not made of numbers: {error}") from error
    if len(numbers) != count or not np.isfinite(numbers).all():
        raise InstanceFileError(f"{line!r} must hold {count} finite numbers.")
    return numbers
