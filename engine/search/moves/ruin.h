// Removal of strings of adjacent customers.
#pragma once

#include "search/route/edit.h"

namespace tandem {

constexpr double longest_usual_string = 10;  // stops, but where `SearchValues::longest` allows more
constexpr double split_share = 0.5;          // how often a string spares some within
constexpr double split_more_share = 0.01;    // and each time one more of them
constexpr double whole_trip_share = 0.05;    // how often a trip is removed whole
constexpr Int longest_whole_trip = 25;       // if it has no more stops than this

// Return how many stops a string has at most: as many as each of so many trips has on average, or
// less.
//
// Up to `longest_usual_string`, and on long routes up to what `Searcher::value` says.
double longest_string(const Searcher& searcher, Int trips);

// Draw how many strings are removed: fewer if they are long.
Int draw_strings(double longest, View<std::uint64_t, 1> rng);

// Draw near whom strings are removed: a random customer, or every other time one of those left out.
Int draw_seed(const ProblemData& data, const Searcher& searcher, View<const Int, 1> absent);

// How many routes customers are removed from, and near whom those are.
struct Chosen {
    Int num_touched;
    Int seed;
};

// Mark strings near a random customer, at most one a trip, and list their routes in `touched`. In
// place.
Chosen choose(const ProblemData& data, Searcher& searcher, double longest, Removed& removed,
              View<Int, 1> touched);

// Mark, every other time, those who go with a customer marked behind the first so many, so that
// they can go elsewhere together. In place.
void mark_company(const ProblemData& data, const Fleet& fleet, View<std::uint64_t, 1> rng,
                  Removed& removed, Int first);

// Take the marked customers out of a route; all, if the rest breaks a rule. In place.
void remove_marked(const ProblemData& data, Fleet& fleet, Int slot, Removed& removed,
                   View<Int, 1> moved);

}  // namespace tandem
