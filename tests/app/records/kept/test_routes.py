"""Plans kept by name over HTTP: whose they are, which version is changed, how many there may be."""

from collections.abc import Callable
from datetime import datetime
from typing import Any

import httpx
import pytest

from tests.app.records.kept.conftest import PLAN, REQUEST, Owner, Service, content

pytestmark = pytest.mark.slow

Keeping = Callable[..., httpx.Client]


def names(who: Owner) -> list[str]:
    """Return the names of somebody's plans, those changed last first."""
    return [plan["name"] for plan in who.ask("GET", "/plans").json()["plans"]]


def error(reply: httpx.Response) -> tuple[int, str]:
    """Return the status and the kind of a refusal."""
    return reply.status_code, reply.json()["type"].removeprefix("urn:tandem:error:")


def test_kept_plan_comes_back_as_it_was_sent(ann: Owner) -> None:
    kept = ann.keep("monday", content(note="rain"))
    assert (kept.status_code, kept.headers["location"]) == (201, "/plans/monday")
    read = ann.ask("GET", kept.headers["location"])
    assert read.headers["etag"] == kept.headers["etag"]
    assert read.headers["cache-control"] == "no-store"
    plan = read.json()
    assert (plan["request"], plan["plan"]) == (REQUEST, PLAN)
    told = {name: plan[name] for name in ("name", "note", "customers", "cost", "links")}
    assert told == {"name": "Monday", "note": "rain", "customers": 1, "cost": 12.5, "links": 0}
    assert plan["expires_at"] is None
    assert kept.json() == {name: value for name, value in plan.items()
                           if name not in ("request", "plan")}


def test_plan_without_a_reply_is_kept_too(ann: Owner) -> None:
    ann.keep("draft", content(plan=None))
    read = ann.ask("GET", "/plans/draft").json()
    assert (read["plan"], read["cost"]) == (None, None)


def test_nobody_sees_or_changes_another_owners_plans(ann: Owner, ben: Owner) -> None:
    tag = ann.keep("monday").headers["etag"]
    link = ann.share("monday")
    asked = [("GET", "/plans/monday", None), ("DELETE", "/plans/monday", None),
             ("PATCH", "/plans/monday", {"name": "mine"}), ("GET", "/plans/monday/links", None),
             ("POST", "/plans/monday/links", None),
             ("DELETE", f"/plans/monday/links/{link['id']}", None)]
    for method, path, body in asked:
        reply = ben.ask(method, path, json=body, headers={"If-Match": tag})
        assert reply.status_code == 404, (method, path)
    assert names(ben) == []
    assert ben.keep("monday", content("Ben's")).status_code == 201
    assert (names(ann), names(ben)) == (["Monday"], ["Ben's"])
    assert ben.ask("DELETE", "/plans/monday").status_code == 204
    assert ann.ask("GET", "/plans/monday").headers["etag"] == tag


def test_change_that_another_one_does_not_know_of_is_not_overwritten(ann: Owner) -> None:
    first = ann.keep("p").headers["etag"]
    second = ann.keep("p", content("by tab one"), if_match=first)
    assert second.status_code == 200
    assert second.headers["etag"] != first
    late = ann.keep("p", content("by tab two"), if_match=first)
    assert error(late) == (412, "plan-changed")
    assert error(ann.keep("p", content("by tab two"))) == (428, "version-needed")
    assert error(ann.keep("p", content("new"), if_none_match="*")) == (412, "plan-changed")
    assert error(ann.keep("p", content("weak"), if_match=f"W/{first}")) == (412, "plan-changed")
    assert names(ann) == ["by tab one"]
    assert ann.keep("p", content("whatever"), if_match="*").status_code == 200
    assert names(ann) == ["whatever"]


def test_plan_that_was_deleted_and_made_anew_is_another_version(ann: Owner) -> None:
    tag = ann.keep("p").headers["etag"]
    ann.ask("DELETE", "/plans/p")
    assert error(ann.keep("p", if_match=tag)) == (412, "plan-changed")
    ann.keep("p", content("anew"))
    assert error(ann.keep("p", if_match=tag)) == (412, "plan-changed")


def test_request_whose_reply_was_lost_can_be_sent_again(ann: Owner) -> None:
    first = ann.keep("p", if_none_match="*")
    again = ann.keep("p", if_none_match="*")
    assert (first.status_code, again.status_code) == (201, 200)
    assert again.json() == first.json()


def test_name_and_note_are_edited_alone(ann: Owner) -> None:
    tag = ann.keep("p", content(note="rain")).headers["etag"]
    assert error(ann.ask("PATCH", "/plans/p", json={"name": "x"})) == (428, "version-needed")
    renamed = ann.ask("PATCH", "/plans/p", json={"name": "Tuesday"}, headers={"If-Match": tag})
    assert (renamed.json()["name"], renamed.json()["note"]) == ("Tuesday", "rain")
    late = ann.ask("PATCH", "/plans/p", json={"note": ""}, headers={"If-Match": tag})
    assert error(late) == (412, "plan-changed")
    assert ann.ask("GET", "/plans/p").json()["request"] == REQUEST


def test_delete_may_ask_for_a_version(ann: Owner) -> None:
    tag = ann.keep("p").headers["etag"]
    ann.keep("p", content("changed"), if_match=tag)
    late = ann.ask("DELETE", "/plans/p", headers={"If-Match": tag})
    assert error(late) == (412, "plan-changed")
    assert ann.ask("DELETE", "/plans/p").status_code == 204
    assert error(ann.ask("GET", "/plans/p")) == (404, "unknown-plan")


