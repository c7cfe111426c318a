"""How errors get from one process to another, and what a death is called."""

import pickle
import traceback
from typing import Any, NamedTuple

from app.schemas.errors import RequestError


class EndedUnexpectedlyError(RequestError, status=503, name="ended-unexpectedly"):
    """The process that worked on it died."""

    title = "The plan was lost"
    always = ("The process that worked on this request ended unexpectedly: try again. If it "
              "happens again, send fewer customers or other options.")


class ToldError(NamedTuple):
    """An error as it is told, whatever its class asks for to be made."""

    kind: type[BaseException]
    args: tuple[Any, ...]
    state: dict[str, Any]

    def again(self) -> BaseException:
        """Return the error."""
        error = self.kind.__new__(self.kind, *self.args)
        error.__dict__.update(self.state)
        return error


def told(error: Exception) -> ToldError:
    """Return an error to be sent; one of ours comes with where it happened."""
    if not isinstance(error, RequestError):
        error.add_note("".join(traceback.format_exception(error)))
    found = ToldError(type(error), error.args, dict(error.__dict__))
    try:
        pickle.loads(pickle.dumps(found))
    except Exception:  # whatever can't be sent is told in words
        return ToldError(RuntimeError, (repr(error),), {"__notes__": error.__dict__.get(
            "__notes__", [])})
    return found
