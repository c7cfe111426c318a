// Stops at launch sites that are there before anybody is flown to from them.
//
// One customer alone may not be worth a stop that two are worth together. So a stop is put on a
// route now and then while customers are missing, and goes again if no drone has used it.
#pragma once

#include "rules/launch_place.h"
#include "search/moves/split.h"

namespace tandem {

constexpr double halting_share = 0.1;  // how often that is done

// Put a stop at a launch site near a customer, or near where it is put, on a route that was
// touched. In place; maybe nothing.
void halt_for(const ProblemData& data, const Searcher& searcher, Int node);

// Take the stops at launch sites that no drone uses off the routes that were touched, if that
// breaks no rule. In place.
void drop_idle_halts(const ProblemData& data, const Searcher& searcher);

// Tell whether a node is a launch site where trucks of a type may stop.
inline bool is_halt(const ProblemData& data, Int k, Int node) {
    return node < data.num_depots && may_halt(data.halts, k, node);
}

constexpr double halts_changed_share = 0.3;  // how often a line's stops there change, not its order

// Put a stop at a launch site near a customer of the line, or take one out. In place.
Places change_halts(const ProblemData& data, Int k, View<Line, 1> line, Int length,
                    View<std::uint64_t, 1> rng);

// Tell whether no customer in the line comes behind a stop that he has to be served before.
bool are_halts_in_order(const ProblemData& data, View<const Line, 1> line, Int length);

}  // namespace tandem
