#include "search/route/charging.h"

#include <utility>

#include "rules/hub.h"
#include "search/route/freshness.h"

namespace tandem {

void charge(NodeTable places, const TravelLegs& legs, const TravelLegs& homeward,
            const VehicleType& type, Sortie& sortie, Int node) {
    Int left = battery_of(type), aboard = sortie.taken, most = aboard, flown = 0;
    Int here = sortie.home;
    for (Int index = sortie.count - 1; index >= 0; --index) {
        const Int before = sortie.nodes[index];
        const Windows place = places[before];
        const TravelLegs& way = index == sortie.count - 1 ? homeward : legs;
        const Int flight = leg(way, before, here).duration, service = place.service_duration();
        left = after_leg(type, left, aboard, flight);
        aboard += weight_flown_out(place) - weight_flown_back(place);
        most = std::max(most, aboard);
        if (hovers_at_customers(type)) left = after_hovering(type, left, aboard, service);
        flown += flight + service;
        here = before;
    }
    const Int flight = leg(legs, node, here).duration;
    sortie.left = after_leg(type, left, aboard, flight);
    sortie.limit = longest_hold(type, flown + flight, sortie.left, most);
}

void hover(NodeTable places, const VehicleType& type, Sortie& sortie, BlockSums& sums) {
    Int aboard = sortie.taken;
    for (Int index = sortie.count - 1; index >= 0; --index) {
        const Windows place = places[sortie.nodes[index]];
        aboard += weight_flown_out(place) - weight_flown_back(place);
        const Int waited = place.waiting(sortie.arrivals[index]);
        if (waited > 0) {
            sortie.left = after_hovering(type, sortie.left, aboard, waited);
            sums.lo = std::max(sums.lo, sums.time);
        }
    }
}

void note_charge(const VehicleType& type, View<Sortie, 1> sorties, Int index, Int first) {
    Sortie& sortie = sorties[index];
    const auto [kept, since] = first_charge(type, sortie.drone);
    sortie.kept = kept;
    sortie.since = since;
    sortie.follows = 0;
    for (Int other = first; other < index; ++other) {
        if (sorties[other].drone != sortie.drone) continue;
        sortie.kept = sorties[other].left;
        sortie.since = recovery_end(type, sorties[other].begin);
        sortie.follows = 1;
    }
    sortie.charged = take_off(type, time_charged(type, sortie.kept, sortie.since, sortie.left), 1);
}

Int await_charge(const VehicleType& type, Sortie& sortie, Int takeoff, Int time) {
    const Int there = charged(type, sortie.kept, sortie.since, launch_begin(type, takeoff, 1));
    sortie.left -= battery_of(type) - there;
    return is_steady(type) && sortie.follows == 1 ? sortie.charged - time : none;
}

namespace {

using Plugging = tandem_plugging;

// Where vehicles are unplugged as others are plugged in, they come first.
constexpr auto comes_before = [](const Plugging& one, const Plugging& other) {
    if (one.depot != other.depot) return one.depot < other.depot;
    return one.time != other.time ? one.time < other.time : one.change < other.change;
};

// Return the slot of the route for which one in a slot stands; `nowhere` if it is new.
Int slot_meant(const Fleet& fleet, Int slot) {
    if (slot < fleet.route.size() - scratch_slots) return slot;
    for (const Stop& stop : stops_of(fleet, slot)) {
        if (stop.kind == customer_stop && fleet.where[stop.node].slot >= 0) {
            return fleet.where[stop.node].slot;
        }
    }
    return nowhere;
}

// When the battery of the vehicle on a trip was last charged, as far as it then was.
Charge charge_of(const VehicleType& type, const Trip& trip, const Charge& before) {
    if (trip.charged_until <= trip.charged_from) return before;
    return {charged(type, before.kept, trip.charged_from, trip.charged_until), before.since};
}

// What a timed trip takes of the battery; more than that holds if it is too much.
Int taken_on(const ProblemData& data, const Tour& tour, const Trip& trip) {
    return battery_of(data.type[tour.route.type]) - follow_trip(data, tour, trip).left();
}

// Write when vehicles of other routes than that in a slot are charged. In place: `data.plugging`.
//
// A route in a scratch slot stands for the one whose customers it serves.
void note_pluggings(const ProblemData& data, const Fleet& fleet, Int slot) {
    const View<Plugging, 1> pluggings = data.plugging;
    const Int own = slot_meant(fleet, slot);
    Int count = 0;
    for (Int other = 0; other < fleet.route.size() - scratch_slots; ++other) {
        const Route& route = fleet.route[other];
        if (other == own || route.length == 0 || !shares_chargers(data.type[route.type])) continue;
        for (const Trip& trip : trips_of(fleet, other)) {
            if (trip.charged_until <= trip.charged_from) continue;
            const Int depot = fleet.stop(other, trip.first).node;
            pluggings.at(count++) = {depot, trip.charged_from, 1};
            pluggings.at(count++) = {depot, trip.charged_until, -1};
        }
    }
    std::sort(pluggings.begin(), pluggings.begin() + count, comes_before);
    pluggings[pluggings.size() - 1].change = count;
}

// The pluggings that were noted; the last row of all tells how many.
View<const Plugging, 1> noted(const ProblemData& data) {
    return data.plugging.first(data.plugging[data.plugging.size() - 1].change);
}

// Places to charge at a depot, beside those that other vehicles take.
class FreeChargers {
public:
    FreeChargers(const ProblemData& data, Int depot)
        : hub_(data.hub[depot]), depot_(depot), pluggings_(noted(data)) {
        first_ = std::lower_bound(pluggings_.begin(), pluggings_.end(), Plugging{depot, none, none},
                                  comes_before);
    }

