"""Files that are no workbooks and no CSV, and such as a program cut or shortened."""

import json
from zipfile import ZipFile
from io import BytesIO
from typing import Any

import pytest

from app.formats.sheets.importing import import_file
from app.formats.sheets.schemas import ImportReply, ImportSettings
from app.formats.sheets.table import NotASheetError
from tests.app.formats.sheets.test_importing import codes

pytestmark = pytest.mark.slow

PLACEMARK = ("<Placemark><name>{name}</name><description>{told}</description>"
             "<ExtendedData><Data name=\"Kisten\"><value>{boxes}</value></Data></ExtendedData>"
             "<Point><coordinates>{lon},{lat},0</coordinates></Point></Placemark>")
ZONE = ("<Placemark><name>Zone</name><Polygon><outerBoundaryIs><LinearRing><coordinates>11,48 "
        "12,48 12,49 11,48</coordinates></LinearRing></outerBoundaryIs></Polygon></Placemark>")
KML = ('<?xml version="1.0" encoding="UTF-8"?><kml xmlns="http://www.opengis.net/kml/2.2"><Document>'
       + PLACEMARK.format(name="Bäcker", told="Hof", boxes=3, lat=48.1, lon=11.5)
       + PLACEMARK.format(name="Café", told="", boxes=2, lat=48.2, lon=11.6) + "{more}"
       "</Document></kml>")


def read(content: str | bytes, **settings: Any) -> ImportReply:
    raw = content.encode() if isinstance(content, str) else content
    return import_file(raw, ImportSettings.model_validate(settings))


def customers(reply: ImportReply) -> list[dict[str, Any]]:
    assert reply.errors == []
    assert reply.request is not None
    return reply.request["customers"]  # type: ignore[no-any-return]


def placed(reply: ImportReply) -> dict[str, list[float]]:
    return {customer["id"]: customer["location"] for customer in customers(reply)}


@pytest.mark.parametrize("encoding", ["utf-8", "cp1252"])
def test_a_page_saved_as_a_workbook_is_read(encoding: str) -> None:
    page = """<html><body><table><tr><td><table border=1>
        <tr><th>Kunde</th><th>Breite</th><th>Länge</th><th colspan="1">Menge</th></tr>
        <tr><td>Bäcker</td><td>48,1371</td><td>11,5754</td><td>3</td></tr>
        <tr><td>Café &amp; Co<br>Hof</td><td>48,22</td><td>11,63</td><td>4</td></tr>
        </table></td></tr></table></body></html>"""
    reply = read(page.encode(encoding))
    assert placed(reply) == {"Bäcker": [11.5754, 48.1371], "Café & Co Hof": [11.63, 48.22]}
    assert [customer["demand"] for customer in customers(reply)] == [[3], [4]]


def test_a_workbook_of_2003_in_xml_is_read() -> None:
    def cells(*texts: str) -> str:
        return "".join(f'<Cell><Data ss:Type="{"Number" if text[0].isdigit() else "String"}">{text}'
                       "</Data></Cell>" for text in texts)

    name = "urn:schemas-microsoft-com:office:spreadsheet"
    reply = read(f'<?xml version="1.0"?><Workbook xmlns="{name}" xmlns:ss="{name}"><Worksheet '
                 f'ss:Name="Tour"><Table><Row>{cells("Kunde", "lat", "lon")}</Row>'
                 f'<Row>{cells("Anna", "48.1", "11.5")}</Row></Table></Worksheet></Workbook>')
    assert (reply.sheet, placed(reply)) == ("Tour", {"Anna": [11.5, 48.1]})


@pytest.mark.parametrize(("kind", "text"), [
    ("DateTime", "garbage"), ("Number", "NaN"), ("Number", "inf"), ("Number", "1e999")])
