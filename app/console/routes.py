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
from starlette.types import Scope

from app.console.bundle import BUNDLE, ENTRY, LATER, bundled
from app.maps.streets.routes import ATTRIBUTION
from app.maps.streets.sea import Box

STATIC_DIR = Path(__file__).parent / "static"

router = APIRouter(include_in_schema=False)


class StreetsConfig(BaseModel):
    """Streets that can be drawn under a plan."""

    name: str  # of their tiles, at /map/{name}/{zoom}/{x}/{y}
    bounds: Box


class ConsoleConfig(BaseModel):
    """What the console needs to know of the service's settings."""

    policies: tuple[str, ...]
    tile_url: str | None
    tile_attribution: str
    streets: tuple[StreetsConfig, ...]
    streets_attribution: str
    finds_addresses: bool
    max_job_seconds: float


class ConsoleFiles(StaticFiles):
    """The console's files, below the edition that they are of or any other.

    A page that was opened before the service was upgraded gets those of now: browsers ask for them
    again each time.
    """

    async def get_response(self, path: str, scope: Scope) -> Response:
        stated, _, rest = path.partition("/")
        if stated == edition() and rest in contents() and scope["method"] in METHODS:
            return Response(contents()[rest], media_type=guess_type(rest)[0],
                            headers={"Cache-Control": "max-age=31536000, immutable"})
        found = rest if EDITION.fullmatch(stated) else path
        response = (Response(contents()[found], media_type=guess_type(found)[0])
                    if found in (BUNDLE, LATER) and scope["method"] in METHODS
                    else await super().get_response(found, scope))
        response.headers["Cache-Control"] = "no-cache"
        return response


METHODS = ("GET", "HEAD")

EDITION = re.compile("[0-9a-f]{16}")


@cache
def contents() -> dict[str, bytes]:
    """Return all files, by their paths, as they were when this was first asked.

    From memory each takes a fifth of the time, and all are two megabytes.
    """
    files = {path.relative_to(STATIC_DIR).as_posix(): path.read_bytes()
             for path in sorted(STATIC_DIR.rglob("*")) if path.is_file()}
    modules = {path: content.decode() for path, content in files.items() if path.endswith(".js")}
    return files | {path: text.encode() for path, text in bundled(modules).items()}


@cache
def edition() -> str:
    """Return what stands for the files as they were when this was first asked."""
    digest = hashlib.sha256()
    for path, content in contents().items():
        digest.update(f"{path}\n".encode())
        digest.update(content)
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
    return ConsoleConfig(policies=settings.policies, tile_url=settings.tile_url,
                         tile_attribution=settings.tile_attribution,
                         streets=tuple(StreetsConfig(name=streets.name, bounds=streets.bounds)
                                       for streets in request.app.state.gallery.ready),
                         streets_attribution=ATTRIBUTION,
                         finds_addresses=bool(request.app.state.addresses.names),
                         max_job_seconds=settings.max_job_seconds)
