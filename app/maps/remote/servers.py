"""What is read and checked of every server that may be asked, before it is."""

from collections.abc import Mapping
from dataclasses import KW_ONLY, dataclass
from urllib.parse import parse_qsl, urlsplit, urlunsplit


@dataclass(frozen=True)
class Server:
    """A server, and how it is asked.

    Parameters
    ----------
    url
        Where its paths begin, such as `http://localhost:5000`.
    at_once
        Most questions at the same time for one caller.
    patience
        Most seconds for one answer, before the question is asked again.
    first_wait
        Seconds until it is asked again, at random up to this, then up to twice as many, and so on.
    failures, rest
        After so many callers in a row that it failed to answer, it isn't asked for so many seconds.
    """

    url: str
    _: KW_ONLY
    at_once: int = 4
    patience: float = 10.0
    first_wait: float = 0.2
    failures: int = 3
    rest: float = 10.0

    @property
    def sent(self) -> Mapping[str, str]:
        """Headers of every question, such as a key."""
        return {}

    def require(self, whose: str, *more: str) -> None:
        """Check address and limits; raises `ValueError` that names the first that is wrong."""
        require_address(self.url, whose)
        for name in ("at_once", "patience", "first_wait", "failures", "rest", *more):
            if not getattr(self, name) > 0:
                raise ValueError(f"{name} of {whose} must be positive")


@dataclass(frozen=True)
class Options:
    """What may stand behind an address: whole numbers, those that needn't be, and texts."""

    whole: tuple[str, ...]
    broken: tuple[str, ...]
    texts: tuple[str, ...]


def parted(address: str) -> tuple[str, dict[str, str]]:
    """Return an address without its options, and these."""
    parts = urlsplit(address)
    options = dict(parse_qsl(parts.query, keep_blank_values=True))
    return urlunsplit(parts._replace(query="")).rstrip("/"), options


def numbers_of(stated: Mapping[str, str], known: Options, whose: str) -> dict[str, int | float]:
    """Return the options that are numbers.

    Raises
    ------
    ValueError
        If one isn't known, or can't be read.
    """
    names = (*known.whole, *known.broken, *known.texts)
    unknown = stated.keys() - set(names)
    if unknown:
        raise ValueError(f"{whose} has no option {min(unknown)!r}: it has {', '.join(names)}")
    try:
        whole = {name: int(stated[name]) for name in known.whole if name in stated}
        return whole | {name: float(stated[name]) for name in known.broken if name in stated}
    except ValueError:
        # What can't be read may hold a key, so it isn't repeated.
        raise ValueError(f"an option of {whose} is no number") from None


def require_address(address: str, whose: str) -> None:
    """Check a server's address; raises `ValueError` if it is another than that of one by HTTP."""
    # Not before it is needed: it takes 8 MB, and many services ask nobody.
    import httpx

    try:
        url = httpx.URL(address)
    except httpx.InvalidURL as error:
        raise ValueError(f"{whose} has no such address: {error}") from error
    if url.scheme not in ("http", "https") or not url.host or url.query or url.fragment:
        raise ValueError(f"the address of {whose} must be as http://host:port is")
