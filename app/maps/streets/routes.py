"""The streets under the console's map, tile by tile."""

import gzip
from typing import Annotated

from fastapi import APIRouter, Header, HTTPException, Path, Request, Response

from app.maps.streets.gallery import Gallery
from app.maps.streets.kinds import MOST_ZOOM

ATTRIBUTION = "© OpenStreetMap contributors"

FOREVER = "public, max-age=31536000, immutable"
"""A tile's address names the extract that it is made of."""

router = APIRouter(include_in_schema=False)


Coordinate = Annotated[int, Path(ge=0, lt=1 << MOST_ZOOM)]


@router.get("/map/{name}/{zoom}/{x}/{y}")
def tile(request: Request, name: str, zoom: Coordinate, x: Coordinate, y: Coordinate,
         accept_encoding: Annotated[str, Header()] = "") -> Response:
    """Return what a tile shows; 204: nothing."""
    gallery: Gallery = request.app.state.gallery
    streets = gallery.find(name)
    if streets is None:
        raise HTTPException(404, f"no streets are called {name!r}")
    content = streets.tile(zoom, x, y)
    headers = {"Cache-Control": FOREVER, "Vary": "Accept-Encoding"}
    if content is None:
        return Response(status_code=204, headers=headers)
    if "gzip" in accept_encoding:
        headers["Content-Encoding"] = "gzip"
    else:
        content = gzip.decompress(content)
    return Response(content, media_type="application/json", headers=headers)
