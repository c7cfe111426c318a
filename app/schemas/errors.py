"""Errors as clients see them: `application/problem+json` with a code, a path and a remedy each."""

import re
from collections.abc import Iterable, Mapping, Sequence
from difflib import get_close_matches
from types import MappingProxyType
from typing import Any, ClassVar, Literal, cast, get_args

from starlette.responses import JSONResponse
from pydantic import BaseModel, Field
from pydantic_core import ErrorDetails

MEDIA_TYPE = "application/problem+json"

MAX_LISTED_ERRORS = 1000
"""A reply lists no more errors than this; `detail` states how many there are."""

Refusal = Literal["overload", "rate_limit", "access"]
"""Why a request is turned away without a look at its content, as metrics count it."""

LONGEST_STEP = 80
"""Characters of a key that a path tells."""

_PLAIN_KEY = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
_NUMBER = re.compile(r"-?\d{1,12}(\.\d{1,9})?")
_WORD = re.compile(r"[\w -]{1,40}")
_QUOTED = re.compile(r"'([^']*)'")

ErrorCode = Literal[
    "MISSING_FIELD",
    "UNKNOWN_FIELD",
    "UNKNOWN_VALUE",
    "WRONG_TYPE",
    "WRONG_LENGTH",
    "OUT_OF_RANGE",
    "TOO_MANY_ERRORS",
    "TOO_MANY_PARTS",
    "DUPLICATE_ID",
    "MISSING_DRONE_ID",
    "PICKUP_OR_PICKUPS",
    "NO_DEPOT",
    "EMPTY_FLEET",
    "UNKNOWN_DEPOT",
    "WINDOW_ENDS_BEFORE_START",
    "TWO_KINDS_OF_WINDOWS",
    "WINDOWS_OVERLAP",
    "WINDOW_WITHOUT_END",
    "LATE_COST_OF_HARD_WINDOW",
    "SOFT_WINDOW_BEFORE_ANOTHER",
    "EARLY_COSTS_DIFFER",
    "TWO_LISTS_OF_VEHICLES",
    "TOO_MANY_GROUPS",
    "SHIFT_ENDS_BEFORE_START",
    "DEPOT_CLOSED",
    "HOURS_DIFFER",
    "MISSING_BREAK_DURATION",
    "TOO_FEW_VEHICLES",
    "RELATION_WITH",
    "UNKNOWN_BREAK",
    "DIMENSION_MISMATCH",
    "TOO_FINE",
    "MISSING_LOCATION",
    "MISSING_LOCATION_INDEX",
    "LOCATION_OFF_GLOBE",
    "LOCATION_TOO_FAR",
    "PLACE_OFF_ROADS",
    "ROADS_WITHOUT_THAT",
    "NO_GEOCODER",
    "ADDRESS_ON_PLANE",
    "ADDRESS_NOT_FOUND",
    "ADDRESS_AMBIGUOUS",
    "ADDRESS_INEXACT",
    "ROUNDED_ON_GLOBE",
    "MATRIX_SIZE",
    "MATRIX_NEGATIVE",
    "MATRIX_VALUE",
    "MATRIX_NULL",
    "MISSING_SPEED",
    "TWO_SPEEDS",
    "SPEED_PROFILE_ORDER",
    "POWER_OR_PRESET",
    "CHARGE_WITHOUT_ENERGY",
    "SWAP_OR_CHARGE",
    "WIND_HOURS",
    "WIND_ORDER",
    "NOT_WHERE_IT_FLIES",
    "ONLY_WHERE_IT_FLIES",
    "POLYGON_CROSSES_ITSELF",
    "POLYGON_WITHOUT_AREA",
    "ZONES_ON_PLANE",
    "ZONE_UNREADABLE",
    "TOO_MANY_LEGS",
    "TOO_MUCH_WORK",
    "UNKNOWN_POLICY",
    "UNKNOWN_CUSTOMER",
    "UNKNOWN_SHIPMENT",
    "UNKNOWN_VEHICLE_TYPE",
    "WRONG_NAME",
    "DUPLICATE_VEHICLE",
    "UNKNOWN_VEHICLE",
    "UNKNOWN_DRONE",
    "WRONG_DEPOT",
    "TRIP_SHAPE",
    "SORTIE_STOPS",
    "TIMES_DISORDERED",
    "PLANNED_TWICE",
    "NOT_PLANNED",
    "CONTRADICTION",
    "PINNED_TO_UNAVAILABLE",
    "SETTLED_PART",
    "ILLEGAL_PLAN",
    "TOO_MANY_VEHICLES",
    "WRONG_PARAMETER",
    "UNKNOWN_PATH",
    "PATHS_OVERLAP",
    "TOO_MANY_SCENARIOS",
    "WEBHOOK",
    "IDEMPOTENCY_KEY_REUSED",
    "MISSING_PLAN_START",
    "BEFORE_PLAN_START",
    "UNKNOWN_TIME_ZONE",
    "FLIGHTS_ON_PLANE",
    "NO_FLIGHTS",
    "NO_WAY_AROUND",
    "BEYOND_FORMAT",
    "TOO_MANY_REVISITS",
]

