"""What of a sheet's columns is sure, what is to be looked at, and what is left aside."""

import pytest

from app.formats.sheets.importing import import_file
from app.formats.sheets.schemas import ImportReply, ImportSettings


def read(head: str, *rows: str) -> ImportReply:
    return import_file("\n".join((head, *rows)).encode(), ImportSettings())


def certainty(reply: ImportReply, heading: str) -> tuple[str, str]:
    [column] = [column for column in reply.columns if column.heading == heading]
    return column.meaning, column.certainty


def test_known_headings_over_what_they_say_are_sure_and_stated_ones_stated() -> None:
    reply = read("Name;Lat;Lon;kg", "A;48,1;11,5;3", "B;48,2;11,6;4")
    assert {column.certainty for column in reply.columns} == {"sure"}
    again = import_file(b"Name;Lat;Lon;kg\nA;48,1;11,5;3\n", ImportSettings(mapping=reply.mapping))
    assert {column.certainty for column in again.columns} == {"stated"}


@pytest.mark.parametrize("cell", ["7", "8:30", "48,13712", "10 min"])
def test_an_unknown_heading_over_what_may_be_for_the_plan_is_open(cell: str) -> None:
    reply = read("Name;Lat;Lon;Kz.", f"A;48,1;11,5;{cell}", f"B;48,2;11,6;{cell}")
    assert certainty(reply, "Kz.") == ("ignored", "open")


@pytest.mark.parametrize("heading", ["Preis", "Cena (Kč)", "Rating", "Tutar TL"])
def test_prices_and_the_like_are_left_aside(heading: str) -> None:
    reply = read(f"Name;Lat;Lon;{heading}", "A;48,1;11,5;7", "B;48,2;11,6;2014")
    assert certainty(reply, heading) == ("ignored", "unused")


def test_words_are_open_where_nothing_names_customers() -> None:
    rows = "4711;Meyer;48,1;11,5", "4712;Huber;48,2;11,6"
    assert certainty(read("Auftragsnr.;Kz.;Lat;Lon", *rows), "Kz.")[1] == "open"
    assert certainty(read("Kunde;Kz.;Lat;Lon", *rows), "Kz.")[1] == "unused"


def test_words_that_divide_rows_are_open() -> None:
    rows = [f"{name};48,1;11,5;{group}" for name, group in zip("ABCD", ("rot", "blau") * 2,
                                                             strict=True)]
    assert certainty(read("Name;Lat;Lon;Zauber", *rows), "Zauber")[1] == "open"
    assert certainty(read("Name;Lat;Lon;Vertreter", *rows), "Vertreter")[1] == "unused"


def test_half_a_pair_is_doubtful_and_plans_nothing() -> None:
    reply = read("Name;Lat;XQ", "A;48,1;11,5", "B;48,2;11,6")
    assert certainty(reply, "Lat") == ("latitude", "doubtful")
    assert [doubt.code for doubt in reply.columns[1].doubts] == ["HALF_PAIR"]
    assert reply.request is None


def test_a_begin_that_may_be_of_either_end_is_doubtful() -> None:
    head = "Name;Pickup lat;Pickup lon;Delivery lat;Delivery lon;{}"
    rows = "A;48,1;11,5;48,2;11,6;9:00", "B;48,2;11,6;48,3;11,7;10:00"
    assert certainty(read(head.format("Start"), *rows), "Start") == ("earliest", "doubtful")
    assert certainty(read(head.format("Pickup from"), *rows), "Pickup from") == (
        "pickup_earliest", "sure")


def test_a_heading_of_a_place_over_coordinates_is_sure() -> None:
    reply = read("Name\tPartenza\tDestinazione", "A\t45.12, 9.12\t45.23, 9.23")
    assert certainty(reply, "Partenza") == ("pickup_point", "sure")
    assert certainty(reply, "Destinazione") == ("point", "sure")


def test_before_which_time_is_no_relation() -> None:
    reply = read("Naam;Lat;Lon;Leveren voor", "A;52,1;4,9;10:00", "B;52,2;4,8;12:30")
    assert certainty(reply, "Leveren voor") == ("latest", "sure")


def test_a_date_with_times_under_a_word_of_two_languages_is_when_it_closes() -> None:
    reply = read("Cliente;Lat;Lon;Abre;Fecha", "A;-23,1;-46,1;23/11/2026 08:00;23/11/2026 12:00")
    assert certainty(reply, "Fecha") == ("latest", "sure")


