"""What the study's figures say, in sentences made from them."""

import statistics
from collections.abc import Callable, Iterable, Sequence
from itertools import combinations, pairwise

from benchmarks.study.tables import (
    differences, markdown, over_seeds, percent, rates_of_demands, rises, surface_of,
)
from benchmarks.study.tasks import (
    FLEETS, GREEDY, MIXED, NOBODY, POLICIES, SAMPLED, SINGLE, Planned, TripRow,
)

TABLE_OF_SIZE = {25: 3, 50: 4, 100: 5}
"""The paper's table of a number of customers."""

CLAIMED_LEAST = {25: 85, 50: 80, 100: 76}
"""Least load of the heterogeneous fleets' trips as the paper's text has it, in percent."""

CLAIMED_BEST = {25: (200, 7.5), 50: (110, 6.5), 100: (200, 8.0)}
"""Capacity and hours of the least cost in the paper's text."""

CLAIMED_WORST = {25: "4 h, with every capacity", 50: "100 at 11 h", 100: "100 at 6.5 h"}

WELL_LOADED, GOAL = 0.8, 0.9

FLAT = 0.005
"""Costs are called the same within this share."""


def words_of(values: Iterable[float], form: str) -> str:
    """Return numbers as people list them."""
    *head, last = [format(value, form) for value in values]
    return f"{', '.join(head)} and {last}" if head else last


def sizes_of(rows: Sequence[Planned]) -> list[int]:
    """Return the numbers of customers."""
    return sorted({row.customers for row in rows})


def shown_trips(rows: Sequence[Planned], trips: Sequence[TripRow]) -> list[TripRow]:
    """Return the trips of the first case's best plan, of each size, by single and mixed fleet."""
    shown: list[TripRow] = []
    for size in sizes_of(rows):
        for fleet in (SINGLE, MIXED):
            best = min((row for row in rows if (row.customers, row.case, row.fleet) == (
                size, 1, fleet)), key=lambda row: row.cost)
            shown += [trip for trip in trips if (
                trip.customers, trip.case, trip.fleet, trip.seed) == (size, 1, fleet, best.seed)]
    return shown


def mixed_rates(trips: Sequence[TripRow], size: int) -> list[float]:
    """Return the load rates of all trips of mixed fleets of a size."""
    return [trip.load_rate for trip in trips if (trip.customers, trip.fleet) == (size, MIXED)]


def on_fleets(rows: Sequence[Planned], trips: Sequence[TripRow]) -> list[str]:
    """Say whether mixed fleets are fuller and cheaper."""
    sizes = sizes_of(rows)
    rates = {size: mixed_rates(trips, size) for size in sizes}
    means = [100 * statistics.fmean(rates[size]) for size in sizes]
    reached = all(mean >= 100 * GOAL for mean in means)
    changes = [100 * (_total(rows, size, MIXED) / _total(rows, size, SINGLE) - 1)
               for size in sizes]
    best = [100 * statistics.fmean(differences(rows, size, SINGLE)) for size in sizes]
    used = [100 * _used(trips, size) for size in sizes]
    lines = [
        f"- A trip of a mixed fleet is loaded {words_of(means, '.1f')} % in the mean, with "
        f"{words_of(sizes, 'd')} customers. The 90 % aimed at is "
        f"{'reached' if reached else 'not reached everywhere'}. Of all capacity sent out, "
        f"{words_of(used, '.1f')} % are used. Its total cost is {words_of(changes, '+z.1f')} % "
        "beside trucks of 150. With the best seed of each case that is "
        f"{words_of(best, '+z.1f')} %.",
        f"- Is every trip above 80 %, as the paper finds? No: "
        f"{words_of([100 * _well_loaded(rates[size]) for size in sizes], '.0f')} % of the trips "
        f"are. The least are {words_of([100 * min(rates[size]) for size in sizes], '.0f')} %. "
        f"The paper's text names {words_of([CLAIMED_LEAST[size] for size in sizes], 'd')} % as "
        f"least, by one plan of each size. Its demands and capacities make "
        f"{words_of([_least_of_demands(size) for size in sizes], '.0f')} %. The last "
        "trip carries what is left, and a fuller one that costs more is no better."]
    if all(_well_loaded(rates[size]) == 1 for size in sizes):
        lines[1] = "- Every trip of mixed fleets is loaded above 80 %, as the paper finds."
    if not reached:
        lines.append(_why_not(rows))
    return lines


