// What a decision sees, and the weights that it is made by.
#pragma once

#include "simulation/state.h"

namespace tandem {

using ActionFeatures = tandem_action_features;
using VehicleFeatures = tandem_vehicle_features;

using Scales = tandem_scales;
using Observation = tandem_observation;
using StepWeights = tandem_step_weights;

inline float to_float(double value) { return float(value); }

}  // namespace tandem
