// An order of customers, each at a place in a line: a trip's with one drone, or two routes'.
#pragma once

#include "search/scratch.h"

namespace tandem {

constexpr Int no_flight = 0;
constexpr Int near_places = 8;  // among how many nearest neighbours of a place one is drawn

// Move what is at place `one` to place `to`. In place.
void shift(View<Line, 1> line, Int one, Int to);

// Between which places of a line, both included, the order was changed, and how many more places
// there are.
struct Places {
    Int first, last;
    Int more = 0;

    bool any() const { return first < last || more != 0; }
};

// Change the order of the customers in the line a little. In place; tell between which places.
Places shuffle(const ProblemData& data, View<Line, 1> line, Int length, View<std::uint64_t, 1> rng);

// Write what a truck that served the whole line would drive. In place.
void measure(const ProblemData& data, Int k, View<Line, 1> line, Int length);

// Return what the operations that are noted in the line cost.
double present_cost(const ProblemData& data, Int k, View<const Line, 1> line, Int length);

// Cut the line into operations at least cost; return that. In place; infinite if it can't be cut.
double split(const ProblemData& data, Int k, View<Line, 1> line, Int length, SplitScratch& scratch);

// Which places of a line were changed, how it was split before, and how much more it may cost at
// most.
struct Changed {
    Places places;
    const SplitScratch& before;
    double most;
};

// Cut a changed line as `split` does; infinite if it would cost more than it may.
//
// What comes before the change isn't looked at again, nor what comes behind it once that tells.
double split_changed(const ProblemData& data, Int k, View<Line, 1> line, Int length,
                     const Changed& changed, SplitScratch& scratch);

}  // namespace tandem
