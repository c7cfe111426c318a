"""What the judge says in seconds and minutes, said in times of the day, hours and minutes."""

import math
import re
from collections.abc import Callable

Words = Callable[[str], str]

_NUMBER = r"(\d+(?:\.\d+)?)"
_INSTANT = re.compile(rf"\b((?:at|before|after|from|until) ){_NUMBER} s\b")
_COMPUTED = re.compile(r"\b(arrival|service_start|departure|launch_time|recovery_time) is "
                       rf"{_NUMBER} s, computed {_NUMBER} s\b")
_LENGTH = re.compile(rf"\b{_NUMBER} (s|minutes?)(?![\w'])")

_SECONDS = {"s": 1.0, "minute": 60.0, "minutes": 60.0}
MINUTE, HOUR = 60, 3600


def wording(clock: Callable[[float], str]) -> Words:
    """Return what puts a message into clocks and lengths; `clock` tells an instant in seconds."""

    def told(message: str) -> str:
        message = _COMPUTED.sub(lambda found: f"{found[1]} is {clock(float(found[2]))}, computed "
                                f"{clock(float(found[3]))}", message)
        message = _INSTANT.sub(lambda found: found[1] + clock(float(found[2])), message)
        return _LENGTH.sub(lambda found: length(float(found[1]) * _SECONDS[found[2]]), message)

    return told


def length(seconds: float) -> str:
    """Return a length of time such as `2 h 5 min`, `2 min 30 s` or `40 s`.

    From an hour on it is rounded up to a minute, so that what is said to suffice does.
    """
    parts: tuple[tuple[float, str], ...]
    if seconds >= HOUR:
        minutes = math.ceil(round(seconds / MINUTE, 6))
        parts = ((minutes // 60, "h"), (minutes % 60, "min"))
    else:
        whole = int(seconds // MINUTE)
        parts = ((whole, "min"), (round(seconds - MINUTE * whole, 3), "s"))
    return " ".join(f"{amount:g} {unit}" for amount, unit in parts if amount) or "0 s"
