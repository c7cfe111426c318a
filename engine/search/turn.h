// What a turn of the annealing begins with and is judged by, whatever holds the routes.
#pragma once

#include <limits>

#include "search/route/layout.h"

namespace tandem {

constexpr Int most_missing = 12;  // how many of the customers left out are tried again each turn

// What a turn may still do before it can't be accepted any more.
struct Spare {
    double cost = std::numeric_limits<double>::infinity();  // of what it inserts
    Int absences = std::numeric_limits<Int>::max();  // of those it tries who have to be served

    // Spends so much on somebody, who is absent or not. In place; false if there isn't so much.
    bool spend(double on_him, bool is_absent) {
        cost -= on_him;
        absences -= is_absent ? 1 : 0;
        return cost >= 0.0 && absences >= 0;
    }
};

// List `most` of the customers left out as absent. In place; return how many are not tried.
Int begin_turn(const ProblemData& data, Searcher& searcher, Int most);

// Let those left out near a customer, who may be one of them, be tried before others. In place.
//
// They come last of the first `total` absent, of whom those from number `first` on are tried. Who
// has to be served is tried by chance alone, everywhere as often.
void try_near(const ProblemData& data, Searcher& searcher, Int seed, Int first, Int total);

// Return by how much a turn may raise the cost, drawn by the temperature.
double draw_rise(const Searcher& searcher);

// Return how many who have to be served are left out before this turn; 0 where nobody has to be.
Int num_lacking(const ProblemData& data, const Searcher& searcher);

// Return how many of those a turn may leave out that inserts the absent from number `first` on.
//
// As many as before, or more by `SearchCounts::to_drop`; where none were, cost alone decides.
Int absences_to_spare(const ProblemData& data, const Searcher& searcher, Int lacking, Int first);

// Tell whether after this turn others are left out who must not be, and seldom were.
//
// They are as many as before, and all who are left out cost no more; or more, if those may be.
// Counts the absences. In place.
//
// Reference: Nagata and Bräysy (2009), a powerful route minimization heuristic for the vehicle
// routing problem with time windows, Operations Research Letters 37:333-338.
bool rarer_absences(const ProblemData& data, Searcher& searcher);

// Tell whether what a turn has inserted so far costs no more than all that it will insert.
bool counts_up(const ProblemData& data, const Searcher& searcher);

// Return what the routes cost before who is absent is inserted, from number `first` on, where they
// and those left out before this turn cost `served`.
double cost_to_insert(const ProblemData& data, const Searcher& searcher, double served, Int first);

// Return the cost after this turn, where the routes and those left out before cost `served`.
double turn_cost(const ProblemData& data, const Searcher& searcher, double served);

}  // namespace tandem
