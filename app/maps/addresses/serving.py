"""Geocoding servers: one question for each address, several at a time."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from pydantic import ValidationError

from app.maps.addresses import nominatim, pelias, photon
from app.maps.addresses.geocoder import (
    GEOCODER, Candidates, GeocoderAnswerError, GeocoderError, GeocoderUnavailableError, Told,
)
from app.maps.addresses.places import AddressPlace, judged
from app.maps.addresses.server import GeocodingServer, ServerKind
from app.maps.remote.asking import RemoteCall, RemoteServer, ShouldStop
from app.maps.remote.errors import SourceError
from app.maps.remote.servers import Options, numbers_of, parted

MOST_BYTES = 2**20
"""Longer than any answer with few places."""

SENSELESS = frozenset({400, 414, 422})
"""Statuses that servers answer to addresses which they can't make anything of."""

OPTIONS = Options(("at_once", "failures"), ("patience", "rest", "per_second"),
                  ("key", "email", "country", "language"))


class _SenselessError(GeocoderAnswerError):
    """The server can't make anything of the address."""


@dataclass(frozen=True)
class Adapter:
    """How a kind of server is asked and what it answers.

    Parameters
    ----------
    is_strict
        Whether it answers only what has all words of an address, in whatever language.
    """

    path_of: Callable[[str, GeocodingServer], str]
    read: Callable[[bytes], list[AddressPlace]]
    is_strict: bool


ADAPTERS: dict[ServerKind, Adapter] = {
    "nominatim": Adapter(nominatim.path_of, nominatim.read, True),
    "photon": Adapter(photon.path_of, photon.read, False),
    "pelias": Adapter(pelias.path_of, pelias.read, False),
}


class ServerGeocoder:
    """A geocoding server.

    Parameters
    ----------
    turn
        Takes a turn to ask, and tells in how many seconds it comes. None: turns come at once.
    """

    def __init__(self, kind: ServerKind, server: GeocodingServer,
                 turn: Callable[[], float] | None = None) -> None:
        self.name: str = kind
        self._adapter = ADAPTERS[kind]
        self._server = server
        self._asking = RemoteServer(server, GEOCODER, _refusal, turn)

    @property
    def scope(self) -> str:
        """What tells its answers from those of others."""
        server = self._server
        return " ".join((self.name, server.url, server.country, server.language))

    def find(self, addresses: Sequence[str], until: float, should_stop: ShouldStop,
             told: Told) -> None:
        """Look addresses up; each answer is told as it comes. Raises `GeocoderError`."""
        questions = [self._question(address) for address in addresses]
        # What the source fails with is stated by `GEOCODER`.
        self._asking.ask(questions, until, should_stop, told)

    def _question(self, address: str) -> RemoteCall[Candidates]:
        def read(body: bytes) -> Candidates:
            try:
                places = self._adapter.read(body)
            except ValidationError as error:
                first = error.errors(include_input=False, include_url=False)[0]
                where = ".".join(map(str, first["loc"]))
                raise GeocoderAnswerError(
                    f"The geocoder answered nonsense: {where}: {first['msg']}.") from None
            return judged(address, places, self.name, self._adapter.is_strict)

        return RemoteCall(self._adapter.path_of(address, self._server), read, MOST_BYTES,
                          refused=_nothing_if_senseless)

    def close(self) -> None:
        """Let go of connections."""
        self._asking.close()


def read_server(address: str) -> GeocodingServer:
    """Return the server of an address with options, as in `https://host?country=fi&key=…`.

    Raises
    ------
    ValueError
        If it can't be read.
    """
    url, options = parted(address)
    numbers = numbers_of(options, OPTIONS, "a geocoder")
    texts = {name: options[name] for name in OPTIONS.texts if name in options}
    return GeocodingServer(url, **texts, **numbers)  # type: ignore[arg-type]


def _refusal(status: int, body: bytes) -> GeocoderError:
    if status in SENSELESS:
        return _SenselessError(f"The geocoder refused with status {status}.")
    return GeocoderUnavailableError(f"The geocoder answered with status {status}.")


def _nothing_if_senseless(error: SourceError) -> Candidates:
    if isinstance(error, _SenselessError):
        return ()
    raise error
