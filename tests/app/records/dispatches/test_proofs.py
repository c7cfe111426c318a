"""What drivers send of those who took it, and that they have seen what is new."""

import base64
from collections.abc import Iterator
from datetime import UTC, datetime
from typing import Any

import httpx
import pytest
from sqlalchemy import text, update

from app.database.tables import DAYS
from app.records.clock import now_ms
from app.records.dispatches.proofs import MAX_SIGNATURE
from app.records.dispatches.schemas import ProofsReply
from app.records.dispatches.store import delete_expired
from app.serving.settings import Settings
from tests.app.conftest import FirstFitPlanner, opened, ready, serving
from tests.app.records.dispatches.days import FIRST, dispatched, event, holding, token_of

pytestmark = pytest.mark.slow

JPEG, PNG = b"\xff\xd8\xff\xe0 a door", b"\x89PNG\r\n\x1a\n a line"


@pytest.fixture(scope="module")
def settings(tmp_path_factory: pytest.TempPathFactory) -> Settings:
    """Return settings of a service that plans nothing."""
    return Settings(data_dir=tmp_path_factory.mktemp("proofs"), role="api", drain_seconds=0)


@pytest.fixture(scope="module")
def service(settings: Settings) -> Iterator[httpx.Client]:
    """Return a client of that service."""
    with serving(FirstFitPlanner(), settings) as client:
        yield ready(client)


def send(client: httpx.Client, token: str, **changes: Any) -> httpx.Response:
    """Send a proof that A was served."""
    now = datetime.now(UTC).isoformat()
    return client.post("/drive/proofs", headers=holding(token), json={
        "id": "p1", "step": FIRST, "now": now, "time": now, "name": " Ms Ito ",
        "photo": base64.b64encode(JPEG).decode(),
        "signature": base64.b64encode(PNG).decode()} | changes)


def test_proof_is_kept_once_with_its_stop_and_served_back(service: httpx.Client) -> None:
    sent = dispatched(service)
    truck, van = (token_of(link) for link in sent["links"])
    for _ in range(2):
        assert send(service, truck).status_code == 200
    assert send(service, van, name="", photo=None, signature=None).status_code == 200
    listed = ProofsReply.model_validate_json(
        service.get(f"/dispatches/{sent['id']}/proofs").text).proofs
    proof, empty = sorted(listed, key=lambda each: each.vehicle)
    assert (proof.vehicle, proof.orders, proof.name) == ("truck-1", ["A"], "Ms Ito")
    assert (proof.photo, proof.signature) == (True, True)
    assert (empty.orders, empty.photo, empty.signature) == ([], False, False)
    for part, picture, kind in (("photo", JPEG, "image/jpeg"), ("signature", PNG, "image/png")):
        reply = service.get(f"/dispatches/{sent['id']}/proofs/truck-1/p1/{part}")
        assert (reply.content, reply.headers["content-type"]) == (picture, kind)
        assert reply.headers["x-content-type-options"] == "nosniff"
    other = dispatched(service)
    for path in (f"{other['id']}/proofs/truck-1/p1/photo", f"{sent['id']}/proofs/van-1/p1/photo"):
        assert service.get(f"/dispatches/{path}").status_code == 404


@pytest.mark.parametrize(("field", "value"), [
    ("photo", base64.b64encode(b"<svg onload='x'/>").decode()),
    ("photo", "no base64!"),
    ("signature", base64.b64encode(PNG + b" " * MAX_SIGNATURE).decode()),
    ("name", "x" * 101),
])
def test_what_is_no_proof_is_refused(service: httpx.Client, field: str, value: str) -> None:
    token = token_of(dispatched(service)["links"][0])
    reply = send(service, token, **{field: value})
    assert reply.status_code == 422, reply.text
    assert reply.json()["errors"][0]["path"] == f"$.{field}"


def test_proofs_need_a_link_and_are_deleted_with_the_day(
        service: httpx.Client, settings: Settings) -> None:
    sent = dispatched(service)
    assert send(service, "wrong").status_code == 401
    token = token_of(sent["links"][0])
    send(service, token)
    with opened(settings) as engine:
        with engine.begin() as connection:
            connection.execute(update(DAYS).where(DAYS.c.id == sent["id"])
                               .values(expires_at=now_ms()))
        delete_expired(engine)
        with engine.connect() as connection:
            left = connection.execute(text("SELECT count(*) FROM day_proofs WHERE day = :id"),
                                      {"id": sent["id"]})
            assert left.scalar() == 0


def test_dispatcher_learns_that_what_is_new_was_seen(service: httpx.Client) -> None:
    sent = dispatched(service)
    token = token_of(sent["links"][0])
    now = datetime.now(UTC).isoformat()
    reply = service.post("/drive/events", headers=holding(token), json={
        "now": now, "events": [event("s1", "changes", now)]})
    assert reply.json()["accepted"] == ["s1"]
    truck, van = service.get(f"/dispatches/{sent['id']}").json()["links"]
    assert datetime.fromisoformat(truck["seen_at"]) <= datetime.now(UTC)
    assert (truck["standing"], truck["done"], van["seen_at"]) == ([], 0, None)
