"""Texts that stay as they are: compressed once, and told unchanged to who has them."""

import gzip
import hashlib
from collections.abc import Mapping
from functools import cached_property

from starlette.datastructures import Headers
from starlette.responses import Response

LEAST_COMPRESSED = 1000
"""Bytes below which it isn't worth the while."""

BINARY = ("image/png", "font/", "application/vnd.", "application/octet-stream")


class Text:
    """The body of replies that are all alike."""

    def __init__(self, content: bytes, media_type: str | None) -> None:
        self.content = content
        self.media_type = media_type or "application/octet-stream"

    @cached_property
    def etag(self) -> str:
        """What stands for the content; weak, as it does so for its compressed form too."""
        return f'W/"{hashlib.sha256(self.content).hexdigest()[:16]}"'

    @cached_property
    def compressed(self) -> bytes | None:
        """The content as gzip; None where that saves nothing."""
        if len(self.content) < LEAST_COMPRESSED or self.media_type.startswith(BINARY):
            return None
        return gzip.compress(self.content, mtime=0)

    def reply(self, asked: Headers, headers: Mapping[str, str]) -> Response:
        """Return the reply to a request with headers `asked`, with more headers of its own."""
        own = {"ETag": self.etag, "Vary": "Accept-Encoding", **headers}
        if self.etag in asked.get("if-none-match", ""):
            return Response(status_code=304, headers=own)
        if "gzip" in asked.get("accept-encoding", "") and self.compressed is not None:
            return Response(self.compressed, media_type=self.media_type,
                            headers=own | {"Content-Encoding": "gzip"})
        return Response(self.content, media_type=self.media_type, headers=own)
