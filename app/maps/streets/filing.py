"""What is made of an extract, once, in a file that is kept beside it.

The file is an SQLite database. Its name tells the extract's content and the version of what makes
it, so that another extract, or a newer version, is made anew.
"""

import hashlib
import os
import sqlite3
from collections.abc import Callable, Sequence
from contextlib import closing, suppress
from pathlib import Path
from tempfile import mkstemp

Fill = Callable[[sqlite3.Connection], None]


def folder_beside(extract: Path) -> Path:
    """Return where is kept what is made of an extract: `berlin.roads` beside `berlin.osm.pbf`."""
    return extract.parent / f"{extract.name.split('.')[0]}.roads"


def file_name(extract: Path, version: int, suffix: str) -> str:
    """Return what the file with something made of an extract is called.

    Raises
    ------
    OSError
        If it can't be read.
    """
    with extract.open("rb") as content:
        digest = hashlib.file_digest(content, "sha256")
    digest.update(bytes([version]))
    return f"{extract.name.split('.')[0]}.{digest.hexdigest()[:16]}{suffix}"


def made(name: str, folders: Sequence[Path], fill: Fill) -> Path:
    """Return a file of this name in any folder, filled in the first that takes it if none has it.

    Raises
    ------
    OSError
        If it can't be written.
    """
    found = next((folder / name for folder in folders if (folder / name).exists()), None)
    if found is not None:
        return found
    for folder in folders[:-1]:
        with suppress(PermissionError):
            return _write(folder / name, fill)
    return _write(folders[-1] / name, fill)


def _write(file: Path, fill: Fill) -> Path:
    """Fill a database that appears whole or not at all."""
    file.parent.mkdir(parents=True, exist_ok=True)
    handle, name = mkstemp(prefix=f".{file.name}.", dir=file.parent)
    os.close(handle)
    try:
        with closing(sqlite3.connect(name)) as database:
            # What is written again if it is lost need not be safe on the disk at each step.
            database.execute("PRAGMA synchronous = OFF")
            fill(database)
            database.commit()
        os.chmod(name, 0o644)
        os.replace(name, file)
    except BaseException:
        with suppress(FileNotFoundError):
            os.unlink(name)
        raise
    return file


def reading(file: Path) -> sqlite3.Connection:
    """Open a file that is never changed."""
    return sqlite3.connect(f"{file.resolve().as_uri()}?mode=ro&immutable=1", uri=True)
