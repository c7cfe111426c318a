"""Processes that end with the one that started them, even if that is killed.

Run as a script by its path, with that process's number, and then a program and its arguments, this
becomes the program.
"""

import ctypes
import os
import signal
import sys

PR_SET_PDEATHSIG = 1


def end_with(parent: int) -> None:
    """Have this process end with its parent: with the thread there that started it. In place."""
    if sys.platform == "linux":
        ctypes.CDLL(None, use_errno=True).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
        if os.getppid() != parent:
            os._exit(1)  # it ended before it could be heard


def main() -> None:
    """Become the program that the arguments name."""
    parent, program = int(sys.argv[1]), sys.argv[2:]
    end_with(parent)
    os.execv(program[0], program)


if __name__ == "__main__":
    main()
