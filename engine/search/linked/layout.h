// Routes as linked stops.
#pragma once

#include <limits>

#include "search/route/layout.h"

namespace tandem {

using Link = tandem_link;
using Run = tandem_run;
using Piece = tandem_piece;
using Entry = tandem_entry;
using Moment = tandem_moment;
using Noted = tandem_noted;
using Least = tandem_least;

// Beside whom no place is near enough, however long a detour may be.
constexpr Int out_of_reach = -far;

// From which distance on `Linked::near` doesn't tell.
constexpr std::int32_t farthest = std::numeric_limits<std::int32_t>::max();

struct Linked {
    View<Link, 1> link;                  // (node,)
    View<Run, 1> run;                    // (slot,)
    View<Piece, 1> piece;                // (piece,)
    View<Link, 1> removed;               // (customer,) of the pieces one after another
    View<std::int64_t, 1> removed_node;  // (customer,) who that is
    View<Entry, 1> entry;                // (customer,)
    View<Moment, 1> moment;              // (moment,)
    View<std::int64_t, 1> retyped;       // (slot,) routes that another type drives since this turn
    View<std::int64_t, 1> former;        // (slot,) the type that did before, else `nowhere`
    Noted* noted;
    View<std::int64_t, 1> hit;  // (slot,) turn of the last string
    View<std::int32_t, 2>
        near;  // (node, rank) mm to or from those that `ProblemData.granular` lists, or what fits
    View<std::int64_t, 1>
        best_first;  // (slot,) first customer of the best plan's route, else `nowhere`
    View<std::int64_t, 1> best_type;    // (slot,)
    View<std::int64_t, 1> best_behind;  // (node,)
    Least* cheapest;                    // of all types
    bool timed;                         // something limits when customers are served
    // (node,) the longer of a customer's legs, `out_of_reach` of one on no route. That is all that
    // tells of most neighbours that a place beside them is too far, and many fit a cache.
    View<std::int64_t, 1> reach;
    // (tier, row) what is aboard around customers, by node, and behind all nodes where the route of
    // each slot begins and where it ends; no tiers where `Run.load` tells all. A route's rows are
    // written as soon as somebody asks.
    View<StopLoad, 2> aboard;
    View<bool, 1> stale;  // (slot,) its rows aren't written since it changed
    bool one_travel;      // all vehicles drive by the same legs
};

inline Linked linked_of(const tandem_linked& from) {
    return {from.link,      from.run,    from.piece,      from.removed,   from.removed_node,
            from.entry,     from.moment, from.retyped,    from.former,    from.noted,
            from.hit,       from.near,   from.best_first, from.best_type, from.best_behind,
            from.cheapest,  from.timed,  from.reach,      from.aboard,    from.stale,
            from.one_travel};
}

}  // namespace tandem
