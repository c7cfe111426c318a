"""Texts of what an import takes for granted, in the languages of the console."""

import re
from pathlib import Path

from app.formats import sheets
from app.formats.sheets.importing import import_file
from app.formats.sheets.schemas import DoubtReply, ImportSettings, SheetErrorReply

SOURCES = Path(sheets.__file__).parent
TEXTS = SOURCES.parents[1] / "console" / "static" / "texts" / "granted"
TEXT = re.compile(r"^  ([A-Z_]+[A-Z])((?:_[a-z]+)*):\s+'(.*)',$", re.MULTILINE)
PLACEHOLDER = re.compile(r"{{(\w+)}}")


def texts(language: str) -> list[tuple[str, str, str]]:
    """Return the code, its case and number, and the text of what may be told."""
    return TEXT.findall((TEXTS / f"{language}.js").read_text("utf-8"))


def told(content: bytes) -> list[DoubtReply | SheetErrorReply]:
    """Return what an import tells."""
    reply = import_file(content, ImportSettings())
    return [*reply.doubts, *reply.errors,
            *(doubt for column in reply.columns for doubt in column.doubts)]


def can_be_told(entry: DoubtReply | SheetErrorReply) -> bool:
    """Tell whether there are texts for it, all made of the values that it has."""
    known = {name for name, value in entry if value is not None} | set(entry.values)
    case = f"_{entry.values['case']}" if "case" in entry.values else ""
    found = [(end, set(PLACEHOLDER.findall(text))) for code, end, text in texts("de")
             if code == entry.code]
    chosen = [names for end, names in found if case and end.startswith(case)] or [
        names for end, names in found if end in ("", "_one", "_other")]
    return bool(chosen) and all(names <= known for names in chosen)
