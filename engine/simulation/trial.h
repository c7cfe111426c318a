// Actions done on a scratch row, and the return home, to tell whether they are legal.
#pragma once

#include "simulation/transition.h"

namespace tandem {

// A rollout, by its row of the state, and the row that actions are tried on.
struct Rollout {
    const Instance& instance;
    State& state;
    Int r, scratch;
};

// An action on a customer.
struct Service {
    Int node;
    bool by_drone;
};

constexpr Int no_reload = -1;

// Tell whether an action on a customer is legal by doing it and the return home on a scratch row.
//
// Exact for every customer that the load, the kind and the number of trips allow, while no more
// than three stops are to be made on the way home for what is aboard: its deliveries, and the
// pickups of parts that lack. Of more, some orders are tried. If `reload` is a node, the trip ends
// there before.
bool legal_by_trial(const Rollout& rollout, Int reload, Service service, Outlook& outlook);

// Tell whether shipments are aboard, or fetched by drones, that have to be delivered before the
// trip ends.
bool carries_parcels(const OpenVehicle& open);

constexpr Int no_delivery = -1;

// Where the shipment is delivered that came aboard last, `no_delivery` if none is aboard.
Int last_aboard(const OpenVehicle& open);

// Tell whether all of a shipment is aboard, or picked up where the vehicle is, by its delivery.
bool is_aboard(const OpenVehicle& open, Int delivery);

// Tell whether the trip may end at a place that is not where the route may: if another follows.
//
// Somebody can be served from there before the vehicle goes where its route ends.
bool may_reload(const Rollout& rollout, Int place, Outlook& outlook);

}  // namespace tandem
