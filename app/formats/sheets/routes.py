"""The endpoint of imports."""

from io import BytesIO
from typing import Annotated, Any

from fastapi import APIRouter, Query, Request, Response
from pydantic import ValidationError
from python_multipart import create_form_parser
from python_multipart.exceptions import FormParserError

from app.formats.sheets.schemas import ImportReply, ImportSettings
from app.plans.routes import Plans
from app.requests.refusal import require_readable
from app.schemas.errors import InvalidRequestError, RequestError, schema_error
from app.schemas.hints import with_hints
from app.schemas.openapi import ERROR_RESPONSES
from app.serving.access.guard import Plan
from app.serving.load.bodies import Body
from app.serving.load.readings import Reading

router = APIRouter()

EXAMPLE = """Kunde;Stra\u00dfe;Ort;Breite;L\u00e4nge;Gewicht (kg);von;bis;Entladezeit (min);Telefon
B\u00e4ckerei M\u00fcller;K\u00f6nigstr. 1;M\u00fcnchen;48,1371;11,5754;12,5;8.30;12.00;10;089 1234
Caf\u00e9 Gr\u00f6\u00df;Ringstr. 3;M\u00fcnchen;48,1471;11,5654;3;9.00;11.30;5;
"""
SETTINGS_EXAMPLE = '{"depot": "48.14, 11.56", "vehicles": 2, "capacity": [100]}'

BODY: dict[str, Any] = {"requestBody": {"required": True, "content": {
    "application/octet-stream": {"schema": {"type": "string", "format": "binary"},
                                 "example": EXAMPLE},
    "multipart/form-data": {"example": {"file": EXAMPLE, "settings": SETTINGS_EXAMPLE}, "schema": {
        "type": "object",
        "required": ["file"],
        "properties": {
            "file": {"type": "string", "format": "binary",
                     "description": "CSV or text with other delimiters, xlsx, xls or ods."},
            "settings": {"type": "string", "description": "`ImportSettings` as JSON."},
        },
    }},
}}}
"""What the endpoint takes; it reads its body itself, to bound it."""

MAX_SETTINGS = 2**20

MOST_PARTS = 8
"""Parts of a form; two are read."""

LOOKING_UP = 5.0
"""Seconds in which addresses are looked up before a reply says how many are known so far."""

MULTIPART = b"multipart/form-data"


class UnreadableFormError(RequestError, name="unreadable-form"):
    """A form that breaks off, or lacks its file."""

    title = "The form can't be read"


Settings = Annotated[str | None, Query(
    max_length=MAX_SETTINGS, description="`ImportSettings` as JSON, where the body is the file "
    f"alone, such as `{SETTINGS_EXAMPLE}`.")]


@router.post("/import", operation_id="import_sheet", summary="Read a spreadsheet of customers",
             tags=["planning"], response_model=ImportReply, responses=ERROR_RESPONSES,
             openapi_extra=BODY)
async def import_sheet(request: Request, principal: Plan, reading: Reading, body: Body,
                       plans: Plans, settings: Settings = None) -> Response:
    """Return what the columns mean, how cells are read, and the request that they make."""
    content_type = request.headers.get("content-type", "")

    def answer() -> bytes:
        # Not before somebody imports: what reads spreadsheets takes 9 MB.
        from app.formats.sheets.addresses import Finder
        from app.formats.sheets.importing import import_file

        file, stated = _parts(body.content, content_type)
        finder = Finder(request.app.state.addresses, LOOKING_UP)
        reply = import_file(file, read_settings(stated if stated is not None else settings), finder,
                            plans.roads.profiles)
        return reply.model_dump_json().encode()

    reply = await reading.run(answer)
    return Response(reply, media_type="application/json")


def read_settings(text: str | bytes | None) -> ImportSettings:
    """Return settings from JSON.

    Raises
    ------
    NotJsonError, InvalidRequestError
        If they are none.
    """
    if not text:
        return ImportSettings()
    require_readable(text if isinstance(text, bytes) else text.encode(), ImportSettings)
    try:
        return ImportSettings.model_validate_json(text)
    except ValidationError as error:
        raise InvalidRequestError(with_hints(
            [schema_error(details) for details in error.errors()], ImportSettings)) from error


def _parts(content: bytes, content_type: str) -> tuple[bytes, bytes | None]:
    """Return the file and the settings of a body; None: it states none."""
    kind = content_type.encode("latin-1")
    if not kind.lower().startswith(MULTIPART):
        return content, None
    parts: dict[bytes | None, bytes] = {}
    seen: list[bytes | None] = []

    def keep_file(file: Any) -> None:
        seen.append(file.field_name)
        _require_few(seen)
        file.file_object.seek(0)
        parts[file.field_name] = file.file_object.read()
        file.close()

    def keep_field(field: Any) -> None:
        seen.append(field.field_name)
        _require_few(seen)
        parts[field.field_name] = field.value or b""

    try:
        parser = create_form_parser({"Content-Type": kind}, keep_field, keep_file,
                                    config={"MAX_MEMORY_FILE_SIZE": len(content) + 1,
                                            "MAX_FIELD_SIZE": MAX_SETTINGS})
        stream = BytesIO(content)
        while chunk := stream.read(2**20):
            parser.write(chunk)
        parser.finalize()
    except (FormParserError, ValueError) as error:
        raise UnreadableFormError(f"The form can't be read ({error}): send it as its boundary "
                                  "says, to its end.") from error
    if b"file" not in parts:
        raise UnreadableFormError("The form has no part named file: name the spreadsheet's so.")
    return parts[b"file"], parts.get(b"settings")


def _require_few(names: list[bytes | None]) -> None:
    if len(names) > MOST_PARTS:
        raise FormParserError(f"it has more than {MOST_PARTS} parts")
