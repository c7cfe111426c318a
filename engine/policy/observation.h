// What a decision sees, and the weights that it is made by.
#pragma once

#include "simulation/state.h"

namespace tandem {

using ActionFeatures = tandem_action_features;
using VehicleFeatures = tandem_vehicle_features;

struct Scales {
    View<const double, 1> time;     // (problem,) ms from a depot to a customer, mean
    View<const double, 1> near;     // (problem,) ms from a customer to its nearest neighbour, mean
    View<const double, 1> horizon;  // (problem,) ms, the last limit stated, or a guess
    View<const double, 1> cost;     // (problem,) cost of driving from a depot to a customer, mean
    View<const double, 1>
        amount;  // (problem,) total demand in the first dimension, or of pickups if more
};

inline Scales scales_of(const tandem_scales& from) {
    return {from.time, from.near, from.horizon, from.cost, from.amount};
}

struct Observation {
    View<std::int64_t, 1> count;   // (rollout,)
    View<std::int64_t, 2> action;  // (rollout, candidate) codes
    View<std::int64_t, 2> token;   // (rollout, candidate) node, or number of nodes + type
    View<Outlook, 2> outlook;      // (rollout, candidate)
    View<float, 3> feature;        // (rollout, candidate, number)
    View<float, 2> glob;           // (rollout, number)
    View<std::int64_t, 1> here;    // (rollout,) token of the vehicle's place
};

inline Observation observation_of(const tandem_observation& from) {
    return {from.count, from.action, from.token, from.outlook, from.feature, from.glob, from.here};
}

struct StepWeights {
    View<const float, 2> globe;
    View<const float, 1> globe_bias;
    View<const float, 2> globe_output;
    View<const float, 1> globe_output_bias;
    View<const float, 2> action;
    View<const float, 1> action_bias;
    View<const float, 2> glimpse_bias;
    View<const float, 2> glimpse_output;
    View<const float, 2> action_query;
    View<const float, 2> action_mix;
    View<const float, 1> action_mix_bias;
    View<const float, 1> action_score;
};

inline StepWeights step_weights_of(const tandem_step_weights& from) {
    return {from.globe,        from.globe_bias,  from.globe_output,    from.globe_output_bias,
            from.action,       from.action_bias, from.glimpse_bias,    from.glimpse_output,
            from.action_query, from.action_mix,  from.action_mix_bias, from.action_score};
}

}  // namespace tandem
