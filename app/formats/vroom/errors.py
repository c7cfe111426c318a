"""Errors as VROOM reports them: a code and one message."""

from collections.abc import Sequence

from fastapi.responses import JSONResponse
from pydantic import BaseModel, Field

from model.dialects.vroom.errors import RefusedError, TooLargeError

INTERNAL, INPUT, ROUTING, TOO_LARGE = 1, 2, 3, 4
"""VROOM's codes; the last is vroom-express's."""

MAX_TOLD = 5
"""An error tells of no more faults than this, and how many there are."""

_STATUS = {INTERNAL: 500, INPUT: 400, ROUTING: 500, TOO_LARGE: 413}


class VroomErrorReply(BaseModel):
    """Why there is no solution."""

    code: int = Field(description="1: internal error, 2: input error, 3: routing error, 4: too "
                                  "large.")
    error: str = Field(description="What is wrong, in words.")


class VroomError(Exception):
    """A request that is answered with an error code of VROOM's."""

    def __init__(self, code: int, message: str) -> None:
        super().__init__(message)
        self.code = code

    def response(self) -> JSONResponse:
        """Return the reply."""
        return JSONResponse({"code": self.code, "error": str(self)}, _STATUS[self.code])


def input_error(faults: Sequence[str]) -> VroomError:
    """Return the error that tells of all that is wrong with a request."""
    more = len(faults) - MAX_TOLD
    told = [*faults[:MAX_TOLD], *([f"And {more} more."] if more > 0 else [])]
    return VroomError(INPUT, " ".join(told))


def refused(error: RefusedError) -> VroomError:
    """Return the error for what the planner refuses."""
    return VroomError(TOO_LARGE if isinstance(error, TooLargeError) else INPUT, str(error))
