// Routes as linked stops.
#pragma once

#include <limits>

#include "search/route/layout.h"

namespace tandem {

// A customer on linked stops. Times are kept only where something limits them. A cache line.
struct Link {
    Int slot;    // of the route
    Int before;  // who comes before, or the depot there
    Int behind;  // likewise
    Int inward;  // how far it is from there
    Int onward;  // and to who comes behind
    Int gap;     // how long that takes
    Int leave;   // when the vehicle does
    Int latest;  // when it has to come
};

// A linked route. Where there is nobody, its end comes first and its beginning last.
struct Run {
    Int type;
    Int first;  // customer
    Int last;   // customer
    Int count;  // of customers
    Int distance;
    Int load[3];
};

// Customers in a row that were taken out this turn.
struct Piece {
    Int slot;  // of their route
    Int type;  // that drove it then
    Int count;
    Int gap;    // of the leg to who came behind
    Int saved;  // how much shorter the route is without them
};

// A customer inserted this turn.
struct Entry {
    Int node;
    Int onward;  // how far the leg was that it came between
    Int gap;     // how long that took
};

// Times of a customer before they changed this turn.
struct Moment {
    Int node, leave, latest;
};

// How many of each were noted this turn.
struct NoteCounts {
    Int pieces, removed, entries, moments, retyped;
    Int over;  // whether there were more moments than there is room
};

// What the vehicle costs that is cheapest.
struct CheapestVehicle {
    double distance;  // a mm more
    double stop;      // a customer more
};

// Beside whom no place is near enough, however long a detour may be.
constexpr Int out_of_reach = -far;

// From which distance on `Linked::near` doesn't tell.
constexpr std::int32_t farthest = std::numeric_limits<std::int32_t>::max();

// How near the neighbours that `ProblemData::granular` lists are, in mm to or from them, or what
// fits.
using Nearness = OwnRows<std::int32_t, 2>;

struct Linked {
    // Makes room for the routes of a search, and for so many changes of times in a turn, none where
    // nothing limits when customers are served.
    Linked(const ProblemData& data, const Searcher& searcher, Int moments,
           std::shared_ptr<const Nearness> measured);

    OwnRows<Link, 1> link;         // (node,)
    OwnRows<Run, 1> run;           // (slot,)
    OwnRows<Piece, 1> piece;       // (piece,)
    OwnRows<Link, 1> removed;      // (customer,) of the pieces one after another
    OwnRows<Int, 1> removed_node;  // (customer,) who that is
    OwnRows<Entry, 1> entry;       // (customer,)
    OwnRows<Moment, 1> moment;     // (moment,)
    OwnRows<Int, 1> retyped;       // (slot,) routes that another type drives since this turn
    OwnRows<Int, 1> former;        // (slot,) the type that did before, else `nowhere`
    NoteCounts noted{};
    OwnRows<Int, 1> hit;  // (slot,) turn of the last string
    std::shared_ptr<const Nearness> measured;
    View<const std::int32_t, 2> near;  // (node, rank) of those
    OwnRows<Int, 1> best_first;   // (slot,) first customer of the best plan's route, else `nowhere`
    OwnRows<Int, 1> best_type;    // (slot,)
    OwnRows<Int, 1> best_behind;  // (node,)
    CheapestVehicle cheapest;     // of all types
    bool timed;                   // something limits when customers are served
    // (node,) the longer of a customer's legs, `out_of_reach` of one on no route. That is all that
    // tells of most neighbours that a place beside them is too far, and many fit a cache.
    OwnRows<Int, 1> reach;
    // (tier, row) what is aboard around customers, by node, and behind all nodes where the route of
    // each slot begins and where it ends; no tiers where `Run::load` tells all. A route's rows are
    // written as soon as somebody asks.
    OwnRows<StopLoad, 2> aboard;
    OwnRows<bool, 1> stale;  // (slot,) its rows aren't written since it changed
    bool one_travel;         // all vehicles drive by the same legs
};

// Whether all vehicles drive by the same legs.
bool is_one_travel(const ProblemData& data);

}  // namespace tandem

// As C knows it.
struct tandem_linked final : tandem::Linked {
    using Linked::Linked;
};
