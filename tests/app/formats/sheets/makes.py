"""Spreadsheets of twelve makes, as programs and people write them."""

from collections.abc import Callable
from datetime import datetime, time
from io import BytesIO
from typing import Any
from zipfile import ZipFile

import xlsxwriter

GERMAN = """\
Tour München, Stand 22.11.2026

Kd.-Nr.;Kunde;Straße;PLZ;Ort;Breite;Länge;Gewicht (kg);von;bis;Entladezeit (Min);Telefon;Hinweis
4711;Bäckerei Müller;Königstr. 1;80331;München;48,1371;11,5754;1.012,5;8.30;12.00;10;089 1234;\
Hof
4712;Café Größ;Ring 3;80333;München;48,1471;11,5654;3,0;9.00;17.30;5;;
4713;Apotheke Süd;Am Bach 5;81369;München;48,1102;11,5454;7,25;8.00;11.15;15;089 77;2x klingeln
"""

FRENCH = """\
Destinataire,Adresse de livraison,Code postal,Ville,Latitude,Longitude,Poids (kg),Créneau,Durée,\
Téléphone,Consignes
Boulangerie Éléonore,12 rue de la Forêt,69001,Lyon,45.7676,4.8344,"12,5",8h30-12h00,10 min,\
04 72 00 11 22,digicode 12A
Café Français,3 place Bellecour,69002,Lyon,45.7578,4.8320,"3",à partir de 9h,5 min,,
Hôtel-Dieu,1 cours d'Herbouville,69004,Lyon,45.7765,4.8210,"40",8h-10h et 14h-16h,1h05,\
06 12 34 56 78,quai nord
"""

AMERICAN = """\
Stop #,Customer,Street Address,City,Zip,Lat,Lng,Weight (lbs),Open Time,Close Time,Duration,\
Delivery Date,Phone
1,Joe's Diner,12 Main St,Springfield,62701,39.8017,-89.6436,"1,250",8:00 AM,12:30 PM,15 min,\
11/23/2026,(217) 555-0101
2,"Corner Store, Inc.",99 Oak Ave,Springfield,62702,39.8217,-89.6536,85,9 am,5 pm,10 min,\
11/23/2026,(217) 555-0102
3,Bakery,7 Elm St,Springfield,62703,39.7617,-89.6336,40.5,12:00 AM,12:00 PM,1:05,11/23/2026,
"""

TABS = """\
id\tx\ty\tdemand\tready_time\tdue_time\tservice_time (s)
A\t35\t20\t7\t0\t36000\t90
B\t15\t30\t26\t28800\t43200\t90
C\t25\t30\t3\t30600\t39600\t120
"""

ITALIAN = """\
Cliente;Indirizzo;CAP;Città;Latitudine;Longitudine;Colli;Dalle;Alle;Sosta (min);Note
Panificio Però;Via Roma 1;20121;Milano;45,4685;9,1824;4;8;12;10;
Caffè Città;Corso Como 3;20154;Milano;45,4825;9,1876;2;8,5;17,75;5;suonare
Farmacia;Via Torino 5;20123;Milano;45,4614;9,1843;11;9,25;11;15;
"""

SWAPPED = """\
Naam;Breedtegraad;Lengtegraad;Gewicht kg;Vanaf;Tot
Bakker;4,8952;52,3702;12;8:00;10:00
Slager;4,9123;52,3602;3;9:00;12:00
Kaasboer;4,8801;52,3802;7;8:00;18:00
"""

MINUTES = """\
name,lat,lon,qty,earliest,latest,service_min
A,48.20,16.37,3,480,720,10
B,48.21,16.36,5,495,1020,5
C,48.19,16.35,1,540,660,10
"""

WINDOWS = """\
Odbiorca;Adres;Szerokość;Długość;Waga [kg];Okno czasowe;Uwagi
Żabka;Łąkowa 3, Łódź;51,7592;19,4560;12,5;8-10;dzwonić
Świat Książki;Piotrkowska 1, Łódź;51,7612;19,4580;3;8:30\u201312:00, 14\u201316;
Apteka;Źródlana 5, Łódź;51,7652;19,4510;7;od 9;
Bar;Długa 7, Łódź;51,7552;19,4410;2;do 11:30;
"""

