// What is aboard at the stops of a route, where that has to be looked at from stop to stop.
#pragma once

#include "search/route/rarer.h"

namespace tandem {

// Tell whether a drone of a row `k` may carry what a sortie does, serving a customer more before
// its number `place`. `nowhere`: nobody more.
bool can_carry(const ProblemData& data, Int k, const Sortie& sortie, Int place, Int node);

// Write what is aboard at each stop of a route. In place; false if that breaks a rule.
bool weigh(const ProblemData& data, const Fleet& fleet, Int slot);

// Return what it costs to drive what is aboard, on a route that was weighed.
double load_cost(const ProblemData& data, const Fleet& fleet, Int slot);

// Return what it costs more to drive a customer's amounts, but for legs that are changed.
//
// The parcel leaves the truck at stop `left`, what is picked up comes aboard at stop `came`.
double load_more(const ProblemData& data, const Fleet& fleet, Int slot, Int left, Int came,
                 Int node);

// Return what driving loads costs more with a customer behind stop `p`, by such a detour.
double load_more_behind(const ProblemData& data, const Fleet& fleet, Int slot, Int p, Int node,
                        const Detour& detour);

// Where a customer may be served on a route by a vehicle of a type.
struct Room {
    const VehicleType& type;
    View<const StopLoad, 2> stop_loads;  // (tier, position) what is aboard
    View<const Int, 3> amounts;
    Int node;

    // Tell whether the parcel may leave the truck at stop `left`, or just before it, and what is
    // picked up come aboard at stop `came`, or just behind it.
    bool allows(Int left, Int came) const {
        return stop_loads.empty() || has_room(type, stop_loads, left, came, amounts, node);
    }
};

// Return what says where a customer may be served on a route by a vehicle of type `k`.
inline Room room_on(const ProblemData& data, const Fleet& fleet, Int slot, Int k, Int node) {
    return {data.type[k], fleet.stop_load[slot], data.amount, node};
}

// Tell whether a truck may serve the customer behind stop `p`.
inline bool room_behind(const Room& room, Int p) { return room.allows(p + 1, p); }

// Tell whether a drone may serve the customer from stop `launch` to `recovery`.
inline bool room_between(const Room& room, Int launch, Int recovery) {
    return room.allows(launch, recovery);
}

// Tell whether a vehicle of type `k` holds what a route of one trip carries, and may stop so often.
bool can_take(const ProblemData& data, const Fleet& fleet, Int slot, Int k);

}  // namespace tandem
