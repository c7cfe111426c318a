"""A file as far as it has been understood."""

from dataclasses import dataclass, field
from typing import Any

from app.formats.sheets.cells import CellError, Doubt
from app.formats.sheets.clocks import Style
from app.formats.sheets.columns import Column
from app.formats.sheets.customers import Entry
from app.formats.sheets.layout import Table
from app.formats.sheets.questions import Questionnaire
from app.formats.sheets.schemas import LookUpReply
from app.formats.sheets.vans import Van
from app.requests.warnings.warning import RequestWarning


@dataclass
class Import:
    """A file as far as it has been understood."""

    table: Table
    style: Style
    columns: list[Column]
    asking: Questionnaire
    vans: list[Van] = field(default_factory=list)  # those that a sheet of the file lists
    fairness: dict[str, Any] = field(default_factory=dict)  # what a sheet says of the whole plan
    doubts: list[Doubt] = field(default_factory=list)
    errors: list[CellError] = field(default_factory=list)
    stops: list[Entry] = field(default_factory=list)
    shipments: list[Entry] = field(default_factory=list)
    request: dict[str, Any] | None = None
    warnings: tuple[RequestWarning, ...] = ()
    looked_up: LookUpReply | None = None
