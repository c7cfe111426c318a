"""Addresses are found in an extract however they are written, and what is doubtful is told."""

from pathlib import Path

import pytest

from app.maps.addresses.index import build_index, find_index, num_houses
from app.maps.addresses.reading import AddressesError
from app.maps.addresses.searching import search
from app.maps.streets.filing import folder_beside
from tests.app.maps.streets.conftest import HELSINKI

OSM = """<?xml version='1.0'?><osm version='0.6' generator='test'>
<node id='1' lon='10.00' lat='50.00' version='1'><tag k='place' v='town'/><tag k='name' v='Adorf'/>
  <tag k='name:en' v='Alphaville'/></node>
<node id='2' lon='10.50' lat='50.00' version='1'><tag k='place' v='village'/>
  <tag k='name' v='Bedorf'/></node>
{houses}
<node id='8' lon='10.001' lat='50.001' version='1'/><node id='9' lon='10.009' lat='50.001'
  version='1'/>
<way id='1' version='1'><nd ref='8'/><nd ref='9'/><tag k='highway' v='residential'/>
  <tag k='name' v='Lindenstraße'/><tag k='name:fr' v='Rue des Tilleuls'/></way>
</osm>"""
HOUSE = ("<node id='{id}' lon='{lon}' lat='50.001' version='1'><tag k='addr:housenumber' "
         "v='{number}'/><tag k='addr:street' v='{street}'/>{rest}</node>")


def towns(folder: Path, *houses: tuple[float, str, str]) -> Path:
    """Return the index of two towns with these houses, by longitude, number and street."""
    extract = folder / "towns.osm"
    extract.write_text(OSM.format(houses="".join(
        HOUSE.format(id=100 + place, lon=lon, number=number, street=street, rest="")
        for place, (lon, number, street) in enumerate(houses))))
    return build_index(extract, [folder])


@pytest.mark.parametrize("written", [
    "Mikonkatu 18, 00100 Helsinki", "mikonkatu 18", "Mikonk. 18 Helsinki", "18 Mikonkatu",
    "MIKONKATU 18 A 5, 00100 HELSINKI, FINLAND", "Mikonkatu nro 18, Helsingfors",
    "Mikaelsgatan 18", "Mikonkaut 18, Helsinki", "Firma Oy, Mikonkatu 18, 2. krs, Helsinki",
])
def test_house_is_found_however_it_is_written(helsinki_index: Path, written: str) -> None:
    (found,) = search(helsinki_index, written)
    assert (found.quality, found.label, found.by, found.unmatched) == (
        "house", "Mikonkatu 18, 00100 Helsinki", "extract", ())
    assert (found.lon, found.lat) == pytest.approx((24.945, 60.1721), abs=2e-4)


def test_street_alone_is_told(helsinki_index: Path) -> None:
    (without_number,) = search(helsinki_index, "Annankatu, Helsinki")
    (beyond,) = search(helsinki_index, "Bulevardi 1000")
    assert (without_number.quality, beyond.quality) == ("street", "street")


def test_town_alone_is_told(helsinki_index: Path) -> None:
    (found,) = search(helsinki_index, "Helsingfors")
    assert (found.quality, found.label) == ("town", "Helsinki")


@pytest.mark.parametrize("written", ["Hauptstraße 5, Berlin", "", " ", "17", "\x00", "\"*", "ÄÖ"])
def test_what_is_not_there_is_not_found(helsinki_index: Path, written: str) -> None:
    assert search(helsinki_index, written) == ()


@pytest.mark.parametrize(("written", "unmatched"), [
    ("Mikonkatu 18, Tampere", ("tampere",)), ("Mikonkatu 18, 33100 Helsinki", ()),
    ("Kaivokatu 1, 33100 Tampere", ("33100", "tampere")),
])
def test_words_that_do_not_fit_are_told(
        helsinki_index: Path, written: str, unmatched: tuple[str, ...]) -> None:
    (found, *_) = search(helsinki_index, written)
    assert found.unmatched == unmatched


def test_house_between_others_is_put_between_them(tmp_path: Path) -> None:
    index = towns(tmp_path, (10.001, "2", "Lindenstraße"), (10.005, "10", "Lindenstraße"),
                  (10.002, "5", "Lindenstraße"))
    (found,) = search(index, "Lindenstr. 4, Adorf")
    assert (found.quality, found.lon) == ("interpolated", pytest.approx(10.002))
    assert found.label == "Lindenstraße 4 (between 2 and 10), Adorf"
    (odd,) = search(index, "Lindenstr. 7, Adorf")
    assert odd.quality == "street"


def test_letters_tell_houses_apart_and_stairways_do_not(tmp_path: Path) -> None:
    index = towns(tmp_path, (10.001, "2", "Lindenstraße"), (10.003, "2a", "Lindenstraße"))
    assert [place.lon for place in search(index, "Lindenstr 2a")] == [10.003]
    assert [place.lon for place in search(index, "Lindenstr 2 A")] == [10.003]
    assert [(place.lon, place.quality) for place in search(index, "Lindenstr 2 C")] == [
        (10.001, "house")]
    assert [place.quality for place in search(index, "Lindenstr 2c")] == ["interpolated"]


def test_same_street_in_two_towns_is_ambiguous_until_the_town_is_named(tmp_path: Path) -> None:
    index = towns(tmp_path, (10.001, "2", "Lindenstraße"), (10.5, "2", "Lindenstraße"))
    assert {place.label for place in search(index, "Lindenstr 2")} == {
        "Lindenstraße 2, Adorf", "Lindenstraße 2, Bedorf"}
    assert [place.label for place in search(index, "Lindenstr 2, Bedorf")] == [
        "Lindenstraße 2, Bedorf"]
    assert [place.label for place in search(index, "2 rue des tilleuls, Alphaville")] == [
        "Lindenstraße 2, Adorf"]


def test_number_within_a_name_is_no_house(tmp_path: Path) -> None:
    index = towns(tmp_path, (10.001, "135", "Straße des 17. Juni"))
    assert [place.quality for place in search(index, "Str. des 17. Juni 135")] == ["house"]
    assert [place.quality for place in search(index, "Straße des 17. Juni")] == ["street"]


def test_addresses_are_gathered_once_and_anew_for_another_extract(tmp_path: Path) -> None:
    first = towns(tmp_path, (10.001, "2", "Lindenstraße"))
    written = first.stat().st_mtime_ns
    assert towns(tmp_path, (10.001, "2", "Lindenstraße")) == first
    assert first.stat().st_mtime_ns == written
    second = towns(tmp_path, (10.001, "4-8", "Lindenstraße"))
    assert (second != first, num_houses(second)) == (True, 3)


def test_helsinki_has_its_houses(helsinki: Path, helsinki_index: Path) -> None:
    assert num_houses(helsinki_index) > 1500
    assert find_index(helsinki, [folder_beside(helsinki)]) == helsinki_index


@pytest.mark.parametrize("content", [b"", b"nothing of the kind", HELSINKI.read_bytes()[:100_000]])
def test_what_is_no_whole_extract_is_refused_and_leaves_nothing(
        content: bytes, tmp_path: Path) -> None:
    extract = tmp_path / "broken.osm.pbf"
    extract.write_bytes(content)
    with pytest.raises(AddressesError, match=r"broken\.osm\.pbf"):
        build_index(extract, [tmp_path / "made"])
    assert list((tmp_path / "made").iterdir()) == []
