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
using Move = tandem_move;
using SearchCounts = tandem_search_counts;
using SearchValues = tandem_search_values;
using Evaluation = tandem_evaluation;
using Strategy = tandem_strategy;

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

struct ProblemData {
    std::int64_t num_depots;
    std::int64_t num_nodes;
    std::int64_t num_types;
    std::int64_t max_visits;  // customers on a sortie
    Strategy strategy;
    Fairness fairness;
    bool all_optional;                      // nobody has to be served
    double unassigned_cost;                 // of whoever it costs least to leave out
    View<const double, 1> unassigned_more;  // (node,) what leaving out another costs above that
    bool unassigned_costs_differ;           // leaving out some costs more than others
    View<const bool, 1> must_serve;  // (node,) leaving it out costs more than any route for one
    NodeTables place;
    View<const std::int64_t, 3>
        amount;  // (node, tier, entry); no tiers where the demand of nodes tells all
    View<const Price, 1> price;                   // (node,) per ms
    View<const Goods, 1> goods;                   // (node,) none where all go together
    View<const Setup, 1> setup;                   // (node,) none where nobody sets up
    View<const std::int64_t, 1> max_time_aboard;  // (node,) ms, none where nothing is limited
    View<const Pair, 1> pair;                     // (node,) none where nobody belongs together
    View<const std::int64_t, 2> max_between;      // (type, node) ms from a pickup to its delivery
    View<const Lag, 2> lag;                       // (node, rank) of who is served behind others
    View<const Lag, 2> across;           // (node, rank) behind or before them, by any vehicle
    View<Span, 1> span;                  // (node,) written as a route is timed
    View<tandem_plugging, 1> plugging;   // (number,) by depot and time, written likewise
    View<const double, 2> vehicle_cost;  // (type, node) of being served by it
    View<const bool, 1> no_launch;       // (node,) none where drones may take off anywhere
    View<const std::int64_t, 1> zones;   // (node,) with hours that hold it, none where none do
    View<const Hub, 1> hub;              // (depot,) none where all have enough
    View<const bool, 2> halts;  // (type, depot) launch sites where it may stop; (0, 0) if none
    View<const std::int64_t, 1> halt_after;  // (depot,) who is served before, or `nowhere`
    View<const double, 1> halt_cost;         // (depot,) of each stop there
    View<const std::int32_t, 2> near_halts;  // (node, rank) launch sites near a customer
    View<const VehicleType, 1> type;         // (row,)
    View<const Rate, 1> rate;                // (row,) per mm and per ms
    View<const Evaluation, 1> evaluation;    // (row,)
    View<const bool, 2> reload;              // (type, node) where a trip may end and the next begin
    View<const std::int64_t, 1> visits;      // (row,) customers on a sortie
    View<const bool, 3> can;                 // (row, 2, node) by truck, by drone
    View<const bool, 2> splice;              // (type, type) vehicles may end each other's routes
    View<const bool, 2>
        swap;   // (type, type) may drive each other's routes at a cost by distance alone
    Legs leg;   // duration, distance
    Legs back;  // the same, for those to a node
    View<const std::int64_t, 2> profile_time;    // (type, change)
    View<const std::int64_t, 2> profile_factor;  // (type, change + 1)
    View<const std::int32_t, 2> near;  // (node, rank) customers, nearest first, -1 behind the last
    View<const std::int32_t, 2>
        granular;       // (node, rank) customers whom a truck would visit before or after
    Deadline deadline;  // of the thread whose data it is
};

inline ProblemData data_of(const tandem_problem_data& from) {
    return {from.num_depots,
            from.num_nodes,
            from.num_types,
            from.max_visits,
            from.strategy,
            from.fairness,
            from.all_optional,
            from.unassigned_cost,
            from.unassigned_more,
            from.unassigned_costs_differ,
            from.must_serve,
            NodeTables(from.place),
            from.amount,
            from.price,
            from.goods,
            from.setup,
            from.max_time_aboard,
            from.pair,
            from.max_between,
            from.lag,
            from.across,
            from.span,
            from.plugging,
            from.vehicle_cost,
            from.no_launch,
            from.zones,
            from.hub,
            from.halts,
            from.halt_after,
            from.halt_cost,
            from.near_halts,
            from.type,
            from.rate,
            from.evaluation,
            from.reload,
            from.visits,
            from.can,
            from.splice,
            from.swap,
            legs_of(from.leg),
            legs_of(from.back),
            from.profile_time,
            from.profile_factor,
            from.near,
            from.granular,
            Deadline(from.deadline)};
}

// Slots behind those of the routes, in which changes are tried.
constexpr Int scratch_slots = 2;

struct Fleet {
    View<Route, 1> route;         // (slot,)
    View<double, 1> cost;         // (slot,)
    View<double, 1> early;        // (slot,) of it, what waiting costs where trips are held back
    View<Stop, 2> stop;           // (slot, position)
    View<StopLoad, 3> stop_load;  // (slot, tier, position); no tiers where loads of trips tell all
    View<Trip, 2> trip;           // (slot, trip)
    View<Sortie, 2> sortie;       // (slot, sortie)
    View<Place, 1> where;         // (node,)
    View<std::int64_t, 1> used;   // (type,) routes
};

inline Fleet fleet_of(const tandem_fleet& from) {
    return {from.route, from.cost,   from.early, from.stop, from.stop_load,
            from.trip,  from.sortie, from.where, from.used};
}

struct Scratch;

struct Searcher {
    Fleet now;
    Fleet before;  // those touched this turn, as they are listed there; who is where is not noted
    Fleet best;    // likewise not
    SearchCounts* count;
    SearchValues* value;
    View<std::uint64_t, 1> rng;     // (1,)
    View<std::int64_t, 1> active;   // slots in use, and behind them those that are free
    View<std::int64_t, 1> rank;     // (slot,) where it stands in `active`
    View<std::int64_t, 1> changed;  // slots changed since the best
    View<bool, 1> is_changed;       // (slot,) it is among those
    View<std::int64_t, 1> missing;  // customers left out
    View<std::int64_t, 1> best_missing;
    View<std::int64_t, 1> absent;      // to be inserted this turn, behind those left alone
    View<std::int64_t, 1> touched;     // slots changed this turn
    View<bool, 1> marked;              // (node,) removed this turn
    View<std::int64_t, 1> absences;    // (node,) turns after which a customer was left out
    View<std::int64_t, 2> hit;         // (slot, trip) turn of the last string
    View<double, 3> alone;             // (type, 2, node) cost of a route that serves one customer
    View<std::int64_t, 2> kept_stamp;  // (node, slot) of the route whose best insertion is kept
    View<Move, 2> kept_move;           // (node, slot) that insertion
    View<double, 2> kept_cost;         // (node, slot) what it costs
    Scratch* scratch = nullptr;        // where customers are inserted
};

inline Searcher searcher_of(const tandem_searcher& from) {
    return {fleet_of(from.now),
            fleet_of(from.before),
            fleet_of(from.best),
            from.count,
            from.value,
            from.rng,
            from.active,
            from.rank,
            from.changed,
            from.is_changed,
            from.missing,
            from.best_missing,
            from.absent,
            from.touched,
            from.marked,
            from.absences,
            from.hit,
            from.alone,
            from.kept_stamp,
            from.kept_move,
            from.kept_cost};
}

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
