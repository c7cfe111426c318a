"""A look at a body before it is parsed: how much is in it, and how much of that can't be right.

Parsing and validating hold Python's lock and take memory for each value and for each error, so a
body that is wrong all over would cost a thousand times its length. This takes a few nanoseconds
for a byte, no memory, and doesn't hold the lock.

What is compiled in stands in this file, since it is this file that a change is looked for in.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from model.kernel.compiled import compiled, inlined

OBJECT, ARRAY, STRING, INTEGER, FRACTION, BOOLEAN, NULL = (1 << bit for bit in range(7))

NOTHING, ANYTHING = 0, 1
"""Shapes that allow nothing and everything."""

NO_SHAPE = -1

FNV_START, FNV_FACTOR = 14695981039346656037, 1099511628211
"""Of the hash of a name, FNV-1a."""

DEPTH = 256
"""Levels that are followed, the body itself among them; the parser gives up at fewer."""

SHAPE, COUNT, SEEN, KEY_START, KEY_END, HAS_ERROR = range(6)
"""Columns of what is known of a level: of its object or array, and of the entry that is read."""

ERRORS, PARTS, LOOSE, LEVELS = range(4)
"""Columns of what is counted: errors, objects and arrays, values whose shape doesn't matter, and
how many levels are open where the scan ends."""

_START, _FACTOR = np.uint64(FNV_START), np.uint64(FNV_FACTOR)


class Shapes(NamedTuple):
    """All shapes of a schema, in columns; the last one has a whole body as its only entry."""

    kinds: NDArray[np.int64]  # bits of what a value may be
    lowest: NDArray[np.float64]  # of numbers
    highest: NDArray[np.float64]
    shortest: NDArray[np.int64]  # of strings in characters
    longest: NDArray[np.int64]
    most: NDArray[np.int64]  # entries of an array, or of an object with free keys
    fewest: NDArray[np.int64]  # entries of an array
    entry: NDArray[np.int64]  # shape of these, NO_SHAPE where keys are not free
    is_row: NDArray[np.bool_]  # whether an array of numbers is left at its first error
    required: NDArray[np.int64]  # bits of keys
    first_key: NDArray[np.int64]  # (shape + 1,) of an object's fields or a string's values
    key_hash: NDArray[np.uint64]  # (key,)
    key_shape: NDArray[np.int64]


@inlined
def _number(text: NDArray[np.uint8], at: int) -> tuple[int, int, float]:
    """Read what should be a number; return where it ends, its kind and about its value."""
    length, begin = len(text), at
    kind, value, scale, sign = INTEGER, 0.0, 1.0, 1.0
    exponent, exponent_sign, part = 0, 1, 0
    while at < length:
        byte = text[at]
        if 48 <= byte <= 57:
            if part == 0:
                value = 10.0 * value + (byte - 48)
            elif part == 1:
                scale *= 0.1
                value += scale * (byte - 48)
            else:
                exponent = min(10 * exponent + (byte - 48), 1000)
        elif byte == 46:  # .
            kind, part = FRACTION, 1
        elif byte in (101, 69):  # e E
            kind, part = FRACTION, 2
        elif byte == 45:  # -
            if part == 2:
                exponent_sign = -1
            else:
                sign = -1.0
        elif byte == 73:  # -Infinity
            at += 7
            value = np.nan
        elif byte != 43:  # +
            break
        at += 1
    if at == begin:
        # No number either: the parser goes no further.
        return length, 0, 0.0
    return at, kind, sign * value * 10.0 ** (exponent_sign * exponent)


@compiled
def _row(text: NDArray[np.uint8], at: int, kinds: int, lowest: float,
         highest: float) -> tuple[int, int, bool]:
    """Read numbers up to what is none; return where, how many and whether all are right."""
    length, number, is_right = len(text), 0, True
    while at < length:
        byte = text[at]
        if byte == 45 or 48 <= byte <= 57:
            at, kind, value = _number(text, at)
            number += 1
            is_right &= kind & kinds != 0 and lowest <= value <= highest
        elif byte in (32, 9, 10, 13, 44):
            at += 1
        else:
            break
    return at, number, is_right


@inlined
def _field(shapes: Shapes, level: NDArray[np.int64], code: np.uint64, escapes: bool,
           found: NDArray[np.int64]) -> int:
    """Return the shape of what an object has under a key, and count what is wrong. In place."""
    shape = level[SHAPE]
    level[COUNT] += 1
    first, last = shapes.first_key[shape], shapes.first_key[shape + 1]
    # Nobody writes names of fields by numbers of characters, except to hide what follows.
    if escapes and last > first:
        return NOTHING
    for key in range(first, last):
        if shapes.key_hash[key] == code:
            bit = np.int64(1) << (key - first)
            if level[SEEN] & bit:
                found[ERRORS] += 1
            level[SEEN] |= bit
            return int(shapes.key_shape[key])
    if shapes.entry[shape] == NO_SHAPE:
        found[ERRORS] += 1
        return ANYTHING if shape != NOTHING else NOTHING
    if level[COUNT] > shapes.most[shape]:
        found[ERRORS] += 1
    return int(shapes.entry[shape])


@inlined
def _allows(shapes: Shapes, shape: int, kind: int, value: float, code: np.uint64,
            escapes: bool) -> bool:
    """Tell whether a shape allows a value: of a kind, a number, or a string of a length."""
    if not shapes.kinds[shape] & kind:
        return False
    if kind == STRING:
        first, last = shapes.first_key[shape], shapes.first_key[shape + 1]
        if first < last and shape > ANYTHING and not shapes.kinds[shape] & OBJECT and not escapes:
            is_known = False
            for key in range(first, last):
                is_known |= shapes.key_hash[key] == code
            return is_known
        return bool(shapes.shortest[shape] <= value <= shapes.longest[shape] or escapes)
    if kind in (INTEGER, FRACTION):
        return bool(shapes.lowest[shape] <= value <= shapes.highest[shape])
    return True


@inlined
def _string(text: NDArray[np.uint8], at: int) -> tuple[int, int, np.uint64, bool]:
    """Read a string; return where it ends, its length, its hash, and whether it has escapes."""
    characters, code, escapes = 0, _START, False
    at += 1
    while at < len(text) and text[at] != 34:  # "
        if text[at] == 92:  # backslash
            escapes = True
            at += 1
        if at < len(text):
            code = (code ^ np.uint64(text[at])) * _FACTOR
            characters += text[at] & 0xC0 != 0x80  # all but the first byte of one are 10xxxxxx
        at += 1
    return at + 1, characters, code, escapes


@inlined
def _value(text: NDArray[np.uint8], at: int) -> tuple[int, int, float, np.uint64, bool]:
    """Read a value, of an object or array its begin; return where it ends and what it is.

    That is its kind, a number or the length of a string, and the string's hash and escapes.
    """
    byte, value, code, escapes = text[at], 0.0, _START, False
    if byte == 34:  # "
        kind = STRING
        at, characters, code, escapes = _string(text, at)
        value = float(characters)
    elif byte in (123, 91):  # { [
        kind = OBJECT if byte == 123 else ARRAY
        at += 1
    elif byte in (116, 102):  # true, false
        kind = BOOLEAN
        at += 4 if byte == 116 else 5
    elif byte == 110:  # null
        kind = NULL
        at += 4
    elif byte in (78, 73):  # NaN, Infinity
        kind, value = FRACTION, np.nan
        at += 3 if byte == 78 else 8
    else:
        at, kind, value = _number(text, at)
    return at, kind, value, code, escapes


@inlined
def _entry(shapes: Shapes, level: NDArray[np.int64], found: NDArray[np.int64]) -> int:
    """Return the shape of an array's next entry, and count one too many. In place."""
    level[COUNT] += 1
    found[ERRORS] += level[COUNT] > shapes.most[level[SHAPE]]
    return int(max(shapes.entry[level[SHAPE]], NOTHING))