_STATED_CODES = frozenset(get_args(ErrorCode))

_CODES: dict[str, ErrorCode] = {
    "missing": "MISSING_FIELD",
    "extra_forbidden": "UNKNOWN_FIELD",
    "literal_error": "UNKNOWN_VALUE",
    "finite_number": "OUT_OF_RANGE",
    "greater_than_equal": "OUT_OF_RANGE",
    "less_than_equal": "OUT_OF_RANGE",
    "too_short": "WRONG_LENGTH",
    "too_long": "WRONG_LENGTH",
    "string_too_short": "WRONG_LENGTH",
    "string_too_long": "WRONG_LENGTH",
}

IN_WORDS, IN_PLACE, ALONE, LISTED = "(word)", "(place)", "(one)", "(list)"
FORECAST = "(forecast)"
AS_NUMBER, AS_EPOCH, AS_TEXT = "(number)", "(epoch)", "(text)"
"""Tags of values that may be one or the other; no part of a path."""

TAGS = frozenset({IN_WORDS, IN_PLACE, ALONE, LISTED, FORECAST, AS_NUMBER, AS_EPOCH, AS_TEXT,
                  "(ed269)", "(ed318)", "(geojson)", "(kml)", "(Polygon)", "(MultiPolygon)",
                  "(Point)", "(GeometryCollection)"})

_TYPE_NAMES = {
    "float_type": "a JSON number",
    "int_type": "a whole JSON number",
    "int_from_float": "a whole JSON number",
    "bool_type": "true or false",
    "string_type": "a JSON string",
    "list_type": "a JSON array",
    "tuple_type": "a JSON array",
    "dict_type": "a JSON object",
    "model_type": "a JSON object",
}

_JSON_NAMES: dict[type, str] = {
    type(None): "null",
    bool: "true or false",
    str: "a string",
    int: "this number",
    float: "this number",
    list: "an array",
    dict: "an object",
}

_REMEDIES = {
    "missing": "This field is required: add it.",
    "extra_forbidden": "There is no field of this name: remove it or correct its spelling.",
    "literal_error": "The value must be one of {expected}: use one of these.",
    "finite_number": "The number is too large: state a finite one, or null where that is allowed.",
    "greater_than_equal": "The number must be at least {ge}: raise it.",
    "less_than_equal": "The number must be at most {le}: lower it, or check its unit.",
    "too_short": "There are {actual_length} entries and at least {min_length} needed: add some.",
    "too_long": "There are more than {max_length} entries: remove some.",
    "string_too_short": "The text is empty: state at least {min_length} character.",
    "string_too_long": "The text has more than {max_length} characters: shorten it.",
}


