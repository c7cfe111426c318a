"""What `POST /import` takes and answers."""

from datetime import date
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from app.formats.sheets.meanings import MEANINGS
from app.formats.sheets.questions import AnsweredQuestion, QuestionKind
from app.maps.addresses.geocoder import Quality
from app.schemas.fairness import FairnessInput
from app.schemas.fields import Amount, Demand, Input, Money, Speed
from app.schemas.response import WarningReply
from app.schemas.times import Currency

Text = Annotated[str, Field(max_length=500)]
Heading = Annotated[str, Field(max_length=2000)]


class ColumnMapping(Input):
    """What a column means, found again by its heading."""

    heading: Heading = Field("", description="Heading; case, accents and signs don't matter.")
    column: Annotated[str, Field(pattern="^[A-Z]{1,3}$")] | None = Field(
        None, description="Letters of the column, which count where it has no heading of its own.")
    meaning: Literal[tuple(MEANINGS)] = Field(  # type: ignore[valid-type]
        description="What its cells are for.")
    unit: Annotated[str, Field(max_length=40)] | None = Field(
        None, description="Unit of bare numbers, see `meanings` of the reply; of an amount, any "
        "word. Null: guessed.")


class Mapping(Input):
    """How a file is to be read: what a reply has as `mapping`, for the next file like it."""

    sheet: Text | None = Field(
        None, description="Name of the sheet. Null: the one that looks most like customers.")
    header_row: Annotated[int, Field(ge=0, le=1000)] | None = Field(
        None, description="Last row of headings, counted from 1; 0: there are none. Null: found.")
    columns: Annotated[list[ColumnMapping], Field(max_length=1000)] = Field(
        [], description="Columns whose meaning is stated; others are guessed.")
    decimals: Literal[",", "."] | None = Field(
        None, description="What stands before decimals. Null: found.")
    day_first: bool | None = Field(
        None, description="Whether 03/04/2026 is in April. Null: found.")
    encoding: Annotated[str, Field(max_length=40, pattern="^[A-Za-z0-9_-]+$")] | None = Field(
        None, description="Encoding of a text file, such as `cp1252`. Null: found.")
    same_place: Literal["together", "apart"] = Field(
        "together", description="Rows of one name and place: `together` they are one stop with the "
        "sum of their amounts; `apart` each is a stop.")
    answers: Annotated[dict[Text, Text], Field(max_length=1000)] = Field(
        {}, description="Answers to `questions` of a reply, by their ids. Those to questions that "
        "this file doesn't raise do no harm.")


class ImportSettings(Input):
    """How a file is to be read, and what else a request needs."""

    mapping: Mapping = Field(Mapping(), description="How the file is to be read.")
    day: Annotated[str, Field(pattern=r"^\d{4}-\d{2}-\d{2}$")] | None = Field(
        None, description="Day that is planned, as `2026-11-23`: rows of other days are left out, "
        "and times with a date count from its midnight. Null: the file's, if it has one.")
    time_zone: Annotated[str, Field(max_length=64)] | None = Field(
        None, description="Name of the IANA time zone, such as `Europe/Berlin`. With it, and a "
        "day, the request has `plan_start` and times of that day. Null: seconds since midnight.")
    depot: Text | None = Field(
        None, description="Where trips begin and end: `48.137, 11.575`, latitude first, as maps "
        "show it, or `x, y`, or an address where the service has a geocoder. Null: a row of the "
        "file that is a depot, else the customers' middle.")
    vehicles: Annotated[int, Field(ge=1, le=10_000)] | None = Field(
        None, description="Number of vehicles. Null: assumed.")
    capacity: Demand | None = Field(
        None, description="What a vehicle holds, of each amount. Null: assumed to be all there is.")
    shift: Text | None = Field(
        None, description="When vehicles work, such as `8:00-17:00`, or `21:00-6:00` to the "
        "morning after. Null: at any time.")
    max_trips: Annotated[int, Field(ge=1, le=1000)] | None = Field(
        None, description="How often a vehicle may go out. Null: assumed to be several times, as "
        "long as there is time.")
    currency: Currency | None = Field(
        None, description="What costs are in, such as `EUR`; it is told with the plan, and what "
        "costs are assumed goes by it.")
    per_hour: Money | None = Field(
        None, description="What an hour of a vehicle with its driver costs. Null: assumed.")
    per_km: Money | None = Field(
        None, description="What a kilometre of a vehicle costs. Null: assumed.")
    speed_kmh: Speed | None = Field(None, description="Speed of the vehicles. Null: the default.")
    drones: Annotated[int, Field(ge=0, le=100)] = Field(
        0, description="Drones on each vehicle.")
    drone_capacity: Demand | None = Field(
        None, description="What a drone carries, of each amount. Needed with drones.")
    fairness: FairnessInput | None = Field(
        None, description="What the plan costs as a whole, as `fairness` of a request. Null: as a "
        "sheet of the file says, if one does.")
    service_minutes: Amount | None = Field(
        None, description="Minutes at each stop whose row states none. Null: none.")
    leave_out_errors: bool = Field(
        False, description="Whether rows with errors are left out, and the rest makes a request.")
    not_found: Literal["error", "address"] = Field(
        "error", description="Rows whose address isn't found, or may be several places: `error` "
        "refuses them; with `address` they are doubts, and the request has the address itself as "
        "such a customer's `location`, to be placed by whoever knows better. So it is of all "
        "addresses where the service has no geocoder.")


