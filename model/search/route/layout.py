"""Arrays of the search: the problem as it reads it, and the routes that it changes.

A route is a row of stops: each trip begins with a START at the depot and ends with an END there,
customers of the truck between. Sorties name the stops where they begin and end by position in the
route and are sorted by them. All else in the arrays follows from these and is written by the
engine; `tandem.h` says what rows hold.

Times inside a block of stops hang on the truck's arrival `t` as `max(t + d, c)`: `d` is the longest
path of durations from there, `c` what windows and releases hold up. Such pairs add up and take
maxima by parts, so that a block, a trip and a route are each a pair with an interval of arrivals
at which all rules hold (Vidal et al. 2013, time-window segments, with drones).
`docs/develop/route-times.md` derives what is made of them.
"""

from typing import NamedTuple

from model.engine.leg import AllLegs
from model.engine.records import Records
from model.problem import BoolArray, FloatArray, Int32Array, IntArray

MOST_VISITS = 8
"""Customers on a sortie that the search puts there at most."""

CUSTOMER, HALT, START, END = range(4)

OTHERS = -1
"""Stamp of a route of the best plan that was not made turn by turn: no route as it is has it."""

NOWHERE, ELSEWHERE = -1, -2
"""Slot of a customer who is left out; of one whom another thread deals with."""


class Strategy(NamedTuple):
    """How a problem is searched: which moves there are, and where insertion looks."""

    loops: bool  # sorties may end at the stop where they began
    crossings: bool  # and at others
    two_opt_star: bool  # routes swap their tails
    resplit: bool  # trips with one drone are split anew between truck and drone
    small_moves: bool  # trips with one drone are annealed by small moves, too
    swap_vehicles: bool  # vehicles drive each other's routes, whose distance tells what they cost
    change_vehicles: bool  # routes are timed anew with vehicles of other types
    scan_all: bool  # insertion looks at all routes, else beside neighbours alone
    keep_places: bool  # customers' best places on routes are kept from turn to turn
    give_up_early: bool  # a turn ends once it costs too much, as no insertion saves anything
    fly_shipments: bool  # drones may serve some end of a shipment
    blink: float  # how often a better place for a customer is overlooked


class PlanPrices(NamedTuple):
    """What a plan costs as a whole."""

    makespan: float  # per ms of its last end
    balance: float  # per part of the measure
    measure: int  # index into MEASURES
    min_vehicles: int
    too_few: float  # of each vehicle fewer
    used: float = 0.0  # how many vehicles, in any case
    sum: float = 0.0  # of their shares
    squares: float = 0.0  # of their shares
    latest: int = 0  # ms, their last end

    @property
    def unused(self) -> float:
        """Return what it costs that nobody else does anything."""
        unequal = self.used * self.squares / self.sum - self.sum if self.sum > 0 else 0.0
        return (self.makespan * self.latest + self.balance * max(0.0, unequal)
                + self.too_few * max(0.0, self.min_vehicles - self.used))


MEASURES = "duration", "stops", "load", "distance"


class ProblemData(NamedTuple):
    """The problem, unchanged by the search."""

    num_depots: int
    num_nodes: int
    num_types: int
    max_visits: int  # customers on a sortie
    strategy: Strategy
    fairness: PlanPrices
    all_optional: bool  # nobody has to be served
    unassigned_cost: float  # of whoever it costs least to leave out
    unassigned_more: FloatArray  # (node,) what leaving out another costs above that
    unassigned_costs_differ: bool  # leaving out some costs more than others
    must_serve: BoolArray  # (node,) leaving it out costs more than any route for one
    place: Records  # (variant, node, row)
    amount: IntArray  # (node, tier, AMOUNTS); no tiers where the demand of nodes tells all
    price: Records  # (node,), per ms
    goods: Records  # (node,), none where all go together
    setup: Records  # (node,), none where nobody sets up
    max_time_aboard: IntArray  # (node,) ms, none where nothing is limited
    pair: Records  # (node,), none where there are no shipments
    max_between: IntArray  # (type, node) ms from a pickup to its delivery, none where unlimited
    lag: Records  # (node, rank) how long behind others each is served, none likewise
    across: Records  # (node, rank) behind or before them by any vehicle, none likewise
    span: Records  # (node,) from when to when, as a route is timed, none likewise
    plugging: Records  # (number,) as a route is timed, none where nobody waits to be charged
    vehicle_cost: FloatArray  # (type, node) of being served by it, none where nobody states any
    no_launch: BoolArray  # (node,) no drone takes off there; none where any may
    zones: IntArray  # (node,) with hours that hold it, as bits; none where none do
    hub: Records  # (depot,), none where all have enough
    halts: BoolArray  # (type, depot) launch sites where it may stop; (0, 0) if there are none
    halt_after: IntArray  # (depot,) who is served before a stop there, or NOWHERE
    halt_cost: FloatArray  # (depot,) of each stop there
    near_halts: Int32Array  # (node, rank) launch sites near a customer, NOWHERE behind the last
    type: Records  # (row,)
    rate: Records  # (row,), per mm and per ms
    evaluation: Records  # (row,)
    reload: BoolArray  # (type, node) where a trip may end and the next begin
    visits: IntArray  # (row,) customers on a sortie
    can: BoolArray  # (row, 2, node) by truck, by drone
    splice: BoolArray  # (type, type) vehicles may end each other's routes
    swap: BoolArray  # (type, type) may drive each other's routes at a cost by distance alone
    leg: AllLegs  # duration, distance
    back: AllLegs  # the same, for those to a node
    profile_time: IntArray  # (type, change)
    profile_factor: IntArray  # (type, change + 1)
    near: Int32Array  # (node, rank) customers, nearest first, -1 behind the last
    granular: Int32Array  # (node, rank) customers whom a truck would visit before or after
    deadline: IntArray  # (2,) when the search must end, as `model.engine.alarm` says


def are_kept(data: ProblemData) -> BoolArray:
    """Mark the nodes (none where nobody is) of customers who go together with others."""
    company = data.goods
    kept: BoolArray = (company["kept_on_trip"] | company["kept_on_vehicle"]) != 0
    return kept


class Fleet(NamedTuple):
    """Routes, one a slot; the last two slots are scratch."""

    route: Records  # (slot,)
    cost: FloatArray  # (slot,)
    early: FloatArray  # (slot,) of it, what waiting costs where trips are held back
    stop: Records  # (slot, position)
    stop_load: Records  # (slot, tier, position); no tiers where the load of trips does
    trip: Records  # (slot, trip)
    sortie: Records  # (slot, sortie)
    where: Records  # (node,)
    used: IntArray  # (type,) routes
