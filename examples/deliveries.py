"""A spreadsheet of sixty deliveries in Munich, and what serves them."""

import random

FLEET = {"depot": "48.1402, 11.5600", "vehicles": "3", "capacity": "450", "shift": "7:00-17:00"}
NUM_CUSTOMERS = 60
HEADINGS = ("Kd.-Nr.;Kunde;Straße;PLZ;Ort;Breite;Länge;Gewicht (kg);von;bis;Entladezeit (Min);"
            "Telefon;Hinweis")
SHOPS = ("Bäckerei", "Café", "Apotheke", "Blumen", "Metzgerei", "Optik")
NAMES = ("Huber", "Müller", "Wagner", "Brandl", "Schäffler", "Özdemir", "Lang", "Weiß", "Pichler",
         "Groß")
STREETS = ("Lindenstr.", "Bahnhofstr.", "Am Bach", "Ringstr.", "Kirchweg", "Schulstr.")


def sheet() -> bytes:
    """Return the spreadsheet, as a program of a German office exports it."""
    rng = random.Random(7)
    lines = ["Tour München", "", HEADINGS]
    for number in range(NUM_CUSTOMERS):
        opens = rng.choice((7.0, 8.0, 8.3, 9.0, 10.0))
        cells = (
            str(4711 + number), f"{SHOPS[number % 6]} {NAMES[number // 6]}",
            f"{rng.choice(STREETS)} {rng.randrange(1, 90)}", str(80331 + rng.randrange(90)),
            "München", f"{rng.gauss(48.14, 0.03):.4f}", f"{rng.gauss(11.57, 0.05):.4f}",
            f"{rng.randrange(20, 300) / 10:.1f}", f"{opens:.2f}",
            f"{opens + rng.choice((3, 4, 6)):.2f}", str(rng.choice((3, 5, 8))),
            f"089 {rng.randrange(10_000, 99_999)}", "2x klingeln" if number % 9 == 0 else "")
        lines.append(";".join(cell.replace(".", ",") if 5 <= at <= 7 else cell
                              for at, cell in enumerate(cells)))
    return "\n".join(lines).encode("cp1252")
