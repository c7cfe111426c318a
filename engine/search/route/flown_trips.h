// Trips of vehicles that fly by themselves on a route: whether they last, and what they take.
#pragma once

#include "rules/flown_trip.h"
#include "search/route/layout.h"

namespace tandem {

// A customer who is put behind a stop, perhaps behind others there, with how long the legs there
// and on take; on, where he is the last.
struct Added {
    Int behind, node, out, on;
};

// Return what is left of a timed trip.
FlownTrip follow_trip(const ProblemData& data, const Tour& tour, const Trip& trip);

// Tell whether a customer is near enough to where a trip begins and ends.
bool reaches(const ProblemData& data, Int k, View<const Stop, 1> stops, const Trip& trip,
             Int customer);

// Tell whether a trip from stop `first` to `last` lasts, with some added, if nobody waits.
bool lasts_in_air(const ProblemData& data, Int k, View<const Stop, 1> stops, Int first, Int last,
                  View<const Added, 1> added);

// Return by how much later a timed trip has to begin at least to last; at most 0 if it does, `far`
// if it can't.
Int excess_in_air(const ProblemData& data, const Tour& tour, const Trip& trip);

// Return how much later a timed trip has to begin for calm; 0 if it needn't, `far` if that doesn't
// help.
Int waits_for_calm(const ProblemData& data, const Tour& tour, const Trip& trip);

// Return how much later a timed trip has to begin for its battery to be charged, with what there
// was `before`; at most 0 if it needn't, `far` if that doesn't help.
Int waits_for_charge(const ProblemData& data, const Tour& tour, const Trip& trip,
                     const Charge& before);

// Return with what a vehicle ends a timed trip, with what there was `before`, and since when it is
// charged.
Charge charge_behind(const ProblemData& data, const Tour& tour, const Trip& trip,
                     const Charge& before);

// Tell whether a timed trip begins before its battery is charged, if any does.
bool lacks_charge(const ProblemData& data, const Tour& tour);

}  // namespace tandem
