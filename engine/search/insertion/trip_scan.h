// A trip on which a shipment is tried, and what each way to try it asks.
#pragma once

#include "rules/rates.h"
#include "search/insertion/best.h"
#include "search/route/rarer.h"

namespace tandem {

struct TripScan {
    TripScan(const Insertion& insertion, Int of_slot, const Trip& tried)
        : data(insertion.data),
          fleet(insertion.searcher.now),
          best(insertion.best),
          node(insertion.node),
          slot(of_slot),
          trip(tried),
          route(fleet.route[slot]),
          type(data.type[route.type]),
          rate(data.rate[route.type]),
          stops(fleet.stop[slot]) {}

    Newcomer newcomer(Int end) const { return newcomer_for(data, type, end); }

    // How a vehicle goes by an end behind a stop, and how much further that is.
    Detour detour(const Newcomer& end, Int behind) const {
        const Stop& stop = stops[behind];
        return end.detour(stop.node, stops[behind + 1].node, stop.leg);
    }

    // Whether what costs at least so much may be passed over.
    bool is_dear(double least) const { return data.strategy.give_up_early && least >= best.cost; }

    Move move_of(Int kind, Int first, Int last) const {
        Move move{};
        move.kind = kind;
        move.slot = slot;
        move.first = first;
        move.last = last;
        move.type = route.type;
        return move;
    }

    const ProblemData& data;
    const Fleet& fleet;
    Best& best;
    const Int node;  // the first pickup
    const Int slot;
    const Trip& trip;
    const Route& route;
    const VehicleType& type;
    const Rate& rate;
    const View<const Stop, 1> stops;
};

}  // namespace tandem
