// Who is served some time behind others on a route: trucks wait for that, drones don't.
#pragma once

#include "rules/lag.h"
#include "search/route/layout.h"

namespace tandem {

struct Truck;

// Tell whether anybody is to be served some time behind others.
inline bool lags_count(const ProblemData& data) { return !data.lag.empty(); }

// Tell whether anybody is to be served some time behind others whom any vehicle may serve.
inline bool orders_cross(const ProblemData& data) { return !data.across.empty(); }

// A part of a route: its stops from one up to another.
struct Part {
    Int first, behind;
};

// Write from when to when those of a route may be served by whom other routes serve, as these are
// planned. In place: `data.span`.
void note_spans(const ProblemData& data, const Fleet& fleet, Int slot);

// Write likewise that they are served as the route is planned, whose trips begin so. In place.
void keep_starts(const ProblemData& data, const Tour& tour);

// Write that a route's trips begin, and its stops are served, as they are timed. In place.
void plan_starts(const Tour& tour);

// The arrival at a timed stop of whoever would be served then without waiting for others.
inline Int as_if_reached(const ProblemData& data, const Stop& stop) {
    return lags_count(data) ? std::max(stop.arrival, stop.start) : stop.arrival;
}

// Have the truck, which reaches stop `p` at `arrival`, wait for those who are to be served before.
//
// In place, if they are on the route's stops and sorties before, or on others, by `data.span`;
// returns when it leaves at the soonest, `far` if that is too late.
Int await_others(const Truck& truck, View<Stop, 1> stops, View<const Sortie, 1> sorties, Int p,
                 Int arrival);

// Tell whether all on a timed route are served as long behind others as they should.
bool keeps_all_lags(const ProblemData& data, const Tour& tour);

// Return by how much somebody is served too long behind another of a timed trip; at most 0 if
// nobody is.
Int most_lag_excess(const ProblemData& data, const Tour& tour, const Trip& trip);

// Return by how much somebody of a part is served too long behind another, there or before it, or
// by a drone too soon; 0 if nobody is.
Int excess_within(const ProblemData& data, View<const Stop, 1> stops, View<const Sortie, 1> sorties,
                  Part part);

// Return when the truck has to leave stop `p` for those to be served in time who are served behind.
//
// Of stops behind, it is known by when service may begin there (`free_start`); the customer's own
// takes `service_duration`.
Int latest_leave(const ProblemData& data, const Tour& tour, Int p, Int service_duration);

}  // namespace tandem