@inlined
def _open(shapes: Shapes, level: NDArray[np.int64], shape: int, kind: int,
          found: NDArray[np.int64]) -> None:
    """Begin an object or array. In place."""
    found[PARTS] += 1
    level[:] = 0
    level[SHAPE] = shape
    level[KEY_START] = 0 if kind == OBJECT else -1


@inlined
def _close(shapes: Shapes, level: NDArray[np.int64], found: NDArray[np.int64]) -> None:
    """End an object or array, and count what it lacks. In place."""
    if level[KEY_START] < 0:
        found[ERRORS] += max(0, shapes.fewest[level[SHAPE]] - level[COUNT])
        return
    missing = shapes.required[level[SHAPE]] & ~level[SEEN]
    while missing:
        missing &= missing - 1
        found[ERRORS] += 1


@inlined
def _numbers(text: NDArray[np.uint8], at: int, shapes: Shapes, level: NDArray[np.int64],
             found: NDArray[np.int64]) -> int:
    """Read an array of numbers up to what is none, and return where; it has one error. In place."""
    shape = level[SHAPE]
    entry = shapes.entry[shape]
    at, number, is_right = _row(text, at, shapes.kinds[entry], shapes.lowest[entry],
                                shapes.highest[entry])
    level[COUNT], level[HAS_ERROR] = number, not is_right
    found[ERRORS] += (not is_right) + max(0, number - shapes.most[shape])
    return at


