"""A database that is prepared while the service starts already."""

import logging
import threading
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from typing import Annotated, TypeVar

from anyio import to_thread
from fastapi import Depends, Request
from sqlalchemy import Engine
from sqlalchemy.exc import SQLAlchemyError

from app.database.files import GONE, Identity, file_of, no_room
from app.database.migrations.running import SchemaError
from app.records.threads import DatabaseThreads

logger = logging.getLogger(__name__)

Result = TypeVar("Result")


class PreparedDatabase:
    """Does work with the database in threads, once its tables are there.

    Parameters
    ----------
    threads
        Where the work is done.
    make_tables
        Makes the tables, or brings them to this version.
    find_misfit
        Returns why the tables can't be used, or None.
    """

    def __init__(self, threads: DatabaseThreads, make_tables: Callable[[], None],
                 find_misfit: Callable[[], str | None]) -> None:
        self._threads = threads
        self._make_tables = make_tables
        self._find_misfit = find_misfit
        self.is_prepared = False
        self._misfit: str | None = None
        self._file: Identity = None
        self._has_tried = threading.Event()

    def prepare(self) -> bool:
        """Make the tables, or bring them to this version; tell whether that went well. In place."""
        try:
            self._make_tables()
        except SchemaError as error:
            self._note_misfit(str(error))
        except SQLAlchemyError as error:
            logger.warning("the database can't be prepared: %s", type(error).__name__)
        else:
            self._note_misfit(None)
            self._file = file_of(self._threads.engine)
            self.is_prepared = True
        self._has_tried.set()
        return self.is_prepared

    @property
    def is_preparing(self) -> bool:
        """Tell whether the database is being prepared for the first time.

        It is over, too, once the database could not be reached: plans need none.
        """
        return not self._has_tried.is_set()

    async def misfit(self) -> str | None:
        """Return why the tables can't be used, if they were found not to fit, and still don't.

        Or why nothing can be written.
        """
        if not self.is_prepared:
            return self._misfit
        file = file_of(self._threads.engine)
        if file is None:
            return GONE
        if self._misfit is not None or file != self._file:
            await self._threads.run(self._look_at_tables, self._changed)
            self._file = file
        return self._misfit or await to_thread.run_sync(no_room, self._threads.engine)

    async def reach(self, work: Callable[[Engine], Result]) -> Result:
        """Do `work` in a thread, as the database has to be waited for.

        Raises
        ------
        RequestError
            If it can't be reached, or the work can't be done.
        """
        if not self.is_prepared:
            raise self._threads.refusal(self._misfit or "The database is being prepared: try again "
                                        "soon.")
        return await self._threads.run(partial(work, self._threads.engine), self._changed)

    def _changed(self) -> str:
        """Look at the tables and say in words what came of it."""
        self._look_at_tables()
        return self._misfit or "The database's tables have changed: try again."

    def _look_at_tables(self) -> None:
        """See whether the tables fit, as far as the database can be reached. In place."""
        with suppress(SQLAlchemyError):
            self._note_misfit(self._find_misfit())

    def _note_misfit(self, misfit: str | None) -> None:
        if misfit is not None and misfit != self._misfit:
            logger.error("%s", misfit)
        self._misfit = misfit


async def get_database(request: Request) -> PreparedDatabase:
    """Return the database of this application's jobs and dispatches."""
    database: PreparedDatabase = request.app.state.jobs.database
    return database


Database = Annotated[PreparedDatabase, Depends(get_database)]
