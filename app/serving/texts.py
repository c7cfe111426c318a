"""Texts that stay as they are: compressed once, and told unchanged to who has them."""

import gzip
import hashlib
from collections.abc import Mapping
from functools import cached_property

import brotli
from starlette.datastructures import Headers
from starlette.responses import Response

LEAST_COMPRESSED = 1000
"""Bytes below which it isn't worth the while."""

QUALITY = 9
"""Of Brotli. 11 takes nine times as long for a twelfth less."""

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
    def by_brotli(self) -> bytes:
        """The content by Brotli, which browsers take over TLS."""
        return bytes(brotli.compress(self.content, quality=QUALITY))

    @cached_property
    def by_gzip(self) -> bytes:
        """The content by gzip."""
        return gzip.compress(self.content, mtime=0)

    def reply(self, asked: Headers, headers: Mapping[str, str]) -> Response:
        """Return the reply to a request with headers `asked`, with more headers of its own."""
        own = {"ETag": self.etag, "Vary": "Accept-Encoding", **headers}
        if self.etag in asked.get("if-none-match", ""):
            return Response(status_code=304, headers=own)
        content, taken = self.content, asked.get("accept-encoding", "")
        if len(content) >= LEAST_COMPRESSED and not self.media_type.startswith(BINARY):
            if "br" in taken:
                content, own["Content-Encoding"] = self.by_brotli, "br"
            elif "gzip" in taken:
                content, own["Content-Encoding"] = self.by_gzip, "gzip"
        return Response(content, media_type=self.media_type, headers=own)
