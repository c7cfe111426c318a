"""Headings of several languages: what their columns mean, and what they are counted in."""

import pytest

from app.formats.sheets.importing import import_file
from app.formats.sheets.schemas import ImportReply, ImportSettings

pytestmark = pytest.mark.slow


def read(*rows: str) -> ImportReply:
    """Import a CSV file whose first row has the headings."""
    return import_file("\n".join(rows).encode(), ImportSettings())


def test_a_word_of_two_languages_is_read_in_that_of_the_sheet() -> None:
    dutch = read("Naam,Breedtegraad,Lengtegraad,Aantal,Van,Tot",
                 "Bakker,52.37,4.89,3,0900,1700", "Slager,52.36,4.91,2,1000,1200")
    english = read("name,lat,lon,kg,van", "Anna,48.1,11.5,5,Van 1", "Ben,48.2,11.6,7,Van 2")
    assert [column.meaning for column in dutch.columns][-2:] == ["earliest", "latest"]
    assert english.columns[-1].meaning == "vehicles"


def test_amounts_have_the_names_and_units_of_their_columns() -> None:
    reply = read("name,lat,lon,Gewicht (kg),Kisten", "Anna,48.1,11.5,5,2", "Ben,48.2,11.6,7,1")
    assert reply.request is not None
    assert reply.request["load_dimensions"] == [{"name": "Gewicht", "unit": "kg"},
                                                {"name": "Kisten"}]


def test_an_unsure_encoding_is_shown_by_a_heading_if_no_cell_does() -> None:
    content = "Dirección,lat,lon\nCalle 1,40.4,-3.7\nCalle 2,40.5,-3.8".encode("cp1252")
    (doubt,) = [doubt for doubt in import_file(content, ImportSettings()).doubts
                if doubt.code == "ENCODING_GUESSED"]
    assert "'Dirección'" in doubt.message
