"""What is kept of a body, and what is refused, without making objects of it."""

import json
import tracemalloc
from typing import Any

import pytest

from app.records.kept.reading import read_content
from app.schemas.errors import InvalidRequestError, NotJsonError
from tests.app.records.kept.conftest import content

pytestmark = pytest.mark.slow


def body_with(**parts: bytes) -> bytes:
    """Return a body with parts as they are written."""
    return b"{" + b",".join(b'"%s":%s' % (name.encode(), value) for name, value in {
        "name": b'"a"', "request": b'{"depots":[],"customers":[],"fleet":[]}', **parts}.items()
        ) + b"}"


def test_content_stays_as_written_but_for_its_blanks() -> None:
    plan = b'{ "cost": {"total": 1.50}, "routes": [1e2, "\xc3\xa4 b"], "x": [ ] }'
    kept = read_content(body_with(plan=plan))
    assert kept.body == (b'{"request":{"depots":[],"customers":[],"fleet":[]},"plan":{"cost":'
                         b'{"total":1.50},"routes":[1e2,"\xc3\xa4 b"],"x":[]}}')
    assert (kept.name, kept.note, kept.customers, kept.cost) == ("a", "", 0, 1.5)


def test_blanks_around_a_body_count_for_nothing() -> None:
    assert read_content(b" \n" + body_with() + b"\t") == read_content(body_with())


@pytest.mark.parametrize(("parts", "path"), [
    ({"request": b"[]"}, "$.request"), ({"request": b"0"}, "$.request"),
    ({"plan": b"[]"}, "$.plan"), ({"plan": b'"x"'}, "$.plan"), ({"name": b"1"}, "$.name"),
    ({"name": b'""'}, "$.name"), ({"note": b"null"}, "$.note"), ({"x": b"0"}, "$.x"),
    ({"plan": b'{"cost":{"total":"1"},"routes":[]}'}, "$.plan.cost.total"),
    ({"plan": b'{"cost":{"total":1e999},"routes":[]}'}, "$.plan.cost.total"),
    ({"plan": b'{"cost":{"total":true},"routes":[]}'}, "$.plan.cost.total"),
    ({"plan": b'{"cost":[],"routes":[]}'}, "$.plan.cost"),
    ({"request": b'{"depots":{},"customers":[],"fleet":[]}'}, "$.request.depots"),
    ({"request": b'{"depots":[],"customers":null,"fleet":[]}'}, "$.request.customers")])
def test_what_is_wrong_is_named(parts: dict[str, bytes], path: str) -> None:
    with pytest.raises(InvalidRequestError) as refused:
        read_content(body_with(**parts))
    assert [error.path for error in refused.value.errors] == [path]


def test_of_many_unknown_fields_one_is_told_for_little_memory() -> None:
    body = b"{" + b",".join(b'"k%d":0' % number for number in range(10**5)) + b"}"
    tracemalloc.start()
    with pytest.raises(InvalidRequestError) as refused:
        read_content(body)
    assert tracemalloc.get_traced_memory()[1] < len(body)
    tracemalloc.stop()
    assert [error.path for error in refused.value.errors] == ["$.k0"]


@pytest.mark.parametrize("body", [
    b"", b"{", b"{} x", b'{"name":"\xff"}', body_with(plan=b'{"cost":NaN}'),
    body_with(plan=b'["\xff"]'), body_with(plan=b'"\\ud800"'), body_with(plan=b"[" * 100_000)])
def test_what_is_no_json_is_refused(body: bytes) -> None:
    with pytest.raises(NotJsonError):
        read_content(body)


def test_large_plans_are_kept_for_little_memory() -> None:
    stops = [{"kind": "customer", "id": str(number), "arrival": number + 0.25, "load": [1, 2.5]}
             for number in range(10_000)]
    customers = [{"id": str(number), "location": [number, 0.5], "demand": [1]}
                 for number in range(10_000)]
    whole: dict[str, Any] = content(
        request={"depots": [], "customers": customers, "fleet": []},
        plan={"cost": {"total": 1}, "routes": [{"trips": [{"stops": stops}]}]})
    body = json.dumps(whole).encode()
    tracemalloc.start()
    kept = read_content(body)
    taken = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert kept.customers == 10_000
    assert json.loads(kept.body) == {name: whole[name] for name in ("request", "plan")}
    assert taken < 4 * len(body)
