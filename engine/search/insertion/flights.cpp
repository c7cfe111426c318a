#include "rules/launch_place.h"
#include "search/insertion/offers.h"
#include "search/insertion/sortie_times.h"
#include "search/route/refresh.h"
#include "search/route/stop_loads.h"

namespace tandem {
namespace {

// From which stop on and up to which a drone is aboard, when it is free there at the soonest, and
// the number of its next sortie.
struct AboardBetween {
    Int since = far, until = none, free = far, next = 0;
};

// Returns between which stops drones of a row are aboard at a place of a route, in half stops;
// between none if all fly then. Of several, all that one of them is.
AboardBetween aboard_at(const ProblemData& data, const Fleet& fleet, Int slot, Int half, Int row) {
    const Route& route = fleet.route[slot];
    const Flying flying = flying_of(data, fleet, slot, row);
    const View<const Sortie, 1> sorties = flying.sorties;
    AboardBetween some;
    for (Int drone = flying.drone; drone < flying.drone + data.type[row].drones; ++drone) {
        AboardBetween aboard{0, route.length, flying.stops[half / 2].arrival, 0};
        for (; aboard.next < sorties.size(); ++aboard.next) {
            const Sortie& sortie = sorties[aboard.next];
            if (sortie.drone != drone) continue;
            if (2 * sortie.recovery > half) {
                aboard.until = 2 * sortie.launch < half ? none : sortie.launch;
                break;
            }
            aboard.since = std::max(aboard.since, Int{sortie.recovery});
            if (2 * sortie.recovery < half) continue;
            aboard.free = sortie.launch < sortie.recovery
                              ? std::max(aboard.free, flying.end_of(sortie))
                              : flying.end_after(sortie, aboard.free);
        }
        if (aboard.until == none) continue;
        some = {std::min(some.since, aboard.since), std::max(some.until, aboard.until),
                std::min(some.free, aboard.free), aboard.next};
    }
    return some;
}

// What is looked up once for sorties to a customer by drones of a row on a route.
struct FlownTo {
    FlownTo(const Insertion& insertion, Int of_slot, Int row_of)
        : data(insertion.data),
          searcher(insertion.searcher),
          node(insertion.node),
          slot(of_slot),
          row(row_of),
          best(insertion.best.cost) {}

    const ProblemData& data;
    const Searcher& searcher;
    const Int node, slot, row;
    const double best;
    const View<const Stop, 1> stops = searcher.now.stop[slot];
    const Route& route = searcher.now.route[slot];
    const Int k = route.type;
    const Int drone = first_drone(data.type, k, row);  // stands for the row's
    const VehicleType& type = data.type[row];
    const Rate rate = data.rate[row];
    const Windows place = data.place.by_air(type)[node];
    const LegRow inward = legs_to(data.back, type.drone_travel, node);
    const LegRow onward = legs_from(data.leg, type.home_travel, node);
    // Whether drones may be recovered elsewhere than they are launched.
    const bool crosses = data.strategy.crossings && !waits_for_drones(data.type[k]);
    // At most, beside what is driven, flown and worked.
    const double saved = most_saved(data, searcher.now, slot, node);
    const Int idle = idle_time(route);  // how long the route could work longer at no cost
    const Speeds speeds = speeds_of(data, k);
};

// Sorties to a customer by drones of a row on a route.
class Flights : FlownTo {
public:
    using FlownTo::FlownTo;

