"""Make the spreadsheet that shows what columns an import understands.

    python examples/sheet.py
"""

from datetime import UTC, datetime
from pathlib import Path

import xlsxwriter

FILE = Path(__file__).parents[1] / "app" / "console" / "static" / "examples" / "working-day.xlsx"

MADE = datetime(2026, 11, 28, tzinfo=UTC)

ORDERS = (
    "Order", "Name", "Latitude", "Longitude", "Kilograms", "From", "Until", "Minutes at stop",
    "Goes with", "Not with", "Same trip as", "Served before", "Least lag (min)",
    "Longest lag (min)", "Preferred driver", "Cost of other driver", "Costs by vehicle",
    "Pickup name", "Pickup latitude", "Pickup longitude", "Pickup until", "Max ride time (min)",
    "Max detour", "Alternative name", "Alternative latitude", "Alternative longitude",
    "Alternative cost", "Cost of leaving out")

PLACES: tuple[tuple[str, float, float, float], ...] = (
    ("Bakery", 60.1710, 24.9410, 12), ("Florist", 60.1688, 24.9432, 5),
    ("Pharmacy", 60.1725, 24.9478, 3), ("Caf\u00e9", 60.1667, 24.9391, 8),
    ("Joiner", 60.1742, 24.9402, 40), ("Painter", 60.1745, 24.9405, 25),
    ("Library", 60.1738, 24.9365, 15), ("Archive", 60.1701, 24.9502, 9),
    ("Hotel", 60.1681, 24.9521, 30), ("Gallery", 60.1655, 24.9475, 6))

RULES: dict[str, dict[str, object]] = {
    "Bakery": {"From": "7:00", "Until": "9:00", "Goes with": "Florist"},
    "Pharmacy": {"Not with": "Joiner", "Cost of leaving out": 80},
    "Caf\u00e9": {"Same trip as": "Bakery", "From": "7:00", "Until": "11:00"},
    "Joiner": {"Served before": "Painter", "Least lag (min)": 30, "Longest lag (min)": 120},
    "Library": {"Preferred driver": "Aino", "Cost of other driver": 6},
    "Archive": {"Costs by vehicle": "van: 4; bike: 0"},
    "Hotel": {"Pickup name": "Laundry", "Pickup latitude": 60.1716, "Pickup longitude": 24.9351,
              "Pickup until": "12:00", "Max ride time (min)": 60, "Max detour": 4,
              "Until": "14:00"},
    "Gallery": {"Alternative name": "Locker", "Alternative latitude": 60.1662,
                "Alternative longitude": 24.9446, "Alternative cost": 1.5},
}

VEHICLES = (
    ("Vehicle", "Driver", "Count", "Capacity (kg)", "Shift", "Break 1", "Break 1 (min)", "Break 2",
     "Break 2 (min)", "Break paid", "Break on the way", "Most aboard at break", "Max work (h)",
     "Driving rules", "Max driving before break (h)", "Rest (min)", "Driven before (h)", "LIFO",
     "Fixed cost", "Cost per hour", "Cost per km"),
    ("van", "Aino", 1, 120, "6:00-16:00", "11:00-13:00", 30, "14:00-15:00", 15, "no", "no", None, 9,
     "EU 561", None, None, 1, "no", 20, 30, 0.5),
    ("bike", "Onni", 2, 60, "7:00-15:00", "10:30-12:30", 30, None, None, "yes", "yes", 40, 8, "no",
     2, 20, None, "yes", 10, 25, 0.1),
)

PLAN = (("Rule of the whole plan", "Value"), ("Least vehicles", 2), ("Balance", "stops"),
        ("Balance cost", 1), ("Makespan cost per hour", 5))


def _orders() -> list[list[object]]:
    depot = {"Name": "Depot", "Latitude": 60.1702, "Longitude": 24.9438}
    rows: list[list[object]] = [list(ORDERS), [depot.get(heading) for heading in ORDERS]]
    for number, (name, latitude, longitude, kilograms) in enumerate(PLACES, 101):
        stated: dict[str, object] = {
            "Order": number, "Name": name, "Latitude": latitude, "Longitude": longitude,
            "Kilograms": kilograms, "From": "8:00", "Until": "15:00", "Minutes at stop": 5}
        stated |= RULES.get(name, {})
        rows.append([stated.get(heading) for heading in ORDERS])
    return rows


def write(file: Path) -> None:
    """Write the workbook: orders, vehicles and what holds for the whole plan."""
    with xlsxwriter.Workbook(file) as book:
        book.set_properties({"created": MADE})
        bold = book.add_format({"bold": True, "text_wrap": True, "valign": "top"})
        for name, rows in (("Orders", _orders()), ("Vehicles", VEHICLES), ("Plan", PLAN)):
            sheet = book.add_worksheet(name)
            sheet.freeze_panes(1, 2 if name == "Orders" else 1)
            sheet.set_column(0, len(rows[0]) - 1, 24 if name == "Plan" else 11)
            for number, row in enumerate(rows):
                sheet.write_row(number, 0, row, bold if number == 0 else None)


if __name__ == "__main__":
    FILE.parent.mkdir(exist_ok=True)
    write(FILE)
