// When sorties can be over at the soonest, by which insertions cost at least so much.
#pragma once

#include "search/route/drone_data.h"

namespace tandem {

// Drones of a row on a route.
struct Flying {
    const ProblemData& data;
    const VehicleType& type;  // the row's
    Int drone;                // the number of the first
    View<const Stop, 1> stops;
    View<const Sortie, 1> sorties;

    // Returns how long a sortie flies home from its last customer.
    Int way_home(const Sortie& sortie) const {
        return leg(legs_of(data.leg, type.home_travel), sortie.nodes[sortie.count - 1],
                   stops[sortie.recovery].node)
            .duration;
    }

    // Returns when a sortie is over at the soonest, as the truck comes to its block.
    Int end_of(const Sortie& sortie) const {
        const Int begun = stops[stops[sortie.launch].block].arrival;
        return recovery_end(type, begun + sortie.ready_d + way_home(sortie));
    }

    // Returns when it is if its drone is free at an instant.
    Int end_after(const Sortie& sortie, Int free) const {
        const Int flown = sortie.ready_d - sortie.takeoff_d + way_home(sortie);
        return recovery_end(type, take_off(type, free, 0) + flown);
    }

    // Returns until when the truck may leave a stop and be no later where all drones are aboard.
    Int left(Int p) const { return stops[p].leave + stops[p].idle; }

    // Returns how much later the truck is there at least if its drone is free at stop `p` then, and
    // goes on by sorties from number `s` on. Of several drones, another may.
    Int delay(Int p, Int free, Int s) const {
        Int later = free - left(p);
        if (type.drones > 1) return later;
        for (; s < sorties.size(); ++s) {
            if (sorties[s].drone != drone) continue;
            if (sorties[s].launch != p) break;
            free = end_after(sorties[s], free);
            p = sorties[s].recovery;
            later = std::max(later, free - left(p));
        }
        return later;
    }
};

inline Flying flying_of(const ProblemData& data, const Fleet& fleet, Int slot, Int row) {
    const Int drone = first_drone(data.type, fleet.route[slot].type, row);
    return {data, data.type[row], drone, fleet.stop[slot], sorties_of(fleet, slot)};
}

}  // namespace tandem
