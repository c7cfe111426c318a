// A customer, or a shipment, on a route of its own.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// Writes the route that serves a customer alone at the least cost. False if none may.
//
// Where it begins and ends at one place, a drone leaves from the start, and comes back there.
bool serve_alone(const ProblemData& data, const Fleet& fleet, Int slot, Int k, Int node,
                 bool by_drone);

// Writes the route that serves a shipment alone in some way, drawn of all. False if it may not.
bool serve_alone_anyhow(const ProblemData& data, const Fleet& fleet, Int slot, Int k, Int node,
                        View<std::uint64_t, 1> rng);

}  // namespace tandem