@pytest.mark.parametrize("last", [";;;7", "Alles;;;7"])
def test_a_last_row_of_bare_sums_is_no_customer(last: str) -> None:
    reply = read("Name;Lat;Lon;kg", "A;48,1;11,5;3", "B;48,2;11,6;4", last)
    assert [asked.kind for asked in reply.questions] == ["total_rows"]
    assert reply.request is not None
    assert len(reply.request["customers"]) == 2
    assert read("Name;Lat;Lon;kg", "A;48,1;11,5;3", "B;48,2;11,6;4", ";;;6").request is None


@pytest.mark.parametrize("heading", ["Ekipa", "Załoga", "Tým", "Squadra", "Équipe", "Csapat"])
def test_crews_name_vehicles(heading: str) -> None:
    reply = read(f"Name;Lat;Lon;{heading}", "A;48,1;11,5;E1", "B;48,2;11,6;E2")
    assert certainty(reply, heading) == ("vehicles", "sure")
    assert reply.request is not None
    assert [kind["id"] for kind in reply.request["fleet"]] == ["E1", "E2"]
    assert [customer["vehicles"] for customer in reply.request["customers"]] == [
        {"allowed": ["E1"]}, {"allowed": ["E2"]}]
    assert "FLEET_NAMED" in [doubt.code for doubt in reply.doubts]


def test_crews_that_some_orders_name_alone_are_told() -> None:
    reply = read("Name;Lat;Lon;Team", "A;48,1;11,5;E1", "B;48,2;11,6;", "C;48,2;11,6;E2")
    assert {error.code for error in reply.errors} == {"UNKNOWN_VEHICLE"}


@pytest.mark.parametrize(("encoding", "name"), [
    ("cp1250", "Őrség Patika"), ("iso8859_2", "Świat Książki"), ("cp1254", "Doğan Şehir"),
    ("mac_roman", "Löwe Größ"), ("cp1252", "Löwe Größ"), ("cp1252", "Açaí Irmãos União")])
def test_letters_are_told_by_those_of_the_headings_language(encoding: str, name: str) -> None:
    head = {"cp1250": "Partner;Raklap", "iso8859_2": "Odbiorca;Waga", "cp1254": "Firma;Koli"}.get(
        encoding, "Kunde;Menge")
    content = f"{head};Lat;Lon\n{name};3;48,1;11,5\n".encode(encoding)
    reply = import_file(content, ImportSettings())
    assert reply.request is not None
    assert reply.request["customers"][0]["id"] == name


def test_the_first_rows_are_told_as_they_are_and_as_they_were_read() -> None:
    reply = read("Name;Lat;Lon;von;bis;XQ", "A;48,1;11,5;8:30;10:00;", ";;;;;",
                 *(f"C{row};48,2;11,6;;9.15;7" for row in range(9)))
    assert reply.table_rows == [2, 4, 5, 6, 7, 8]
    told = {column.heading: column for column in reply.columns}
    assert {column.pair for column in reply.columns} == {None, "B", "C", "D", "E"}
    assert (told["Lat"].pair, told["bis"].pair) == ("C", "D")
    ends = [cell and (cell.cell, cell.raw, cell.read) for cell in told["bis"].cells]
    assert ends[:2] == [("E2", "10:00", "10:00"), ("E4", "9.15", "9:15")]
    assert told["XQ"].cells[0] is None
    assert told["XQ"].likely[-2:] == ["info", "ignored"]
    assert "demand" in told["XQ"].likely


def test_dates_without_a_year_are_of_the_year_of_the_day_that_is_planned() -> None:
    content = b"Name;Lat;Lon;Datum\nA;48,1;11,5;23.11.\nB;48,2;11,6;24.11.\n"
    reply = import_file(content, ImportSettings(day="2026-11-23"))
    assert certainty(reply, "Datum") == ("date", "sure")
    assert reply.request is not None
    assert [customer["id"] for customer in reply.request["customers"]] == ["A"]
    assert certainty(import_file(content, ImportSettings()), "Datum") == ("ignored", "open")


def test_a_vehicle_by_its_heading_is_a_begin_where_its_cells_are_times() -> None:
    reply = read("Naam;Lat;Lon;Van;Tot", "A;52,1;4,5;23-11-2026 10:00;23-11-2026 11:30",
                 "B;52,2;4,6;23-11-2026 09:00;23-11-2026 12:00")
    assert certainty(reply, "Van") == ("earliest", "sure")
