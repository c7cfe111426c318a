"""What may be wrong with the answers of a server of roads, by name."""

from tests.app.maps.roads import faults
from tests.app.maps.roads.faults import Answer, Fault


def swap_rows(answer: Answer) -> None:
    answer["sources"].reverse()
    answer["durations"].reverse()
    answer["distances"].reverse()


def somewhere(answer: Answer) -> None:
    answer["sources"][0]["location"][0] += 0.1


MENDED: dict[str, Fault] = {
    "refused": faults.cut(0.0),
    "cut in the head": faults.cut(0.03),
    "cut in the body": faults.cut(0.7),
    "longer than it is": faults.longer,
    "not compressed": faults.uncompressed,
    **{f"status {code}": faults.status(code) for code in (408, 429, 500, 502, 503, 504)},
    "a moment, please": faults.status(429, Retry_After="0"),
    "a date": faults.status(503, Retry_After="Sun, 22 Nov 2020 00:00:00 GMT"),
    "no date": faults.status(503, Retry_After="soon"),
}
"""What asking again may mend."""

WRONG: dict[str, Fault] = {
    "cut unseen": faults.cut_unseen(0.7),
    "half a compression": faults.compressed(0.5),
    "empty": faults.body(b""),
    "a page": faults.body(b"<html>Sign in</html>"),
    "bytes": faults.body(bytes(range(256))),
    "null": faults.body(b"null"),
    "a list": faults.body(b"[]"),
    "deep": faults.body(b"[" * 30_000),
    "endless": faults.body(b" " * 200_000),
    "a bomb": faults.body(b"[" + b"0," * 200_000 + b"0]"),
    "not a number": faults.number(b"NaN"),
    "infinite": faults.number(b"Infinity"),
    "too large": faults.number(b"1e999"),
    "huge": faults.number(b"1e300"),
    "a string": faults.number(b'"12"'),
    "true": faults.number(b"true"),
    "an object": faults.number(b"{}"),
    "another code": faults.changed(lambda answer: answer.update(code="NoTable")),
    "no code": faults.changed(lambda answer: answer.pop("code")),
    "no durations": faults.changed(lambda answer: answer.pop("durations")),
    "no distances": faults.changed(lambda answer: answer.update(distances=None)),
    "no sources": faults.changed(lambda answer: answer.pop("sources")),
    "a row less": faults.changed(lambda answer: answer["durations"].pop()),
    "a row more": faults.changed(lambda answer: answer["distances"].append([])),
    "a column less": faults.changed(lambda answer: answer["durations"][0].pop()),
    "a column more": faults.changed(lambda answer: answer["durations"][0].append(1.0)),
    "no row": faults.changed(lambda answer: answer["durations"].__setitem__(0, None)),
    "a source less": faults.changed(lambda answer: answer["sources"].pop()),
    "another order": faults.changed(swap_rows),
    "another spot": faults.changed(somewhere),
    "a spot off the globe": faults.changed(
        lambda answer: answer["sources"][0].update(location=[200.0, 60.0])),
    "half a spot": faults.changed(lambda answer: answer["sources"][0].update(location=[24.9])),
    "half a way": faults.changed(lambda answer: answer["durations"][0].__setitem__(0, None)),
    "less than nothing": faults.changed(
        lambda answer: answer["durations"][0].__setitem__(0, -1.0)),
    "no distance": faults.changed(
        lambda answer: answer.update(distances=[[0.0] * len(row) for row in answer["distances"]])),
    "kilometres": faults.changed(lambda answer: answer.update(
        distances=[[x and x / 1000 for x in row] for row in answer["distances"]])),
    "hours": faults.changed(lambda answer: answer.update(
        durations=[[x and x / 3600 for x in row] for row in answer["durations"]])),
    "status 400": faults.status(400),
    "status 404": faults.status(404),
    "status 204": faults.status(204),
    "elsewhere": faults.status(302, Location="http://127.0.0.1:1/"),
    "endless pause": faults.status(429, Retry_After="86400"),
}
"""What asking again is not to mend."""

SLOW: dict[str, Fault] = {
    "late": faults.delay(0.05),
    "too late": faults.delay(1_000.0),
    "drop by drop": faults.drip(0.02),
}


NOWHERE = faults.changed(lambda answer: answer["sources"].__setitem__(0, None))
"""Puts a place on no road."""
