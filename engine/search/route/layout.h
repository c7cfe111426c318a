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
#include "rows.h"
#include "rules/clock.h"
#include "rules/fairness.h"
#include "rules/leg.h"
#include "rules/load.h"
#include "search/route/move.h"

namespace tandem {

using SearchCounts = tandem_search_counts;
using SearchValues = tandem_search_values;
using Evaluation = tandem_evaluation;

// A stop of a truck: what is chosen, and all that follows.
struct Stop {
    Int node;
    Int kind;     // a customer, where a trip starts or ends, or a launch site
    Int release;  // of the trip that starts here
    Int leave;    // when the truck leaves
    Int latest;   // the last arrival that keeps all rules behind
    Int leg;      // how far it is to the next stop
    Int gap;      // how long that takes
    Int flying;   // drones in the air then
    Int trip, early, rest, end, cum, depart, arrival, before, block, last, d, c, hi, lo, dep, hold;
    Int idle;
    Int rests;       // breaks before the next, as rules/breaks.h packs them
    Int heavy;       // bits of breaks for which too much is aboard before the next
    Int start;       // of service, where lags count
    Int free_start;  // the latest that costs nothing, likewise; of a plan, its start
    double window_cost;
};

// A drone's way from a stop to its customers, and back at another or the same.
struct Sortie {
    Int launch;    // the position of the stop where it begins
    Int recovery;  // likewise, where it ends
    Int drone;     // its number on the truck
    Int count;     // of customers
    Int state;     // whether it waits, flies or is done, while its block is timed
    Int takeoff_d, takeoff_c, ready_d, ready_c, takeoff, begin, held, home, limit, left, taken;
    Int charged, kept, since, follows;
    Int zones;  // with hours, that hold any of its places
    Int nodes[8];
    Int arrivals[8];  // at the customers

    std::span<const Int> customers() const { return {nodes, std::size_t(count)}; }
    bool serves(Int node) const {
        return std::ranges::find(customers(), node) != customers().end();
    }
};

struct Trip {
    Int first, last;
    Int halts;  // stops at launch sites
    Int release, distance, barred;
    Int kept;  // relations by which others go on this trip
    Int load[3];
    Int wanted;         // of a battery as it begins, for it and all trips behind
    Int charged_from;   // when the vehicle is charged before it
    Int charged_until;  // the same as that where it isn't
};

// A vehicle's route, in a slot.
struct Route {
    Int type;
    Int length;  // of stops; 0 in an empty slot
    Int trips, sorties, end, cum, working;
    Leg legs;  // all of them as one, without setups, if they are limited
    Int offset, awaited;
    Int unpaid;   // breaks
    Int placed;   // where its breaks are: as it ends soonest, as they are, nowhere
    Int driving;  // at the wheel, of a driver who mustn't rest by rules, far if there are rests
    Int stamp;    // stands for what the route is; 0 while a turn changes it
    Int barred;
    Int kept;  // relations by which others go by this vehicle
};

// Where a customer is served.
struct Place {
    Int slot;      // of the route; -1 if left out, -2 if another thread's
    Int position;  // of the stop; else -1
    Int sortie;    // its number; else -1
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
inline bool has_window(const Stop& stop) { return stop.kind <= halt_stop; }

// The problem, with the deadline of the thread whose data it is.
struct ProblemData : ProblemTables, tandem_problem_data {
    NodeTables place;
    Deadline deadline;
};

inline ProblemData data_of(const tandem_problem_data& from) {
    return {from.problem, from, from.problem.node, Deadline(from.deadline)};
}

// How fast a type drives.
inline Speeds speeds_of(const ProblemData& data, Int k) {
    return {data.type[k], data.profile_time[k], data.profile_factor[k]};
}

// How many rows there are, as `model/search/route/room.py` counts them.
struct SearchRoom {
    Int routes, stops, trips, sorties;  // of a route, all but the first
};

// Slots behind those of the routes, in which changes are tried.
constexpr Int scratch_slots = 2;

// Routes, one a slot, and behind them those in which changes are tried.
struct Fleet {
    // Makes room, and notes where so many nodes are. Pages are touched only where routes are.
    Fleet(const ProblemData& data, const SearchRoom& room, Int nodes);

    OwnRows<Route, 1> route;   // (slot,)
    OwnRows<double, 1> cost;   // (slot,)
    OwnRows<double, 1> early;  // (slot,) of it, what waiting costs where trips are held back
    OwnRows<Stop, 2> stop;     // (slot, position)
    OwnRows<StopLoad, 3>
        stop_load;              // (slot, tier, position); no tiers where loads of trips tell all
    OwnRows<Trip, 2> trip;      // (slot, trip)
    OwnRows<Sortie, 2> sortie;  // (slot, sortie)
    OwnRows<Place, 1> where;    // (node,)
    OwnRows<Int, 1> used;       // (type,) routes
};

// A route, and rows with room for all that may be on it.
struct Tour {
    Route& route;
    View<Stop, 1> stops;
    View<Trip, 1> trips;
    View<Sortie, 1> sorties;
};

inline Tour tour_of(const Fleet& fleet, Int slot) {
    return {fleet.route[slot], fleet.stop[slot], fleet.trip[slot], fleet.sortie[slot]};
}

// The stops, the trips and the sorties of the route in a slot.
inline View<Stop, 1> stops_of(const Fleet& fleet, Int slot) {
    return fleet.stop[slot].first(fleet.route[slot].length);
}

inline View<Trip, 1> trips_of(const Fleet& fleet, Int slot) {
    return fleet.trip[slot].first(fleet.route[slot].trips);
}

inline View<Sortie, 1> sorties_of(const Fleet& fleet, Int slot) {
    return fleet.sortie[slot].first(fleet.route[slot].sorties);
}

struct Scratch;

// A search: its routes, and all that it works with.
struct Searcher {
    Searcher(const ProblemData& data, const SearchRoom& room);

    Fleet now;
    Fleet before;  // routes touched this turn, as they are listed there; who is where is not noted
    Fleet best;    // likewise
    std::unique_ptr<SearchCounts> count;
    std::unique_ptr<SearchValues> value;
    OwnRows<std::uint64_t, 1> rng;  // (1,)
    OwnRows<Int, 1> slots;          // all, of which `active` shows those that it may use
    View<Int, 1> active;            // slots in use, and behind them those that are free
    OwnRows<Int, 1> rank;           // (slot,) where it stands in `active`
    OwnRows<Int, 1> changed;        // slots changed since the best
    OwnRows<bool, 1> is_changed;    // (slot,) it is among those
    OwnRows<Int, 1> missing;        // customers left out
    OwnRows<Int, 1> best_missing;
    OwnRows<Int, 1> absent;            // to be inserted this turn, behind those left alone
    OwnRows<Int, 1> touched;           // slots changed this turn
    OwnRows<bool, 1> marked;           // (node,) removed this turn
    OwnRows<Int, 1> absences;          // (node,) turns after which a customer was left out
    OwnRows<Int, 2> hit;               // (slot, trip) turn of the last string
    OwnRows<Int, 2> kept_stamp;        // (node, slot) of the route whose best insertion is kept
    OwnRows<Move, 2> kept_move;        // (node, slot) that insertion
    OwnRows<double, 2> kept_cost;      // (node, slot) what it costs
    OwnRows<double, 3> alone;          // (type, 2, node) cost of a route that serves one customer
    std::shared_ptr<Scratch> scratch;  // where customers are inserted; none until somebody looks
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
