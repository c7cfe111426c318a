"""The browser console: its page at `/`, its files below `/console/`.

The page asks for its files below a name that stands for what is in them. Browsers keep them as long
as that stays. Its modules are two files.
"""

import hashlib
import re
from functools import cache
from mimetypes import guess_type
from pathlib import Path

from fastapi import APIRouter, FastAPI, Request
from fastapi.responses import HTMLResponse, Response
from fastapi.staticfiles import StaticFiles
from pydantic import BaseModel
from starlette.datastructures import Headers
from starlette.types import Scope

from app.console.bundle import BUNDLE, ENTRY, STYLE, bundled, styled
from app.maps.streets.routes import ATTRIBUTION
from app.maps.streets.sea import Box
from app.serving.access.setup import PUBLIC_TILES
from app.serving.texts import Text

STATIC_DIR = Path(__file__).parent / "static"

router = APIRouter(include_in_schema=False)


class StreetsConfig(BaseModel):
    """Streets that can be drawn under a plan."""

    name: str  # of their tiles, at /map/{name}/{zoom}/{x}/{y}
    bounds: Box


class TilesConfig(BaseModel):
    """Tiles of a server."""

    url: str
    attribution: str


class ConsoleConfig(BaseModel):
    """What the console needs to know of the service's settings."""

    policies: tuple[str, ...]
    tile_url: str | None
    tile_attribution: str
    streets: tuple[StreetsConfig, ...]
    streets_attribution: str
    ground: StreetsConfig  # what is drawn below them, and where there are none
    public_tiles: TilesConfig  # of somebody else's server, for who asks for them
    finds_addresses: bool
    max_job_seconds: float


class ConsoleFiles(StaticFiles):
    """The console's files, below the edition that they are of or any other.

    A page that was opened before the service was upgraded gets those of now: browsers ask for them
    again each time.
    """

    async def get_response(self, path: str, scope: Scope) -> Response:
        stated, _, rest = path.partition("/")
        found = rest if EDITION.fullmatch(stated) else path
        if found not in contents() or scope["method"] not in METHODS:
            return await super().get_response(found, scope)
        lasts = "max-age=31536000, immutable" if stated == edition() else "no-cache"
        return contents()[found].reply(Headers(scope=scope), {"Cache-Control": lasts})


METHODS = ("GET", "HEAD")

EDITION = re.compile("[0-9a-f]{16}")


@cache
def contents() -> dict[str, Text]:
    """Return all files, by their paths, as they were when this was first asked.

    From memory each takes a fifth of the time, and all are three megabytes.
    """
    files = {path.relative_to(STATIC_DIR).as_posix(): path.read_bytes()
             for path in sorted(STATIC_DIR.rglob("*")) if path.is_file()}
    texts = {path: content.decode() for path, content in files.items()
             if path.endswith((".css", ".js"))}
    made = bundled({path: text for path, text in texts.items() if path.endswith(".js")})
    files |= {path: text.encode() for path, text in {**made, STYLE: styled(texts)}.items()}
    return {path: Text(content, guess_type(path)[0]) for path, content in files.items()}


@cache
def edition() -> str:
    """Return what stands for the files as they were when this was first asked."""
    digest = hashlib.sha256()
    for path, text in contents().items():
        digest.update(f"{path} {text.etag}\n".encode())
    return digest.hexdigest()[:16]


def mount_console(app: FastAPI) -> None:
    """Serve the console. In place."""
    app.include_router(router)
    app.mount("/console", ConsoleFiles(directory=STATIC_DIR), name="console")


@router.get("/")
def page() -> HTMLResponse:
    """Return the page."""
    html = (STATIC_DIR / "index.html").read_text("utf-8")
    html = html.replace(ENTRY, BUNDLE).replace('"console/', f'"console/{edition()}/')
    return HTMLResponse(html, headers={"Cache-Control": "no-cache"})


@router.get("/console/config.json")
async def config(request: Request) -> ConsoleConfig:
    """Return the settings that the console follows."""
    settings = request.app.state.settings
    ground = request.app.state.gallery.ground
    return ConsoleConfig(policies=settings.policies, tile_url=settings.tile_url,
                         tile_attribution=settings.tile_attribution,
                         streets=tuple(StreetsConfig(name=streets.name, bounds=streets.bounds)
                                       for streets in request.app.state.gallery.ready),
                         streets_attribution=ATTRIBUTION,
                         ground=StreetsConfig(name=ground.name, bounds=ground.bounds),
                         public_tiles=TilesConfig(url=PUBLIC_TILES, attribution=ATTRIBUTION),
                         finds_addresses=bool(request.app.state.addresses.names),
                         max_job_seconds=settings.max_job_seconds)