def _least_of_demands(size: int) -> float:
    """Return the least load of the paper's mixed fleet by its own demands, in percent."""
    return min(rates_of_demands(TABLE_OF_SIZE[size], "heterogeneous"))


def _why_not(rows: Sequence[Planned]) -> str:
    """Say why trips of mixed fleets aren't fuller."""
    full = [sum(load >= GOAL for load in _best_loads(rows, size)) for size in sizes_of(rows)]
    cases = len(_best_loads(rows, sizes_of(rows)[0]))
    pairs = [(one, other) for one, other in combinations(rows, 2)
             if (one.customers, one.case) == (other.customers, other.case)
             and abs(one.cost - other.cost) > 1e-6 * one.cost
             and abs(one.mean_load_rate - other.mean_load_rate) > 0.001]
    dearer = sum((one.mean_load_rate > other.mean_load_rate) == (one.cost > other.cost)
                 for one, other in pairs)
    return (f"- Why not? The best plan of the mixed fleet reaches 90 % in {words_of(full, 'd')} of "
            f"{cases} cases. But nobody pays for a load rate. Of two plans of one case, the fuller "
            f"one is the dearer in {percent(dearer / max(len(pairs), 1), 0)} %. A truck of 200 "
            "costs 10 % more per km than one of 150, and has a third more room. So it is cheap to "
            "send it out with room left.")


def _best_loads(rows: Sequence[Planned], size: int) -> list[float]:
    """Return the mean load rate of the mixed fleet's cheapest plan, case by case."""
    best: dict[int, Planned] = {}
    for row in rows:
        if (row.customers, row.fleet) == (size, MIXED) and (
                row.case not in best or row.cost < best[row.case].cost):
            best[row.case] = row
    return [row.mean_load_rate for row in best.values()]


def _used(trips: Sequence[TripRow], size: int) -> float:
    mixed = [trip for trip in trips if (trip.customers, trip.fleet) == (size, MIXED)]
    return sum(trip.demand for trip in mixed) / sum(trip.capacity for trip in mixed)


def _total(rows: Sequence[Planned], size: int, fleet: str) -> float:
    return over_seeds([row for row in rows if (row.customers, row.fleet) == (size, fleet)],
                      lambda row: row.cost)[0]


def _well_loaded(rates: Sequence[float]) -> float:
    return sum(rate > WELL_LOADED for rate in rates) / len(rates)


def on_search(rows: Sequence[Planned]) -> list[str]:
    """Say where a fleet that may use any truck came out dearer than one of fewer kinds."""
    others = [fleet for fleet in FLEETS if fleet != MIXED]
    shares = [share for size in sizes_of(rows) for fleet in others
              for share in differences(rows, size, fleet)]
    dearer = [share for share in shares if share > 1e-9]
    if not dearer:
        return ["- What one capacity can do all three can too. In no case was the mixed fleet "
                "dearer."]
    return ["- What one capacity can do all three can too. Where the mixed fleet is dearer, the "
            f"search has failed. It did in {len(dearer)} of {len(shares)} comparisons, by "
            f"{percent(statistics.fmean(dearer), 2)} % in their mean and "
            f"{percent(max(dearer), 2)} % at most."]


def on_hours(rows: Sequence[Planned]) -> list[str]:
    """Hold the paper's findings on hours and capacity against the surfaces."""
    lines = []
    for size in sizes_of(rows):
        surface = surface_of(rows, size)
        (capacity, limit), least = min(surface.items(), key=lambda item: item[1])
        (most_capacity, most_limit), most = max(surface.items(), key=lambda item: item[1])
        flat = [hours for (room, hours), cost in surface.items()
                if room == capacity and cost <= least * (1 + FLAT)]
        best = "{} at {:g} h".format(*CLAIMED_BEST[size])
        lines.append([str(size), best, f"{capacity} at {limit:g} h ({least:.1f})",
                      f"{min(flat):g} to {max(flat):g} h", CLAIMED_WORST[size],
                      f"{most_capacity} at {most_limit:g} h ({most:.1f})"])
    return [
        *markdown(["customers", "least cost, paper", "here", f"within {100 * FLAT:g} % of it",
                   "most, paper", "here"], lines, words=0), "",
        *_on_capacity(rows), *_on_longer_days(rows)]


