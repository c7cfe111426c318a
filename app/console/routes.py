"""The browser console: its page at `/`, its files below `/console/`.

The page asks for its files below a name that stands for what is in them. Browsers keep them as long
as that stays, and open the console with one request in place of a hundred.
"""

import hashlib
import re
from functools import cache
from pathlib import Path

from fastapi import APIRouter, FastAPI, Request
from fastapi.responses import HTMLResponse, Response
from fastapi.staticfiles import StaticFiles
from pydantic import BaseModel
from starlette.types import Scope

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
        is_edition = EDITION.fullmatch(stated) is not None
        response = await super().get_response(rest if is_edition else path, scope)
        keep = is_edition and stated == edition()
        response.headers["Cache-Control"] = "max-age=31536000, immutable" if keep else "no-cache"
        return response


EDITION = re.compile("[0-9a-f]{16}")


@cache
def edition() -> str:
    """Return what stands for the files as they were when this was first asked."""
    digest = hashlib.sha256()
    for path in sorted(path for path in STATIC_DIR.rglob("*") if path.is_file()):
        digest.update(f"{path.relative_to(STATIC_DIR)}\n".encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def mount_console(app: FastAPI) -> None:
    """Serve the console. In place."""
    app.include_router(router)
    app.mount("/console", ConsoleFiles(directory=STATIC_DIR), name="console")


@router.get("/")
def page() -> HTMLResponse:
    """Return the page."""
    html = (STATIC_DIR / "index.html").read_text("utf-8")
    return HTMLResponse(html.replace('"console/', f'"console/{edition()}/'),
                        headers={"Cache-Control": "no-cache"})


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
