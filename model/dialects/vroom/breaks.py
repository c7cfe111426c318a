"""Where the breaks of a route are taken, by VROOM's rules. Times in hundredths of a second.

Each route of a vehicle has all of its breaks, in their order. Breaks lie in gaps: before the first
job, between two, or behind the last. A vehicle drives on while it waits for a break to open, and
what is left of the leg is driven behind it.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from model.dialects.vroom.windows import MISSED, Slots, last_start, start_in

NEVER = -1
"""Latest time to leave by which nothing can be done; any time before 0 says the same."""


@dataclass(frozen=True, slots=True)
class Pause:
    """A break: how long, and when it may start."""

    duration: int
    slots: Slots


@dataclass(frozen=True, slots=True)
class VroomRest:
    """A break as it is taken."""

    number: int  # index into the vehicle's breaks
    gap: int  # index of the job behind it, or how many jobs there are
    arrival: int
    start: int  # after waiting
    duration: int
    travel: int  # driven of the gap's leg until then


@dataclass(frozen=True)
class GapsForBreaks:
    """A route to find breaks for: what lies in its gaps, and what behind each of them but the last.
    """

    times: Sequence[int]  # (gap,) of the leg
    actions: Sequence[int]  # (job,) setup and service
    slots: Sequence[Slots]  # (job,) when it may start
    pauses: Sequence[Pause]
    allows: Callable[[int, int], bool]  # by gap and break: whether the load does

    def earliest_end(self, begin: int) -> int:
        """Return when the route ends that begins then, `MISSED` if it can't."""
        if not self.pauses:
            return self._plain_end(begin)
        ends = (begin, *[MISSED] * len(self.pauses))
        for job, action in enumerate(self.actions):
            ends = after_job(self.arrivals(ends, job), action, self.slots[job])
        return self.arrivals(ends, len(self.actions))[-1]

    def arrivals(self, ends: Sequence[int], gap: int) -> list[int]:
        """Return the earliest arrivals behind a gap, by the number of breaks over by then."""
        return arrivals(ends, self.times[gap], self.pauses, lambda number: self.allows(gap, number))

    def latest_departure(self, end: int) -> tuple[int, list[int]]:
        """Return the latest departure by which the route is over by `end`, and how many breaks are
        over behind each gap then.
        """
        if not self.pauses:
            return self._plain_departure(end), [0] * len(self.times)
        number = len(self.pauses)
        latest = [NEVER] * number + [end]
        chosen = []
        for gap in range(len(self.actions), -1, -1):
            if gap < len(self.actions):
                latest = [last_start(time - self.actions[gap], self.slots[gap])
                          for time in latest]
            best = self._leaves(latest, gap)
            latest = [time for time, _ in best]
            chosen.append([over for _, over in best])
        over, counts = 0, []
        for choice in reversed(chosen):
            over = choice[over]
            counts.append(over)
        return latest[0], counts

    def _plain_end(self, time: int) -> int:
        """Return when a route without breaks ends."""
        for travel, action, slots in zip(self.times, self.actions, self.slots, strict=False):
            time = start_in(time + travel, slots) + action
        return time + self.times[-1]

    def _plain_departure(self, time: int) -> int:
        """Return the latest departure of a route without breaks."""
        time -= self.times[-1]
        for travel, action, slots in zip(self.times[-2::-1], self.actions[::-1], self.slots[::-1],
                                         strict=True):
            time = last_start(time - action, slots) - travel
        return time

    def _leaves(self, latest: Sequence[int], gap: int) -> list[tuple[int, int]]:
        """Return the latest times to leave for arrivals behind breaks of a gap, which `latest` are
        by how many are over behind it; by how many are before it, and how many are behind it then.
        """
        best = [(NEVER, over) for over in range(len(latest))]
        for over, arrival in enumerate(latest):
            time, left = arrival, self.times[gap]
            best[over] = max(best[over], (time - left, over))
            for number in range(over - 1, -1, -1):
                if time < 0 or not self.allows(gap, number):
                    break
                pause = self.pauses[number]
                behind = time - pause.duration
                time = last_start(behind, pause.slots)
                left -= min(left, max(0, behind - time))
                best[number] = max(best[number], (time - left, over))
        return best

    def drive(self, gap: int, leave: int, numbers: range,
              starts: Sequence[int] = ()) -> tuple[int, list[VroomRest]]:
        """Return the arrival behind a gap in which some breaks are taken, and those.

        They start as soon as they may, or by `starts` of all breaks.
        """
        time, left, rests = leave, self.times[gap], []
        for number in numbers:
            pause = self.pauses[number]
            start = starts[number] if starts else start_in(time, pause.slots)
            driven = min(left, start - time)
            left -= driven
            # Who waits for the last of the way has arrived before.
            rests.append(VroomRest(number, gap, time + driven, start, pause.duration,
                                   self.times[gap] - left))
            time = start + pause.duration
        return time + left, rests


def arrivals(ends: Sequence[int], travel: int, pauses: Sequence[Pause],
             allows: Callable[[int], bool]) -> list[int]:
    """Return the earliest arrivals behind a leg, by the number of breaks over by then.

    Parameters
    ----------
    ends
        When the vehicle may leave, by the number of breaks that are over.
    """
    earliest = [MISSED] * len(ends)
    for first, time in enumerate(ends):
        left = travel
        for over in range(first, len(ends)):
            if time >= MISSED:
                break
            earliest[over] = min(earliest[over], time + left)
            if over == len(pauses) or not allows(over):
                break
            start = start_in(time, pauses[over].slots)
            left -= min(left, start - time)
            time = start + pauses[over].duration if start < MISSED else MISSED
    return earliest


def after_job(arrivals: Sequence[int], action: int, slots: Slots) -> tuple[int, ...]:
    """Return when a job is done, by arrivals."""
    starts = [MISSED if time >= MISSED else start_in(time, slots) for time in arrivals]
    return tuple([MISSED if start >= MISSED else start + action for start in starts])
