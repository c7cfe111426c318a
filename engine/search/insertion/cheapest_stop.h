// The cheapest stop for a customer where only the distance of the detour counts.
#pragma once

#include <array>

#include "search/route/layout.h"

namespace tandem {

// A type of vehicles that would serve a customer more on a trip, and what it costs more.
struct Serving {
    Int type;
    double cost;
};

// Tells whether an insertion into a route costs its detour alone.
bool is_simple(const ProblemData& data, const Fleet& fleet, Int slot);

// Returns the type that would serve a customer more on a trip: a larger one if `enlarge`; or
// `nowhere`.
Serving serving_type(const ProblemData& data, const Fleet& fleet, Int slot, Int index, Int node,
                     bool enlarge);

// Lets the move be to serve a customer behind one of two stops of a lean route, if that costs less
// than `best`; returns the best cost so far.
double take_cheaper(const ProblemData& data, const Searcher& searcher, Int slot,
                    const std::array<Int, 2>& places, Int node, Serving serving, double best);

// Finds the cheapest stop where all routes are lean; returns the best cost so far.
//
// In place: the move, if that is a stop that costs less than `best`; also what is kept.
double scan_lean(const ProblemData& data, const Searcher& searcher, Int node, double best,
                 bool enlarge);

// Finds the cheapest stop on a route where only distance counts. As `try_route` of places.h.
void scan_simple(const ProblemData& data, const Searcher& searcher, Int slot, Int node,
                 bool enlarge);

// Finds the cheapest stop beside neighbours where only distance counts. As `scan_lean`.
double scan_beside(const ProblemData& data, const Searcher& searcher, Int node, double best,
                   bool enlarge);

// Finds the cheapest stop beside neighbours where all routes are lean. As `scan_lean`.
double scan_beside_lean(const ProblemData& data, const Searcher& searcher, Int node, double best,
                        bool enlarge);

}  // namespace tandem
