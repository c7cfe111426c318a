"""SQLite's file under a running service: what is written to one that was deleted is lost."""

import sqlite3
import tempfile
from pathlib import Path
from typing import Any
from urllib.parse import quote

from sqlalchemy import Engine, event
from sqlalchemy.exc import DisconnectionError, OperationalError
from sqlalchemy.pool import ConnectionPoolEntry

GONE = ("The database's file is gone, so nothing can be kept: put it back, or start the service "
        "anew, which makes an empty one.")

BESIDE = "-wal"
"""What the name of the file with the latest commits ends with."""

Identity = tuple[int, int] | None
"""Device and number of a file; None: it isn't there."""

NO_FILE: Identity = (0, 0)
"""For databases that are no file of ours."""


class FolderError(OSError):
    """Nothing can be kept in the folder for data."""


def check_folder(folder: Path) -> None:
    """Make sure that files can be made in the folder for data, which is made if need be.

    Raises
    ------
    FolderError
        If not; its words say why.
    """
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=folder).close()
    except OSError as error:
        raise FolderError(f"Nothing can be written to the folder {folder} ({error.strerror}): have "
                          "TANDEM_DATA_DIR name one that this user may write to.") from error


def file_of(engine: Engine) -> Identity:
    """Tell an engine's file from others, as it is now; None: it is gone."""
    if engine.dialect.name != "sqlite":
        return NO_FILE
    return _identity(Path(engine.url.database or ""))


ROOM = 2**20
"""Bytes that have to be free beside an engine's file, for what is written next."""


def no_room(engine: Engine) -> str | None:
    """Return in words why nothing more can be written beside an engine's file; None: it can."""
    if engine.dialect.name != "sqlite":
        return None
    folder = Path(engine.url.database or "").absolute().parent
    try:
        with tempfile.TemporaryFile(dir=folder) as file:
            # Full disks, quotas and limits of a process are all told by trying.
            file.write(bytes(ROOM))
            file.flush()
    except OSError as error:
        return (f"Nothing can be written to the database's folder ({error.strerror}): make room "
                "on its disk.")
    return None


def why_unreachable(engine: Engine) -> str:
    """Return in words why a database isn't reached."""
    return ("The database can't be reached: try again soon." if file_of(engine) is not None
            else GONE)


class DatabaseFile:
    """The file that an engine's connections write to.

    A file that was deleted stays open for whoever has it open: they would go on writing, and all be
    lost with the last of them. So each connection is told from those to another file when it is
    taken from the pool and before it commits.
    """

    def __init__(self, path: Path) -> None:
        self._path = path

    def connect(self) -> sqlite3.Connection:
        """Return a connection to the file, which isn't made anew if it is gone."""
        return sqlite3.connect(f"file:{quote(str(self._path.absolute()))}?mode=rw", uri=True,
                               check_same_thread=False)

    def watch(self, engine: Engine) -> None:
        """Have no connection of an engine write to a file that is gone. In place."""
        event.listen(engine, "connect", self._note)
        event.listen(engine, "checkout", self._take)
        event.listen(engine, "commit", lambda connection: self._require(connection.connection))

    def _note(self, _: Any, record: ConnectionPoolEntry) -> None:
        record.info["file"] = _identity(self._path)

    def _take(self, _: Any, record: ConnectionPoolEntry, __: Any) -> None:
        """Let a connection to another file be used no more. In place."""
        if not self._is_of(record.info):
            # The pool connects anew, which fails if there is no file.
            raise DisconnectionError

    def _require(self, connection: Any) -> None:
        if not self._is_of(connection.info):
            raise _gone()

    def _is_of(self, info: dict[str, Any]) -> bool:
        """Tell whether a connection's files are those that are there; note the latest. In place."""
        latest = _identity(self._path.with_name(self._path.name + BESIDE))
        known = info.setdefault("latest", latest) or latest
        info["latest"] = known
        return info["file"] is not None and (info["file"], known) == (
            _identity(self._path), latest)


def _gone() -> OperationalError:
    return OperationalError(None, None, sqlite3.OperationalError(GONE))


def _identity(path: Path) -> Identity:
    try:
        found = path.stat()
    except OSError:
        return None
    return found.st_dev, found.st_ino