SEVERAL_ROWS = """\
Order No;Client;Address;GPS;Boxes;Kilos;From;To;Contact
1001;Garage Novak;Hlavni 1, Praha;50.0755, 14.4378;2;10.5;8:00;12:00;Jan
1002;Garage Novak;Hlavni 1, Praha;50.0755, 14.4378;1;4;8:00;12:00;Eva
1003;Lekarna;Nova 2, Praha;50.0855, 14.4278;4;2;9:00;17:00;
1004;Garage Novak;Stara 9, Brno;49.1951, 16.6068;3;1;8:00;12:00;
1005;Lekarna;Nova 2, Praha;50.0855, 14.4278;1;1;13:00;17:00;
"""

GERMAN_SETTINGS = {"depot": "48.14, 11.56", "vehicles": 3, "capacity": [1500], "shift": "7-17"}


def workbook(fill: Callable[[xlsxwriter.Workbook], None]) -> bytes:
    """Return a workbook."""
    content = BytesIO()
    with xlsxwriter.Workbook(content, {"in_memory": True}) as book:
        fill(book)
    return content.getvalue()


def merged_headings() -> bytes:
    """Return a workbook with a title, headings in two rows, clocks as Excel holds them, a sum."""
    def fill(book: xlsxwriter.Workbook) -> None:
        book.add_worksheet("Deckblatt").write(0, 0, "Tourenplanung")
        sheet = book.add_worksheet("Touren KW 48")
        clock = book.add_format({"num_format": "hh:mm"})
        sheet.merge_range("A1:H1", "Auslieferung Nürnberg")
        sheet.merge_range("A3:A4", "Filiale")
        sheet.merge_range("B3:C3", "Koordinaten")
        sheet.merge_range("D3:E3", "Lieferfenster")
        sheet.merge_range("F3:G3", "Menge")
        sheet.write("H3", "Standzeit")
        for column, text in enumerate(("Breite", "Länge", "von", "bis", "Gewicht", "Paletten",
                                       "Min."), 1):
            sheet.write(3, column, text)
        rows: list[tuple[Any, ...]] = [
            ("Nordring", 49.4791, 11.0731, time(6, 30), time(9, 0), 320.5, 1, 20),
            ("Südpark", 49.4261, 11.0871, time(7, 0), time(12, 15), 80, 2, 15),
            ("Altstadt", 49.4539, 11.0775, time(5, 0), time(8, 45), 12, 0, 10)]
        for row, cells in enumerate(rows, 4):
            for column, cell in enumerate(cells):
                if isinstance(cell, time):
                    sheet.write_datetime(row, column, cell, clock)
                else:
                    sheet.write(row, column, cell)
        sheet.write(8, 0, "Summe")
        sheet.write(8, 5, 412.5)
        sheet.write(8, 6, 3)
    return workbook(fill)


def fractions() -> bytes:
    """Return a workbook whose clocks have lost their format: shares of a day."""
    def fill(book: xlsxwriter.Workbook) -> None:
        sheet = book.add_worksheet()
        for row, cells in enumerate([
                ("Cliente", "Latitud", "Longitud", "Bultos", "Desde", "Hasta",
                 "Tiempo de descarga"),
                ("Panadería", 40.4168, -3.7038, 3, 8 / 24, 12 / 24, 10 / 1440),
                ("Farmacia", 40.4268, -3.6938, 1, 8.5 / 24, 0.75, 5 / 1440),
                ("Librería", 40.4068, -3.7138, 2, 0.375, 1, 15 / 1440)]):
            sheet.write_row(row, 0, cells)
    return workbook(fill)


