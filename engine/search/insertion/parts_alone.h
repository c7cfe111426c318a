// Several pickups of a shipment and its delivery on a trip of their own.
#pragma once

#include "search/insertion/best.h"

namespace tandem {

// Tries such a shipment, by the first pickup, on a trip of its own behind a stop of a route, in
// several orders and ways.
void try_parts_trip(const Insertion& insertion, Int slot, Int behind);

// Writes a route that serves such a shipment alone, in the best of several orders, by truck or in
// ways in which drones serve some end. False if none keeps the rules. In place.
bool serve_parts_alone(const ProblemData& data, const Fleet& fleet, Int slot, Int k, Int node,
                       bool by_drone);

// Likewise, in some way, drawn of all. False if it may not.
bool serve_parts_anyhow(const ProblemData& data, const Fleet& fleet, Int slot, Int k, Int node,
                        View<std::uint64_t, 1> rng);

}  // namespace tandem