def test_pages_list_those_changed_last_first(ann: Owner) -> None:
    tags = {str(number): ann.keep(str(number), content(str(number))).headers["etag"]
            for number in range(5)}
    ann.keep("1", content("1 again"), if_match=tags["1"])
    listed: list[str] = []
    cursor = None
    while cursor is not None or not listed:
        page = ann.ask("GET", "/plans", params={"limit": 2} | (
            {"cursor": cursor} if cursor else {})).json()
        listed += [plan["name"] for plan in page["plans"]]
        cursor = page["next"]
    assert listed == ["1 again", "4", "3", "2", "0"]
    assert error(ann.ask("GET", "/plans?cursor=x")) == (422, "invalid-request")


def test_plans_need_a_key_with_the_scope(ann: Owner, service: Service) -> None:
    ann.keep("p")
    jobs = service.owner("jobs")
    for method, path in (("GET", "/plans"), ("PUT", "/plans/p"), ("GET", "/plans/p"),
                         ("PATCH", "/plans/p"), ("DELETE", "/plans/p"),
                         ("POST", "/plans/p/links"), ("GET", "/plans/p/links"),
                         ("DELETE", "/plans/p/links/000000000000")):
        assert service.client.request(method, path).status_code == 401, path
        assert jobs.ask(method, path).status_code == 403, path


@pytest.mark.parametrize(("body", "path"), [
    (content(name=""), "$.name"), (content(name="a\x00b"), "$.name"), (content(note=5), "$.note"),
    (content(request={"depots": [], "customers": []}), "$.request.fleet"),
    (content(plan={"routes": []}), "$.plan.cost"), (content(plans=[]), "$.plans"),
    ({"name": "x"}, "$")])
def test_what_is_no_plan_is_refused_where_it_is_wrong(
        ann: Owner, body: dict[str, Any], path: str) -> None:
    reply = ann.keep("p", body)
    assert reply.status_code == 422
    assert [fault["path"] for fault in reply.json()["errors"]] == [path]


def test_bodies_that_are_no_json_are_refused(ann: Owner) -> None:
    for body in (b"{", b"[]", b'{"name": "x", "request": {"depots": [], "customers": [], '
                 b'"fleet": [NaN]}}', b'{"name": "\\ud800"}', b"\xff"):
        reply = ann.ask("PUT", "/plans/p", content=body)
        assert reply.status_code in (400, 422), body
    assert error(ann.ask("PUT", "/plans/a.b", json=content())) == (422, "invalid-request")


def test_open_service_keeps_so_many_plans_and_bytes(keeping: Keeping) -> None:
    client = keeping(max_kept_plans=2, max_kept_bytes=2000)
    for name in "ab":
        assert client.put(f"/plans/{name}", json=content()).status_code == 201
    full = client.put("/plans/c", json=content())
    assert error(full) == (409, "no-room")
    assert "TANDEM_MAX_KEPT_PLANS" in full.json()["detail"]
    tag = client.get("/plans/a").headers["etag"]
    large = content(plan=PLAN | {"long": "x" * 2000})
    big = client.put("/plans/a", json=large, headers={"If-Match": tag})
    assert error(big) == (409, "no-room")
    assert "TANDEM_MAX_KEPT_BYTES" in big.json()["detail"]
    client.delete("/plans/b")
    assert client.put("/plans/c", json=content()).status_code == 201


def test_plans_expire_if_the_settings_say_so(
        keeping: Keeping, monkeypatch: pytest.MonkeyPatch) -> None:
    client = keeping(kept_plan_days=1.0)
    kept = client.put("/plans/old", json=content()).json()
    token = client.post("/plans/old/links").json()["token"]
    life = (datetime.fromisoformat(kept["expires_at"])
            - datetime.fromisoformat(kept["changed_at"]))
    assert life.total_seconds() == 86_400
    later = int(datetime.fromisoformat(kept["changed_at"]).timestamp() * 1000) + 86_400_001
    monkeypatch.setattr("app.records.kept.store.now_ms", lambda: later)
    assert client.get("/plans").json()["plans"] == []
    assert client.get("/plans/old").status_code == 404
    assert client.get("/shared-plan", headers={"X-Share-Token": token}).status_code == 404
    assert client.put("/plans/old", json=content("anew")).status_code == 201


@pytest.mark.usefixtures("same_minute")
def test_keeping_counts_towards_the_rate_of_plans(keeping: Keeping) -> None:
    client = keeping(plans_per_minute=2)
    replies = [client.put(f"/plans/{number}", json=content()) for number in range(3)]
    assert [reply.status_code for reply in replies] == [201, 201, 429]
    assert client.get("/plans").status_code == 200


def test_pages_of_other_origins_keep_nothing(keeping: Keeping) -> None:
    client = keeping(cors_origins=("https://dispatch.example.org",))
    foreign = {"Origin": "https://other.example.org", "Sec-Fetch-Site": "cross-site"}
    for method in ("PUT", "PATCH", "DELETE"):
        reply = client.request(method, "/plans/p", json=content(), headers=foreign)
        assert error(reply) == (403, "foreign-page")
    assert client.get("/plans", headers={"Host": "turned.example.org"}).status_code == 421
    allowed = client.options("/plans/p", headers={
        "Origin": "https://dispatch.example.org", "Access-Control-Request-Method": "PUT",
        "Access-Control-Request-Headers": "content-type,if-match"})
    assert allowed.status_code == 200
    own = {"Origin": "https://dispatch.example.org", "Sec-Fetch-Site": "cross-site"}
    kept = client.put("/plans/p", json=content(), headers=own)
    assert "ETag" in kept.headers["access-control-expose-headers"]
