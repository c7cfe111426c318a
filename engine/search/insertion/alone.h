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

// From which stop to which a drone delivers on a trip that ends at stop `end`, behind the last
// pickup: from the end, from that pickup there, or from that pickup and back.
constexpr Int ways_to_bring = 3;

struct Bringing {
    Int launch, recovery;
};

constexpr Bringing bringing_flight(Int way, Int end) {
    return {way == 0 ? end : end - 1, way == 2 ? end - 1 : end};
}

}  // namespace tandem