class _Reply(BaseModel):
    model_config = ConfigDict(extra="forbid")


ToldValues = Annotated[dict[str, str | int | float | list[str]], Field(
    description="What the message is made of, by name, for whoever tells it in other words: "
    "`count` rows, cells or stops; `name` or `names`, `value` as the cell has it, `meaning`, "
    "`unit`, `address`, `place`, `amount`; `case` where one code says several things.")]


class DoubtReply(_Reply):
    """Something that was guessed or assumed."""

    code: str = Field(description="Stable name of the kind of doubt.")
    message: str = Field(description="What was taken for what.")
    column: str | None = Field(None, description="Letters of the column, if it is about one.")
    cell: str | None = Field(None, description="Name of the cell, such as `C17`, if about one.")
    values: ToldValues = {}


class SheetErrorReply(_Reply):
    """A cell that can't be read, or something that a request lacks."""

    code: str = Field(description="Stable name of the kind of error.")
    message: str = Field(description="What is wrong and how to mend it.")
    cell: str | None = Field(None, description="Name of the cell, such as `C17`.")
    values: ToldValues = {}


class ExampleReply(_Reply):
    """A cell, and what was read."""

    cell: str = Field(description="Name of the cell.")
    raw: str = Field(description="What it holds, about as a spreadsheet shows it.")
    read: str | None = Field(description="What was read. Null: it can't be read.")


Certainty = Literal["stated", "sure", "doubtful", "open", "unused"]


class ColumnReply(_Reply):
    """A column and what it is taken for."""

    column: str = Field(description="Letters.")
    heading: str = Field(description="Heading, from all rows of headings.")
    meaning: str = Field(description="What its cells are for.")
    unit: str | None = Field(description="Unit of bare numbers, or of amounts.")
    confidence: float = Field(description="0 to 1; 1 where the mapping states it.")
    certainty: Certainty = Field(
        description="`stated` by the mapping; `sure`; `doubtful`: read on one witness, look at "
        "it; `open`: not read, though its cells may be for the plan; `unused`.")
    pair: str | None = Field(description="Letters of the column that completes it, such as the "
                             "longitude of a latitude, or the end of a begin.")
    likely: list[str] = Field(description="What else it may mean, the likeliest first.")
    cells: list[ExampleReply | None] = Field(
        description="Its cells in `table_rows`, and what was made of them. Null: an empty one.")
    examples: list[ExampleReply] = Field(description="Some cells that look different, likewise.")
    doubts: list[DoubtReply] = Field(description="What may be meant otherwise.")


class MeaningReply(_Reply):
    """What a column may mean."""

    meaning: str = Field(description="As a mapping names it.")
    title: str = Field(description="In words.")
    units: list[str] = Field(description="Units that bare numbers may be in; none: there is no "
                             "choice.")


class ChoiceReply(_Reply):
    """One way to answer a question."""

    answer: str = Field(description="What is sent for it.")
    title: str = Field(description="In words.")