@inlined
def _is_within(found: NDArray[np.int64], most: NDArray[np.int64]) -> bool:
    return bool(found[ERRORS] <= most[ERRORS] and found[PARTS] <= most[PARTS]
                and found[LOOSE] <= most[LOOSE])


@inlined
def _wrong(shapes: Shapes, level: NDArray[np.int64], shape: int, kind: int,
           found: NDArray[np.int64]) -> int:
    """Count a wrong value, and return the shape of what is in it. In place."""
    # An array of numbers is left at its first error.
    if level[HAS_ERROR] == 0 or kind in (OBJECT, ARRAY) or not shapes.is_row[level[SHAPE]]:
        # What is neither the number nor the text that it may be is two errors.
        is_either = shapes.kinds[shape] & FRACTION and shapes.kinds[shape] & STRING
        found[ERRORS] += 2 if is_either else 1
    level[HAS_ERROR] = 1
    return NOTHING if shape == NOTHING else ANYTHING


@compiled
def scan(text: NDArray[np.uint8], shapes: Shapes, most: NDArray[np.int64],
         levels: NDArray[np.int64], found: NDArray[np.int64]) -> bool:
    """Count what is in a body, up to bounds; tell whether none was exceeded. In place.

    Parameters
    ----------
    text
        JSON. Where it is none, what comes after is not looked at by the parser either.
    shapes
        What the body may hold.
    most
        Bounds of the first columns of `found`.
    levels
        (DEPTH, 6) what is open where the scan ends: the body itself, and what is in it.
    found
        What was counted.
    """
    at, depth, awaits_key = 0, 0, False
    _open(shapes, levels[0], len(shapes.kinds) - 1, ARRAY, found)
    while at < len(text) and _is_within(found, most):
        level, byte = levels[depth], text[at]
        if byte in (32, 9, 10, 13, 44, 58):  # white space, comma, colon
            at += 1
        elif byte in (125, 93):  # } ]
            if depth == 0:
                break
            _close(shapes, level, found)
            at, depth = at + 1, depth - 1
            awaits_key = levels[depth, KEY_START] >= 0
        elif awaits_key and byte == 34:  # "
            end, _, code, escapes = _string(text, at)
            level[KEY_START], level[KEY_END] = at + 1, end - 1
            shape, at, awaits_key = _field(shapes, level, code, escapes, found), end, False
        else:
            at, kind, value, code, escapes = _value(text, at)
            if level[KEY_START] < 0:
                shape = _entry(shapes, level, found)
            if not _allows(shapes, shape, kind, value, code, escapes):
                shape = _wrong(shapes, level, shape, kind, found)
            found[LOOSE] += shape == ANYTHING
            if kind in (OBJECT, ARRAY):
                depth += 1
                if depth == DEPTH:
                    break
                _open(shapes, levels[depth], shape, kind, found)
                if shapes.is_row[shape] and kind == ARRAY:
                    at = _numbers(text, at, shapes, levels[depth], found)
            awaits_key = levels[depth, KEY_START] >= 0
    found[LEVELS] = min(depth + 1, DEPTH)
    return _is_within(found, most)