def dates() -> bytes:
    """Return a workbook with dates and times in one cell, as exports of databases have them."""
    def fill(book: xlsxwriter.Workbook) -> None:
        sheet = book.add_worksheet("Export")
        stamp = book.add_format({"num_format": "dd.mm.yyyy hh:mm"})
        day = book.add_format({"num_format": "dd.mm.yyyy"})
        sheet.write_row(0, 0, ("AuftragsNr", "Empfänger", "Liefertag", "Frühestens", "Spätestens",
                               "Bereit ab", "Lat", "Lon", "Gewicht_kg"))
        for row, (order, name, first, last, ready, lat, lon, mass) in enumerate([
                (9001, "Müller", (8, 0), (10, 0), (6, 30), 48.2082, 16.3738, 12),
                (9002, "Gruber", (9, 15), (17, 0), (7, 0), 48.2182, 16.3638, 3.5)], 1):
            sheet.write_row(row, 0, (order, name))
            sheet.write_datetime(row, 2, datetime(2026, 11, 23), day)
            for column, clock in enumerate((first, last, ready), 3):
                sheet.write_datetime(row, column, datetime(2026, 11, 23, *clock), stamp)
            sheet.write_row(row, 6, (lat, lon, mass))
    return workbook(fill)


def open_document(more: str = "") -> bytes:
    """Return a sheet of LibreOffice: headings over two columns, clocks, a repeated empty column."""
    def cell(value: Any, span: int = 1) -> str:
        spanned = f' table:number-columns-spanned="{span}"' if span > 1 else ""
        rest = "<table:covered-table-cell/>" * (span - 1)
        if value is None:
            return "<table:table-cell/>"
        if isinstance(value, time):
            kind = f'time" office:time-value="PT{value:%HH%MM%SS}'
        elif isinstance(value, str):
            kind = "string"
        else:
            kind = f'float" office:value="{value}'
        return (f'<table:table-cell office:value-type="{kind}"{spanned}><text:p>{value}</text:p>'
                f"</table:table-cell>{rest}")

    rows = [cell("Kunde") + cell("Koordinaten", 2) + cell("Menge kg") + cell("Lieferfenster", 2),
            "".join(map(cell, (None, "Breite", "Länge", None, "von", "bis"))),
            "".join(map(cell, ("Bäckerei", 48.1371, 11.5754, 12.5, time(6, 30), time(9)))),
            "".join(map(cell, ("Café", 48.1471, 11.5654, 3, time(8), time(17, 15))))]
    names = "".join(f' xmlns:{name}="urn:oasis:names:tc:opendocument:xmlns:{name}:1.0"'
                    for name in ("office", "table", "text"))
    table = "".join(f"<table:table-row>{row}</table:table-row>" for row in rows)
    content = BytesIO()
    with ZipFile(content, "w") as archive:
        kind = "application/vnd.oasis.opendocument.spreadsheet"
        archive.writestr("mimetype", kind)
        archive.writestr("META-INF/manifest.xml", (
            '<?xml version="1.0"?><manifest:manifest xmlns:manifest="urn:oasis:names:tc:'
            'opendocument:xmlns:manifest:1.0"><manifest:file-entry manifest:full-path="/" '
            f'manifest:media-type="{kind}"/></manifest:manifest>'))
        archive.writestr("content.xml", (
            f'<?xml version="1.0"?><office:document-content{names}><office:body>'
            f'<office:spreadsheet><table:table table:name="Touren">{table}{more}</table:table>'
            "</office:spreadsheet></office:body></office:document-content>"))
    return content.getvalue()


def large(rows: int = 20_000) -> bytes:
    """Return a CSV file with many rows, four for each stop."""
    lines = ["order,name,lat,lon,kg,from,to,notes"]
    lines += [f"{number},Shop {number // 4},{48 + number // 4 % 700 / 1e3:.4f},"
              f"{11 + number // 2800 / 1e3:.4f},{number % 9 + 1},08:00,{10 + number // 4 % 8}:00,"
              for number in range(rows)]
    return "\n".join(lines).encode()
