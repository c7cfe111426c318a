#include <utility>

#include "search/insertion/offers.h"
#include "search/route/goods.h"

namespace tandem {
namespace {

// Stops of a trip that is split, from the first to the last, with the sorties launched there.
struct Half {
    Int first, last;
};

// Calls `visit` with each customer whom drones serve that are launched in half of a trip.
template <class Visit>
void for_each_flown(const Fleet& fleet, Int slot, Half half, const Visit& visit) {
    for (const Sortie& sortie : sorties_of(fleet, slot)) {
        if (half.first <= sortie.launch && sortie.launch <= half.last) {
            for (const Int node : sortie.customers()) visit(node);
        }
    }
}

// Tells whether a customer may go with those of half of a trip.
bool goods_may_join_half(const ProblemData& data, const Fleet& fleet, Int slot, Half half,
                         Int node) {
    if (!goods_count(data)) return true;
    const View<const Stop, 1> stops = fleet.stop[slot];
    Company there{0, 0};
    const auto add = [&](Int other) {
        there.barred |= barred_on_trip(data.goods[other]);
        there.kept |= kept_on_trip(data.goods[other]);
    };
    for (Int q = half.first; q <= half.last; ++q) {
        if (stops[q].kind == customer_stop) add(stops[q].node);
    }
    for_each_flown(fleet, slot, half, add);
    return may_accompany(data.goods[node], there, fleet.route[slot]);
}

// Tells whether a trip split behind stop `p` may be two, a customer more at the split, by what is
// aboard.
//
// `front`: at the end of the first.
bool halves_fit(const ProblemData& data, const Fleet& fleet, Int slot, Int p, Int node,
                bool front) {
    const VehicleType& type = data.type[fleet.route[slot].type];
    const Trip& trip = fleet.trip(slot, fleet.stop(slot, p).trip);
    for (Int tier = 0; tier < tiers_aboard(fleet); ++tier) {
        const View<const StopLoad, 1> stop_loads = fleet.stop_load[slot][tier];
        const Cargo more = cargo_for(data.amount, node, tier);
        const Cargo one = cargo_between(stop_loads, trip.first, p + 1);
        const Cargo other = cargo_between(stop_loads, p + 1, trip.last + 1);
        if (!may_be_joined(type, one, front ? more : no_cargo, tier) ||
            !may_be_joined(type, front ? no_cargo : more, other, tier)) {
            return false;
        }
    }
    return true;
}

// Tells whether a trip can be split behind stop `p`, a customer more before or behind the split.
//
// `until`: before. Loads are not looked at.
bool split_fits(const ProblemData& data, const Fleet& fleet, Int slot, Int p, Int node,
                bool until) {
    const View<const Stop, 1> stops = fleet.stop[slot];
    const VehicleType& type = data.type[fleet.route[slot].type];
    const NodeTable places = data.place.by_truck(type);
    const TravelLegs legs = legs_of(data.leg, type.travel);
    const Int first = fleet.trip(slot, stops[p].trip).first;
    const Int last = fleet.trip(slot, stops[p].trip).last;
    Int front = 0, rear = 0, front_length = 0, rear_length = 0;
    for (Int q = first; q < last; ++q) {
        Int& half = q <= p ? front : rear;
        if (q > first) half = std::max(half, release_of(places[stops[q].node]));
        if (q < p) front_length += stops[q].leg;
        if (q > p) rear_length += stops[q].leg;
    }
    Int& joined = until ? front : rear;
    joined = std::max(joined, release_of(places[node]));
    Front way{std::max(stops[first].arrival, front)};
    for (Int q = first + 1; q <= p; ++q) {
        if (!way.serve(places[stops[q].node], stops[q - 1].gap)) return false;
    }
    Int here = stops[p].node;
    const auto duration_to = [&](Int to, Int& length) {
        const Leg on = leg(legs, std::exchange(here, to), to);
        length += on.distance;
        return on.duration;
    };
    if (until && !way.serve(places[node], duration_to(node, front_length))) return false;
    way.drive(duration_to(type.depot, front_length));
    if (!may_end(type, way.time)) return false;
    way.time = std::max(way.time + type.reload_duration, rear);
    if (!until && !way.serve(places[node], duration_to(node, rear_length))) return false;
    way.drive(duration_to(stops[p + 1].node, rear_length));
    return Rear{stops[p + 1].latest}.allows(way) &&
           std::max(front_length, rear_length) <= longest_trip(type);
}

// Tells whether a customer can be served by a trip of its own behind stop `p`, or -1.
bool trip_fits(const ProblemData& data, const Fleet& fleet, Int slot, Int p, Int node) {
    const auto [route, stops, trips, sorties] = tour_of(fleet, slot);
    const VehicleType& type = data.type[route.type];
    const NodeTable places = data.place.by_truck(type);
    const TravelLegs legs = legs_of(data.leg, type.travel);
    const Int free = p >= 0 ? stops[p].leave + type.reload_duration : type.shift_earliest;
    Front way{std::max(free, release_of(places[node]))};
    const Leg out = leg(legs, type.depot, node), home = leg(legs, node, type.depot);
    if (!way.serve(places[node], out.duration)) return false;
    way.drive(home.duration);
    if (!may_end(type, way.time) || out.distance + home.distance > longest_trip(type)) return false;
    way.drive(type.reload_duration);
    return p + 1 == route.length || Rear{stops[p + 1].latest}.allows(way);
}

}  // namespace

bool part_fits(const ProblemData& data, const Fleet& fleet, Int slot, Int p, Int node, bool front) {
    const View<const Stop, 1> stops = fleet.stop[slot];
    const Trip& trip = fleet.trip(slot, stops[p].trip);
    const Half half = front ? Half{trip.first, p} : Half{p + 1, trip.last};
    if (!goods_may_join_half(data, fleet, slot, half, node)) return false;
    Amount load = demand_of(data.place[0][node]);
    Int count = 1;
    for (Int q = half.first; q <= half.last; ++q) {
        if (stops[q].kind != customer_stop) continue;
        ++count;
        load = plus(load, demand_of(data.place[0][stops[q].node]));
    }
    const VehicleType& type = data.type[fleet.route[slot].type];
    if (!allows_stops(type, count)) return false;
    if (tiers_aboard(fleet) > 0) return halves_fit(data, fleet, slot, p, node, front);
    for_each_flown(fleet, slot, half,
                   [&](Int other) { load = plus(load, demand_of(data.place[0][other])); });
    return holds(type, load);
}

bool may_begin(const ProblemData& data, Int k, Int node) {
    for (Int tier = 0; tier < tiers_of(data); ++tier) {
        if (!may_be_all(data.type[k], cargo_for(data.amount, node, tier), tier)) return false;
    }
    return true;
}

bool more_trips_fit(const ProblemData& data, const Fleet& fleet, const Move& move, Int node) {
    if (begins_trip(move)) return trip_fits(data, fleet, move.slot, move.first, node);
    const bool until = move.placement[0].how == How::serve;
    return split_fits(data, fleet, move.slot, move.first, node, until);
}

}  // namespace tandem
