"""What is read and checked of every server that may be asked, before it is."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from urllib.parse import parse_qsl, urlsplit, urlunsplit


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


def require_positive(server: object, names: Iterable[str], whose: str) -> None:
    """Check limits of a server; raises `ValueError` that names the first that isn't positive."""
    for name in names:
        if not getattr(server, name) > 0:
            raise ValueError(f"{name} of {whose} must be positive")
