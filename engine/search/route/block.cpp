

#include "rules/launch_place.h"
#include "search/route/charging.h"

namespace tandem {
namespace {

// Return until when the windows hold a sortie back that it meets if it leaves at `takeoff`.
Int held_by_windows(const DroneData& drone_data, const Sortie& sortie, Int node, Int takeoff) {
    Front front{takeoff};
    Int back = none, here = node;
    for (const Int next : sortie.customers()) {
        const Windows place = drone_data.places[next];
        const Int flight = leg(drone_data.legs, here, next).duration;
        front.drive(flight);
        back =
            std::max(back + flight + place.service_duration(), earliest_back(place, front.time, 0));
        front.serve(place);
        here = next;
    }
    return held_until(back + leg(drone_data.homeward, here, sortie.home).duration, sortie.limit);
}

// Return when a sortie is back for its recovery that leaves `node` at `takeoff`.
Int back_at(const DroneData& drone_data, const Sortie& sortie, Int node, Int takeoff) {
    Front front{takeoff};
    Int here = node;
    for (const Int next : sortie.customers()) {
        front.serve(drone_data.places[next], leg(drone_data.legs, here, next).duration);
        here = next;
    }
    front.drive(leg(drone_data.homeward, here, sortie.home).duration);
    return front.time;
}

// Return when a sortie takes off at `node` that can at `takeoff`: then, or held back.
Int soonest_takeoff(const DroneData& drone_data, const Sortie& sortie, Int node, Int takeoff) {
    takeoff = std::max(takeoff, sortie.held);
    if (charges_aboard(drone_data.type)) takeoff = std::max(takeoff, sortie.charged);
    const bool single = drone_data.places[0].are_single();
    const bool storms = storms_sometime(drone_data.type);
    if (single && !storms) return takeoff;
    while (true) {
        Int held = single ? none : held_by_windows(drone_data, sortie, node, takeoff);
        if (held <= takeoff && storms) {
            held = calm_takeoff(drone_data.type, takeoff,
                                back_at(drone_data, sortie, node, takeoff), sortie.zones);
        }
        if (held <= takeoff) return takeoff;
        takeoff = held;
    }
}

// Let the truck arrive at the block from `first` to `last`. In place.
void bound_arrival(BlockSums& sums, Interval within) {
    sums.lo = std::max(sums.lo, within.first);
    sums.hi = std::min(sums.hi, within.last);
}

// Bound the truck's arrival by the window of a customer who is reached so.
//
// In place; false if that is too late however soon the truck arrives.
inline bool reach(Windows place, TimeSegment reached, BlockSums& sums) {
    if (place.too_late(reached.c)) return false;
    bound_arrival(sums, place.allowed_within(sums.time, reached));
    sums.dep = std::min(sums.dep, place.in_same_window(reached.at(sums.time)) - reached.d);
    return true;
}

// Tell whether no customer of a sortie lies too far from where it is launched or recovered.
bool reaches(const Truck& truck, const DroneData& drone_data, const Sortie& sortie, Int node) {
    const VehicleType& type = drone_data.type;
    return !limits_range(type) ||
           std::all_of(sortie.nodes, sortie.nodes + sortie.count,
                       [&](Int customer) { return in_range(truck.data, type, node, customer); });
}

// Return when the launch of a sortie at `node` can begin, by what the truck does there.
TimeSegment ready_to_launch(const Truck& truck, const Sortie& sortie, Int node,
                            const BlockSums& sums) {
    const auto is_handed = [&](Int delivery) {
        return hands_over(truck.data.pair, node, delivery);
    };
    if (!some_paired(truck.data.pair) ||
        std::none_of(sortie.nodes, sortie.nodes + sortie.count, is_handed)) {
        return {sums.free_d, sums.free_c};
    }
    return {std::max(sums.free_d, sums.served_d), std::max(sums.free_c, sums.served_c)};
}

// Launch a sortie from `node` once the truck is ready. In place; false if not allowed.
bool fly_out(const Truck& truck, const DroneData& drone_data, Sortie& sortie, Int node,
             BlockSums& sums) {
    const VehicleType& type = drone_data.type;
    const TimeSegment ready = ready_to_launch(truck, sortie, node, sums);
    Int d = take_off(type, ready.d, sums.launched);
    Int c = take_off(type, ready.c, sums.launched);
    const Int takeoff = TimeSegment{d, c}.at(sums.time);
    const Int held = soonest_takeoff(drone_data, sortie, node, takeoff);
    if (held > takeoff) c = held;
    if (charges_aboard(type)) {
        const Int free = d;
        d = std::max(d, await_charge(type, sortie, TimeSegment{d, c}.at(sums.time), sums.time));
        sums.awaited += d - free;
    }
    sums.free_d = sortie.takeoff_d = d;
    sums.free_c = sortie.takeoff_c = c;
    sortie.takeoff = TimeSegment{d, c}.at(sums.time);
    Int here = node;
    for (Int index = 0; index < sortie.count; ++index) {
        const Int next = sortie.nodes[index];
        const Windows place = drone_data.places[next];
        const Int flight = leg(drone_data.legs, here, next).duration;
        const TimeSegment reached{d + flight, c + flight};
        if (unreachable(flight) || !reach(place, reached, sums)) return false;
        sortie.arrivals[index] = reached.at(sums.time);
        const auto [start_d, start_c] = place.start_within(sums.time, reached);
        d = start_d + place.service_duration();
        c = start_c + place.service_duration();
        here = next;
    }
    sortie.ready_d = d;
    sortie.ready_c = c;
    sortie.state = sortie_flies;
    ++sums.flying;
    ++sums.launched;
    if (hovers_at_customers(type)) hover(drone_data.places, type, sortie, sums);
    return !is_limited(type) || sortie.left >= 0;
}

// Recover a sortie at `node`. In place; false if endurance or energy forbids it.
bool bring_home(const DroneData& drone_data, Sortie& sortie, Int node, BlockSums& sums) {
    const VehicleType& type = drone_data.type;
    const Int flight = leg(drone_data.homeward, sortie.nodes[sortie.count - 1], node).duration;
    const TimeSegment back{sortie.ready_d + flight, sortie.ready_c + flight};
    const TimeSegment begin{std::max(sums.free_d, back.d), std::max(sums.free_c, back.c)};
    if (unreachable(flight)) return false;
    bound_arrival(sums, lasting_within(endurance_of(type), {sortie.takeoff_d, sortie.takeoff_c},
                                       {counted_until(type, back.d, begin.d),
                                        counted_until(type, back.c, begin.c)}));
    if (storms_sometime(type)) {
        const Int calm = calm_until(type, sortie.takeoff, sortie.zones);
        if (begin.c > calm) return false;
        sums.hi = std::min(sums.hi, calm - begin.d);
        sums.dep = std::min(sums.dep, calm - begin.d);
    }
    if (is_limited(type)) {
        const Interval hovering =
            lasting_within(longest_hover(type, sortie.left, sortie.taken), back, begin);
        bound_arrival(sums, hovering);
        // A sortie as long as before may wait where that takes more.
        sums.dep = std::min(sums.dep, hovering.last);
    }
    sortie.begin = begin.at(sums.time);
    if (charges_aboard(type)) {
        sortie.left =
            after_hovering(type, sortie.left, sortie.taken, sortie.begin - back.at(sums.time));
    }
    const Int slack = sortie.begin - begin.d;
    if (sortie.takeoff - sortie.takeoff_d > slack) sums.dep = std::min(sums.dep, slack);
    sums.free_d = recovery_end(type, begin.d);
    sums.free_c = recovery_end(type, begin.c);
    sortie.state = sortie_done;
    --sums.flying;
    return sums.lo <= sums.hi;
}

// Tell whether the drone of a sortie has ended all sorties before it.
bool is_aboard(View<const Sortie, 1> sorties, Int index, Int oldest) {
    for (Int other = oldest; other < index; ++other) {
        if (sorties[other].drone == sorties[index].drone && sorties[other].state != sortie_done) {
            return false;
        }
    }
    return true;
}

// Tell whether a drone may be in the air beside those that are, launched at stop `p`.
//
// Those that come back there are launched first: behind, there might be no room.
bool has_airspace(const VehicleType& type, View<const Sortie, 1> sorties, Int index, Int p,
                  const BlockSums& sums) {
    if (sums.flying >= most_airborne(type)) return false;
    if (sums.flying + 1 < most_airborne(type) || sorties[index].recovery == p) return true;
    for (Int other = sums.oldest; other < sorties.size() && sorties[other].launch <= p; ++other) {
        const Sortie& loop = sorties[other];
        if (loop.state == sortie_waits && loop.launch == p && loop.recovery == p) return false;
    }
    return true;
}

// Tell whether a drone that has still to be recovered at stop `p` fetches what a sortie delivers.
bool is_on_its_way(View<const Pair, 1> pairs, View<const Sortie, 1> sorties, Int index, Int p,
                   Int oldest) {
    const Sortie& sortie = sorties[index];
    for (Int other = oldest; other < sorties.size() && sorties[other].launch <= p; ++other) {
        const Sortie& fetching = sorties[other];
        if (other == index || fetching.recovery != p || fetching.state == sortie_done) continue;
        for (const Int node : fetching.customers()) {
            if (is_pickup(pairs, node) && sortie.serves(pairs[node].partner)) {
                return true;
            }
        }
    }
    return false;
}

// Tell whether a sortie is to be launched or recovered at stop `p` next.
bool is_due(const Truck& truck, View<const Sortie, 1> sorties, Int index, Int p,
            const BlockSums& sums) {
    const Sortie& sortie = sorties[index];
    if (sortie.state == sortie_flies) return sortie.recovery == p;
    return sortie.state == sortie_waits && sortie.launch == p &&
           is_aboard(sorties, index, sums.oldest) &&
           (!limits_airborne(truck.type) || has_airspace(truck.type, sorties, index, p, sums)) &&
           (!some_paired(truck.data.pair) ||
            !is_on_its_way(truck.data.pair, sorties, index, p, sums.oldest));
}

// Return when the launch or recovery of a sortie that is due can begin, doubled.
//
// A drone that is there is recovered before another is launched.
Int twice_begin(const Truck& truck, const Sortie& sortie, Int node, const BlockSums& sums) {
    const DroneData drone_data = truck.drone_data(sortie);
    if (sortie.state == sortie_flies) {
        const Int free = TimeSegment{sums.free_d, sums.free_c}.at(sums.time);
        const Int flight = leg(drone_data.homeward, sortie.nodes[sortie.count - 1], node).duration;
        const Int ready = std::max(sums.time + sortie.ready_d, sortie.ready_c);
        return 2 * std::max(free, ready + flight);
    }
    const Int ready = ready_to_launch(truck, sortie, node, sums).at(sums.time);
    const Int takeoff =
        soonest_takeoff(drone_data, sortie, node, take_off(drone_data.type, ready, sums.launched));
    return 2 * launch_begin(drone_data.type, takeoff, sums.launched) + 1;
}

// Return the sortie whose launch or recovery at stop `p` can begin first; -1: none is left.
Int next_operation(const Truck& truck, View<Sortie, 1> sorties, Int p, Int node,
                   const BlockSums& sums) {
    Int chosen = -1, earliest = none;
    for (Int index = sums.oldest; index < sorties.size() && sorties[index].launch <= p; ++index) {
        Sortie& sortie = sorties[index];
        if (!is_due(truck, sorties, index, p, sums)) continue;
        if (sortie.state == sortie_waits) {
            const DroneData drone_data = truck.drone_data(sortie);
            if (charges_aboard(drone_data.type)) {
                note_charge(drone_data.type, sorties, index, sums.first_sortie);
            }
        }
        if (chosen < 0) {
            chosen = index;
            continue;
        }
        // Mostly there is but one, whose time needn't be known.
        if (earliest == none) earliest = twice_begin(truck, sorties[chosen], node, sums);
        const Int begin = twice_begin(truck, sortie, node, sums);
        if (begin < earliest) {
            chosen = index;
            earliest = begin;
        }
    }
    return chosen;
}

// Launch and recover all that stop `p` asks for. In place; false if not allowed.
bool operate(const Truck& truck, View<Sortie, 1> sorties, Int p, Int node, BlockSums& sums) {
    const Int count = sorties.size();
    while (true) {
        const Int index = next_operation(truck, sorties, p, node, sums);
        if (index < 0) break;
        if (!is_launch_place(truck.data.no_launch, node)) return false;
        Sortie& sortie = sorties[index];
        const DroneData drone_data = truck.drone_data(sortie);
        const bool allowed = sortie.state == sortie_flies
                                 ? bring_home(drone_data, sortie, node, sums)
                                 : fly_out(truck, drone_data, sortie, node, sums);
        if (!allowed || !reaches(truck, drone_data, sortie, node)) return false;
    }
    for (Int index = sums.oldest; index < count && sorties[index].launch <= p; ++index) {
        if (sorties[index].state == sortie_waits) return false;
    }
    while (sums.oldest < count && sorties[sums.oldest].state == sortie_done) ++sums.oldest;
    return true;
}

// Have the truck leave a depot, where all is done so, before that closes. In place; false if it
// can't.
bool leave_in_hours(const Truck& truck, const Stop& stop, TimeSegment done, BlockSums& sums) {
    const Int closes = closes_at(truck.type, truck.places, stop.node);
    if (done.c > closes) return false;
    sums.hi = std::min(sums.hi, closes - done.d);
    sums.dep = std::min(sums.dep, closes - done.d);
    return true;
}

// Return how long the truck stays at a stop at least, whenever it comes: for its own service, and
// for sorties of one drone from there, of those `launched`, back to there.
Int least_stay(const Truck& truck, const Stop& stop, View<const Sortie, 1> launched) {
    Int looping = 0, drone = nowhere;
    for (const Sortie& sortie : launched) {
        if (sortie.recovery > sortie.launch) continue;
        if (drone == nowhere) drone = sortie.drone;
        if (sortie.drone != drone) continue;
        const DroneData drone_data = truck.drone_data(sortie);
        const Int flown =
            sortie.ready_d - sortie.takeoff_d +
            leg(drone_data.homeward, sortie.nodes[sortie.count - 1], stop.node).duration;
        looping += recovery_end(drone_data.type, take_off(drone_data.type, flown, 0));
    }
    const Int served = stop.kind == customer_stop ? truck.places[stop.node].service_duration() : 0;
    return std::max(served, looping);
}

// Write how long the truck waits for drones in a block, whose sorties are given, behind each stop,
// where it is left at its `idle`. In place.
//
// Of drones that fly in turn, the next takes off as much later as the last is recovered.
void note_idle(const Truck& truck, View<Stop, 1> stops, View<const Sortie, 1> sorties, Int first,
               Int last) {
    const bool in_turn = most_airborne(truck.type) == 1;
    Int behind = 0, launched = sorties.size();
    for (Int p = last; p > first; --p) {
        const Stop& before = stops[p - 1];
        const Int stay = stops[p].idle - before.idle - before.gap, until = launched;
        while (launched > 0 && sorties[launched - 1].launch == p) --launched;
        stops[p].idle = behind;
        if (in_turn && p < last && launched > 0 && sorties[launched - 1].recovery == p) {
            behind = sorties[launched - 1].begin - stops[p].arrival;
        } else {
            behind += stay - least_stay(truck, stops[p], sorties.part(launched, until - launched));
        }
    }
    stops[first].idle = behind;
}

// Return the zones with hours to which a sortie comes that is launched at a node.
Int zones_met(const ProblemData& data, const Sortie& sortie, Int node) {
    Int zones = zones_at(data.zones, node) | zones_at(data.zones, sortie.home);
    for (const Int node : sortie.customers()) zones |= zones_at(data.zones, node);
    return zones;
}

// Return what weighs of that which a drone brings to its recovery.
Int weight_home(const ProblemData& data, NodeTable places, const Sortie& sortie) {
    Int weight = 0;
    for (Int visit = 0; visit < sortie.count; ++visit) {
        if (!is_fetched_within(data.pair, sortie.nodes, sortie.count, visit)) {
            weight += weight_flown_back(places[sortie.nodes[visit]]);
        }
    }
    return weight;
}

}  // namespace

void make_ready(const Truck& truck, View<const Stop, 1> stops, View<Sortie, 1> sorties) {
    const bool single = truck.own[0].are_single();
    for (Sortie& sortie : sorties) {
        const DroneData drone_data = truck.drone_data(sortie);
        const Int node = sortie.home = stops[sortie.recovery].node;
        sortie.state = sortie_waits;
        sortie.held = none;
        sortie.limit = endurance_of(drone_data.type);
        if (storms_sometime(drone_data.type)) {
            sortie.zones = zones_met(truck.data, sortie, stops[sortie.launch].node);
        }
        if (is_limited(drone_data.type)) {
            sortie.taken = weight_home(truck.data, drone_data.places, sortie);
            charge(drone_data.places, drone_data.legs, drone_data.homeward, drone_data.type, sortie,
                   stops[sortie.launch].node);
        }
        if (!single) continue;
        Int back = 0;
        Int home = leg(drone_data.homeward, sortie.nodes[sortie.count - 1], node).duration;
        for (Int index = sortie.count - 1; index >= 0; --index) {
            const Int here = sortie.nodes[index];
            const Windows place = drone_data.places[here];
            back = std::max(back, earliest_back(place, none, home));
            home += place.service_duration();
            if (index > 0) home += leg(drone_data.legs, sortie.nodes[index - 1], here).duration;
        }
        sortie.held = held_until(back, sortie.limit);
    }
}

Int time_block(const Truck& truck, View<Stop, 1> stops, View<Sortie, 1> sorties, Int first,
               BlockSums& sums) {
    const VehicleType& type = truck.type;
    const TravelLegs legs = legs_of(truck.data.leg, type.travel);
    const Int time = sums.time;
    auto [d, c] = truck.origin(time);
    sums.hi = sums.dep = far;
    sums.lo = none;
    sums.flying = 0;
    const Int oldest = sums.oldest;
    bool is_held = false;
    Int p = first;
    while (true) {
        Stop& stop = stops[p];
        stop.arrival = std::max(time + d, c);
        stop.block = first;
        if (has_window(stop)) {
            const Windows place = truck.places[stop.node];
            if (!reach(place, {d, c}, sums)) return -1;
            if (stop.kind == halt_stop) {
                const auto [start_d, start_c] = place.start_within(time, {d, c});
                d = start_d;
                c = start_c;
            }
        } else if (stop.kind == start_stop) {
            c = std::max(c, std::max(stop.release, stop.hold));
        } else {
            c = let_in(type, truck.places, stop.node, c);
        }
        sums.free_d = d;
        sums.free_c = c;
        auto [served_d, served_c] = truck.serve(stop, time, {d, c});
        if (lags_count(truck.data)) {
            const Int leave = await_others(truck, stops, sorties, p, stop.arrival);
            if (leave == far) return -1;
            served_c = std::max(served_c, leave);
        }
        sums.served_d = served_d;
        sums.served_c = served_c;
        if (!operate(truck, sorties, p, stop.node, sums)) return -1;
        d = std::max(served_d, sums.free_d);
        c = std::max(served_c, sums.free_c);
        stop.leave = std::max(time + d, c);
        stop.idle = d;
        is_held = is_held || c > time + d;  // by windows
        stop.flying = sums.flying;
        stop.latest = far;
        stop.early = none;
        if (stop.kind == end_stop) {
            if (!may_end(type, c)) return -1;
            sums.hi = std::min(sums.hi, last_end(type) - d);
        }
        if (!has_window(stop) && !leave_in_hours(truck, stop, {d, c}, sums)) return -1;
        if (sums.flying == 0) break;
        if (stop.kind == end_stop || p + 1 >= stops.size() || waits_for_drones(type)) return -1;
        const Int next = stops[p + 1].node;
        stop.gap = leg(legs, stop.node, next).duration;
        if (rests_in_gaps(type)) stop.gap += duration_of(type, Rests(stop.rests));
        TimeSegment there = truck.travel(stop.node, next, stop.gap, {d, c});
        if (truck.pauses(stop)) {
            there.c = truck.come(stop, next, c, sums.driver);
            if (there.c == far) return -1;
        }
        d = there.d;
        c = there.c;
        ++p;
    }
    Stop& begun = stops[first];
    begun.d = d;
    begun.c = c;
    begun.hi = sums.hi;
    begun.lo = sums.lo;
    begun.dep = sums.dep;
    if (is_held) {
        // Nobody knows how long it waits: it may come later.
        for (Int q = first; q <= p; ++q) stops[q].idle = far;
    } else {
        note_idle(truck, stops, sorties.part(oldest, sums.oldest - oldest), first, p);
    }
    return p;
}

}  // namespace tandem