def test_a_cell_that_is_not_of_its_type_is_a_text(kind: str, text: str) -> None:
    name = "urn:schemas-microsoft-com:office:spreadsheet"
    rows = "".join("<Row>" + "".join(f'<Cell><Data ss:Type="{kind}">{text}</Data></Cell>'
                                     for kind, text in row) + "</Row>" for row in (
        [("String", heading) for heading in ("Kunde", "lat", "lon", "Hinweis")],
        [("String", "Anna"), ("Number", "48.1"), ("Number", "11.5"), (kind, text)]))
    reply = read(f'<?xml version="1.0"?><Workbook xmlns="{name}" xmlns:ss="{name}"><Worksheet>'
                 f"<Table>{rows}</Table></Worksheet></Workbook>")
    assert customers(reply)[0]["info"] == {"notes": text}


@pytest.mark.parametrize("cell", ["1e999", "1" * 400, r'"\ud800"'])
def test_what_json_alone_can_hold_is_a_text(cell: str) -> None:
    reply = read(f'[{{"name": "Anna", "lat": 48.1, "lon": 11.5, "notes": {cell}}}]')
    assert customers(reply)
    assert "Anna" in reply.model_dump_json()


@pytest.mark.parametrize("number", ["1e999", "1" * 400])
def test_points_that_are_nowhere_are_left_out(number: str) -> None:
    feature = ('{{"type": "Feature", "geometry": {{"type": "Point", "coordinates": [{}, 48.1]}},'
               '"properties": {{"name": "{}"}}}}')
    reply = read('{"type": "FeatureCollection", "features": ['
                 f'{feature.format("11.5", "Anna")}, {feature.format(number, "Ben")}]}}')
    assert placed(reply) == {"Anna": [11.5, 48.1]}


@pytest.mark.parametrize("is_zipped", [False, True])
def test_points_of_kml_are_customers_and_its_areas_asked_about(is_zipped: bool) -> None:
    content = KML.format(more=ZONE).encode()
    if is_zipped:
        packed = BytesIO()
        with ZipFile(packed, "w") as archive:
            archive.writestr("doc.kml", content)
        content = packed.getvalue()
    reply = read(content)
    assert placed(reply) == {"Bäcker": [11.5, 48.1], "Café": [11.6, 48.2]}
    assert [customer["demand"] for customer in customers(reply)] == [[3], [2]]
    assert customers(reply)[0]["info"] == {"notes": "Hof"}
    [question] = reply.questions
    assert (question.kind, question.sheet) == ("sheet", "Lines and areas")
    also = read(content, mapping={"answers": {question.id: "also"}})
    assert placed(also)["Zone"] == [11.5, 48.5]


def test_points_of_geojson_are_customers() -> None:
    def feature(kind: str, at: Any, **told: Any) -> dict[str, Any]:
        return {"type": "Feature", "geometry": {"type": kind, "coordinates": at},
                "properties": told}

    reply = read(json.dumps({"type": "FeatureCollection", "features": [
        feature("Point", [11.5, 48.1], name="Anna", menge=3),
        feature("Point", [11.6, 48.2], name="Ben", menge=2),
        feature("LineString", [[11, 48], [12, 49]], name="Weg")]}))
    assert placed(reply) == {"Anna": [11.5, 48.1], "Ben": [11.6, 48.2]}
    assert [question.id for question in reply.questions] == ["sheet:Lines and areas"]


@pytest.mark.parametrize("content", [
    '{"a": 1}', "[" * 100_000, '{"features": ' + "[" * 50_000, "<html><p>Log in</p></html>", "<",
    "[", '[{"name": "Anna", "lat": 48.1, "lon": 11.5, "demand": NaN}]',
    '{"features": [{"geometry": {"type": "Point", "coordinates": [NaN, 48.1]}}]}',
    '{"type": "FeatureCollection", "features": [{"geometry": {"coordinates": 1}}]}'])
def test_marks_without_rows_are_refused(content: str) -> None:
    with pytest.raises(NotASheetError, match="save it as CSV"):
        read(content)


def test_headings_in_brackets_are_no_json() -> None:
    assert placed(read("[Name];lat;lon\nAnna;48.1;11.5")) == {"Anna": [11.5, 48.1]}


