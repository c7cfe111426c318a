"""Links that show one plan to whoever has them."""

import logging
from collections.abc import Callable

import httpx
import pytest
from sqlalchemy import text

from app.database.connections import make_engine
from tests.app.records.kept.conftest import PLAN, REQUEST, Owner, Service, content

pytestmark = pytest.mark.slow


def see(client: httpx.Client, token: str) -> httpx.Response:
    """Ask for a shared plan without a key."""
    return client.get("/shared-plan", headers={"X-Share-Token": token})


def test_link_shows_the_plan_without_a_key_and_nothing_else(ann: Owner) -> None:
    ann.keep("p", content(note="rain"))
    link = ann.share("p")
    reply = see(ann.client, link["token"])
    assert reply.status_code == 200
    assert reply.headers["cache-control"] == "no-store"
    shown = reply.json()
    assert sorted(shown) == ["changed_at", "is_live", "name", "note", "plan", "request"]
    assert (shown["name"], shown["request"], shown["plan"]) == ("Monday", REQUEST, PLAN)
    assert link["path"] == f"/#shared={link['token']}"
    for headers in ({"Authorization": f"Bearer {link['token']}"},
                    {"X-API-Key": link["token"]}, {"X-Share-Token": link["token"]}):
        assert ann.client.get("/plans", headers=headers).status_code == 401
        assert ann.client.get("/plans/p", headers=headers).status_code == 401


def test_link_shows_the_plan_as_it_is_now(ann: Owner) -> None:
    tag = ann.keep("p").headers["etag"]
    token = ann.share("p")["token"]
    ann.keep("p", content("Tuesday", plan=None), if_match=tag)
    shown = see(ann.client, token).json()
    assert (shown["name"], shown["plan"]) == ("Tuesday", None)


def test_link_ends_alone_or_with_its_plan(ann: Owner) -> None:
    ann.keep("p")
    one, two = ann.share("p"), ann.share("p")
    listed = ann.ask("GET", "/plans/p/links").json()["links"]
    assert {link["id"] for link in listed} == {one["id"], two["id"]}
    assert "token" not in listed[0]
    assert ann.ask("GET", "/plans/p").json()["links"] == 2
    assert ann.ask("DELETE", f"/plans/p/links/{one['id']}").status_code == 204
    assert ann.ask("DELETE", f"/plans/p/links/{one['id']}").status_code == 404
    assert see(ann.client, one["token"]).status_code == 404
    assert see(ann.client, two["token"]).status_code == 200
    ann.ask("DELETE", "/plans/p")
    assert see(ann.client, two["token"]).status_code == 404
    ann.keep("p", content("anew"))
    assert see(ann.client, two["token"]).status_code == 404


def test_wrong_ended_and_missing_tokens_get_the_same_reply(ann: Owner) -> None:
    ann.keep("p")
    link = ann.share("p")
    token = link["token"]
    ended = ann.share("p")
    ann.ask("DELETE", f"/plans/p/links/{ended['id']}")
    wrong = [token[:-1] + ("0" if token[-1] != "0" else "1"), ended["token"], ann.key, "x", "",
             token.replace(link["id"], "0" * 12)]
    replies = [see(ann.client, each) for each in wrong] + [ann.client.get("/shared-plan")]
    assert {(reply.status_code, reply.text) for reply in replies} == {
        (404, replies[0].text)}
    assert replies[0].json()["type"] == "urn:tandem:error:unknown-link"


def test_tokens_are_in_neither_logs_nor_the_database(
        ann: Owner, service: Service, caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level(logging.DEBUG)
    ann.keep("p")
    token = ann.share("p")["token"]
    assert see(ann.client, token).status_code == 200
    for path in (f"/shared-plan?token={token}", f"/{token}", f"/shared-plan?x={token}"):
        assert ann.client.get(path).status_code == 400
    ours = [record for record in caplog.records if not record.name.startswith("httpx")
            and not record.name.startswith("httpcore")]
    assert any(record.message == "request" for record in ours)
    assert all(token[-64:] not in str(vars(record)) for record in ours)
    engine = make_engine(service.settings.database)
    with engine.connect() as connection:
        rows = list(connection.execute(text("SELECT * FROM plan_links")))
    engine.dispose()
    assert rows
    assert token[-64:] not in str(rows)


@pytest.mark.usefixtures("same_minute")
def test_guessing_tokens_is_slowed_down(keeping: Callable[..., httpx.Client]) -> None:
    client = keeping(wrong_keys_per_minute=3)
    client.put("/plans/p", json=content())
    token = client.post("/plans/p/links").json()["token"]
    replies = [see(client, "tdm_share_x").status_code for _ in range(5)]
    assert replies == [404, 404, 404, 429, 429]
    assert see(client, token).status_code == 200


def test_so_many_links_may_be_made_of_a_plan(ann: Owner) -> None:
    ann.keep("p")
    statuses = [ann.ask("POST", "/plans/p/links").status_code for _ in range(21)]
    assert statuses == [201] * 20 + [409]
