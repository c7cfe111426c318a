"""Jobs -> replies, as plain data (see `app.records.jobs.schemas`)."""

from app.records.jobs.rows import JobRow
from app.records.jobs.schemas import Data
from app.schemas.instants import instant_of


def summary(row: JobRow) -> Data:
    """Return a job without its result."""
    return {
        "id": row.id,
        "kind": row.kind,
        "state": row.state,
        "created_at": _instant(row.created_at),
        "started_at": _instant(row.started_at),
        "finished_at": _instant(row.finished_at),
        "expires_at": _instant(row.expires_at),
        "progress": row.progress,
        "cost": row.cost,
        "search_iterations": row.search_iterations,
        "error": row.error,
        "waiting_for": row.waiting_for,
    }


def progress(row: JobRow, seen: int) -> Data:
    """Return the data of an event `progress`, `seen` being the revision of the one before."""
    return {"cost": row.cost, "search_iterations": row.search_iterations,
            "progress": row.progress, "state": row.state,
            "waiting_for": row.waiting_for, "improved": row.improved_revision > seen}


def _instant(milliseconds: int | None) -> str | None:
    return None if milliseconds is None else instant_of(milliseconds)
