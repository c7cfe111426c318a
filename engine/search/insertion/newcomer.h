// A customer who is to be inserted, as vehicles of one type meet him between any two places.
#pragma once

#include "rules/segment.h"
#include "search/route/layout.h"

namespace tandem {

// What is looked up once for all places that a customer is tried at.
struct Newcomer {
    Int node;
    Windows place;
    LegRow inward;  // legs to the customer
    LegRow onward;  // and from there

    // How much further it is by the customer than from one place to another, so far apart.
    Int further(Int before, Int behind, Int apart) const {
        return distance_from(inward, before) + distance_to(onward, behind) - apart;
    }

    Detour detour(Int before, Int behind, Int apart) const {
        const Leg out = leg_from(inward, before), on = leg_to(onward, behind);
        return {out, on, out.distance + on.distance - apart};
    }

    // Tells whether a vehicle that comes so is served, and in time for the next place behind a leg,
    // which takes as long as `on` tells once that matters.
    template <class Duration>
    bool is_in_time(Front front, Rear rear, const Duration& on) const {
        if (!front.serve(place)) return false;
        front.drive(on());
        return rear.allows(front);
    }

    // Tells whether a vehicle that leaves one place so may come next, and be at another in time.
    // Most places are passed over by distance, so that durations are looked up here alone.
    bool comes_between(Int before, Front front, Int behind, Rear rear) const {
        front.drive(leg_from(inward, before).duration);
        return is_in_time(front, rear, [&] { return leg_to(onward, behind).duration; });
    }
};

// Returns a customer as vehicles of a type meet him.
[[gnu::always_inline]] inline Newcomer newcomer_for(const ProblemData& data,
                                                    const VehicleType& type, Int node) {
    return {node, data.place.by_truck(type)[node], legs_to(data.back, type.travel, node),
            legs_from(data.leg, type.travel, node)};
}

}  // namespace tandem
