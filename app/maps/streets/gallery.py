"""The streets that a service draws: those of its extracts, made at its first start."""

import logging
import os
from collections.abc import Iterable, Sequence
from concurrent.futures import BrokenExecutor, Future, ProcessPoolExecutor, wait
from multiprocessing import get_context
from pathlib import Path

from app.maps.streets.filing import folder_beside
from app.maps.streets.reading import StreetsError
from app.maps.streets.store import SUFFIX, Streets, build_streets
from app.serving.load.with_parent import end_with

GROUND = Path(__file__).with_name(f"ground{SUFFIX}")
"""Coasts, water, borders and large cities of the world, which `.ci/ground.py` makes."""

logger = logging.getLogger(__name__)


class Gallery:
    """Streets by name, each from when it is ready.

    Parameters
    ----------
    extracts
        Files to draw; the tiles of each are kept beside it.
    spare
        Folder for tiles of what lies where nothing can be written.
    """

    def __init__(self, extracts: Iterable[Path], spare: Path) -> None:
        self._extracts = list(dict.fromkeys(extracts))
        self._spare = spare
        self.ground = Streets.opened(GROUND)
        self._ready: dict[str, Streets] = {}
        self._executor: ProcessPoolExecutor | None = None
        self._making: list[Future[Streets]] = []

    def start(self) -> None:
        """Make what isn't there yet, in a process of its own beside the planner. In place."""
        if not self._extracts:
            return
        # Nothing else tells it that this process was killed.
        self._executor = ProcessPoolExecutor(1, get_context("spawn"), end_with, (os.getpid(),))
        for extract in self._extracts:
            folders = (folder_beside(extract), self._spare)
            future = self._executor.submit(build_streets, extract, folders)
            future.add_done_callback(self._take)
            self._making.append(future)
        self._executor.shutdown(wait=False)

    def stop(self) -> None:
        """Wait for nothing more. In place."""
        if self._executor is not None:
            self._executor.shutdown(wait=False, cancel_futures=True)

    def wait(self, seconds: float) -> None:
        """Wait until all is ready that can be, or some seconds. In place."""
        wait(self._making, seconds)

    @property
    def ready(self) -> Sequence[Streets]:
        """The streets that can be drawn now."""
        return tuple(self._ready.values())

    def find(self, name: str) -> Streets | None:
        """Return the streets of this name, if they can be drawn."""
        return self.ground if name == self.ground.name else self._ready.get(name)

    def _take(self, future: "Future[Streets]") -> None:
        if future.cancelled():
            return
        try:
            streets = future.result()
        except (StreetsError, OSError, BrokenExecutor) as error:
            logger.warning("no streets on the map: %s", error)
        else:
            self._ready[streets.name] = streets
