"""Tokens that let in whoever has them: made at random, shown once, kept as hashes."""

import hashlib
import hmac
import re
import secrets
from dataclasses import dataclass
from functools import cached_property

PREFIX = "tdm_"
"""What every token begins with, so that people, scanners for secrets and our own logs know it."""

ID_BYTES, SECRET_BYTES = 6, 32

NO_DIGEST = bytes(32)
"""Compared with where there is no token of the id presented."""


@dataclass(frozen=True)
class NewToken:
    """A token that was just made."""

    id: str
    text: str
    digest: bytes  # SHA-256 of the whole text; 256 random bits need no slow hash


@dataclass(frozen=True)
class TokenKind:
    """What one kind of token is for, by its name after `PREFIX`; empty: API keys."""

    name: str = ""

    @cached_property
    def _pattern(self) -> re.Pattern[str]:
        return re.compile(rf"{self._beginning}([0-9a-f]{{{2 * ID_BYTES}}})_"
                          rf"[0-9a-f]{{{2 * SECRET_BYTES}}}")

    @property
    def _beginning(self) -> str:
        return f"{PREFIX}{self.name}_" if self.name else PREFIX

    def make(self) -> NewToken:
        """Return a new token: its text can't be found again from what is kept of it."""
        token_id = secrets.token_hex(ID_BYTES)
        text = f"{self._beginning}{token_id}_{secrets.token_hex(SECRET_BYTES)}"
        return NewToken(token_id, text, digest_of(text))

    def id_of(self, presented: str) -> str:
        """Return the id that a token states; empty if it isn't one of this kind."""
        matched = self._pattern.fullmatch(presented)
        return matched[1] if matched else ""


def digest_of(text: str) -> bytes:
    """Return what is kept of a token."""
    return hashlib.sha256(text.encode()).digest()


def is_token(presented: str, digest: bytes) -> bool:
    """Tell whether what was presented is the token of a digest.

    It is hashed whole and compared in constant time: with `NO_DIGEST` where none is known, this
    takes as long, so the time tells neither how much is right nor whether the id exists.
    """
    return hmac.compare_digest(digest_of(presented), digest)