def _on_capacity(rows: Sequence[Planned]) -> list[str]:
    steps, cheaper = 0, 0
    for size in sizes_of(rows):
        surface = surface_of(rows, size)
        for limit in {hours for _, hours in surface}:
            costs = [cost for (_, hours), cost in sorted(surface.items()) if hours == limit]
            steps += len(costs) - 1
            cheaper += sum(later < sooner for sooner, later in pairwise(costs))
    verdict = "always" if cheaper == steps else f"in {cheaper} of {steps} steps"
    return [f"- Does capacity help? The next larger truck is cheaper in the mean {verdict}. Costs "
            "rise less than capacity does."]


def _on_longer_days(rows: Sequence[Planned]) -> list[str]:
    dearer, steps, most = rises(rows)
    return ["- A longer day forbids nothing, so the best plan can't become dearer with it. Of the "
            f"{steps} steps to more hours {dearer} did, by {percent(most, 2)} % at most: so much "
            "the search misses. The paper has the least cost at 6.5 to 8 h. That can come from a "
            "search that misses, or from a cost per hour that it doesn't tell of.",
            f"- Short days are dear. Those of {_of_days(rows, min)}. Those of "
            f"{_of_days(rows, max)}."]


def _of_days(rows: Sequence[Planned], chosen: Callable[[Iterable[float]], float]) -> str:
    """Say how many trucks the shortest or longest days take, and how full."""
    limit = chosen({row.hours for row in rows})
    mine = [row for row in rows if row.hours == limit]
    return (f"{limit:g} h take {statistics.fmean(row.vehicles for row in mine):.1f} trucks in the "
            f"mean, loaded {100 * statistics.fmean(row.mean_load_rate for row in mine):.0f} %")


def on_drones(rows: Sequence[Planned]) -> list[str]:
    """Say what drones, windows and speeds cost or save."""
    def saved(drones: int, fewer: int) -> float:
        return -100 * _change(rows, lambda row: row.drones == drones,
                              lambda row: row.drones == fewer)

    lines = [f"- One drone on each truck saves {saved(1, 0):.1f} % of the total in the mean. The "
             f"second saves {saved(2, 1):.1f} % more."]
    for windows in ("soft", "hard"):
        with_them = [row for row in rows if row.windows in (windows, "off")]
        more = 100 * _change(with_them, lambda row: row.windows != "off",
                             lambda row: row.windows == "off")
        lines.append(f"- {windows.capitalize()} windows: {more:+.1f} % beside none.")
    slower = 100 * _change(rows, lambda row: row.speeds != "fixed",
                           lambda row: row.speeds == "fixed")
    lines.append(f"- Rush hours: {slower:+.1f} % beside a fixed speed.")
    left_out = sum(row.unassigned for row in rows)
    lines.append(f"- Customers left out in all these plans: {left_out}.")
    return lines


def _change(rows: Sequence[Planned], one: Callable[[Planned], bool],
            other: Callable[[Planned], bool]) -> float:
    """Return by how much the mean cost differs, as a share."""
    return (statistics.fmean(row.cost for row in rows if one(row))
            / statistics.fmean(row.cost for row in rows if other(row)) - 1)


def on_policies(rows: Sequence[Planned]) -> list[str]:
    """Say what the policies are worth, alone and as a start."""
    def beside(decoding: str, turns_of: Callable[[Planned], bool], policy: str,
               other: str) -> float:
        pairs = {(row.customers, row.case, row.policy): row.cost for row in rows
                 if row.decoding == decoding and turns_of(row) and not row.unassigned}
        shares = [cost / pairs[size, case, other] - 1 for (size, case, name), cost in pairs.items()
                  if name == policy and (size, case, other) in pairs]
        return 100 * statistics.fmean(shares)

    first, second = POLICIES
    alone = [beside(decoding, lambda row: not row.turns, first, second)
             for decoding in (GREEDY, SAMPLED)]
    lines = [f"- Alone, plans of `{first}` cost {words_of(alone, '+z.1f')} % beside those of "
             f"`{second}`. That is greedily and by 128 samples, where both serve everybody."]
    for turns in sorted({row.turns // row.customers for row in rows} - {0}):
        def with_turns(row: Planned, turns: int = turns) -> bool:
            return row.turns == turns * row.customers

        values = [beside(GREEDY, with_turns, name, NOBODY) for name in POLICIES]
        lines.append(f"- After {turns} turns a customer, searches begun by them end at "
                     f"{words_of(values, '+z.1f')} % beside insertion's.")
    return lines
