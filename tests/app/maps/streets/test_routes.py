"""Tiles over HTTP: kept for ever, since their address names what they are made of."""

import gzip
from collections.abc import Callable
from pathlib import Path

import httpx
import pytest
from fastapi import FastAPI

from app.maps.streets.gallery import Gallery
from app.maps.streets.routes import router
from tests.app.maps.streets.conftest import osm_xml
from tests.conftest import PATIENCE, complete

Get = Callable[..., httpx.Response]


def opened(*extracts: Path, spare: Path) -> Gallery:
    """Return a gallery that has made all that it can."""
    gallery = Gallery(extracts, spare)
    gallery.start()
    gallery.wait(PATIENCE)
    gallery.stop()
    return gallery


@pytest.fixture(scope="module")
def gallery(tmp_path_factory: pytest.TempPathFactory) -> Gallery:
    folder = tmp_path_factory.mktemp("streets")
    extract = folder / "island.osm"
    extract.write_text(osm_xml())
    return opened(extract, folder / "missing.osm", extract, spare=folder)


@pytest.fixture
def get(gallery: Gallery) -> Get:
    """Return a function that asks for what is at an address."""
    app = FastAPI()
    app.state.gallery = gallery
    app.include_router(router)

    async def ask(address: str, **options: object) -> httpx.Response:
        transport = httpx.ASGITransport(app)
        async with httpx.AsyncClient(transport=transport, base_url="http://test") as client:
            return await client.get(address, **options)

    return lambda address, **options: complete(ask(address, **options))


def test_what_can_be_drawn_is_ready_though_other_extracts_are_missing(gallery: Gallery) -> None:
    (streets,) = gallery.ready
    assert streets.file.parent.name == "island.roads"


def test_tile_is_compressed_for_those_who_take_it_so(get: Get, gallery: Gallery) -> None:
    (streets,) = gallery.ready
    content = streets.tile(14, 8192, 8191)
    assert content is not None
    address = f"/map/{streets.name}/14/8192/8191"
    reply = get(address)
    assert reply.headers["Content-Encoding"] == "gzip"
    assert "immutable" in reply.headers["Cache-Control"]
    plain = get(address, headers={"Accept-Encoding": "identity"})
    assert "Content-Encoding" not in plain.headers
    assert plain.content == reply.content == gzip.decompress(content)


def test_nothing_is_said_so(get: Get, gallery: Gallery) -> None:
    (streets,) = gallery.ready
    assert get(f"/map/{streets.name}/14/1/1").status_code == 204
    assert get("/map/other/14/8192/8191").status_code == 404
    assert get(f"/map/{streets.name}/14/1/{10**30}").status_code == 422
