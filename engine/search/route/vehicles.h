// What trips and sorties carry, and what a route costs by distance alone by vehicles of each type.
#pragma once

#include <limits>

#include "rules/drone_types.h"
#include "rules/flight.h"
#include "rules/shift.h"
#include "search/route/rarer.h"
#include "search/route/state.h"

namespace tandem {

// Tell whether drones of a type's vehicles may serve some end of a shipment, by one of them.
inline bool flies_some_end(const ProblemData& data, Int k, Int end) {
    bool flies = data.can(k, 1, data.pair[data.pair[end].unit].partner);
    for_each_pickup(data.pair, end, [&](Int pickup) { flies = flies || data.can(k, 1, pickup); });
    return flies;
}

// Return how many customers the truck itself serves on a trip.
inline Int stops_on(const Trip& trip) { return trip.last - trip.first - 1 - trip.halts; }

// Tell whether a sortie more may be flown on a trip of a route, by their number.
bool may_launch(const VehicleType& type, const Route& route, View<const Sortie, 1> sorties,
                const Trip& trip);

// Return how many of a truck's sorties from `first` on are flown by drones of a row.
Int num_flown(View<const VehicleType, 1> types, Int k, View<const Sortie, 1> sorties, Int first,
              Int behind, Int row);

// Tell whether there are batteries for the sorties of a trip.
//
// Where drones are of one type, `allows_sorties` tells that already.
bool have_batteries(View<const VehicleType, 1> types, Int k, View<const Sortie, 1> sorties,
                    Int first, Int behind);

// Tell whether drones of a row have a battery for one more sortie on a trip.
//
// Where they are of one type, `may_launch` tells that already.
bool has_battery(View<const VehicleType, 1> types, const Route& route,
                 View<const Sortie, 1> sorties, const Trip& trip, Int row);

// Return how many launches of a trip come before its stop `p`, if that matters.
inline Int launches_before(const VehicleType& type, const Route& route,
                           View<const Sortie, 1> sorties, const Trip& trip, Int p) {
    Int count = 0;
    if (launches_differ(type)) {
        for (const Sortie& sortie : sorties.first(route.sorties)) {
            if (trip.first <= sortie.launch && sortie.launch < p) ++count;
        }
    }
    return count;
}

// Return the stop of the launch that takes another time since a trip changes at stop `p`.
//
// That was the trip's first launch where a sortie from stop `p` comes before it; where the trip is
// cut behind stop `p`, the next launch becomes one. `nowhere`: none does.
Int launch_changed(const VehicleType& type, const Route& route, View<const Sortie, 1> sorties,
                   const Trip& trip, Int p, bool is_sortie);

// Return what a trip carries from the depot.
inline Amount load_of(const Trip& trip) { return amount_of(trip.load); }

// How far a route of one trip is driven where distance alone costs, to how many, with what.
struct Haul {
    Int distance, stops;
    Amount load;
};

inline Haul haul_of(const Trip& trip) { return {trip.distance, stops_on(trip), load_of(trip)}; }

// Return what it costs by a vehicle of type `k`.
inline double route_cost(const ProblemData& data, Int k, const Haul& haul) {
    return trip_cost(data.rate[k], haul.distance, haul.stops);
}

// Tell whether a vehicle of a type holds what a trip carries, and may stop so often.
inline bool may_make(const VehicleType& type, const Trip& trip) {
    return holds(type, load_of(trip)) && allows_stops(type, stops_on(trip));
}

// Let a trip carry more. In place.
inline void add_load(Trip& trip, const Amount& amount) {
    for (std::size_t dimension = 0; dimension < amount.size(); ++dimension) {
        trip.load[dimension] += amount[dimension];
    }
}

// Tell, as `may_fit` does, by what is aboard at the stops of a trip, where that is looked at.
bool may_fit_in_tiers(const ProblemData& data, const Fleet& fleet, Int slot, Int index, Int k,
                      Int node);

// Tell whether a vehicle of type `k` may hold what a trip does and a customer's amounts.
//
// Where more than its load tells, that hangs on where the customer is served: see `has_room`.
inline bool may_fit(const ProblemData& data, const Fleet& fleet, Int slot, Int index, Int k,
                    Int node) {
    return fits(data.type[k], load_of(fleet.trip(slot, index)), data.place[0][node]) &&
           (tiers_aboard(fleet) == 0 || may_fit_in_tiers(data, fleet, slot, index, k, node));
}

// Tell whether a vehicle of type `k` may fit a customer in as well, and stop once more.
inline bool takes(const ProblemData& data, const Fleet& fleet, Int slot, Int index, Int k,
                  Int node) {
    return may_fit(data, fleet, slot, index, k, node) &&
           allows_stops(data.type[k], stops_on(fleet.trip(slot, index)) + 1);
}

// Return the type for which type `k` would be exchanged to take a customer more on a route.
//
// The cheapest that is left and holds them all, as far as `may_fit` tells as well; `nowhere` if
// there is none.
template <class MayFit>
Int larger_type(const ProblemData& data, const Fleet& fleet, Int k, const Haul& haul, Int node,
                const MayFit& may_fit) {
    Int chosen = nowhere;
    double best = std::numeric_limits<double>::infinity();
    for (Int by = 0; by < data.num_types; ++by) {
        const VehicleType& type = data.type[by];
        if (!data.swap(k, by) || !data.can(by, 0, node) || !is_left(data, fleet, by)) continue;
        const double cost = route_cost(data, by, haul) + data.rate[by].stop;
        if (cost < best && fits(type, haul.load, data.place[0][node]) &&
            allows_stops(type, haul.stops + 1) && may_fit(by)) {
            chosen = by;
            best = cost;
        }
    }
    return chosen;
}

// Let a vehicle of another type drive a route that costs by distance alone. In place.
void change_type(const ProblemData& data, const Fleet& fleet, Int slot, Int k);

}  // namespace tandem
