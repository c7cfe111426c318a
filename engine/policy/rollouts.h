// Rollouts of the policy `attention`, from the first actions to the end of a plan.
#pragma once

#include "policy/decision.h"

namespace tandem {

// Where a rollout begins, and how it goes on.
struct Course {
    Embedding memory;
    double temperature;
    View<std::uint64_t, 1> random;
    Int kept;              // actions that are given
    View<Int, 1> actions;  // codes
};

// The likeliest of so many candidates, or one drawn by probability if the temperature isn't 0.
//
// Scores fill whole lanes. If one is drawn, they are overwritten, and the state of random numbers
// moves on.
Int choose(std::vector<float>& scores, Int count, double temperature,
           View<std::uint64_t, 1> random);

// Plan row `r` of the state until an alarm tells to give up; returns how many actions there are.
//
// Actions are tried on the last row of the state.
Int roll_out(const StepWeights& weights, const Scene& scene, State& state, Int r,
             const Course& course, View<const Int, 1> alarm);

}  // namespace tandem