    // Return when a vehicle that is there from `since` on may begin to be charged for so long;
    // `far` if never.
    Int soonest(Int since, Int duration) const {
        if (hub_.chargers >= unlimited) return since;
        Int taken = 0, begin = has_free_charger(hub_, 0) ? since : far;
        for (const Plugging* next = first_; next != pluggings_.end() && next->depot == depot_;
             ++next) {
            if (begin != far && next->time >= begin + duration) break;
            taken += next->change;
            if (!has_free_charger(hub_, taken)) {
                begin = far;
            } else if (begin == far) {
                begin = std::max(since, next->time);
            }
        }
        return begin;
    }

private:
    const Hub& hub_;
    const Int depot_;
    const View<const Plugging, 1> pluggings_;
    const Plugging* first_;
};

// Write of how much each trip wants to begin with, for those behind to begin as they are timed. In
// place; false if any takes more than a battery holds.
bool look_ahead(const ProblemData& data, const Tour& tour) {
    const auto& [route, stops, trips, sorties] = tour;
    const VehicleType& type = data.type[route.type];
    Int lacking = 0;
    for (Int index = route.trips - 1; index >= 0; --index) {
        Trip& trip = trips[index];
        const Int taken = taken_on(data, tour, trip);
        if (taken > battery_of(type)) return false;
        trip.wanted = std::min(battery_of(type), taken + lacking);
        if (index == 0) break;
        const Int since = stops[trips[index - 1].last].leave, until = stops[trip.first].leave;
        lacking = std::max(Int{0}, trip.wanted - charged(type, 0, since, until));
    }
    return true;
}

// How long a battery is charged that has so much until it has enough; 0 if it has.
Int time_to_have(const VehicleType& type, Int kept, Int wanted) {
    return time_charged(type, kept, 0, battery_of(type) - wanted);
}

}  // namespace

bool charge_in_turn(const ProblemData& data, const Fleet& fleet, Int slot) {
    const Tour tour = tour_of(fleet, slot);
    const auto& [route, stops, trips, sorties] = tour;
    const VehicleType& type = data.type[route.type];
    if (!look_ahead(data, tour)) return false;
    Charge charge = first_charge(type, 0);
    bool others_are_noted = false;
    for (Trip& trip : trips.first(route.trips)) {
        const auto plug = [&](Int wanted) {
            if (!std::exchange(others_are_noted, true)) note_pluggings(data, fleet, slot);
            const Int duration = time_to_have(type, charge.kept, wanted);
            trip.charged_from =
                FreeChargers(data, stops[trip.first].node).soonest(charge.since, duration);
            trip.charged_until = trip.charged_from == far ? far : trip.charged_from + duration;
            return trip.charged_until - stops[trip.first].leave;
        };
        const auto wait = [&] {
            const Int taken = taken_on(data, tour, trip);
            if (taken > battery_of(type)) return far;
            trip.charged_from = trip.charged_until = charge.since;
            const Int wanted = std::max(taken, trip.wanted);
            if (wanted <= charge.kept || plug(wanted) <= 0) return Int{0};
            trip.charged_from = trip.charged_until = charge.since;
            if (taken <= charge.kept) return Int{0};
            const Int later = plug(taken);
            return trip.charged_from == far ? far : later;
        };
        if (!hold_trip(data, tour, trip, wait)) return false;
        charge = charge_of(type, trip, charge);
        charge.kept -= taken_on(data, tour, trip);
        charge.since = stops[trip.last].leave;
    }
    return true;
}

bool is_charged_in_turn(const ProblemData& data, const Tour& tour) {
    const auto& [route, stops, trips, sorties] = tour;
    const VehicleType& type = data.type[route.type];
    Charge charge = first_charge(type, 0);
    for (const Trip& trip : trips.first(route.trips)) {
        if (trip.charged_until > trip.charged_from &&
            (trip.charged_from < charge.since || trip.charged_until > stops[trip.first].leave)) {
            return false;
        }
        charge = charge_of(type, trip, charge);
        charge.kept -= taken_on(data, tour, trip);
        charge.since = stops[trip.last].leave;
        if (charge.kept < 0) return false;
    }
    return true;
}

bool has_places(const ProblemData& data, const Fleet& fleet, Int slot) {
    const View<const Stop, 1> stops = fleet.stop[slot];
    const View<const Trip, 1> made = trips_of(fleet, slot);
    note_pluggings(data, fleet, slot);
    return std::ranges::all_of(made, [&](const Trip& trip) {
        return trip.charged_until <= trip.charged_from ||
               FreeChargers(data, stops[trip.first].node)
                       .soonest(trip.charged_from, trip.charged_until - trip.charged_from) ==
                   trip.charged_from;
    });
}

}  // namespace tandem
