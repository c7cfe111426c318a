#include "search/route/batteries.h"

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

}  // namespace tandem
