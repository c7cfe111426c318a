"""A file as far as it has been understood."""

from dataclasses import dataclass, field
from typing import Any

from app.sheets.cells import CellError, Doubt
from app.sheets.clocks import Style
from app.sheets.columns import Column
from app.sheets.customers import Entry
from app.sheets.layout import Table
from app.sheets.questions import Asking
from app.sheets.schemas import LookUpReply
from app.sheets.vans import Van
from app.warnings.warning import RequestWarning


@dataclass
class Import:
    """A file as far as it has been understood."""

    table: Table
    style: Style
    columns: list[Column]
    asking: Asking
    vans: list[Van] = field(default_factory=list)  # those that a sheet of the file lists
    doubts: list[Doubt] = field(default_factory=list)
    errors: list[CellError] = field(default_factory=list)
    stops: list[Entry] = field(default_factory=list)
    request: dict[str, Any] | None = None
    warnings: tuple[RequestWarning, ...] = ()
    looked_up: LookUpReply | None = None