class InputError(BaseModel):
    """One thing that is wrong with a request."""

    code: ErrorCode = Field(description="Stable name of the kind of error.")
    path: str = Field(description="Where it is in the request, such as `$.customers[3].id`.")
    message: str = Field(description="What is wrong and how to mend it.")


class ProblemDocument(BaseModel):
    """An error reply after RFC 9457."""

    type: str = Field(description="Kind of error as a URI.")
    title: str = Field(description="Kind of error in words.")
    status: int = Field(description="HTTP status code.")
    detail: str = Field(description="What happened this time.")
    errors: list[InputError] = Field([], description="Every error found in the request.")


class RequestError(ValueError):
    """A request that can't be answered, and the HTTP status that says so."""

    status: ClassVar[int] = 400
    name: ClassVar[str] = "bad-request"
    title = "The request can't be read"
    refusal: ClassVar[Refusal | None] = None
    """None: its content was looked at."""
    always: ClassVar[str] = ""
    """Its detail, where that is always the same."""
    headers: Mapping[str, str] = MappingProxyType({})

    def __init_subclass__(cls, status: int | None = None, name: str | None = None,
                          refusal: Refusal | None = None) -> None:
        super().__init_subclass__()
        cls.status = status or cls.status
        cls.name = name or cls.name
        cls.refusal = refusal or cls.refusal

    def __init__(self, detail: str | None = None, errors: Sequence[InputError] = ()) -> None:
        super().__init__(self.always if detail is None else detail)
        self.errors = tuple(errors)


class NotJsonError(RequestError, name="not-json"):
    """The body is not JSON."""

    title = "The body is not JSON"


class BodyTooLargeError(RequestError, status=413, name="body-too-large"):
    """The body is longer than the service accepts."""

    title = "The body is too large"


class InvalidRequestError(RequestError, status=422, name="invalid-request"):
    """The body is JSON, and not a valid request."""

    title = "The request is not valid"

    def __init__(self, errors: Sequence[InputError]) -> None:
        count = len(errors)
        listed = f"; the first {MAX_LISTED_ERRORS} are listed" if count > MAX_LISTED_ERRORS else ""
        plural = "" if count == 1 else "s"
        super().__init__(f"The request has {count} error{plural}{listed}.",
                         errors[:MAX_LISTED_ERRORS])


class NoRoadsError(RequestError, status=503, name="roads-unavailable"):
    """Where roads come from doesn't answer, or not what can be right."""

    title = "The roads are unavailable"


class NoGeocoderError(RequestError, status=503, name="geocoder-unavailable"):
    """Where addresses are looked up doesn't answer, or not in time."""

    title = "The geocoder is unavailable"


def problem_response(status: int, name: str, title: str, detail: str,
                     errors: Iterable[InputError] = (),
                     headers: Mapping[str, str] | None = None) -> JSONResponse:
    """Return an error reply."""
    document = ProblemDocument(type=f"urn:tandem:error:{name}", title=title, status=status,
                               detail=detail, errors=list(errors))
    return JSONResponse(document.model_dump(), status, headers, media_type=MEDIA_TYPE)


def json_path(location: Iterable[str | int]) -> str:
    """Return a JSON path such as `$.customers[3].time_window.latest`."""
    path = "$"
    for key in location:
        if isinstance(key, int):
            path += f"[{key}]"
        elif len(key) <= LONGEST_STEP and _PLAIN_KEY.fullmatch(key):
            path += f".{key}"
        else:
            path += "[" + repr(key[:LONGEST_STEP]) + "]"
    return path


NO_LEG = "A leg that isn't there is stated as null in both tables."


def schema_errors(found: Sequence[ErrorDetails]) -> list[InputError]:
    """Return all that pydantic found, in our words.

    What may be a number or a text is one error, of that which it was meant to be.
    """
    others = {details["loc"][:-1] for details in found
              if _is_of_text(details) or _is_of_epoch(details)}
    kept = [details for details in found
            if details["loc"][-1:] not in ((AS_TEXT,), (AS_EPOCH,))
            or _is_of_text(details) or _is_of_epoch(details)]
    return [schema_error(details) for details in kept
            if details["loc"][-1:] != (AS_NUMBER,) or details["loc"][:-1] not in others]


