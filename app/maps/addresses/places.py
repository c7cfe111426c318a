"""What a geocoding server answers, judged by the address that was asked for."""

from dataclasses import dataclass

from app.maps.addresses.asked import AddressWords, has_word, names_in, postcodes_in
from app.maps.addresses.geocoder import QUALITIES, Candidate, Candidates, Quality
from app.maps.addresses.likeliest import Ranked, likeliest
from app.maps.addresses.spelling import house_numbers, is_number, key_of, words_of

LONGEST_LABEL = 300


@dataclass(frozen=True)
class AddressPlace:
    """A place as a server tells it."""

    lon: float
    lat: float
    label: str
    quality: Quality
    number: str = ""
    street: str = ""
    postcode: str = ""
    region: tuple[str, ...] = ()  # towns and all larger around it


def judged(address: str, places: list[AddressPlace], by: str, is_strict: bool) -> Candidates:
    """Return what an address may mean, of what a server answered.

    Servers answer another house if they don't know the one that was asked for.

    Parameters
    ----------
    is_strict
        Whether the server answers only what has all words, in whatever language.
    """
    asked = AddressWords.of(address)
    ranked = []
    for place in places:
        quality = _quality(asked, place)
        unmatched = _unmatched(asked, place, is_strict)
        ranked.append(Ranked((len(unmatched), QUALITIES.index(quality)), Candidate(
            place.lon, place.lat, place.label[:LONGEST_LABEL], quality, by, unmatched)))
    return likeliest(ranked)


def _quality(asked: AddressWords, place: AddressPlace) -> Quality:
    if place.quality not in ("house", "interpolated"):
        return place.quality
    words = set(asked.words)
    together = {first + second for first, second in zip(asked.words, asked.words[1:], strict=False)}
    if place.number:
        numbers = set(house_numbers(place.number)) or {key_of(place.number)}
        return place.quality if numbers & (words | together) else "street"
    told = {*words_of(place.label), *words_of(place.postcode)}
    return place.quality if all(word in told for word in words if is_number(word)) else "street"


def _unmatched(asked: AddressWords, place: AddressPlace, is_strict: bool) -> tuple[str, ...]:
    """Return words of the address that speak against a place."""
    numbers = set(house_numbers(place.number))
    stated = [code for code in postcodes_in(asked.words) if code not in numbers]
    right = words_of(place.postcode)
    wrong = [code for code in stated if right and code not in right and code != "".join(right)]
    if is_strict or not place.street:
        return tuple(wrong)
    alike = asked.most_alike(key_of(place.street))
    if alike is None:
        return (*wrong, *names_in(asked.words))
    names = names_in(asked.rest(alike[1], None))
    region = [word for name in place.region for word in words_of(name)]
    if region and names and not any(has_word(name, region) for name in names):
        wrong += names
    return tuple(wrong)
