// What the search looks at only where a rarer rule is stated.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// Return how many tiers loads have to be looked at in at each stop; 0 if that isn't needed.
inline Int tiers_of(const ProblemData& data) { return data.amount.shape(1); }

// As `tiers_of`, by the routes.
inline Int tiers_aboard(const Fleet& fleet) { return fleet.stop_load.shape(1); }

// Tell whether trucks may stop at places for their drones alone.
inline bool has_halts(const ProblemData& data) { return !data.halts.empty(); }

// The launch sites nearest to a customer, which are looked at more often than others near; behind
// the last one `nowhere`.
inline View<const std::int32_t, 1> nearest_halts(const ProblemData& data, Int node) {
    constexpr Int most = 3;
    const View<const std::int32_t, 1> near = data.near_halts[node];
    return near.first(std::min(most, near.size()));
}

// Tell whether some goods must not go with others.
inline bool goods_count(const ProblemData& data) { return !data.goods.empty(); }

// Tell whether depots have only so many batteries, or places to charge, for who flies.
inline bool hubs_count(const ProblemData& data) { return !data.hub.empty(); }

// Tell whether who flies may have to wait until another was charged.
inline bool waits_for_chargers(const ProblemData& data) { return !data.plugging.empty(); }

// Tell whether a route is timed between what others do: the order counts in which they are.
inline bool routes_meet(const ProblemData& data) {
    return !data.across.empty() || waits_for_chargers(data);
}

// Tell whether some parcels may be aboard for so long and no longer.
inline bool time_aboard_counts(const ProblemData& data) { return !data.max_time_aboard.empty(); }

// Tell whether what a vehicle of type `k` has aboard costs by the way that it is driven.
inline bool loads_cost(const ProblemData& data, Int k) { return data.rate[k].load > 0.0; }

// Tell whether leaving out some costs more than leaving out others.
inline bool is_dearer_to_some(const ProblemData& data) { return data.unassigned_costs_differ; }

}  // namespace tandem
