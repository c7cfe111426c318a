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

// Describe the drives, the launches and the return of the open vehicle.
void describe_moves(const Instance& instance, const Scales& scale, const State& state, Int r,
                    Observation& seen);

// List and describe the legal actions of the rollouts `first` to `behind`.
//
// A rollout without a legal action is finished. Returns the largest count.
Int observe(const Scene& scene, State& state, Int first, Int behind, Int scratch,
            Observation& seen);

// Do the chosen candidate of each rollout `first` to `behind`.
//
// `choice` is (rollout,), an index into the candidates; rollouts without any stay as they are.
void act(const Instance& instance, State& state, Int first, Int behind, View<const Int, 1> choice,
         const Observation& seen);

}  // namespace tandem
