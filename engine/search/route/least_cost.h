// What a route costs at least whose driver rests, which is known before it is timed.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// Return whether a driver of a type may have to rest, so that timing takes long.
bool may_rest(const VehicleType& type);

// Return how long a vehicle whose driver rests works at least on a route.
//
// Its legs, services and reloads last so long, and its breaks and rests, as far as they are paid
// and can't be missed by whoever begins later.
Int least_working(const ProblemData& data, const Route& route, View<const Stop, 1> stops);

// What a route costs at least, and how long its vehicle works then.
struct LeastPrice {
    double cost;
    Int working;
};

// Return what such a route costs at least, once its trips are loaded.
LeastPrice least_cost(const ProblemData& data, const Fleet& fleet, Int slot);

}  // namespace tandem
