// What rules that few state make of candidates and of the open vehicle.
//
// Prices by vehicle, parcels that are fetched and brought, who goes with whom, and rests. All of it
// is 0 where nobody states any of them.
#pragma once

#include "policy/lookahead.h"

namespace tandem {

// The open vehicle of a rollout, and whom it may serve.
struct Duty {
    const Setting& setting;
    const Unit& unit;
    const Vehicle& vehicle;
    const VehicleLog& log;
    View<const bool, 1> served;          // (node,)
    View<const double, 2> vehicle_cost;  // (type, node), or none
    Int num_nodes;                       // without padding
};

// Describe serving a customer.
void describe_rarer(const Duty& duty, const Candidate& candidate, ActionFeatures& feature);

// Describe the end of a trip, or with `for_good` of the vehicle's work.
void describe_parting(const Duty& duty, bool for_good, ActionFeatures& feature);

// Describe the open vehicle at an instant.
void describe_duty(const Duty& duty, Int now, VehicleFeatures& feature);

}  // namespace tandem