    // Lists those from stop `launch`.
    void offer_from(Int launch) const {
        const Stop& from = stops[launch];
        if (!is_launch_place(data.no_launch, from.node)) return;
        const Leg out = leg_from(inward, from.node);
        // Most stops are so far away that nothing else needs to be looked at.
        if (flown_cost(rate, out.distance) - saved >= best) return;
        if (!in_range(data, type, from.node, node)) return;
        const Int ready = launch > 0 ? take_off(type, from.arrival, 0) : from.arrival;
        const double late = priced_ ? lateness_cost(data, node, ready + out.duration) : 0.0;
        if (flown_cost(rate, out.distance) + late - saved >= best) return;
        Front front{from.arrival + out.duration};
        if (!front.serve(place)) return;
        const Int left = gone_by(type, from.leave);
        const AboardBetween aboard = aboard_at(data, searcher.now, slot, 2 * launch, row);
        const Int free = launch > 0 ? take_off(type, aboard.free, 0) : ready;
        const Int begun = recovery_end(type, free);
        Int last = aboard.until;
        const Int furthest = searcher.now.trip(slot, from.trip).last;
        last = std::min({last, furthest, crosses ? launch + max_span : launch});
        for (Int recovery = data.strategy.loops ? launch : launch + 1; recovery <= last;
             ++recovery) {
            const Stop& to = stops[recovery];
            const Leg home = leg_to(onward, to.node);
            const double flown = flown_cost(rate, out.distance + home.distance);
            if (flown + late - saved >= best || !in_range(data, type, to.node, node)) continue;
            if (!is_launch_place(data.no_launch, to.node)) continue;
            if (recovery < route.length - 1 &&
                recovery_end(type, front.time + home.duration) + to.gap >
                    stops[recovery + 1].latest) {
                continue;
            }
            const Flight flight{type, place, out.duration, home.duration};
            if (!within_endurance(type, left, left, to.arrival)) {
                // Held back for the window, the truck leaves later and may wait less on its way.
                if (earliest_back(place, left + out.duration, 0) <= left) break;
                if (to.arrival > earliest_back(place, left + out.duration, home.duration)) {
                    continue;
                }
            }
            // The truck leaves no sooner than the drone is aboard, whatever else it has time for.
            const Int later = flying_.delay(recovery, begun + flight.duration(), aboard.next);
            const Int longer = std::max(Int{0}, speeds.left_of(later) - idle);
            double cost = flown + usual_work_cost(rate, longer) + late - saved;
            if (loaded_) {
                cost += load_more(data, searcher.now, slot, launch, recovery, node);
            }
            if (cost < best && flight.can_serve() && room_between(room_, launch, recovery)) {
                add_offer(searcher, cost, slot, launch, recovery)
                    .add(How::fly, node, launch, recovery, drone);
            }
        }
    }

private:
    const Room room_ = room_on(data, searcher.now, slot, k, node);
    const Flying flying_ = flying_of(data, searcher.now, slot, row);
    const bool priced_ = data.evaluation[k].priced;
    const bool loaded_ = loads_cost(data, k);
};

}  // namespace

void offer_sorties(const Insertion& insertion, Int slot, Int first, Int last) {
    const auto [data, searcher, node, enlarge, best] = insertion;
    const Fleet& now = searcher.now;
    const Route& route = now.route[slot];
    const Trip& trip = now.trip(slot, now.stop(slot, first).trip);
    const auto may_fly = [&, &data = data, node = node](Int row) {
        return data.can(row, 1, node) && has_battery(data.type, route, now.sortie[slot], trip, row);
    };
    const Int first_row = first_drone_row(data.type, route.type);
    if (next_drone_row(data.type, first_row) == no_row) {
        if (!may_fly(first_row)) return;
        const Flights flights(insertion, slot, first_row);
        for (Int launch = first; launch <= last; ++launch) flights.offer_from(launch);
        return;
    }
    for (Int launch = first; launch <= last; ++launch) {
        for (Int row = first_row; row >= 0; row = next_drone_row(data.type, row)) {
            if (may_fly(row)) Flights(insertion, slot, row).offer_from(launch);
        }
    }
}

namespace {

// From where to where a drone flies, and at which of these the truck stops at a launch site by
// more, behind that stop; `nowhere` at others.
struct FlownBetween {
    Int launch, recovery, launch_halt, recovery_halt;
};

// Sorties to a customer by drones of a row that begin or end at stops at launch sites to come.
class Halting : FlownTo {
public:
    using FlownTo::FlownTo;

