// Rollouts of the policy `attention`, from the first actions to the end of a plan.
#pragma once

#include "policy/decision.h"

namespace tandem {

using Courses = tandem_courses;

// The likeliest of so many candidates, or one drawn by probability if the temperature isn't 0.
//
// Scores fill whole lanes. If one is drawn, they are overwritten, and the state of random numbers
// moves on.
Int choose(std::vector<float>& scores, Int count, double temperature,
           View<std::uint64_t, 1> random);

// Plan each rollout, on so many threads, until an alarm tells to give up.
//
// Each thread tries actions on a row of its own of the state, behind those of all rollouts.
void roll_out(const StepWeights& weights, View<const float, 3> memory, const Scene& scene,
              State& state, const Courses& courses, View<const Int, 1> alarm, Int threads);

}  // namespace tandem
