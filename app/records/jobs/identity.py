"""A name for each process that works on jobs, the same again after it was killed and restarted.

A process begins anew what one of its name had begun, so two must never share a name.
"""

import fcntl
import os
from dataclasses import dataclass
from itertools import count
from pathlib import Path


@dataclass(frozen=True)
class Identity:
    """The name of this process, held until `release`."""

    name: str
    descriptor: int

    def release(self) -> None:
        """Leave the name to the next process. In place."""
        os.close(self.descriptor)


def take_identity(worker: str, folder: Path) -> Identity:
    """Return the first free of `<worker>-0`, `<worker>-1` and so on, on this machine.

    A lock on a file in `folder` holds it; it ends with the process, however that ends.
    """
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    for number in count():
        name = f"{worker}-{number}"
        descriptor = os.open(folder / f"{name}.lock", os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            os.close(descriptor)
            continue
        return Identity(name, descriptor)
    raise AssertionError("count() never ends")
