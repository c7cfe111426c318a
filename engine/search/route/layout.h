// The problem as the search reads it, and the routes that it changes.
//
// A route is a row of stops: each trip begins with a start at the depot and ends with an end there,
// customers of the truck between. Sorties name the stops where they begin and end by position in
// the route and are sorted by them. All else in the arrays follows from these and is written by
// `refresh`.
//
// Times inside a block of stops hang on the truck's arrival `t` as `max(t + d, c)`: `d` is the
// longest path of durations from there, `c` what windows and releases hold up. Such a `TimeSegment`
// adds up and takes maxima by parts, so that a block, a trip and a route are each one with an
// interval of arrivals at which all rules hold (Vidal et al. 2013, time-window segments, with
// drones). `docs/develop/route-times.md` derives what is made of them.
#pragma once

#include "deadline.h"
#include "rules/fairness.h"
#include "rules/window.h"

namespace tandem {

using StopLoad = tandem_stop_load;
using Stop = tandem_stop;
using Sortie = tandem_sortie;
using Trip = tandem_trip;
using Route = tandem_route;
using Place = tandem_place;
using SearchCounts = tandem_search_counts;
using SearchValues = tandem_search_values;
using Evaluation = tandem_evaluation;
using Strategy = tandem_strategy;
using Fleet = tandem_fleet;

// Where a customer is inserted; which fields tell, `kind` says.
struct Move {
    Int kind;
    Int slot;
    Int first;
    Int last;  // of a pair on a trip of its own, how the delivery is flown
    Int drone;
    Int sortie;
    Int type;
    Int halt;     // the launch site
    Int landing;  // that of recovery, if there are two; of a pair, the stop
    Int late;     // 1: a pair is flown to after others from and to the same stops; 2: its delivery
                  // from the last of several pickups behind a stop
    std::int32_t end[8];  // of several pickups, in order: the stop times 8, and the pickup's number
};

// `Stop.kind`.
constexpr Int customer_stop = 0;
constexpr Int halt_stop = 1;  // a launch site, where the truck stops for its drones alone
constexpr Int start_stop = 2;
constexpr Int end_stop = 3;

// `Sortie.state`.
constexpr Int sortie_waits = 0;
constexpr Int sortie_flies = 1;
constexpr Int sortie_done = 2;

// `Route.placed`.
constexpr Int breaks_by_end = 0;
constexpr Int breaks_kept = 1;
constexpr Int breaks_left_out = 2;

// Stamp of a route that this turn changes; any other stands for what the route in the slot is.
constexpr Int changing = 0;

// Stamp of a route of the best plan that was not made turn by turn: no route as it is has it.
constexpr Int others = -1;

// Slot of a customer who is left out; of one whom another thread deals with.
constexpr Int nowhere = -1;
constexpr Int elsewhere = -2;

// `SearchCounts.changed` where any slot may have changed since the best.
constexpr Int all_slots = -1;

// Tell whether the truck comes to a stop within a window: to a customer, or a launch site.
inline bool has_window(const tandem_stop& stop) { return stop.kind <= halt_stop; }

// The problem, with the deadline of the thread whose data it is.
struct ProblemData : tandem_problem_data {
    NodeTables place;
    Deadline deadline;
};

inline ProblemData data_of(const tandem_problem_data& from) {
    return {from, from.place, Deadline(from.deadline)};
}

// Slots behind those of the routes, in which changes are tried.
constexpr Int scratch_slots = 2;

struct Scratch;

struct Searcher : tandem_searcher {
    Fleet before;  // routes touched this turn, as they are listed there; who is where is not noted
    View<Int, 1> rank;           // (slot,) where it stands in `active`
    View<Int, 1> changed;        // slots changed since the best
    View<bool, 1> is_changed;    // (slot,) it is among those
    View<Int, 1> absent;         // to be inserted this turn, behind those left alone
    View<Int, 1> touched;        // slots changed this turn
    View<bool, 1> marked;        // (node,) removed this turn
    View<Int, 2> hit;            // (slot, trip) turn of the last string
    View<Int, 2> kept_stamp;     // (node, slot) of the route whose best insertion is kept
    View<Move, 2> kept_move;     // (node, slot) that insertion
    View<double, 2> kept_cost;   // (node, slot) what it costs
    Scratch* scratch = nullptr;  // where customers are inserted
};

// Copy what is chosen of a stop. In place.
inline void copy_sequence(const Stop& stop, Stop& to) {
    to.node = stop.node;
    to.kind = stop.kind;
    to.release = stop.release;
}

// Let a trip be empty, but for when its vehicle is charged before it. In place.
inline void clear_trip(Trip& trip) {
    trip.first = trip.last = trip.halts = trip.release = trip.distance = 0;
    for (Int dimension = 0; dimension < dimensions_per_tier; ++dimension) trip.load[dimension] = 0;
}

}  // namespace tandem
