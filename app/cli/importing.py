"""`tandem import`: a spreadsheet of customers becomes a request."""

from collections.abc import Collection, Sequence
from collections.abc import Mapping as Stated
from contextlib import closing
from pathlib import Path
from typing import Annotated, Any

import typer
from pydantic import ValidationError
from pydantic_core import from_json, to_json

from app.cli.file_errors import EXIT_BAD_INPUT, refuse
from app.formats.sheets.addresses import Finder
from app.formats.sheets.importing import import_file
from app.formats.sheets.meanings import MEANINGS
from app.formats.sheets.schemas import ColumnReply, ImportReply, ImportSettings, Mapping
from app.maps.addresses.addresses import Addresses
from app.maps.addresses.opening import opened_addresses
from app.maps.addresses.setting import GeocoderSettingError
from app.maps.roads.setting import SettingError, read_setting
from app.schemas.errors import RequestError
from app.serving.settings import Settings

EXAMPLES = 3

LOOKING_UP = 24 * 3600.0
"""Seconds in which addresses are looked up: who runs a command can end it."""

TOLD_EACH = 100


def import_sheet(
    sheet_file: Annotated[Path, typer.Argument(
        metavar="INPUT", help="CSV or other text with delimiters, xlsx, xls or ods.", exists=True,
        dir_okay=False)],
    output: Annotated[Path | None, typer.Option(
        "--output", "-o", help="File to write the request to.")] = None,
    mapping: Annotated[Path | None, typer.Option(
        help="How columns are read, as --save-mapping wrote it.", exists=True,
        dir_okay=False)] = None,
    save_mapping: Annotated[Path | None, typer.Option(
        help="File to write how columns were read to, for the next file like it.")] = None,
    depot: Annotated[str | None, typer.Option(
        help="Where trips begin and end, latitude first: \"48.137,11.575\", or an "
             "address.")] = None,
    vehicles: Annotated[int | None, typer.Option(help="Number of vehicles.")] = None,
    capacity: Annotated[str | None, typer.Option(
        help="What a vehicle holds, with blanks between for several amounts: \"800 4.5\".")] = None,
    shift: Annotated[str | None, typer.Option(help="When vehicles work: 8:00-17:00.")] = None,
    max_trips: Annotated[int | None, typer.Option(help="How often a vehicle may go out.")] = None,
    currency: Annotated[str | None, typer.Option(help="What costs are in: EUR.")] = None,
    per_hour: Annotated[float | None, typer.Option(
        help="What an hour of a vehicle with its driver costs.")] = None,
    per_km: Annotated[float | None, typer.Option(help="What a kilometre costs.")] = None,
    speed: Annotated[float | None, typer.Option(help="Speed in km/h.")] = None,
    drones: Annotated[int, typer.Option(help="Drones on each vehicle.")] = 0,
    drone_capacity: Annotated[str | None, typer.Option(help="What a drone carries.")] = None,
    fairness: Annotated[str | None, typer.Option(
        help="What the plan costs as a whole, as JSON: "
             "'{\"min_vehicles\": 3, \"makespan_cost_per_hour\": 20}'.")] = None,
    service_minutes: Annotated[float | None, typer.Option(
        help="Minutes at each stop whose row states none.")] = None,
    day: Annotated[str | None, typer.Option(help="Day that is planned: 2026-11-23.")] = None,
    time_zone: Annotated[str | None, typer.Option(
        help="Time zone: Europe/Berlin. Times are then those of the day's clocks.")] = None,
    sheet: Annotated[str | None, typer.Option(help="Name of the workbook's sheet.")] = None,
    answer: Annotated[list[str] | None, typer.Option(
        help="Answer to a question that was told, such as \"sheet:Tuesday=also\"; "
             "repeat it for several.")] = None,
    leave_out_errors: Annotated[bool, typer.Option(
        help="Leave out rows with errors.")] = False,
) -> None:
    """Turn a spreadsheet of customers into a request of POST /plan, and tell what was guessed."""
    stated = {
        "depot": depot, "vehicles": vehicles, "capacity": _numbers(capacity), "shift": shift,
        "max_trips": max_trips, "currency": currency, "per_hour": per_hour,
        "per_km": per_km, "speed_kmh": speed, "drones": drones,
        "drone_capacity": _numbers(drone_capacity), "fairness": _read_json(fairness),
        "service_minutes": service_minutes, "day": day, "time_zone": time_zone,
        "leave_out_errors": leave_out_errors,
    }
    settings = _settings(stated, _with_answers(_mapping(mapping, sheet), answer or ()))
    try:
        with closing(_geocoders()) as addresses:
            finder = Finder(addresses, LOOKING_UP, _show_progress)
            reply = import_file(sheet_file.read_bytes(), settings, finder, _road_profiles())
    except RequestError as error:
        refuse(sheet_file, error)
    except SettingError as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(EXIT_BAD_INPUT) from error
    _tell(reply)
    if save_mapping is not None:
        save_mapping.write_text(reply.mapping.model_dump_json(indent=2) + "\n", "utf-8")
    if reply.request is None:
        raise typer.Exit(EXIT_BAD_INPUT)
    content = to_json(reply.request)
    if output is None:
        typer.echo(content)
    else:
        output.write_bytes(content)


