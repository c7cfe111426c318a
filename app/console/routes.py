"""The browser console: its page at `/`, its files below `/console/`."""

from pathlib import Path

from fastapi import APIRouter, FastAPI, Request
from fastapi.responses import FileResponse, Response
from fastapi.staticfiles import StaticFiles
from pydantic import BaseModel
from starlette.types import Scope

from app.streets.routes import ATTRIBUTION
from app.streets.sea import Box

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


class ConsoleFiles(StaticFiles):
    """Files that browsers ask for again each time; libraries, whose names say which, they keep."""

    async def get_response(self, path: str, scope: Scope) -> Response:
        response = await super().get_response(path, scope)
        keep = path.startswith("vendor")
        response.headers["Cache-Control"] = "max-age=31536000, immutable" if keep else "no-cache"
        return response


def mount_console(app: FastAPI) -> None:
    """Serve the console. In place."""
    app.include_router(router)
    app.mount("/console", ConsoleFiles(directory=STATIC_DIR), name="console")


@router.get("/")
async def page() -> FileResponse:
    """Return the page."""
    return FileResponse(STATIC_DIR / "index.html", headers={"Cache-Control": "no-cache"})


@router.get("/console/config.json")
async def config(request: Request) -> ConsoleConfig:
    """Return the settings that the console follows."""
    settings = request.app.state.settings
    return ConsoleConfig(policies=settings.policies, tile_url=settings.tile_url,
                         tile_attribution=settings.tile_attribution,
                         streets=tuple(StreetsConfig(name=streets.name, bounds=streets.bounds)
                                       for streets in request.app.state.gallery.ready),
                         streets_attribution=ATTRIBUTION,
                         finds_addresses=bool(request.app.state.addresses.names))
