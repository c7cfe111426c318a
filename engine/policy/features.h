// What a policy sees at each step: its candidates and the state of the open vehicle.
//
// Like the tokens, all numbers are free of units. Training and decoding share this file.
#pragma once

#include "simulation/state.h"

namespace tandem {

// What the decision of one rollout sees, its row of an `Observation`.
struct Seen {
    Int& count;
    View<Int, 1> action;              // (candidate,) codes
    View<Int, 1> token;               // (candidate,) node, or number of nodes + type
    View<Outlook, 1> outlook;         // (candidate,)
    View<ActionFeatures, 1> feature;  // (candidate,)
    VehicleFeatures& vehicle;
    Int& here;  // token of the vehicle's place
};

// A row of an observation, whose floats are given their names.
inline Seen seen_of(const Observation& seen, Int r) {
    const View<float, 2> feature = seen.feature[r];
    auto* rows = reinterpret_cast<ActionFeatures*>(feature.data());
    auto* vehicle = reinterpret_cast<VehicleFeatures*>(seen.glob[r].data());
    return {seen.count[r], seen.action[r], seen.token[r], seen.outlook[r], {rows, {feature.size()}},
            *vehicle,      seen.here[r]};
}

// List and describe the legal actions of one rollout, which is finished if there is none.
void observe(const Scene& scene, State& state, Int r, Int scratch, const Seen& seen);

}  // namespace tandem
