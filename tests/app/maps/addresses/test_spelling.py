"""One address, written in many ways."""

import pytest

from app.maps.addresses.spelling import house_numbers, key_of


@pytest.mark.parametrize(("one", "other"), [
    ("Hauptstraße", "HAUPTSTR."), ("Hauptstrasse", "Haupt Str."), ("Säästöpankinranta",
                                                                   "saastopankinranta"),
    ("Aleksanterinkatu", "Aleksanterink."), ("Mannerheimintie", "mannerheimint"),
    ("Łódzka", "Lodzka"), ("St. Mary's Street", "Saint Marys St"), ("Sandgasse", "Sandg."),
    ("Rue de l'Église", "rue de l\u2019eglise"), ("Köpmangatan", "KÖPMANG."),
])
def test_same_name(one: str, other: str) -> None:
    assert key_of(one) == key_of(other) != ""


@pytest.mark.parametrize(("one", "other"), [
    ("Hauptstraße", "Hauptplatz"), ("Annankatu", "Annantie"), ("Main Street", "Main Road"),
])
def test_other_name(one: str, other: str) -> None:
    assert key_of(one) != key_of(other)


@pytest.mark.parametrize(("stated", "numbers"), [
    ("12", ["12"]), ("5 A", ["5a"]), ("14B", ["14b"]), ("2-6", ["2", "4", "6"]),
    ("29-27", ["29", "27"]), ("1\u20134", ["1", "2", "3", "4"]), ("3;5", ["3", "5"]),
    ("12/14", ["12", "14"]), ("2, 2. krs./Floor 2", ["2"]), ("1-9999", ["1"]), ("s/n", []),
])
def test_house_numbers_of_a_map(stated: str, numbers: list[str]) -> None:
    assert list(house_numbers(stated)) == numbers
