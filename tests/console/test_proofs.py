"""Proof of delivery: taken on a phone, with and without network, and looked at in the console."""

import struct
import zlib
from collections.abc import Iterator
from typing import Any

import httpx
import pytest
from playwright.sync_api import Browser, BrowserContext, Page, expect

from tests.app.records.dispatches.days import PLAN, PROBLEM, dispatched
from tests.console.serving import new_context
from tests.console.steps import follow, open_tab
from tests.console.test_drivers import PHONE, mark, open_page
from tests.console.test_everyone import findings

pytestmark = pytest.mark.slow


@pytest.fixture
def phone(browser: Browser) -> Iterator[BrowserContext]:
    """Return a phone's browser."""
    context = new_context(browser, **PHONE)
    yield context
    context.close()


def photo(side: int) -> bytes:
    """Return a grey square as PNG."""
    def chunk(kind: bytes, content: bytes) -> bytes:
        whole = kind + content
        return struct.pack(">I", len(content)) + whole + struct.pack(">I", zlib.crc32(whole))

    rows = b"".join(b"\0" + b"\x80" * side for _ in range(side))
    head = struct.pack(">IIBBBBB", side, side, 8, 0, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head)
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def sign(page: Page) -> None:
    """Draw a line with a finger."""
    box = page.locator("canvas.signature").bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + 20, box["y"] + 60)
    page.mouse.down()
    page.mouse.move(box["x"] + 120, box["y"] + 30, steps=4)
    page.mouse.up()


@pytest.mark.thorough
def test_proof_taken_without_network_comes_to_the_dispatcher(
        client: httpx.Client, phone: BrowserContext, page: Page) -> None:
    sent = dispatched(client)
    driven = open_page(phone, sent["links"][0])
    expect(driven.get_by_role("status")).to_have_text("All is sent.")
    phone.set_offline(True)
    stop = driven.locator("li.stop").first
    stop.locator(".head").click()
    stop.get_by_role("button", name="Proof of delivery").click()
    stop.get_by_label("Name of who took it").fill("Ms Ito")
    stop.get_by_label("Photo").set_input_files(
        {"name": "door.png", "mimeType": "image/png", "buffer": photo(2000)})
    sign(driven)
    assert findings(driven) == []
    stop.get_by_role("button", name="Keep the proof").click()
    expect(stop).to_contain_text("A proof is kept.")
    expect(driven.get_by_role("status")).to_contain_text("1 not sent yet")
    mark(driven, "Leave hub", "Left")
    expect(driven.get_by_role("status")).to_contain_text("2 not sent yet")
    phone.set_offline(False)
    driven.evaluate("dispatchEvent(new Event('online'))")
    expect(driven.get_by_role("status")).to_have_text("All is sent.")
    (proof,) = client.get(f"/dispatches/{sent['id']}/proofs").json()["proofs"]
    assert (proof["orders"], proof["name"], proof["photo"]) == (["A"], "Ms Ito", True)
    picture = client.get(f"/dispatches/{sent['id']}/proofs/truck-1/{proof['id']}/photo")
    assert picture.content[:3] == b"\xff\xd8\xff"  # made small on the phone
    open_tab(page, "drivers")
    follow(page, sent["id"])
    page.get_by_text("Proofs of delivery").click()
    page.get_by_role("button", name="Signature for A").click()
    drawn = page.locator(".proofs img")
    expect(drawn).to_be_visible()
    assert drawn.evaluate("each => each.decode().then(() => each.naturalWidth)") > 100
    assert findings(page, ".panel") == []
    page.locator(".proofs").get_by_role("button", name="A", exact=True).click()
    details = page.locator("section.details")
    details.get_by_text("Proofs of delivery").click()
    expect(details.get_by_role("button", name="Photo of A")).to_be_visible()


def test_driver_is_told_what_is_new_and_what_was_taken_away_and_confirms(
        client: httpx.Client, phone: BrowserContext) -> None:
    sent = dispatched(client)
    page = open_page(phone, sent["links"][0])
    expect(page.get_by_role("status")).to_have_text("All is sent.")
    routes: list[Any] = [
        {**PLAN["routes"][0], "trips": PLAN["routes"][1]["trips"]},
        {**PLAN["routes"][1], "trips": [{**PLAN["routes"][0]["trips"][0], "sorties": [], "stops": [
            *PLAN["routes"][0]["trips"][0]["stops"]]}]}]
    client.post(f"/dispatches/{sent['id']}/plan", json={
        "problem": PROBLEM, "plan": {"routes": routes}}).raise_for_status()
    page.reload()
    news = page.get_by_role("alert")
    for word in ("New", "Taken away", "D, 8:22", "B, 8:24"):
        expect(news).to_contain_text(word)
    assert findings(page) == []
    page.reload()
    news.get_by_role("button", name="I have seen it").click()
    expect(news).to_have_count(0)
    expect(page.get_by_role("status")).to_have_text("All is sent.")
    truck, van = client.get(f"/dispatches/{sent['id']}").json()["links"]
    assert truck["seen_at"] is not None
    assert van["seen_at"] is None