    // Lists those for which the truck stops at a launch site behind stop `p`, with a drone that is
    // `aboard` there.
    void offer_behind(Int p, Int halt, const AboardBetween& aboard) const {
        if (!may_halt(data.halts, k, halt) || !in_range(data, type, halt, node) ||
            !is_served_by(p, data.halt_after[halt])) {
            return;
        }
        const TravelLegs legs = legs_of(data.leg, data.type[k].travel);
        const Stop &here = stops[p], &behind = stops[p + 1];
        const Leg there = leg(legs, here.node, halt), on = leg(legs, halt, behind.node);
        const Leg out = leg_from(inward, halt), home = leg_to(onward, halt);
        const Trip& trip = searcher.now.trip(slot, here.trip);
        const Int distance = there.distance + on.distance - here.leg;
        if (distance > longest_trip(data.type[k]) - trip.distance) return;
        const double driven = drive_cost(data.rate[k], distance) + data.halt_cost[halt] - saved;
        if (driven + flown_cost(rate, std::min(out.distance, home.distance)) >= best) return;
        // While drones fly, the truck may have time before they are back.
        const Int detour = there.duration + on.duration - here.gap;
        const Int longer = detour - idle - here.idle;
        const Int handled = handling_duration(type);
        const Int least_longer = std::max(Int{0}, longer - handled);
        if (driven + usual_work_cost(data.rate[k], least_longer) >= best) return;
        if (data.strategy.loops) {
            const Flight loop{type, place, out.duration, home.duration};
            offer({p, p, halt, halt}, loop, driven, out.distance + home.distance,
                  recovery_end(type, longer + loop.duration()));
        }
        if (!crosses) return;
        offer_landings(p, halt, out, driven, longer, aboard.until);
        const Int last = std::min({trip.last, aboard.until, p + max_span});
        for (Int recovery = p + 1; recovery <= last; ++recovery) {
            const Stop& to = stops[recovery];
            const Leg back = leg_to(onward, to.node);
            if (!may_end_at(to)) continue;
            const Flight flight{type, place, out.duration, back.duration};
            const Int begun = recovery_end(type, here.leave + there.duration);
            offer({p, recovery, halt, nowhere}, flight, driven, out.distance + back.distance,
                  std::max(longer, begun + flight.duration() - to.leave - idle));
        }
        for (Int launch = std::max({trip.first, aboard.since, p - max_span + 1}); launch <= p;
             ++launch) {
            const Stop& from = stops[launch];
            if (!may_end_at(from)) continue;
            const Leg way = leg_from(inward, from.node);
            const Flight flight{type, place, way.duration, home.duration};
            const Int begun = recovery_end(type, from.arrival + on.duration);
            offer({launch, p, nowhere, halt}, flight, driven, way.distance + home.distance,
                  std::max(longer - handled, begun + flight.duration() - behind.leave - idle));
        }
    }

private:
    // Lists those from a launch site behind stop `p` to one more behind a later stop.
    //
    // `driven` and `longer` are what the first stop costs, and how much longer it takes; a drone is
    // aboard up to stop `until`.
    void offer_landings(Int p, Int halt, const Leg& out, double driven, Int longer,
                        Int until) const {
        const TravelLegs legs = legs_of(data.leg, data.type[k].travel);
        const View<const std::int32_t, 1> near = nearest_halts(data, node);
        const Int last =
            std::min({searcher.now.trip(slot, stops[p].trip).last, until, p + max_span + 1}) - 1;
        for (Int rank = 0; rank < std::min(max_landings, near.size()); ++rank) {
            const Int landing = near[rank];
            if (landing < 0) break;
            if (!may_halt(data.halts, k, landing) || !in_range(data, type, landing, node)) {
                continue;
            }
            const Leg home = leg_to(onward, landing);
            const Flight flight{type, place, out.duration, home.duration};
            for (Int q = p + 1; q <= last; ++q) {
                const Stop &here = stops[q], &behind = stops[q + 1];
                const Leg there = leg(legs, here.node, landing),
                          on = leg(legs, landing, behind.node);
                const Int detour = there.duration + on.duration - here.gap - here.idle;
                const double cost =
                    driven + data.halt_cost[landing] +
                    drive_cost(data.rate[k], there.distance + on.distance - here.leg);
                if (cost >= best || !is_served_by(q, data.halt_after[landing])) continue;
                offer({p, q, halt, landing}, flight, cost, out.distance + home.distance,
                      longer + std::max(Int{0}, detour));
            }
        }
    }

    // Tells whether a drone may leave, or come to, a stop as it flies to the customer.
    bool may_end_at(const Stop& stop) const {
        return is_launch_place(data.no_launch, stop.node) && in_range(data, type, stop.node, node);
    }

