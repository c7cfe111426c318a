// What a route costs at least whose driver rests, which is known before it is timed.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// Return how long a route could work longer at no cost.
Int spare_time(const ProblemData& data, const Route& route, View<const Stop, 1> stops);

// What a route costs at least, and how long its vehicle works then.
struct LeastPrice {
    double cost;
    Int working;
};

// Return what a route costs at least whose driver rests, once its trips are loaded.
LeastPrice least_cost(const ProblemData& data, const Fleet& fleet, Int slot);

}  // namespace tandem
