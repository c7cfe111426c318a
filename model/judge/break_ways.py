"""The cheapest ways to take breaks on a route, for all begins at once.

A way to have come so far is dropped for those begins for which another one with the same breaks is
there no later, at no higher cost, and no nearer to any limit. Times in ms.
"""

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise, product
from typing import NamedTuple

from model.judge.breaks import ON_A_LEG, BreakDecision, is_due
from model.judge.courses import Leg, RouteCourse
from model.judge.instants import ANY, NONE, Begins, Instant, fixed
from model.judge.metrics import allowed_overtime, overtime
from model.problem import MS_PER_HOUR, UNLIMITED, Break

LATE, SKIPPED = 1.0, 1e10
"""Costs in place of rules that nobody can keep: per ms too late, and of a break not taken."""

DEPARTURE, WAY, ARRIVAL = range(len(ON_A_LEG))

MOST_WAYS = 200
"""Ways that are gone on with; more than that are had with many breaks whose windows overlap."""

UNBOUNDED = float("inf")
TOLERANCE = 1e-9
"""Of costs that are added up in another order."""


class TakenBreaks(NamedTuple):
    """Where breaks are taken on a route that begins then."""

    begin: int
    breaks: tuple[tuple[int, BreakDecision], ...]  # each with the index of its trip


Found = tuple[tuple[float, int, int, int], TakenBreaks]
"""A whole way, and what is smaller for a better one."""


class _Price(NamedTuple):
    """What it costs to come to somebody late, or early."""

    node: int
    instant: Instant
    due: int
    late: float = 0.0  # per ms
    once: float = 0.0
    early: float = 0.0  # per ms

    def at(self, begin: int) -> float:
        late = self.instant.at(begin) - self.due
        return late * self.late + self.once if late > 0 else -late * self.early


class _Following(NamedTuple):
    """What follows a leg."""

    duration: int = 0  # at least
    end: int = 0  # of the route, at least
    early_cost: float = 0.0  # per ms, the highest
    least: frozenset[int] = frozenset()  # nodes behind whom others come some time later
    most: frozenset[int] = frozenset()

    @property
    def marks(self) -> list[int]:
        """Nodes from which others count."""
        return sorted(self.least | self.most)

    def with_before(self, leg: Leg) -> "_Following":
        """Return what follows the leg before, which is given."""
        ready = max(leg.waits, leg.opens[0]) + leg.service + self.duration
        return _Following(self.duration + leg.duration + leg.setup + leg.service,
                       max(self.end, ready), max(self.early_cost, leg.early_cost),
                       (self.least | {node for node, _ in leg.least}) - {leg.node},
                       (self.most | {node for node, _ in leg.most}) - {leg.node})


class _Way(NamedTuple):
    """A way to have come so far."""

    time: Instant
    begins: Begins  # for which it is one
    marks: tuple[Instant, ...]  # when service began at nodes from which others count
    breaks: tuple[tuple[int, BreakDecision], ...] = ()
    prices: frozenset[_Price] = frozenset()
    cost: float = 0.0  # beside them

    def ended(self, behind: _Following) -> Instant:
        """Return when the route ends, at the soonest."""
        return self.time.plus(behind.duration).or_later(fixed(behind.end))

    def turns(self, prices: frozenset[_Price]) -> set[int]:
        """Return the begins between which all rises or falls evenly, as far as those prices do."""
        found = {*self.begins, self.time.turn, *(mark.turn for mark in self.marks)}
        for price in prices:
            turn = price.due - price.instant.after
            found |= {price.instant.turn, turn, turn + 1}
        return found


def best_breaks(course: RouteCourse, stated: Mapping[int, tuple[int, int]], likely: int,
                most: int) -> list[TakenBreaks]:
    """Return the best ways to take breaks, at most so many, the best first.

    `stated` has trip and stop of breaks that are to be taken there. Where no way keeps all limits,
    those that begin at once, and are late the least. A route that begins at a `likely` instant is
    looked at first.
    """
    first, last = course.begins
    pauses = sum([each.duration for each in course.kind.breaks])
    at_once = [course._replace(begins=Begins(begin, begin)) for begin in (
        first, *[min(max(first, begin), last) for begin in (likely, likely - pauses)])]
    found, limit, least = list[Found](), UNBOUNDED, _least_cost(course)
    for begun in (*at_once, course):
        if limit > least:
            found += _Search(begun, stated, False, limit).found()
        if most == 1:
            limit = min([each[0][0] for each in found], default=limit)
    # Later trips may keep limits by beginning later.
    freed = tuple([leg._replace(most=() if leg.trip else leg.most) for leg in course.legs])
    found = found or _Search(course._replace(legs=freed), stated, False).found()
    found = found or _Search(at_once[0], stated, True).found()
    ways = dict[tuple[tuple[int, BreakDecision], ...], TakenBreaks]()
    for _, taken in sorted(found):
        ways.setdefault(taken.breaks, taken)
    return [*ways.values()][:most]


