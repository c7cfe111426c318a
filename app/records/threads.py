"""Threads in which endpoints wait for the database, so that the event loop doesn't."""

import logging
from collections.abc import Callable
from typing import TypeVar

from anyio import CapacityLimiter, to_thread
from sqlalchemy import Engine
from sqlalchemy.exc import SQLAlchemyError

from app.database.connections import is_misfit, is_outage
from app.database.files import why_unreachable
from app.database.migrations.running import SchemaError
from app.schemas.errors import RequestError

logger = logging.getLogger(__name__)

Result = TypeVar("Result")


class DatabaseThreads:
    """Some threads, and words for what goes wrong in them.

    Parameters
    ----------
    engine
        What they wait for.
    number
        How many there are, apart from those that plan.
    refusal
        What is raised where the database can't be used.
    """

    def __init__(self, engine: Engine, number: int, refusal: type[RequestError]) -> None:
        self.engine = engine
        self.refusal = refusal
        self._limiter = CapacityLimiter(number)

    async def run(self, work: Callable[[], Result], misfit: Callable[[], str]) -> Result:
        """Do `work` in a thread; `misfit`, also in one, tells why the tables don't fit.

        Raises
        ------
        RequestError
            `refusal` if the database can't be used; what `work` raises if it can't be done.
        """
        try:
            return await to_thread.run_sync(work, limiter=self._limiter)
        except SchemaError as error:
            raise self.refusal(str(error)) from error
        except SQLAlchemyError as error:
            if is_misfit(error):
                why = await to_thread.run_sync(misfit, limiter=self._limiter)
                raise self.refusal(why) from error
            if not is_outage(error):
                raise
            # The class alone: messages may repeat the URL, and so its password.
            logger.warning("the database can't be reached: %s", type(error).__name__)
            raise self.refusal(why_unreachable(self.engine)) from error