class QuestionReply(_Reply):
    """Something that only who sends the file can know; until then the default is taken."""

    id: str = Field(description="Name for its answer in `mapping.answers`, the same for the next "
                    "file like it.")
    kind: QuestionKind = Field(description="What it is about.")
    text: str = Field(description="The question in words.")
    values: dict[str, str | int] = Field(description="What the words are made of, by kind.")
    column: str | None = Field(description="Letters of the column, if it is about one.")
    cell: str | None = Field(description="Name of the first cell that it is about.")
    sheet: str | None = Field(description="Name of the sheet, if it is about one.")
    examples: list[str] = Field(description="Some cells that it is about.")
    choices: list[ChoiceReply] = Field(
        description="Answers; to `column` any meaning is one.")
    default: str | None = Field(
        description="What is taken without an answer. Null: it must be answered.")
    answer: str | None = Field(description="What this reply was made with.")
    is_answered: bool = Field(description="Whether that was stated.")

    @classmethod
    def of(cls, asked: AnsweredQuestion) -> "QuestionReply":
        """Return what is told of a question."""
        question = asked.question
        return cls(
            id=question.id, kind=question.kind, text=question.text, values=dict(question.values),
            column=question.column, cell=question.cell, sheet=question.sheet,
            examples=list(question.examples), default=question.default, answer=asked.answer,
            is_answered=asked.is_answered,
            choices=[ChoiceReply(answer=answer, title=title)
                     for answer, title in question.choices.items()])


class SheetReply(_Reply):
    """A sheet of the file."""

    name: str = Field(description="Name; empty for text files.")
    rows: int = Field(description="Rows.")
    is_hidden: bool = Field(False, description="Whether the workbook hides it.")


class FoundReply(_Reply):
    """Where an address of the file is."""

    cell: str = Field(description="Name of the cell.")
    address: str = Field(description="As the row states it.")
    location: tuple[float, float] = Field(description="`[longitude, latitude]` that was found.")
    label: str = Field(description="What was found there, in the geocoder's words.")
    quality: Quality = Field(description="`house`, `interpolated`, `street` or `town`.")
    by: str = Field(description="The geocoder.")
    doubt: str | None = Field(description="Why it may be wrong, in words.")


class LookUpReply(_Reply):
    """What became of the rows that have addresses and no coordinates."""

    asked: int = Field(description="Such rows.")
    known: int = Field(description="Those that the geocoder has answered. While there are fewer "
                       "than `asked`, send the file again: answers are kept.")
    places: list[FoundReply] = Field(description="Where they are, as far as they were found.")


class ImportReply(_Reply):
    """What was read, what of it is doubtful or wrong, and the request if it is complete."""

    sheets: list[SheetReply] = Field(description="Sheets of the file.")
    sheet: str = Field(description="The one that was read.")
    encoding: str | None = Field(description="Encoding of a text file. Null: a workbook.")
    delimiter: str | None = Field(description="What stands between cells of a text file.")
    header_rows: list[int] = Field(description="Rows of headings, counted from 1.")
    rows: int = Field(description="Rows below that hold anything.")
    customers: int = Field(description="Customers that they make.")
    shipments: int = Field(description="Shipments that they make.")
    columns: list[ColumnReply] = Field(description="Columns that hold anything.")
    table_rows: list[int] = Field(description="The first rows below the headings, counted from 1.")
    day: str | None = Field(description="Day that is planned, if the file or you state one.")
    doubts: list[DoubtReply] = Field(description="What was guessed or assumed beside the columns.")
    questions: list[QuestionReply] = Field(
        description="What would else be dropped, or taken for granted, without a word: answer in "
        "`mapping.answers`, and send the file again.")
    errors: list[SheetErrorReply] = Field(description="Cells that can't be used, and what lacks.")
    num_errors: int = Field(description="Errors, listed or not.")
    looked_up: LookUpReply | None = Field(
        None, description="Addresses that were looked up. Null: none.")
    mapping: Mapping = Field(description="How it was read: send it with the next file like it.")
    meanings: list[MeaningReply] = Field(description="What columns may mean.")
    request: dict[str, Any] | None = Field(
        description="The request of `POST /plan`; times are seconds since midnight of the day, or "
        "of the wall clock if `time_zone` is stated. Null: there are errors.")
    warnings: list[WarningReply] = Field(
        description="What is allowed in the request and is hardly meant, as `POST /warnings` says.")


def day_of(settings: ImportSettings) -> date | None:
    """Return the day that is planned, if it is stated.

    Raises
    ------
    ValueError
        If there is no such day.
    """
    return None if settings.day is None else date.fromisoformat(settings.day)
