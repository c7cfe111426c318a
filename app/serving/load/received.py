"""A body that is here, as planning sees it: commands without a server plan, too."""

from dataclasses import dataclass


@dataclass(frozen=True)
class ReceivedBody:
    """A request's body and when its last byte came, on `time.perf_counter`."""

    content: bytes
    received_at: float
