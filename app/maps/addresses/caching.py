"""Answers of geocoders that are kept, in a file that processes share, and their turns to ask.

The file is an SQLite database, which keeps what is asked for often in memory as well.
"""

import logging
import sqlite3
import threading
import time
from collections.abc import Iterable, Mapping
from dataclasses import asdict
from pathlib import Path

from pydantic import TypeAdapter, ValidationError
from pydantic_core import to_json

from app.maps.addresses.geocoder import Candidate, Candidates

logger = logging.getLogger(__name__)

DAY = 86_400.0

KEPT, NOTHING_KEPT = 30 * DAY, DAY
"""Seconds for which an answer is kept, and one that nothing was found: it may be on the map soon.
"""

MOST_KEPT = 100_000
"""Answers; those kept for longest are let go."""

LONGEST_LOCK = 2.0

TABLES = """
CREATE TABLE IF NOT EXISTS answer (scope TEXT, address TEXT, candidates BLOB, kept_at REAL,
                                   PRIMARY KEY (scope, address)) WITHOUT ROWID;
CREATE INDEX IF NOT EXISTS answer_by_age ON answer (kept_at);
CREATE TABLE IF NOT EXISTS turn (host TEXT PRIMARY KEY, next REAL NOT NULL);
"""

_CANDIDATES: TypeAdapter[Candidates] = TypeAdapter(tuple[Candidate, ...])


class AnswerCache:
    """Answers by geocoder and address. Threads and processes may share it.

    Parameters
    ----------
    file
        Where answers are; None, or where nothing can be written: in memory alone.
    """

    def __init__(self, file: Path | None = None, most: int = MOST_KEPT) -> None:
        self._most = most
        self._lock = threading.Lock()
        self._database = _opened(file)

    def get(self, scope: str, addresses: Iterable[str]) -> Mapping[str, Candidates]:
        """Return the answers that are known."""
        now = time.time()
        found = {}
        with self._lock:
            for address in addresses:
                row = self._database.execute(
                    "SELECT candidates, kept_at FROM answer WHERE scope = ? AND address = ?",
                    (scope, _key(address))).fetchone()
                known = None if row is None else _read(row[0])
                if known is not None and now - row[1] < (KEPT if known else NOTHING_KEPT):
                    found[address] = known
        return found

    def put(self, scope: str, address: str, candidates: Candidates) -> None:
        """Keep an answer. In place."""
        content = to_json([asdict(candidate) for candidate in candidates])
        try:
            with self._lock, self._database:
                self._database.execute("INSERT OR REPLACE INTO answer VALUES (?, ?, ?, ?)",
                                       (scope, _key(address), content, time.time()))
                self._database.execute(
                    "DELETE FROM answer WHERE kept_at < (SELECT kept_at FROM answer "
                    "ORDER BY kept_at DESC LIMIT 1 OFFSET ?)", (self._most - 1,))
        except sqlite3.OperationalError as error:
            # What can't be written is asked for again, some time.
            logger.warning("an address is not kept: %s", error)

    def take_turn(self, host: str, gap: float) -> float:
        """Take the next turn to ask a host; return in how many seconds it comes. In place."""
        now = time.time()
        try:
            with self._lock, self._database:
                (taken,) = self._database.execute(
                    "INSERT INTO turn VALUES (:host, :now + :gap) ON CONFLICT (host) DO UPDATE SET "
                    "next = min(max(next, :now), :now + 60) + :gap RETURNING next",
                    {"host": host, "now": now, "gap": gap}).fetchone()
        except sqlite3.OperationalError as error:
            logger.warning("turns to ask are not shared: %s", error)
            return gap
        return max(0.0, float(taken) - gap - now)

    def close(self) -> None:
        """Close the file."""
        with self._lock:
            self._database.close()


def _opened(file: Path | None) -> sqlite3.Connection:
    if file is not None:
        try:
            file.parent.mkdir(parents=True, exist_ok=True)
            return _with_tables(
                sqlite3.connect(file, timeout=LONGEST_LOCK, check_same_thread=False))
        except (OSError, sqlite3.Error) as error:
            logger.warning("addresses are kept in memory alone: %s", error)
    return _with_tables(sqlite3.connect(":memory:", check_same_thread=False))


def _with_tables(database: sqlite3.Connection) -> sqlite3.Connection:
    try:
        database.execute("PRAGMA journal_mode = WAL")
        database.execute("PRAGMA synchronous = NORMAL")
        database.executescript(TABLES)
    except sqlite3.Error:
        database.close()
        raise
    return database


def _key(address: str) -> str:
    return " ".join(address.casefold().split())


def _read(content: bytes) -> Candidates | None:
    try:
        return _CANDIDATES.validate_json(content)
    except ValidationError:
        return None
