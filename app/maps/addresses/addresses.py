"""The geocoders that a service has: what plans and imports ask where addresses are."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field

from app.maps.addresses.caching import AnswerCache
from app.maps.addresses.geocoder import QUALITIES, Candidates, Geocoder, GeocoderError
from app.maps.remote.asking import ShouldStop


@dataclass
class LookedUp:
    """What addresses may mean, as far as there was an answer."""

    candidates: dict[str, Candidates] = field(default_factory=dict)
    error: GeocoderError | None = None  # why some lack


class Addresses:
    """Geocoders, of which each is asked what those before it don't know exactly.

    Parameters
    ----------
    cache
        Where answers are kept; None: nowhere.
    """

    def __init__(self, geocoders: Sequence[Geocoder], cache: AnswerCache | None = None) -> None:
        self._geocoders = geocoders
        self._cache = cache

    @property
    def names(self) -> tuple[str, ...]:
        """What the geocoders are called; none: addresses can't be looked up."""
        return tuple(geocoder.name for geocoder in self._geocoders)

    def close(self) -> None:
        """Let go of connections. In place."""
        for geocoder in self._geocoders:
            geocoder.close()
        if self._cache is not None:
            self._cache.close()

    def look_up(self, addresses: Iterable[str], until: float,
                should_stop: ShouldStop = lambda: False,
                told: Callable[[], None] = lambda: None) -> LookedUp:
        """Return what addresses may mean.

        Parameters
        ----------
        until
            When to have ended at the latest, on `time.perf_counter`.
        told
            Is told of each that was asked for.
        """
        looked_up = LookedUp()
        known = looked_up.candidates
        asked = list(dict.fromkeys(addresses))
        for geocoder in self._geocoders:
            asked = [address for address in asked if not _is_exact(known.get(address, ()))]
            answered = self._answers(geocoder, asked, until, should_stop, told, looked_up)
            for address, candidates in answered.items():
                known[address] = _better(known.get(address, ()), candidates)
            if looked_up.error is not None:
                # Others may know what nothing is known of.
                for address in asked:
                    if address not in answered and not known.get(address):
                        known.pop(address, None)
                break
        return looked_up

    def _answers(self, geocoder: Geocoder, addresses: Sequence[str], until: float,
                 should_stop: ShouldStop, told: Callable[[], None],
                 looked_up: LookedUp) -> dict[str, Candidates]:
        """Return a geocoder's answers, kept or asked for; note why some lack. In place."""
        cache = self._cache if geocoder.scope else None
        found = {} if cache is None else dict(cache.get(geocoder.scope, addresses))
        left = [address for address in addresses if address not in found]

        def take(place: int, candidates: Candidates) -> None:
            found[left[place]] = candidates
            if cache is not None:
                cache.put(geocoder.scope, left[place], candidates)
            told()

        if left:
            try:
                geocoder.find(left, until, should_stop, take)
            except GeocoderError as error:
                looked_up.error = error
        return found


def _is_exact(candidates: Candidates) -> bool:
    return (len(candidates) == 1 and candidates[0].quality == "house"
            and not candidates[0].unmatched)


def _better(first: Candidates, second: Candidates) -> Candidates:
    return min(first, second, key=_badness)


def _badness(candidates: Candidates) -> tuple[float, ...]:
    if not candidates:
        return (float("inf"),)
    best = candidates[0]
    return (len(best.unmatched), QUALITIES.index(best.quality), len(candidates))


NO_ADDRESSES = Addresses(())
