// Removal of strings of adjacent customers.
#pragma once

#include "randomness.h"
#include "search/route/edit.h"

namespace tandem {

constexpr double longest_usual_string = 10;  // stops, but where `SearchValues::longest` allows more

// A string of stops, how many of them are removed, and how many within are spared.
struct StopString {
    Int size, spared;

    Int span() const { return size + spared; }
};

// Draw a string of a row of so many stops. As a rule it removes no more than `longest`.
StopString draw_string(View<std::uint64_t, 1> rng, double longest, Int stops);

// Draw behind how many that are removed those come that are spared.
Int draw_gap(View<std::uint64_t, 1> rng, const StopString& string);

// Call `remove` with the places in such a row, from 0 on, of a string drawn around one of them.
template <class Remove>
void draw_around(View<std::uint64_t, 1> rng, double longest, Int stops, Int place,
                 const Remove& remove) {
    const StopString string = draw_string(rng, longest, stops);
    const Int lowest = std::max(Int{0}, place - string.span() + 1);
    const Int highest = std::min(place, stops - string.span());
    const Int begin = lowest + below(rng, highest - lowest + 1);
    const Int gap = draw_gap(rng, string);
    for (Int offset = 0; offset < string.span(); ++offset) {
        if (offset < gap || offset >= gap + string.spared) remove(begin + offset);
    }
}

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
struct RuinSize {
    Int num_touched, seed;
};

// Mark strings near a random customer, at most one a trip, and list their routes in `touched`. In
// place.
RuinSize choose(const ProblemData& data, Searcher& searcher, double longest, Removed& removed,
                View<Int, 1> touched);

// Mark, every other time, those who go with a customer marked behind the first so many, so that
// they can go elsewhere together. In place.
void mark_company(const ProblemData& data, const Fleet& fleet, View<std::uint64_t, 1> rng,
                  Removed& removed, Int first);

// Take the marked customers out of a route; all, if the rest breaks a rule. In place.
void remove_marked(const ProblemData& data, Fleet& fleet, Int slot, Removed& removed,
                   View<Int, 1> moved);

}  // namespace tandem
