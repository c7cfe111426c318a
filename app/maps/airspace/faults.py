"""What a file of zones holds, and what of it can't be read."""

from collections.abc import Callable
from dataclasses import dataclass, field

from app.maps.airspace.masks import Piece
from app.maps.airspace.shapes import ShapeError
from app.maps.airspace.zone import Zone

Path = tuple[str | int, ...]


@dataclass(frozen=True)
class Fault:
    """What is wrong, and where it is in the file."""

    path: Path
    message: str


@dataclass
class Reading:
    """What a file holds, as far as it can be read."""

    zones: list[Zone] = field(default_factory=list)
    faults: list[Fault] = field(default_factory=list)  # what can't be read
    doubts: list[Fault] = field(default_factory=list)  # what was read as if it said less

    def areas(self, path: Path, make: Callable[[], list[Piece]]) -> list[Piece]:
        """Return an area, in one piece or several; none if it is none, which is noted."""
        try:
            return make()
        except ShapeError as error:
            self.faults.append(Fault(path, str(error)))
            return []