    // Tells whether somebody, if anybody, is served up to stop `p`, drones being recovered by then.
    bool is_served_by(Int p, Int customer) const {
        if (customer < 0) return true;
        const Place& place = searcher.now.where[customer];
        if (place.slot != slot) return false;
        if (place.position >= 0) return place.position <= p;
        return searcher.now.sortie(slot, place.sortie).recovery <= p;
    }

    // Lists an insertion, if that may be cheapest, by how much longer the vehicle works at least.
    void offer(const FlownBetween& way, const Flight& flight, double driven, Int flown,
               Int longer) const {
        const double cost = driven + flown_cost(rate, flown) +
                            usual_work_cost(data.rate[k], std::max(Int{0}, longer));
        if (cost >= best || unreachable(std::max(flight.out, flight.home)) || !flight.can_serve()) {
            return;
        }
        const auto& [launch, recovery, from, to] = way;
        const bool comes_back = from >= 0 && launch == recovery;
        const Int last = std::max(launch + 1, to < 0 ? recovery : recovery + 1);
        Offer& move = add_offer(searcher, cost, slot, launch, last);
        Int begin = launch, end = recovery;
        if (from >= 0) {
            move.add(How::halt, from, ++begin);
            ++end;
        }
        if (to >= 0 && !comes_back) move.add(How::halt, to, ++end);
        move.add(How::fly, node, begin, end, drone);
    }
};

}  // namespace

void offer_halts(const Insertion& insertion, Int slot, Int first, Int last) {
    const auto [data, searcher, node, enlarge, best] = insertion;
    const Fleet& now = searcher.now;
    const Route& route = now.route[slot];
    const Trip& trip = now.trip(slot, now.stop(slot, first).trip);
    for (Int row = first_drone_row(data.type, route.type); row >= 0;
         row = next_drone_row(data.type, row)) {
        if (!data.can(row, 1, node) ||
            !has_battery(data.type, route, now.sortie[slot], trip, row)) {
            continue;
        }
        const Halting halting(insertion, slot, row);
        for (Int p = first; p <= last; ++p) {
            const AboardBetween aboard = aboard_at(data, now, slot, 2 * p + 1, row);
            if (aboard.until < aboard.since) continue;
            for (const Int halt : nearest_halts(data, node)) {
                if (halt < 0) break;
                halting.offer_behind(p, halt, aboard);
            }
        }
    }
}

void offer_halt_trips(const Insertion& insertion, Int slot) {
    const auto [data, searcher, node, enlarge, best] = insertion;
    if (!data.strategy.loops) return;
    const Fleet& now = searcher.now;
    const Route& route = now.route[slot];
    const Int k = route.type, depot = data.type[k].depot;
    if (!may_begin(data, k, node)) return;
    const TravelLegs legs = legs_of(data.leg, data.type[k].travel);
    for (Int row = first_drone_row(data.type, k); row >= 0; row = next_drone_row(data.type, row)) {
        const VehicleType& type = data.type[row];
        if (!data.can(row, 1, node)) continue;
        for (const Int halt : nearest_halts(data, node)) {
            if (halt < 0) break;
            if (!may_halt(data.halts, k, halt) || !in_range(data, type, halt, node)) continue;
            const Leg out = leg(legs_of(data.leg, type.drone_travel), halt, node);
            const Leg home = leg(legs_of(data.leg, type.home_travel), node, halt);
            const Flight flight{type, data.place.by_air(type)[node], out.duration, home.duration};
            const Int driven = leg(legs, depot, halt).distance + leg(legs, halt, depot).distance;
            const double cost = drive_cost(data.rate[k], driven) + data.halt_cost[halt] +
                                flown_cost(data.rate[row], out.distance + home.distance) -
                                most_saved(data, now, slot, node);
            if (cost >= best.cost || !flight.can_serve()) continue;
            for (Int p = -1; p < route.length; ++p) {
                if (p >= 0 && now.stop(slot, p).kind != end_stop) continue;
                Offer& move = add_offer(searcher, cost, slot, p, p + 1);
                move.add(How::begin, depot, p + 1);
                move.add(How::halt, halt, p + 2);
                move.add(How::end, depot, p + 3);
                move.add(How::fly, node, p + 2, p + 2, first_drone(data.type, k, row));
            }
        }
    }
}

}  // namespace tandem
