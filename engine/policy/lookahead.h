// What a candidate leads to: its unserved neighbours, near by and in time.
//
// A policy that builds a plan step by step must guess what a step costs later. These features look
// one customer further: what comes next, what can no longer come, what would better come before.
#pragma once

#include "simulation/state.h"

namespace tandem {

// The units of one problem that steps need.
struct Unit {
    double time;  // ms
    double near;  // ms
    double cost;
};

// Squash a length of any size to 0..1, half at `scale`.
inline double ratio(double value, double scale) { return value > 0 ? value / (value + scale) : 0; }
inline double ratio(Int value, double scale) { return ratio(double(value), scale); }

// Squash what a limit leaves to 0..1, half at `scale`; 1 where there is no limit.
inline double slack(Int limit, Int used, double scale) {
    return limit >= unlimited ? 1 : ratio(limit - used, scale);
}

// A candidate of the open vehicle, for whom neighbours are looked through.
struct Candidate {
    Int here;  // node of the vehicle
    Int node;
    bool by_air;  // a drone serves it
    Int load;     // of the vehicle, what is left in the first dimension
    const Outlook& outlook;
};

// Describe what serving a candidate means for its unserved neighbours.
//
// `neighbours` are the node's, nearest first, -1 behind the last.
void describe_neighbours(const Setting& setting, View<const Int, 1> neighbours,
                         View<const bool, 1> served, const Candidate& candidate, const Unit& unit,
                         ActionFeatures& feature);

// The open vehicle of a rollout, and whom it may serve.
struct Duty {
    const Setting& setting;
    const Unit& unit;
    const Vehicle& vehicle;
    const VehicleLog& log;
    View<const bool, 1> served;  // (node,)
};

// Describe serving a customer.
void describe_rarer(const Duty& duty, const Candidate& candidate, ActionFeatures& feature);

// Describe the end of a trip, or with `for_good` of the vehicle's work.
void describe_parting(const Duty& duty, bool for_good, ActionFeatures& feature);

// Describe the open vehicle at an instant.
void describe_duty(const Duty& duty, Int now, VehicleFeatures& feature);

}  // namespace tandem