def test_entities_of_xml_are_not_unfolded() -> None:
    bomb = "".join(f'<!ENTITY e{number} "{f"&e{number - 1};" * 10}">' for number in range(1, 12))
    with pytest.raises(NotASheetError):
        read(f'<?xml version="1.0"?><!DOCTYPE k [<!ENTITY e0 "aaaaaaaaaa">{bomb}]><kml>'
             "<Placemark><name>&e11;</name><Point><coordinates>11,48</coordinates></Point>"
             "</Placemark></kml>")


LINKS = {
    "https://www.google.com/maps/place/X/@48.0,11.0,17z/data=!3m1!4b1!8m2!3d48.1!4d11.5": "a pin",
    "https://maps.google.com/?q=48.1,11.5": "a question",
    "https://www.google.com/maps/search/?api=1&query=48.1%2C11.5": "a search",
    "https://www.google.com/maps/dir/?api=1&destination=48.1,11.5": "a way",
    "https://www.google.com/maps/@48.1,11.5,15z": "a view",
    "https://www.openstreetmap.org/?mlat=48.1&mlon=11.5#map=17/48.0/11.0": "a marker",
    "https://www.openstreetmap.org/#map=17/48.1/11.5": "a map",
    "https://maps.apple.com/?ll=48.1,11.5&q=Anna": "Apple", "geo:48.1,11.5?z=17": "a phone",
    "https://www.bing.com/maps?cp=48.1~11.5&lvl=16": "Bing",
    "https://waze.com/ul?ll=48.1,11.5&navigate=yes": "Waze"}


@pytest.mark.parametrize("link", LINKS)
@pytest.mark.parametrize("heading", ["Karte", "Map link", "Ort (Link)"])
def test_links_to_maps_are_places(link: str, heading: str) -> None:
    assert placed(read(f'Kunde;{heading}\nAnna;"{link}"\n'))["Anna"] == [11.5, 48.1]


def test_a_short_link_is_refused_with_what_to_do() -> None:
    reply = read("Kunde;Karte\nAnna;https://maps.app.goo.gl/Ab12\nBen;geo:48.1,11.5\n"
                 "Cleo;geo:48.2,11.6\n")
    [error] = reply.errors
    assert (error.code, error.cell) == ("MISREAD", "B2")
    assert "copy the longer address" in error.message


def test_decimal_commas_between_commas_are_put_together() -> None:
    reply = read("name,lat,lon,kg\nAnna,48,137,11,575,3,5\nBen,48,2,11,6,12,25\nCleo,48,1,11,5,7\n")
    assert placed(reply)["Anna"] == [11.575, 48.137]
    assert [customer["demand"] for customer in customers(reply)] == [[3.5], [12.25], [7]]
    assert "DECIMAL_COMMAS" in codes(reply)


def test_decimal_commas_that_can_be_read_in_two_ways_are_refused_in_words() -> None:
    reply = read("Kunde,Breite,Länge,Menge,Gewicht\nAnna,48,137,11,575,3,4,5\n")
    [error] = reply.errors
    assert (error.code, error.cell) == ("TOO_MANY_CELLS", "A2")
    assert "comma" in error.message
    assert "semicolons" in error.message


def test_a_column_without_a_heading_is_not_put_together() -> None:
    reply = read("name,lat,lon\nAnna,48.1,11.5,7\nBen,48.2,11.6,8\n")
    assert placed(reply)["Ben"] == [11.6, 48.2]
    assert [question.id for question in reply.questions] == ["column:D"]


def test_numbers_whose_digits_are_lost_are_doubted_and_not_joined() -> None:
    reply = read("Auftrag;Breite;Länge;Menge\n1,23457E+11;48,1;11,5;1\n1,23457E+11;48,1;11,5;2\n")
    assert len(customers(reply)) == 2
    [doubt] = [doubt for doubt in reply.doubts if doubt.code == "DIGITS_LOST"]
    assert (doubt.column, doubt.cell) == ("A", "A2")


@pytest.mark.parametrize(("cell", "hours"), [
    ("8-11 AM / 2-4 PM", [(8, 11), (14, 16)]), ("9am-12pm, 1pm-5pm", [(9, 12), (13, 17)]),
    ("8-12 Uhr und 14-18 Uhr", [(8, 12), (14, 18)]), ("AM", [(0, 12)]), ("vormittags", [(0, 12)]),
    ("matin", [(0, 12)]), ("22:00-2:00", [(22, 26)]), ("22-6 Uhr", [(22, 30)]),
    ("8:00-12:00\n14:00-16:00", [(8, 12), (14, 16)]), ("8-12 Uhr", [(8, 12)])])
