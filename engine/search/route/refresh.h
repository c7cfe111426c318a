// Bringing a route up to date after its sequence has changed.
#pragma once

#include "search/route/pricing.h"

namespace tandem {

// Write times and cost of a route with trips that end where they do. In place; false if it breaks
// a rule.
//
// Where that costs less, its trips are held back; `settled` tells. False, too, if it is known to
// cost no less than `bar` before it is timed.
bool price_as_is(const ProblemData& data, const Fleet& fleet, Int slot, double bar, bool& settled);

// Write all that follows from the sequence of a route. In place; false if it breaks a rule.
//
// Where trips may end at several places, that which costs least is chosen between two.
bool refresh(const ProblemData& data, const Fleet& fleet, Int slot);

// As `refresh`, of a vehicle that is charged in turn: its trips begin no sooner than planned, and
// it is charged as planned before. False, too, if that doesn't do.
bool refresh_as_planned(const ProblemData& data, const Fleet& fleet, Int slot);

// Keep a route in a slot that nobody uses, to be put back. In place.
void set_aside(const ProblemData& data, const Fleet& fleet, Int slot, Int to);

// Go on from a route that was set aside. In place.
//
// Where others hang on when it serves whom, that is the same to the millisecond.
void put_back(const ProblemData& data, const Fleet& fleet, Int slot, Int from);

// As `refresh`, of a route whose cost is all that is asked, and that only if it is below `bar`.
bool refresh_cost(const ProblemData& data, const Fleet& fleet, Int slot, double bar);

// Return how much of the time that a route works is waiting, which a change may use up.
//
// For windows, or batteries.
inline Int idle_time(const Route& route) {
    return route.working + route.offset - route.cum + route.awaited;
}

// Return a random customer whom this thread deals with, served or left out.
//
// Whoever comes last if this thread deals with too few to be found.
Int any_customer(const ProblemData& data, const Fleet& fleet, View<std::uint64_t, 1> rng);

// Return a random customer near `focus`, or anywhere if that is `nowhere`. As `any_customer`.
Int draw_customer(const ProblemData& data, const Fleet& fleet, Int focus,
                  View<std::uint64_t, 1> rng);

// Return the stop at a customer, or the one from where a drone flies there.
inline Int stop_beside(const Fleet& fleet, Int node) {
    const Place& place = fleet.where[node];
    if (place.position >= 0) return place.position;
    return fleet.sortie(place.slot, place.sortie).launch;
}

// Write where the customers of the route in a slot are. In place: `places` (node,).
void note_places(View<Place, 1> places, const Tour& tour, Int slot);

// Write where the customers of a route are. In place.
inline void locate(const Fleet& fleet, Int slot) {
    note_places(fleet.where, tour_of(fleet, slot), slot);
}

}  // namespace tandem
