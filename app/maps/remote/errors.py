"""What may come of asking others, told without addresses and keys: clients may read it."""

from dataclasses import dataclass


class SourceError(Exception):
    """Nothing was told this time."""


class SourceUnavailableError(SourceError):
    """The source is down, too slow or too busy, or its setting is wrong."""

    counts = True
    """Whether it says anything of the source: not if the caller had no time for an answer."""

    is_late = False
    """Whether the caller's time was over, and the source hadn't failed before."""


class SourceAnswerError(SourceError):
    """The source answered what can't be right, or that it can't answer this."""


class SourceStoppedError(SourceError):
    """The caller said stop before there was an answer."""


@dataclass(frozen=True)
class SourceKind:
    """What a source is called, and the errors that it fails with."""

    name: str
    unavailable: type[SourceUnavailableError]
    answer: type[SourceAnswerError]
    stopped: type[SourceStoppedError]