def test_several_windows_of_a_cell_are_read(cell: str, hours: list[tuple[int, int]]) -> None:
    [customer] = customers(read(f'Kunde;Breite;Länge;Zeitfenster\nAnna;48,1;11,5;"{cell}"\n'))
    windows = customer.get("time_windows") or [customer["time_window"]]
    assert [(window["earliest"] / 3600, window["latest"] / 3600) for window in windows] == hours


def test_the_afternoon_is_a_window_and_so_are_two_columns() -> None:
    [customer] = customers(read("Kunde;Breite;Länge;Fenster\nAnna;48,1;11,5;nachmittags\n"
                                .replace("Fenster", "Zeitfenster")))
    assert customer["time_window"] == {"earliest": 43_200}
    [customer] = customers(read("Kunde;Breite;Länge;Vormittag;Nachmittag\n"
                                "Anna;48,1;11,5;8-12;14-16\n"))
    assert [window["earliest"] for window in customer["time_windows"]] == [28_800, 50_400]


def test_dates_that_are_numbers_are_dates() -> None:
    reply = read("Kunde;Breite;Länge;Datum;von;bis\nAnna;48,1;11,5;46349;0,333333;0,5\n"
                 "Ben;48,2;11,6;46349;46349,375;46349,75\n".replace("46349,375;46349,75",
                                                                     "0,375;0,75"))
    assert reply.day == "2026-11-23"
    assert customers(reply)[1]["time_window"] == {"earliest": 32_400, "latest": 64_800}
    both = read("Kunde;Breite;Länge;von;bis\nAnna;48,1;11,5;46349,375;46349,75\n")
    assert both.day == "2026-11-23"
    assert customers(both)[0]["time_window"] == {"earliest": 32_400, "latest": 64_800}


def test_headings_of_other_programs_are_known() -> None:
    reply = read("Customer,Lat,Lng,Pkgs,handling_s,State\nAnna,40.1,-75.1,3 Pkgs,300,PA\n")
    [customer] = customers(reply)
    assert (customer["demand"], customer["service_duration"]) == ([3], 300)
    assert customer["info"]["address"] == "PA"
    assert reply.questions == []
    for heading, seconds in (("Abladen", 300), ("Minuten", 300), ("Min.", 300), ("Sekunden", 5)):
        [customer] = customers(read(f"Kunde;Breite;Länge;{heading}\nAnna;48,1;11,5;5\n"))
        assert customer["service_duration"] == seconds


def test_amounts_may_be_counted_in_any_word() -> None:
    reply = read("Kunde;Breite;Länge;Menge\nAnna;48,1;11,5;3 Kisten\nBen;48,2;11,6;2 Kisten\n")
    assert [customer["demand"] for customer in customers(reply)] == [[3], [2]]
    assert reply.request is not None
    assert reply.request["load_dimensions"] == [{"name": "Menge", "unit": "Kisten"}]


def test_points_of_a_layer_of_depots_are_depots() -> None:
    layers = {"Depot": [("Werk Nord", 11.5)], "Montag": [("A", 11.6), ("B", 11.7)]}
    folders = "".join(f"<Folder><name>{layer}</name>" + "".join(
        f"<Placemark><name>{name}</name><Point><coordinates>{lon},48.1</coordinates></Point>"
        "</Placemark>" for name, lon in points) + "</Folder>" for layer, points in layers.items())
    reply = import_file(f"<kml><Document>{folders}</Document></kml>".encode(), ImportSettings())
    assert reply.request is not None
    assert [depot["location"] for depot in reply.request["depots"]] == [[11.5, 48.1]]
    assert [customer["id"] for customer in reply.request["customers"]] == ["A", "B"]
    assert "DEPOT_IN_FILE" in [doubt.code for doubt in reply.doubts]
