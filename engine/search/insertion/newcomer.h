// A customer who is to be inserted, as the vehicles of one route meet it.
#pragma once

#include "rules/leg.h"
#include "rules/window.h"
#include "search/route/layout.h"
#include "search/route/stop_loads.h"

namespace tandem {

// The legs to a customer and from there, and how much further that is than from stop to stop.
struct Detour {
    Leg out;
    Leg on;
    Int distance;
};

struct Newcomer {
    Windows place;
    LegRow inward;  // legs to the customer
    LegRow onward;  // and from there
    Room room;

    Detour behind(View<const Stop, 1> stops, Int p) const {
        const Leg out = leg_from(inward, stops[p].node), on = leg_to(onward, stops[p + 1].node);
        return {out, on, out.distance + on.distance - stops[p].leg};
    }

    // How much further it is by the customer than from stop `p` to the next.
    Int further_behind(View<const Stop, 1> stops, Int p) const {
        return distance_from(inward, stops[p].node) + distance_to(onward, stops[p + 1].node) -
               stops[p].leg;
    }

    // Tells whether a truck that leaves stop `p` at `leave` may come next, and then reach the
    // following stop. Most are passed over by distance, so that durations are looked up here alone.
    bool comes_in_time(View<const Stop, 1> stops, Int p, Int leave) const {
        const Int arrival = leave + leg_from(inward, stops[p].node).duration;
        if (place.too_late(arrival)) return false;
        const Stop& behind = stops[p + 1];
        return place.end_of_service(arrival) + leg_to(onward, behind.node).duration <=
               behind.latest;
    }
};

// Returns a customer as trucks of type `k` meet it on a route, for one of type `by` to be served.
inline Newcomer newcomer_on(const ProblemData& data, const Fleet& fleet, Int slot, Int by,
                            Int node) {
    const VehicleType& type = data.type[fleet.route[slot].type];
    return {data.place.by_truck(type)[node], legs_to(data.back, type.travel, node),
            legs_from(data.leg, type.travel, node), room_on(data, fleet, slot, by, node)};
}

// Tells whether a truck that leaves at `leave` may serve a customer next, and then reach a stop.
inline bool is_in_time(Windows place, const Detour& detour, Int leave, const Stop& behind) {
    const Int arrival = leave + detour.out.duration;
    return !place.too_late(arrival) &&
           place.end_of_service(arrival) + detour.on.duration <= behind.latest;
}

}  // namespace tandem