def _road_profiles() -> Collection[str]:
    stated = Settings().roads
    return read_setting(stated.get_secret_value()) if stated else ()


def _geocoders() -> Addresses:
    try:
        return opened_addresses(Settings())
    except GeocoderSettingError as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(EXIT_BAD_INPUT) from error


def _show_progress(known: int, asked: int) -> None:
    """Tell from time to time how many addresses are looked up."""
    if known % TOLD_EACH == 0 or known == asked:
        typer.echo(f"{known} of {asked} addresses are looked up", err=True)


def _settings(stated: Stated[str, Any], mapping: Mapping) -> ImportSettings:
    try:
        return ImportSettings.model_validate({**stated, "mapping": mapping})
    except ValidationError as error:
        for details in error.errors():
            option = "--" + str(details["loc"][0]).replace("_", "-")
            typer.echo(f"{option}: {details['msg']}", err=True)
        raise typer.Exit(EXIT_BAD_INPUT) from error


def _mapping(file: Path | None, sheet: str | None) -> Mapping:
    try:
        mapping = Mapping() if file is None else Mapping.model_validate_json(file.read_bytes())
    except ValidationError as error:
        typer.echo(f"{file}: {error}", err=True)
        raise typer.Exit(EXIT_BAD_INPUT) from error
    return mapping if sheet is None else mapping.model_copy(update={"sheet": sheet})


def _with_answers(mapping: Mapping, answers: Sequence[str]) -> Mapping:
    given = {}
    for text in answers:
        name, sign, answer = text.rpartition("=")
        if not sign:
            raise typer.BadParameter(f"{text!r} has no = between a question and its answer")
        given[name] = answer
    return mapping.model_copy(update={"answers": mapping.answers | given})


def _read_json(text: str | None) -> Any:
    try:
        return None if text is None else from_json(text)
    except ValueError as error:
        raise typer.BadParameter(f"{text!r} is no JSON") from error


def _numbers(text: str | None) -> list[float] | None:
    if text is None:
        return None
    try:
        return [float(part) for part in text.split()]
    except ValueError as error:
        raise typer.BadParameter(f"{text!r} are no numbers with blanks between") from error


def _tell(reply: ImportReply) -> None:
    """Print what was guessed, and what is doubtful or wrong."""
    for column in reply.columns:
        typer.echo(_line(column), err=True)
    for doubt in [*(doubt for column in reply.columns for doubt in column.doubts), *reply.doubts]:
        typer.echo(f"? {doubt.message}", err=True)
    for question in reply.questions:
        choices = ", ".join(choice.answer for choice in question.choices)
        taken = question.answer or "an answer is needed"
        typer.echo(f"?? {question.text} {question.id}={taken} ({choices})", err=True)
    for warning in reply.warnings:
        typer.echo(f"warning {warning.code} {warning.path}: {warning.message}", err=True)
    for error in reply.errors:
        typer.echo(f"! {error.cell + ': ' if error.cell else ''}{error.message}", err=True)
    if reply.num_errors > len(reply.errors):
        typer.echo(f"! and {reply.num_errors - len(reply.errors)} more", err=True)
    told = "" if reply.request else ", no request"
    sent = f"{reply.shipments} shipments, " if reply.shipments else ""
    typer.echo(f"{reply.rows} rows, {reply.customers} customers, {sent}{reply.num_errors} "
               f"errors{told}", err=True)


def _line(column: ColumnReply) -> str:
    heading = f" {column.heading!r}" if column.heading else ""
    if column.meaning == "ignored":
        return f"{column.column}{heading}: not used"
    unit = f" in {column.unit}" if column.unit else ""
    examples = ", ".join(f"{example.raw} \u2192 {example.read or 'no reading'}"
                         for example in column.examples[:EXAMPLES])
    return f"{column.column}{heading}: {MEANINGS[column.meaning].title}{unit}: {examples}"
