// The memory that a search takes: its routes, and all that it works with.
#pragma once

#include <memory>

#include "rows.h"
#include "search/scratch.h"

namespace tandem {

// How many rows there are, as `model/search/beginning/room.py` counts them.
struct SearchRoom {
    Int routes, stops, trips, sorties;  // of a route, all but the first
};

// Routes, one a slot, and behind them those in which changes are tried. Pages are touched only
// where routes are.
struct OwnFleet {
    // Notes where so many nodes are.
    OwnFleet(const ProblemData& data, const SearchRoom& room, Int nodes);

    Fleet view() const { return {route, cost, early, stop, stop_load, trip, sortie, where, used}; }

    OwnRows<Route, 1> route;
    OwnRows<double, 1> cost, early;
    OwnRows<Stop, 2> stop;
    OwnRows<StopLoad, 3> stop_load;
    OwnRows<Trip, 2> trip;
    OwnRows<Sortie, 2> sortie;
    OwnRows<Place, 1> where;
    OwnRows<Int, 1> used;
};

// Its fields are those of `Searcher`.
struct Search {
    Search(const ProblemData& data, const SearchRoom& room);

    OwnFleet now, before, best;
    SearchCounts count{};
    SearchValues value{};
    OwnRows<std::uint64_t, 1> rng;
    OwnRows<Int, 1> active, rank, changed;
    OwnRows<bool, 1> is_changed;
    OwnRows<Int, 1> missing, best_missing, absent, touched;
    OwnRows<bool, 1> marked;
    OwnRows<Int, 1> absences;
    OwnRows<Int, 2> hit, kept_stamp;
    OwnRows<Move, 2> kept_move;
    OwnRows<double, 2> kept_cost;
    std::unique_ptr<Scratch> scratch;  // none until somebody looks
};

// The search that Python sees, with all that it works with.
Searcher searcher_of(const tandem_searcher& from);

// The same, with room for what it writes down while it looks, for one call at a time.
Searcher looking(const ProblemData& data, const tandem_searcher& from);

}  // namespace tandem

// As C knows it.
struct tandem_search final : tandem::Search {
    using Search::Search;
};
