// Trips held back so that nobody's parcel is aboard, nobody who flies by itself in the air, and
// nobody served behind another, for too long.
#pragma once

#include "rules/driving.h"
#include "rules/holding.h"
#include "search/route/flown_trips.h"
#include "search/route/routes.h"

namespace tandem {

// Return when truck or drone first leaves the depot on the timed trip from stop `first` on.
Int departure_of(const ProblemData& data, const Tour& tour, Int first);

// Tell whether trips of type `k` may have to be held back.
bool holds_count(const ProblemData& data, Int k);

// Tell whether somebody's parcel is too long aboard on a timed route, a trip too long in the air,
// or somebody served too soon or too late behind another.
bool any_too_long(const ProblemData& data, const Tour& tour);

// Return by how much later a timed trip has to begin at least; at most 0 if it needn't, `far` if
// that doesn't help.
Int most_excess(const ProblemData& data, const Tour& tour, const Trip& trip);

// Return in how much time a timed trip, begun later, meets other windows or speeds; `far` if never.
Int time_to_turn(const ProblemData& data, const Tour& tour, const Trip& trip);

// Let a trip of a timed route begin as soon as nothing lasts too long, and its battery is charged.
//
// `wait_for_charge` returns how much later it has to begin for that; at most 0 if it needn't, `far`
// if that doesn't help. In place; false if that doesn't help, or a rule is broken, or the search
// must end: where drivers rest, each time takes long.
template <class WaitForCharge>
bool hold_trip(const ProblemData& data, const Tour& tour, const Trip& trip,
               const WaitForCharge& wait_for_charge) {
    const VehicleType& type = data.type[tour.route.type];
    Holding holding(trip.last - trip.first + 1);
    while (true) {
        const Int excess = most_excess(data, tour, trip);
        Int wait = excess > 0 ? holding.wait(excess, time_to_turn(data, tour, trip))
                              : waits_for_calm(data, tour, trip);
        if (wait == 0) wait = wait_for_charge();
        if (wait <= 0) return true;
        if (wait == far || (is_timed_slowly(type) && data.deadline.passed())) return false;
        Stop& stop = tour.stops[trip.first];
        stop.release = std::max(stop.arrival, stop.release) + wait;
        if (!drive_forward(data, tour)) return false;
    }
}

// Let each trip of a timed route begin as soon as nothing lasts too long, and its battery is
// charged.
//
// In place; false if that doesn't help, or a rule is broken.
bool hold_trips(const ProblemData& data, const Tour& tour);

}  // namespace tandem
