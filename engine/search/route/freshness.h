// Trips held back so that nobody's parcel is aboard, nobody who flies by itself in the air, and
// nobody served behind another, for too long.
#pragma once

#include "rules/driving.h"
#include "rules/holding.h"
#include "search/route/flown_trips.h"
#include "search/route/routes.h"

namespace tandem {

// Return when truck or drone first leaves the depot on the timed trip from stop `first` on.
Int departure_of(const ProblemData& data, const Route& route, View<const Stop, 1> stops,
                 View<const Sortie, 1> sorties, Int first);

// Tell whether trips of type `k` may have to be held back.
bool holds_count(const ProblemData& data, Int k);

// Tell whether somebody's parcel is too long aboard on a timed route, a trip too long in the air,
// or somebody served too soon or too late behind another.
bool any_too_long(const ProblemData& data, const Route& route, View<const Stop, 1> stops,
                  View<const Trip, 1> trips, View<const Sortie, 1> sorties);

// Return by how much later a timed trip has to begin at least; at most 0 if it needn't, `far` if
// that doesn't help.
Int most_excess(const ProblemData& data, const Route& route, View<const Stop, 1> stops,
                const Trip& trip, View<const Sortie, 1> sorties);

// Return in how much time a timed trip, begun later, meets other windows or speeds; `far` if never.
Int time_to_turn(const ProblemData& data, const Route& route, View<const Stop, 1> stops,
                 const Trip& trip, View<const Sortie, 1> sorties);

// Let a trip of a timed route begin as soon as nothing lasts too long, and its battery is charged.
//
// `wait_for_charge` returns how much later it has to begin for that; at most 0 if it needn't, `far`
// if that doesn't help. In place; false if that doesn't help, or a rule is broken, or the search
// must end: where drivers rest, each time takes long.
template <class WaitForCharge>
bool hold_trip(const ProblemData& data, Route& route, View<Stop, 1> stops, const Trip& trip,
               View<Sortie, 1> sorties, const WaitForCharge& wait_for_charge) {
    const VehicleType& type = data.type[route.type];
    Holding holding(trip.last - trip.first + 1);
    while (true) {
        const Int excess = most_excess(data, route, stops, trip, sorties);
        Int wait = excess > 0
                       ? holding.wait(excess, time_to_turn(data, route, stops, trip, sorties))
                       : waits_for_calm(data, route, stops, trip);
        if (wait == 0) wait = wait_for_charge();
        if (wait <= 0) return true;
        if (wait == far || (may_pause(type) && data.deadline.passed())) return false;
        Stop& stop = stops[trip.first];
        stop.release = std::max(stop.arrival, stop.release) + wait;
        if (!drive_forward(data, route, stops, sorties)) return false;
    }
}

// Let each trip of a timed route begin as soon as nothing lasts too long, and its battery is
// charged.
//
// In place; false if that doesn't help, or a rule is broken.
bool hold_trips(const ProblemData& data, Route& route, View<Stop, 1> stops,
                View<const Trip, 1> trips, View<Sortie, 1> sorties);

}  // namespace tandem
