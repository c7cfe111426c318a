// The cheapest stop for a customer where only the distance of the detour counts.
#pragma once

#include "search/insertion/best.h"

namespace tandem {

// Tells whether an insertion into a route costs its detour alone.
inline bool is_simple(const ProblemData& data, const Route& route) {
    return data.evaluation[route.type].by_detour && route.sorties == 0;
}

// Tries the customer on all trips of a route where only distance counts.
void scan_simple(const Insertion& insertion, Int slot);

// Tries the customer beside a neighbour where only distance counts.
void scan_beside(const Insertion& insertion, Int other);

}  // namespace tandem
