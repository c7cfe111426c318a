"""Arrays of the search: the problem as it reads it, and the routes that it changes.

A route is a row of stops: each trip begins with a START at the depot and ends with an END there,
customers of the truck between. Sorties name the stops where they begin and end by position in the
route and are sorted by them. All else in the arrays follows from these and is written by
`refresh.refresh`.

Times inside a block of stops hang on the truck's arrival `t` as `max(t + d, c)`: `d` is the longest
path of durations from there, `c` what windows and releases hold up. Such pairs add up and take
maxima by parts, so that a block, a trip and a route are each a pair with an interval of arrivals
at which all rules hold (Vidal et al. 2013, time-window segments, with drones).
"""

from typing import NamedTuple

import numpy as np

from model.problem import BoolArray, FloatArray, IntArray

(S_NODE, S_KIND, S_RELEASE, S_LEAVE, S_LATEST, S_LEG, S_GAP, S_FLYING, S_TRIP, S_EARLY, S_REST,
 S_END, S_CUM, S_DEPART, S_ARRIVAL, S_BEFORE, S_BLOCK, S_LAST, S_D, S_C, S_HI, S_LO, S_DEP,
 S_HOLD, S_IDLE) = range(25)
STOP_COLUMNS = 25
SEQUENCE_COLUMNS = 3
"""The first columns of a stop, which are chosen; the others follow."""
LEAN_COLUMNS = 9
"""The first columns of a stop, which are all that a lean route needs."""

CUSTOMER, START, END = range(3)

(F_LAUNCH, F_RECOVERY, F_DRONE, F_COUNT, F_STATE, F_TAKEOFF_D, F_TAKEOFF_C, F_READY_D, F_READY_C,
 F_TAKEOFF, F_BEGIN, F_HELD, F_NODE) = range(13)
WAITING, FLYING, DONE = range(3)

T_FIRST, T_LAST, T_RELEASE, T_DISTANCE, T_LOAD = range(5)
TRIP_COLUMNS = 8

(R_TYPE, R_LENGTH, R_TRIPS, R_SORTIES, R_END, R_CUM, R_WORKING, R_OFFSET, R_STAMP) = range(9)
ROUTE_COLUMNS = 9

CHANGING = 0
"""Stamp of a route that this turn changes; any other stands for what the route in the slot is."""

K_STAMP, K_DETOUR, K_STOP = range(3)
"""Stamp of the route, shortest detour for a customer, stop before it; -1 if none is that short."""
KEPT_COLUMNS = 3
K_MOVE = 1
"""Where routes are not lean, what follows the stamp is the best insertion, as in `edit`."""

B_BEST, B_BLINK = range(2)
"""Cost below which insertions are looked for, and how often one is overlooked."""

W_SLOT, W_POSITION, W_SORTIE = range(3)
NOWHERE, ELSEWHERE = -1, -2
"""Slot of a customer who is left out; of one whom another thread deals with."""

MODE_TIMED, MODE_PRICED, MODE_SETTLED, MODE_PROFILE, MODE_SIMPLE, MODE_LEAN = 1, 2, 4, 8, 16, 32
"""Flags of a type: working time costs or is limited; lateness or waiting cost, or speed changes;
trips must be held back to know the cost; speed changes; an insertion's cost is that of its distance
alone; as that, with one trip of any distance, no releases and no drones."""


class World(NamedTuple):
    """The problem, unchanged by the search."""

    num_depots: int
    num_nodes: int
    num_types: int
    max_visits: int  # customers on a sortie
    tails: bool  # routes may swap their tails
    single_drones: bool  # some type has one drone, and trips may be split anew
    loops: bool  # sorties may end where they began
    crossings: bool  # sorties may end elsewhere
    general: bool  # insertions may cost more than their detour; else all routes are lean
    traded: bool  # vehicles may drive each other's routes
    mixed: bool  # types of vehicles, some of whose routes are not lean, may drive each other's
    scan_all: bool  # else insertion looks beside neighbours only
    adds_up: bool  # to insert a customer never saves anything, if no detour does
    keeps: bool  # customers' best places on routes are kept from turn to turn
    blink: float  # how often a better place for a customer is overlooked
    unassigned_cost: float  # of whoever it costs least to leave out
    unassigned_more: FloatArray  # (node,) what leaving out another costs above that
    must_serve: BoolArray  # (node,) leaving it out costs more than any route for one
    place: IntArray  # (node, NODE_COLUMNS)
    price: FloatArray  # (node, 2) cost per ms of lateness and of waiting
    type: IntArray  # (type, TYPE_COLUMNS)
    rate: FloatArray  # (type, 5) fixed, per mm, per ms, per mm and ms of drones
    mode: IntArray  # (type,) MODE_ flags
    visits: IntArray  # (type,) customers on a sortie
    can: BoolArray  # (type, 2, node) by truck, by drone
    swap: BoolArray  # (type, type) may drive each other's routes at a cost by distance alone
    leg: IntArray  # (travel, origin, to, 2) duration, distance
    back: IntArray  # (travel, to, origin, 2) the same
    profile_time: IntArray  # (type, change)
    profile_factor: IntArray  # (type, change + 1)
    near: IntArray  # (node, rank) customers, nearest first, -1 behind the last
    fit: IntArray  # (node, rank) customers whom a truck would visit before or after
    stop: IntArray  # (1,) not 0 once the search must end, as `model.kernel.alarm` says


class Fleet(NamedTuple):
    """Routes, one a slot; the last two slots are scratch."""

    route: IntArray  # (slot, ROUTE_COLUMNS)
    cost: FloatArray  # (slot,)
    early: FloatArray  # (slot,) of it, what waiting costs where trips are held back
    stop: IntArray  # (slot, position, STOP_COLUMNS)
    trip: IntArray  # (slot, trip, TRIP_COLUMNS)
    sortie: IntArray  # (slot, sortie, F_NODE + 2 * max_visits) customers, then their arrivals
    where: IntArray  # (node, 3) slot, position of the stop or -1, sortie or -1
    used: IntArray  # (type,) routes


def empty_fleet(world: World, slots: int, stops: int, trips: int, sorties: int) -> Fleet:
    """Allocate a fleet without routes. Pages are touched only where routes are."""
    return Fleet(
        route=np.zeros((slots + 2, ROUTE_COLUMNS), np.int64),
        cost=np.zeros(slots + 2),
        early=np.zeros(slots + 2),
        stop=np.zeros((slots + 2, stops, STOP_COLUMNS), np.int64),
        trip=np.zeros((slots + 2, trips, TRIP_COLUMNS), np.int64),
        sortie=np.zeros((slots + 2, sorties, F_NODE + 2 * world.max_visits), np.int64),
        where=np.full((world.num_nodes, 3), NOWHERE, np.int64),
        used=np.zeros(world.num_types, np.int64),
    )
