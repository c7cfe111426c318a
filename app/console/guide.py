"""The guide at `/guide/`: pages of `docs/`, which `zensical` made when the package was built."""

from pathlib import Path

from fastapi import FastAPI
from fastapi.responses import Response
from fastapi.staticfiles import StaticFiles
from starlette.exceptions import HTTPException
from starlette.types import Scope

SITE_DIR = Path(__file__).parent / "built_guide"


class GuideFiles(StaticFiles):
    """Pages and what belongs to them; browsers ask each time whether they are still the same."""

    async def check_config(self) -> None:
        """Find nothing wrong where the guide is not built: each request is told so."""

    async def get_response(self, path: str, scope: Scope) -> Response:
        if not SITE_DIR.exists():
            raise HTTPException(404, "The guide is not built: run `make guide`")
        response = await super().get_response(path, scope)
        response.headers["Cache-Control"] = "no-cache"
        return response


def mount_guide(app: FastAPI) -> None:
    """Serve the guide. In place."""
    app.mount("/guide", GuideFiles(directory=SITE_DIR, html=True, check_dir=False), name="guide")
