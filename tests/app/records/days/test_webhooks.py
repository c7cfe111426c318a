"""Webhooks of days: what follows from plans is told, signed, again after a failure."""

from collections.abc import Iterator

import httpx
import pytest
from pydantic import SecretStr
from standardwebhooks import Webhook

from app.records.jobs import webhook
from app.serving.settings import Settings
from tests.app.conftest import SearchingPlanner, ready, serving
from tests.app.records.days.living import PROBLEM, begun, clock, followed, order, standing, told
from tests.app.records.jobs.receiving import FailingReceiver
from tests.conftest import eventually

pytestmark = pytest.mark.slow

SECRET = "whsec_MDEyMzQ1Njc4OTAxMjM0NTY3ODkwMTIzNDU2Nzg5MDE="


@pytest.fixture(scope="module")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[httpx.Client]:
    """Return a client of a service that calls webhooks, soon again where they failed."""
    settings = Settings(data_dir=tmp_path_factory.mktemp("hooked"), drain_seconds=0, role="all",
                        public_url="https://tandem.example",
                        webhook_secret=SecretStr(SECRET))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(webhook, "FIRST_WAIT", 0.25)
        with serving(SearchingPlanner(), settings) as client:
            yield ready(client)


def test_news_of_plans_are_told_signed_and_again(service: httpx.Client) -> None:
    receiver = FailingReceiver(failures=1)
    day = begun(service, webhook=receiver.url)
    told(service, day, clock(), order("G", 1, 1, time_window={"latest": 0.5}), at=1)
    # plan.changed and eta.changed of the first plan, one of them twice; then plan and risk.
    eventually(lambda: len(receiver.calls) == 5)
    receiver.close()
    messages = {headers["webhook-id"]: Webhook(SECRET).verify(body, headers)
                for headers, body in receiver.calls}
    assert len(messages) == 4
    assert {(each["type"], each["data"]["plan_number"]) for each in messages.values()} == {
        ("plan.changed", 1), ("eta.changed", 1), ("plan.changed", 2), ("order.at_risk", 2)}
    assert {each["data"]["day"] for each in messages.values()} == {day}
    links = {event["about"]["order"]: event["about"].pop("link") for each in messages.values()
             for event in each["data"]["events"] if "order" in event["about"]}
    assert links == {link["order"]: link["url"]
                     for link in service.get(f"/days/{day}/links").json()["links"]}
    heard = sorted((event["number"], event["kind"]) for each in messages.values()
                   for event in each["data"]["events"])
    streamed = [(event["number"], event["kind"])
                for event in followed(service, day, standing(service, day).revision)
                if event["kind"] in ("plan.changed", "eta.changed", "order.at_risk")]
    assert heard == streamed


def test_what_is_no_webhook_is_refused(service: httpx.Client) -> None:
    reply = service.post("/days", json={"problem": PROBLEM, "webhook": "ftp://example.org"})
    assert reply.status_code == 422
    assert [(each["code"], each["path"]) for each in reply.json()["errors"]] == [
        ("WEBHOOK", "$.webhook")]
