// Rollouts of the policy `attention`, from the first actions to the end of a plan.
#pragma once

#include "policy/decision.h"
#include "policy/exponential.h"

namespace tandem {

using Courses = tandem_courses;

// The likeliest candidate, or one drawn by probability if the temperature isn't 0.
Int choose(View<const float, 1> scores, double temperature, const BitGenerator& bits);

// Plan each rollout, on so many threads, until a flag tells to give up.
//
// Each thread tries actions on a row of its own of the state, behind those of all rollouts.
void roll_out(const StepWeights& weights, View<const float, 3> memory, const Scene& scene,
              State& state, const Courses& courses, View<const Int, 1> stop, Int threads);

}  // namespace tandem
