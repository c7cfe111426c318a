

#include "search/insertion/proposal.h"
#include "search/insertion/shipments.h"
#include "search/route/ends.h"
#include "search/route/refresh.h"
#include "search/route/rests.h"
#include "search/search.h"

namespace tandem {
namespace {

// The first and the last of the stops that a move changes.
struct ChangedStops {
    Int first, last;
};

// Copies the sequence of stops `first` to `last` with their sorties to another slot; returns how
// many sorties were skipped.
Int copy_part(const Fleet& fleet, Int slot, ChangedStops part, Int to) {
    const View<const Stop, 1> source = fleet.stop[slot];
    const View<Stop, 1> target = fleet.stop[to];
    for (Int p = part.first; p <= part.last; ++p) {
        copy_sequence(source[p], target[p - part.first]);
        target[p - part.first].hold = none;
    }
    Int skipped = 0, count = 0;
    const auto [route, stops, trips, sorties] = tour_of(fleet, slot);
    const View<Sortie, 1> copies = fleet.sortie[to];
    for (Int s = 0; s < route.sorties; ++s) {
        const Int launch = sorties[s].launch;
        if (launch < part.first) {
            ++skipped;
        } else if (launch <= part.last) {
            copies[count] = sorties[s];
            copies[count].launch -= part.first;
            copies[count].recovery -= part.first;
            ++count;
        }
    }
    fleet.route[to] = route;
    fleet.route[to].length = part.last - part.first + 1;
    fleet.route[to].sorties = count;
    return skipped;
}

// Returns the stops of the blocks that a move changes.
//
// `held` tells that the trip will begin later, so that all from its beginning on changes. Of one
// who flies by itself, the whole trip has to be looked at.
ChangedStops part_of(const VehicleType& type, const Fleet& fleet, Int slot, const Move& move,
                     bool held) {
    const View<const Stop, 1> stops = fleet.stop[slot];
    Int p = std::max(Int{move.first}, Int{0});
    Int q = std::min(Int{move.last}, fleet.route[slot].length - 1);
    const Trip& trip = fleet.trip(slot, stops[p].trip);
    const bool alone = begins_trip(move), by_drone = flies(move);
    if (!alone && (by_drone || move.count > 1)) {
        q = std::max(
            q, launch_changed(type, fleet.route[slot], fleet.sortie[slot], trip, p, by_drone));
    }
    const bool whole = bounds_trips(type) && !(alone && !by_drone);
    if (held || whole) p = trip.first;
    if (whole) q = std::max(q, trip.last);
    return {stops[p].block, stops[stops[q].block].last};
}

// The move as it is in a part of the route that begins so many stops and sorties later.
Move within(const Move& move, Int stops, Int sorties) {
    Move moved;
    moved.become(move);
    for (Placement& placed : std::span(moved.placement.data(), std::size_t(moved.count))) {
        const bool joins = placed.how == How::join;
        placed.from -= std::int32_t(joins ? sorties : stops);
        if (!joins) placed.to -= std::int32_t(stops);
    }
    return moved;
}

// Returns what a move costs with the stops that it adds, if so much without.
double with_stops(const ProblemData& data, const Move& move, double cost) {
    for (const Placement& placed : move.placements()) {
        if (placed.how == How::serve) cost += data.rate[move.type].stop;
        if (placed.how == How::halt) cost += data.halt_cost[placed.node];
    }
    return cost;
}

// A route up to the end of some stops, and how far those are driven.
struct DrivenPart {
    PaidFront front;
    Int driven;
};

// Tells whether all trips last in the air that begin and end among some stops, whose legs are
// known.
bool trips_last(const ProblemData& data, const Route& route, View<const Stop, 1> stops) {
    Int first = nowhere;
    for (Int p = 0; p < route.length; ++p) {
        if (stops[p].kind == start_stop) first = p;
        if (stops[p].kind == end_stop && first >= 0 &&
            !lasts_in_air(data, route.type, stops, first, p, {})) {
            return false;
        }
    }
    return true;
}

// Times the changed stops in slot `to`, which take the place of those from `first` on. Nothing if a
// rule is broken.
std::optional<DrivenPart> time_part(const ProblemData& data, const Fleet& fleet, Int slot,
                                    Int first, Int to) {
    const Route& route = fleet.route[to];
    const Int length = route.length, count = route.sorties;
    const View<Stop, 1> stops = fleet.stop[to].first(length);
    const View<Sortie, 1> sorties = fleet.sortie[to].first(count);
    const View<const Stop, 1> old = fleet.stop[slot];
    const Truck truck(data, route.type);
    const VehicleType& type = truck.type;
    const TravelLegs legs = legs_of(data.leg, type.travel);
    PaidFront front{old[first].arrival, old[first].before, first > 0 ? old[first - 1].depart : far};
    make_ready(truck, stops, sorties);
    BlockSums sums;
    sums.launched = launches_before(type, fleet.route[slot], fleet.sortie[slot],
                                    fleet.trip(slot, old[first].trip), first);
    Int driven = 0;
    for (Int p = 0; p < length;) {
        const Int last = pass_block(truck, stops, sorties, p, sums, front);
        if (last < 0) return std::nullopt;
        for (Int q = p; q < last; ++q) {
            driven += leg(legs, stops[q].node, stops[q + 1].node).distance;
        }
        p = last + 1;
        if (p == length) break;
        Int gap = type.reload_duration;
        if (stops[last].kind != end_stop) {
            const Leg way = leg(legs, stops[last].node, stops[p].node);
            gap = way.duration;
            driven += way.distance;
        }
        stops[last].gap = gap;
        front.drive(gap);
    }
    if (bounds_trips(type) && !trips_last(data, route, stops)) return std::nullopt;
    return DrivenPart{front, driven};
}

// Returns what it costs to put the stops in slot `to` in the place of a part.
double price_part(const ProblemData& data, const Fleet& fleet, Int slot, ChangedStops part,
                  Int to) {
    const std::optional<DrivenPart> driven_part = time_part(data, fleet, slot, part.first, to);
    if (!driven_part) return infeasible;
    auto [front, driven] = *driven_part;
    const Route& route = fleet.route[slot];
    const View<const Stop, 1> old = fleet.stop[slot];
    const Int k = route.type;
    const VehicleType& type = data.type[k];
    std::optional<Whole> whole = whole_of(front);
    if (part.last + 1 < route.length) {
        front.drive(old[part.last].gap);
        whole = join(front, rear_of(old[part.last + 1]));
        if (!whole) return infeasible;
    }
    const double longer = longer_cost(type, data.rate[k], route, *whole);
    if (longer == infeasible) return infeasible;
    if (limits_legs(type)) {
        const Leg changed = legs_on(data, type, fleet.stop[to], 0, fleet.route[to].length - 1) -
                            legs_on(data, type, old, part.first, part.last);
        if (!may_drive_all(type, route.legs + changed)) return infeasible;
    }
    for (Int p = part.first; p < part.last; ++p) driven -= old[p].leg;
    double cost = double(driven) * data.rate[k].distance + longer;
    for (Int s = 0; s < fleet.route[to].sorties; ++s) {
        cost += sortie_cost(data, k, fleet.stop[to], fleet.sortie(to, s));
    }
    for (Int s = 0; s < route.sorties; ++s) {
        const Sortie& sortie = fleet.sortie(slot, s);
        if (part.first <= sortie.launch && sortie.launch <= part.last) {
            cost -= sortie_cost(data, k, old, sortie);
        }
    }
    return cost;
}

// Lets the trips in slot `to` begin no earlier than their parcels are there.
//
// `alone` tells that the customer has a trip of its own.
void give_releases(const Fleet& fleet, Int to, bool alone, const Trip& trip, Int release) {
    for (Int p = 0; p < fleet.route[to].length; ++p) {
        Stop& stop = fleet.stop(to, p);
        if (stop.kind != start_stop) continue;
        if (stop.release == none) {
            stop.release = alone ? release : std::max(release, trip.release);
        } else if (p == 0 && !alone) {
            stop.release = std::max(stop.release, release);
        }
    }
}

// As `price_stop`.
template <class Rarer>
double price_between(const OnTrip& on, Int p, const Newcomer& newcomer) {
    const Stop& here = on.stops[p];
    const Detour detour = newcomer.detour(here.node, on.stops[p + 1].node, here.leg);
    Inserted inserted;
    Proposal<Rarer> proposal(on, p, inserted);
    if (!proposal.serve(newcomer, detour.out)) return infeasible;
    const double dearer = vehicle_cost_at(on.data.vehicle_cost, on.route.type, newcomer.node);
    return proposal.price(detour.on, dearer + on.rate.stop);
}

}  // namespace

double price_move(const ProblemData& data, const Fleet& fleet, const Move& move, Int node,
                  double bar) {
    const Int slot = move.slot, to = fleet.route.size() - 1;
    const Int k = fleet.route[slot].type;
    if (data.evaluation[k].priced || has_driving_rules(data.type[k]) ||
        (is_apart(data, k) && (move.count > 1 || bounds_reach(data.type[k]))) ||
        is_paired(data.pair, node)) {
        copy_part(fleet, slot, {0, fleet.route[slot].length - 1}, to);
        if (!apply(sequence_in(fleet, to), move) ||
            !refresh_cost(data, fleet, to, bar + fleet.cost[slot])) {
            return infeasible;
        }
        return fleet.cost[to] - fleet.cost[slot];
    }
    const Trip& trip = fleet.trip(slot, fleet.stop(slot, std::max(Int{move.first}, Int{0})).trip);
    const Int release = release_of(data.place[0][node]);
    const bool alone = begins_trip(move);
    const ChangedStops part =
        part_of(data.type[k], fleet, slot, move, !alone && release > trip.release);
    const Int skipped = copy_part(fleet, slot, part, to);
    if (!apply(sequence_in(fleet, to), within(move, part.first, skipped))) return infeasible;
    give_releases(fleet, to, alone, trip, release);
    return with_stops(
        data, move,
        price_part(data, fleet, slot, part, to) + vehicle_cost_at(data.vehicle_cost, k, node));
}

bool stands_alone(const ProblemData& data, const Fleet& fleet, Int slot, Int p, Int node) {
    const Route& route = fleet.route[slot];
    const Stop& stop = fleet.stop(slot, p);
    return joins_anywhere(data, route) && stop.flying == 0 &&
           !(has_driving_rules(data.type[route.type]) &&
             may_have_to_rest(data, fleet, slot, p, node)) &&
           release_of(data.place[0][node]) <= fleet.trip(slot, stop.trip).release;
}

double price_stop(const ProblemData& data, const Fleet& fleet, Int slot, Int p,
                  const Newcomer& newcomer) {
    const OnTrip on(data, fleet, slot, fleet.trip(slot, fleet.stop(slot, p).trip));
    return on.asks_more ? price_between<RarerRules>(on, p, newcomer)
                        : price_between<NoRarerRules>(on, p, newcomer);
}

}  // namespace tandem
