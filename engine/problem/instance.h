// Problems as Python packed them, a row per problem.
#pragma once

#include "include/tandem.h"

namespace tandem {

using Node = tandem_node;
using Setup = tandem_setup;
using Price = tandem_price;
using Goods = tandem_goods;
using Hub = tandem_hub;
using Pair = tandem_pair;
using Lag = tandem_lag;
using Span = tandem_span;
using VehicleType = tandem_vehicle_type;
using Rate = tandem_rate;
using Cost = tandem_cost;
using LegLaw = tandem_leg_law;
using Point = tandem_point;
using Legs = tandem_legs;
using ProblemTables = tandem_problem_tables;
using Instance = tandem_instance;

using Int = std::int64_t;

constexpr Int far = Int{1} << 58;       // an instant later than any that occurs
constexpr Int none = -far;              // and one earlier
constexpr Int dimensions_per_tier = 3;  // how many dimensions of load are looked at together
constexpr Int max_tiers = 3;            // for all eight dimensions

constexpr Int unlimited = Int{1} << 42;        // no limit on a time (ms) or a distance (mm)
constexpr Int unreachable_leg = Int{1} << 50;  // duration and distance of what can't be flown
constexpr std::int32_t no_leg = INT32_MAX;     // the same where legs are held in 32 bits
constexpr Int full_speed = 1'000'000;  // factor at which a leg takes the duration its table states

constexpr Int no_profile = -1;  // `speed_changes` of who drives as fast all day
constexpr Int no_row = -1;      // `drone_row` behind the last

// `pickup_order`: in any order, after all deliveries of which there is one, and so where there may
// be none, as some came before the trip began or all is one stack.
constexpr Int pickups_any = 0;
constexpr Int pickups_last = 1;
constexpr Int pickups_begun = 2;

using ActionFeatures = tandem_action_features;
using VehicleFeatures = tandem_vehicle_features;

using Scales = tandem_scales;
using Observation = tandem_observation;
using Scene = tandem_scene;
using StepWeights = tandem_step_weights;

inline Int customers_of(const ProblemTables& problem) {
    return problem.num_nodes - problem.num_depots;
}

inline float to_float(double value) { return float(value); }

}  // namespace tandem