def _is_of_epoch(details: ErrorDetails) -> bool:
    """Tell whether an error is of what was read as seconds since 1970."""
    return details["loc"][-1:] == (AS_EPOCH,) and details["type"] in _STATED_CODES


def _is_of_text(details: ErrorDetails) -> bool:
    """Tell whether an error is of what was meant as a text: it is one, and no number in quotes."""
    if details["loc"][-1:] != (AS_TEXT,) or details["type"] == "string_type":
        return False
    given = details.get("input")
    return not (isinstance(given, str) and _NUMBER.fullmatch(given))


def schema_error(details: ErrorDetails) -> InputError:
    """Return what pydantic found, in our words."""
    kind = details["type"]
    location = tuple(key for key in details["loc"] if key not in TAGS)
    context: dict[str, Any] = details.get("ctx", {})
    if kind in _STATED_CODES:
        message = details["msg"]
    elif kind in _TYPE_NAMES:
        message = f"The value must be {_TYPE_NAMES[kind]}: {_instead(details)}."
    elif kind in _REMEDIES:
        message = _REMEDIES[kind].format_map(_rounded(context)) + _closest(details)
    else:
        message = f"{details['msg']}: correct the value."
    code = cast(ErrorCode, kind) if kind in _STATED_CODES else _CODES.get(kind, "WRONG_TYPE")
    if location[:1] == ("matrices",) and len(location) > 3:
        code = "MATRIX_VALUE"
        if kind == "less_than_equal":
            message = f"{message[:-1]}. {NO_LEG}"
    return InputError(code=code, path=json_path(location), message=message)


def _instead(details: ErrorDetails) -> str:
    """Say what to write, if that can be told from what was sent."""
    sent, kind = details.get("input", ...), details["type"]
    number = _number_in(sent)
    if kind == "list_type" and number is not None:
        return f"write [{number}]"
    if kind == "list_type" and isinstance(sent, str) and _WORD.fullmatch(sent):
        return f'write ["{sent}"]'
    if kind in ("list_type", "tuple_type") and isinstance(sent, dict):
        return "put what it lists between [ and ], not an object"
    if kind in ("float_type", "int_type") and isinstance(sent, str) and number is not None:
        return f"write {number} without quotes"
    if kind in ("int_type", "int_from_float") and isinstance(sent, float):
        return f"write {int(sent)}" if sent.is_integer() else f"state one, not {sent:.6g}"
    if kind == "string_type" and number is not None:
        return f'write "{number}"'
    return f"state one, not {_shown(details)}"


def _number_in(sent: object) -> str | None:
    """Return a number that was sent, or stands in a text that was."""
    text = str(sent) if isinstance(sent, int | float) and not isinstance(sent, bool) else sent
    return text if isinstance(text, str) and _NUMBER.fullmatch(text) else None


def _rounded(context: Mapping[str, Any]) -> dict[str, Any]:
    """Return bounds without decimals that tell nothing."""
    return {name: int(bound) if isinstance(bound, float) and bound.is_integer() else bound
            for name, bound in context.items()}


def _closest(details: ErrorDetails) -> str:
    """Say which of some words was meant, if one is like what was sent."""
    sent = details.get("input")
    if details["type"] != "literal_error" or not isinstance(sent, str) or len(sent) > 40:
        return ""
    words = _QUOTED.findall(str(details.get("ctx", {}).get("expected", "")))
    close = get_close_matches(sent.lower(), words, 1)
    return f" Did you mean {close[0]!r}?" if close else ""


def _shown(details: ErrorDetails) -> str:
    """Say what was sent instead, without repeating it."""
    return _JSON_NAMES.get(type(details.get("input", ...)), "this")
