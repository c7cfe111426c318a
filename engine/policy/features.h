// What a policy sees at each step: its candidates and the state of the open vehicle.
//
// Like the tokens, all numbers are free of units. Training and decoding share this file.
#pragma once

#include "policy/observation.h"

namespace tandem {

// Problems as policies see them.
struct Scene {
    const Instance& instance;
    const Scales& scale;
    View<const float, 3> type_token;  // (problem, type, features)
};

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

inline Seen seen_of(const Observation& seen, Int r) {
    return {seen.count[r],     seen.action[r],  seen.token[r], seen.outlook[r],
            seen.described[r], seen.vehicle[r], seen.here[r]};
}

// List and describe the legal actions of one rollout, which is finished if there is none.
void observe(const Scene& scene, State& state, Int r, Int scratch, const Seen& seen);

}  // namespace tandem