def _least_cost(course: RouteCourse) -> float:
    """Return what a route costs at least."""
    duration = sum([leg.duration + leg.setup + leg.service for leg in course.legs])
    return duration * course.kind.cost_per_hour / MS_PER_HOUR


class _Search:
    """Looks for ways to take breaks on a course."""

    def __init__(self, course: RouteCourse, stated: Mapping[int, tuple[int, int]],
                 is_lenient: bool, limit: float = UNBOUNDED) -> None:
        self._course, self._kind, self._stated = course, course.kind, stated
        self._limit = limit + TOLERANCE  # of costs
        self._is_lenient, self._breaks = is_lenient, course.kind.breaks
        self._windows = [self._window(each) for each in self._breaks]
        is_steady = course.kind.speed_profile is None
        self._places = [(DEPARTURE, WAY, ARRIVAL) if each.anywhere and is_steady
                        else (DEPARTURE, ARRIVAL) for each in self._breaks]
        behind = [_Following()]
        for leg in reversed(course.legs):
            behind.append(behind[-1].with_before(leg))
        self._behind = behind[::-1]
        over, longest = allowed_overtime(self._kind), self._kind.max_working_duration
        self._ends = fixed(self._kind.latest + over)
        self._works = UNLIMITED if longest is None else longest + over

    def _window(self, each: Break) -> tuple[Instant, Instant]:
        since = self._course.begin if each.after_departure else fixed(0)
        return since.plus(each.earliest), since.plus(each.latest)

    def found(self) -> list[Found]:
        """Return all ways that are left at the end."""
        course = self._course
        ways = {course.taken: [_Way(course.time, course.begins,
                                    tuple([course.time] * len(self._behind[0].marks)))]}
        for index in range(len(course.legs)):
            ways = self._passed(index, ways)
        return [found for mask, each in ways.items() for way in each
                for found in self._ended(mask, way)]

    def _passed(self, index: int, ways: dict[int, list[_Way]]) -> dict[int, list[_Way]]:
        """Return the ways behind a leg that are any good, by the breaks taken, as bits."""
        leg, passed = self._course.legs[index], dict[int, list[_Way]]()
        for mask, each in ways.items():
            for way in each:
                for taken, driven in self._driven(index, mask, way, way.time.plus(leg.duration)):
                    passed.setdefault(taken, []).extend(self._served(index, taken, driven))
        behind = self._behind[index + 1]
        return self._likeliest({mask: _undominated(each, behind) for mask, each in passed.items()})

    def _likeliest(self, ways: dict[int, list[_Way]]) -> dict[int, list[_Way]]:
        """Return ways without those that are dearest of very many that have come to a break."""
        if sum(map(len, ways.values())) <= MOST_WAYS:
            return ways
        kept = dict[int, list[_Way]]()
        for number in range(len(self._breaks) + 1):
            found = [(mask, way) for mask, each in ways.items() if mask.bit_length() == number
                     for way in each]
            found.sort(key=lambda each: self._so_far(*each))
            for mask, way in found[:MOST_WAYS // (len(self._breaks) + 1)]:
                kept.setdefault(mask, []).append(way)
        return kept

    def _so_far(self, mask: int, way: _Way) -> tuple[float, int]:
        """Return what a way costs so far that begins as late as it may, and until when it lasts."""
        begin, rate = way.begins.last, self._kind.cost_per_hour / MS_PER_HOUR
        worked = way.time.at(begin) - self._course.works_since.at(begin) - self._unpaid(mask)
        return way.cost + sum([price.at(begin) for price in way.prices]) + worked * rate, worked

    def _driven(self, index: int, mask: int, way: _Way, arrival: Instant,
                first: int = DEPARTURE) -> Iterator[tuple[int, _Way]]:
        """Yield how a leg may be driven that otherwise ends at `arrival`, with breaks from a place.
        """
        yield mask, way._replace(time=arrival)
        leg = self._course.legs[index]
        if leg.stop is None:
            return
        ways, here = [way], (leg.trip, leg.stop)
        for number in range(mask.bit_length(), len(self._breaks)):
            if number not in leg.heavy and self._stated.get(number, here) == here:
                for way, place in product(ways, self._places[number]):
                    if place >= first:
                        yield from self._paused(index, mask, way, arrival, number, place)
            ways = [way._replace(begins=begins) for way in ways
                    for begins in self._without(number, self._behind[index + 1], way) if begins]

    def _paused(self, index: int, mask: int, way: _Way, arrival: Instant, number: int,
                place: int) -> Iterator[tuple[int, _Way]]:
        """Yield how a leg may be driven with a break at a place, and maybe others behind it."""
        leg, (opens, closes) = self._course.legs[index], self._windows[number]
        start = (arrival if place == ARRIVAL else way.time).or_later(opens)
        begins = way.begins.within(start.until(closes))
        if not begins:
            return
        duration = self._breaks[number].duration
        time = ends = start.plus(duration)
        if place == DEPARTURE:
            ends = time.plus(leg.duration)
        elif place == WAY:
            ends = arrival.or_later(opens).plus(duration)
        taken = leg.trip, BreakDecision(number, leg.stop or 0, ON_A_LEG[place])
        paused = way._replace(time=time, begins=begins, breaks=(*way.breaks, taken))
        mask |= 1 << number
        if begins := begins.within(self._in_time(paused, mask, self._behind[index + 1])):
            yield from self._driven(index, mask, paused._replace(begins=begins), ends, place)

    def _without(self, number: int, behind: _Following, way: _Way) -> Iterator[Begins]:
        """Yield for which begins a break may not be due, as far as that can be told yet."""
        each, (opens, closes) = self._breaks[number], self._windows[number]
        if self._is_lenient:
            yield way.begins
        elif number not in self._stated:
            yield way.begins.within(way.ended(behind).until(closes))
            yield way.begins.within(opens.plus(each.duration).until(self._course.begin))

    def _served(self, index: int, mask: int, way: _Way) -> Iterator[_Way]:
        """Yield how the stop behind a leg may be made, in which window."""
        leg, behind = self._course.legs[index], self._behind[index + 1]
        marks = dict(zip(self._behind[index].marks, way.marks, strict=True))
        ready = way.time.plus(leg.setup)
        begun, begins = ready.or_later(fixed(leg.waits)), way.begins
        for node, least in leg.least:
            begun = begun.or_later(marks[node].plus(least))
        is_soft = self._is_lenient or leg.late_cost is not None
        for opens, closes in zip(leg.opens, leg.closes, strict=True):
            start, here = begun.or_later(fixed(opens)), begins
            if not is_soft or closes != leg.closes[-1]:
                here = here.within(begun.until(fixed(closes)))
            for node, most in () if self._is_lenient else leg.most:
                here = here.within(start.until(marks[node].plus(most)))
            if here:
                marks[leg.node] = start
                served = _priced(way._replace(
                    time=start.plus(leg.service).or_later(ready.plus(leg.busy)), begins=here,
                    marks=tuple([marks[node] for node in behind.marks])), leg, ready, opens, start)
                if here := here.within(self._in_time(served, mask, behind)):
                    yield served._replace(begins=here)
            if begun.least <= closes:
                begins = begins.within(Begins(closes - begun.after + 1, begins.last))

    def _in_time(self, way: _Way, mask: int, behind: _Following) -> Begins:
        """Return for which begins a route may still end in time, and cheap enough.

        Breaks that aren't paid shorten no work but waiting.
        """
        if self._is_lenient:
            return ANY
        works, rate = self._works, self._kind.cost_per_hour / MS_PER_HOUR
        left = self._limit - way.cost - sum(
            [min(price.at(begin) for begin in way.begins) for price in way.prices])
        if rate and left < UNLIMITED * rate:
            works = min(works, int(left // rate))
        elif left < 0:
            return NONE
        most = self._course.works_since.plus(works)
        return way.ended(behind).until(self._ends).within(
            way.time.plus(behind.duration - self._unpaid(mask)).until(most)).within(
            fixed(behind.end).until(most.plus(self._unpaid(-1))))

    def _unpaid(self, mask: int) -> int:
        """Return how long breaks are that aren't paid."""
        return sum([each.duration for number, each in enumerate(self._breaks)
                    if mask >> number & 1 and not each.paid])

    def _ended(self, mask: int, way: _Way) -> Iterator[Found]:
        """Yield a way with the begins for which it costs least."""
        lacking = [number for number in range(len(self._breaks)) if not mask >> number & 1]
        unpaid = self._unpaid(mask)
        for ways in product(*[[*self._without(number, _Following(), way)] for number in lacking]):
            begins = way.begins
            for each in ways:
                begins = begins.within(each)
            if not self._is_lenient:
                begins = begins.within(way.time.until(
                    self._course.works_since.plus(self._works + unpaid)))
            if begins:
                yield min([self._ranked(way, begin, lacking, unpaid) for begin in self._turns(
                    way._replace(begins=begins), unpaid)])

    def _turns(self, way: _Way, unpaid: int) -> Iterator[int]:
        """Yield the begins one of which costs least."""
        kind, turns = self._kind, way.turns(way.prices)
        turns |= {kind.latest - way.time.after, self._course.works_since.turn}
        if kind.max_working_duration is not None:
            turns.add(way.time.least - kind.max_working_duration - unpaid)
        yield from (begin for begin in turns if way.begins.first <= begin <= way.begins.last)

    def _ranked(self, way: _Way, begin: int, lacking: Sequence[int], unpaid: int) -> Found:
        """Return a way that begins then, and what is smaller for a better one."""
        kind, end = self._kind, way.time.at(begin)
        working = end - self._course.works_since.at(begin) - unpaid
        over = overtime(kind, end, working)
        cost = way.cost + sum([price.at(begin) for price in way.prices])
        rate = kind.overtime.cost_per_hour if kind.overtime else 0.0
        cost += (working * kind.cost_per_hour + over * rate) / MS_PER_HOUR
        if self._is_lenient:
            since = self._course.begin.at(begin)
            cost += max(0, over - allowed_overtime(kind)) * LATE
            cost += sum([is_due(self._breaks[number], since, end) for number in lacking]) * SKIPPED
        return ((round(cost, 9), len(way.breaks), end, -begin),
                TakenBreaks(begin, way.breaks))


def _priced(way: _Way, leg: Leg, ready: Instant, opens: int, start: Instant) -> _Way:
    """Return a way with what it costs to be early or late behind a leg."""
    late, once = (LATE, 0.0) if leg.late_cost is None else leg.late_cost
    prices, cost = way.prices, way.cost
    for price in (_Price(leg.node, start, leg.closes[-1], late, once),
                  _Price(leg.node, ready, opens, early=leg.early_cost)):
        first, last = price.at(way.begins.first), price.at(way.begins.last)
        if first == last:  # it only rises, or only falls
            cost += first
        else:
            prices |= {price}
    return way._replace(prices=prices, cost=cost)


def _undominated(ways: Sequence[_Way], behind: _Following) -> list[_Way]:
    """Return ways without those begins for which another one is no worse."""
    kept = list[_Way]()
    for way in sorted(ways, key=lambda way: (way.time.least, way.time.after)):
        parts = [way]
        for other in kept:
            if other.time.after <= way.time.after or other.time.least <= way.time.least:
                parts = [rest for part in parts for rest in _trimmed(part, other, behind)]
        for part in parts:
            kept = [rest for other in kept for rest in _trimmed(other, part, behind)]
        kept += parts
    return kept


def _trimmed(way: _Way, other: _Way, behind: _Following) -> list[_Way]:
    """Return a way without those begins for which another one is no worse."""
    both = way.begins.within(other.begins)
    if not both or (other.time.after > way.time.after and other.time.least > way.time.least):
        return [way]
    own, others = way.prices - other.prices, other.prices - way.prices
    turns = way.turns(own) | other.turns(others) | {
        *both, way.time.least - other.time.after, other.time.least - way.time.after}
    good = [(begin, _is_no_worse(other, way, others, own, behind, begin))
            for begin in sorted(turns) if both.first <= begin <= both.last]
    gone = [Begins(begin, end) for (begin, is_good), (end, stays_good) in pairwise(good)
            if is_good and stays_good]
    if both.first == both.last and good[0][1]:
        gone = [both]
    parts, first = list[_Way](), way.begins.first
    for each in gone:
        if first < each.first:
            parts.append(way._replace(begins=Begins(first, each.first - 1)))
        first = each.last + 1
    if first <= way.begins.last:
        parts.append(way._replace(begins=Begins(first, way.begins.last)))
    return parts


def _is_no_worse(one: _Way, other: _Way, ones: frozenset[_Price], others: frozenset[_Price],
                 behind: _Following, begin: int) -> bool:
    """Tell whether a way is no worse than another for a begin, whatever follows."""
    sooner = other.time.at(begin) - one.time.at(begin)
    if sooner < 0:
        return False
    cost = one.cost + sum([price.at(begin) for price in ones]) + sooner * behind.early_cost
    if cost > other.cost + sum([price.at(begin) for price in others]) + TOLERANCE:
        return False
    for node, mark, instead in zip(behind.marks, one.marks, other.marks, strict=True):
        later = mark.at(begin) - instead.at(begin)
        if (node in behind.most and later < 0) or (node in behind.least and later > 0):
            return False
    return True
