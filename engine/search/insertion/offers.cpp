#include "search/insertion/offers.h"

#include <algorithm>

#include "randomness.h"
#include "rules/drone_types.h"
#include "rules/energy.h"
#include "rules/flight.h"
#include "search/insertion/cheapest_stop.h"
#include "search/insertion/evaluate.h"
#include "search/insertion/least.h"
#include "search/insertion/new_trips.h"
#include "search/insertion/newcomer.h"
#include "search/route/edit.h"
#include "search/route/ends.h"
#include "search/route/goods.h"
#include "search/route/rarer.h"
#include "search/route/refresh.h"
#include "search/route/routes.h"
#include "search/route/vehicles.h"

namespace tandem {
namespace {

// Lists an insertion that costs at least `cost`; returns it, to complete it.
Move& add_offer(const Searcher& searcher, double cost, Int kind, Int slot, Int first) {
    const Int index = searcher.count->offers++;
    searcher.least[index] = cost;
    Move& offer = searcher.offer[index];
    offer.kind = kind;
    offer.slot = slot;
    offer.first = first;
    return offer;
}

// What a change of a route costs less, or lasts without costing anything.
struct Slack {
    Int spare;     // how long the route could work longer at no cost
    double early;  // what its waiting costs, which may become less
};

// Returns what a customer behind stop `p` costs at least, or `best` if that is no less, or not
// allowed.
double stop_costs(const World& world, Int k, const Newcomer& newcomer, const Detour& detour,
                  View<const Stop, 1> stops, Int p, Int node, const Slack& slack, double best) {
    const Rate& rate = world.rate[k];
    double cost = double(detour.distance) * rate.distance - slack.early;
    cost += rate.stop;
    const Int mode = world.mode[k];
    const Stop &here = stops[p], &behind = stops[p + 1];
    if (mode & mode_timed) {
        // While drones fly, the truck may have time before they are back.
        const Int longer =
            detour.out.duration + detour.on.duration + service_duration(newcomer.place) - here.gap;
        cost += double(std::max(Int{0}, longer - slack.spare - here.idle)) * rate.time;
    }
    if (cost >= best || !is_in_time(newcomer.place, detour, here.leave, behind)) return best;
    if (mode & mode_priced) {
        const Int arrival = here.leave + detour.out.duration;
        const Int following = end_of_service(newcomer.place, arrival) + detour.on.duration;
        cost += lateness_cost(world, node, arrival) + lateness_cost(world, behind.node, following) -
                lateness_cost(world, behind.node, behind.arrival);
    }
    return cost;
}

// Returns a drone of a row that is aboard from stop `launch` to `recovery`; `nowhere`: there is
// none.
//
// That which flies least from and to these stops, so that drones fly side by side; on the trip, if
// drones are charged aboard.
Int free_drone(const World& world, const Fleet& fleet, Int slot, Int launch, Int recovery,
               Int row) {
    const View<const Sortie, 1> sorties = fleet.sortie[slot].first(fleet.route[slot].sorties);
    const View<const Stop, 1> stops = fleet.stop[slot];
    const bool charging = charges_aboard(world.type[row]);
    Int chosen = nowhere, fewest = 0;
    const Int number = first_drone(world.type, fleet.route[slot].type, row);
    for (Int drone = number; drone < number + world.type[row].drones; ++drone) {
        bool free = true;
        Int beside = 0;
        for (const Sortie& sortie : sorties) {
            if (sortie.drone != drone) continue;
            const Int first = sortie.launch, last = sortie.recovery;
            // Sorties are in the order of their launches.
            if (first > recovery && !charging) break;
            const bool same_trip = charging && stops[first].trip == stops[launch].trip;
            if (same_trip || (first <= recovery && launch <= last)) ++beside;
            if ((first < recovery && launch < last) ||
                (launch == recovery && first < launch && launch < last) ||
                (first == last && launch < first && first < recovery) ||
                (first == launch && recovery > launch && last > first)) {
                free = false;
            }
        }
        if (free && (chosen == nowhere || beside < fewest)) {
            chosen = drone;
            fewest = beside;
        }
    }
    return chosen;
}

// Returns until which stop some drone of a row is free that is aboard at stop `launch`: that stop
// alone if all are launched there, the one before if none is aboard.
Int free_until(const World& world, const Fleet& fleet, Int slot, Int launch, Int row) {
    const Route& route = fleet.route[slot];
    const View<const Sortie, 1> sorties = fleet.sortie[slot].first(route.sorties);
    const Int number = first_drone(world.type, route.type, row);
    Int until = launch - 1;
    for (Int drone = number; drone < number + world.type[row].drones; ++drone) {
        Int free = route.length;
        for (const Sortie& sortie : sorties) {
            if (sortie.drone != drone || sortie.recovery <= launch) continue;
            free = sortie.launch < launch ? launch - 1 : sortie.launch;
            break;
        }
        until = std::max(until, free);
    }
    return until;
}

// Sorties to a customer by drones of a row on a route.
class Flights {
public:
    Flights(const World& world, const Searcher& searcher, Int slot, Int row, Int node)
        : world_(world),
          searcher_(searcher),
          slot_(slot),
          row_(row),
          node_(node),
          stops_(searcher.now.stop[slot]),
          length_(searcher.now.route[slot].length),
          type_(world.type[row]),
          rate_(world.rate[row]),
          place_(places_by_air(world.place, type_)[node]),
          inward_(legs_to(world.back, type_.drone_travel, node)),
          onward_(legs_from(world.leg, type_.home_travel, node)),
          room_(room_on(world, searcher.now, slot, searcher.now.route[slot].type, node)),
          best_(searcher.bound->best),
          early_(searcher.now.early[slot]),
          idle_(idle_time(searcher.now.route[slot])),
          priced_((world.mode[searcher.now.route[slot].type] & mode_priced) != 0),
          loaded_(loads_cost(world, searcher.now.route[slot].type)) {}

    // Lists those from stop `launch`.
    void offer_from(Int launch) const {
        const Stop& from = stops_[launch];
        const Leg out = leg_from(inward_, from.node);
        // Most stops are so far away that nothing else needs to be looked at.
        if (double(out.distance) * rate_.drone_distance - early_ >= best_) return;
        const Int ready = launch > 0 ? take_off(type_, from.arrival, 0) : from.arrival;
        const double late = priced_ ? lateness_cost(world_, node_, ready + out.duration) : 0.0;
        if (double(out.distance) * rate_.drone_distance + late - early_ >= best_) return;
        if (too_late(place_, from.arrival + out.duration)) return;
        const Int served = end_of_service(place_, from.arrival + out.duration);
        const Int left = gone_by(type_, from.leave);
        const Int begun = recovery_end(type_, ready) - idle_;
        Int last = free_until(world_, searcher_.now, slot_, launch, row_);
        const Int furthest = searcher_.now.trip(slot_, from.trip).last;
        last = std::min({last, furthest, world_.crossings ? launch + max_span : launch});
        for (Int recovery = world_.loops ? launch : launch + 1; recovery <= last; ++recovery) {
            const Stop& to = stops_[recovery];
            const Leg home = leg_to(onward_, to.node);
            const double flown = double(out.distance + home.distance) * rate_.drone_distance;
            if (flown + late - early_ >= best_) continue;
            if (recovery < length_ - 1 && recovery_end(type_, served + home.duration) + to.gap >
                                              stops_[recovery + 1].latest) {
                continue;
            }
            const Int flight = out.duration + service_duration(place_) + home.duration;
            if (!within_endurance(type_, left, left, to.arrival)) {
                // Held back for the window, the truck leaves later and may wait less on its way.
                if (earliest_back(place_, left + out.duration, 0) <= left) break;
                if (to.arrival > earliest_back(place_, left + out.duration, home.duration)) {
                    continue;
                }
            }
            // The truck leaves no sooner than the drone is aboard, whatever else it has time for.
            const Int longer = std::max(Int{0}, begun + flight - to.leave);
            double cost = flown + double(longer) * rate_.time + late - early_;
            if (loaded_) {
                cost += load_more(world_, searcher_.now, slot_, launch, recovery, node_);
            }
            if (cost < best_ && can_serve(type_, place_, out.duration, home.duration) &&
                room_between(room_, launch, recovery)) {
                Move& offer = add_offer(searcher_, cost, by_sortie, slot_, launch);
                offer.last = recovery;
                offer.type = row_;
            }
        }
    }

private:
    const World& world_;
    const Searcher& searcher_;
    Int slot_;
    Int row_;
    Int node_;
    View<const Stop, 1> stops_;
    Int length_;
    const VehicleType& type_;
    Rate rate_;
    NodeRows place_;
    LegRow inward_;
    LegRow onward_;
    Room room_;
    double best_;
    double early_;  // what the route's waiting costs, which may become less
    Int idle_;      // how long the route could work longer at no cost
    bool priced_;
    bool loaded_;
};

// Returns what an insertion costs, at least `least`; `infeasible` if it can't be.
//
// In place: a sortie's drone.
double price_offer(const World& world, const Searcher& searcher, Move& move, Int node,
                   double least) {
    const Fleet& now = searcher.now;
    const Int kind = move.kind, slot = move.slot, p = move.first;
    if (kind == by_sortie) {
        move.drone = free_drone(world, now, slot, p, move.last, move.type);
        if (move.drone < 0) return infeasible;
    } else if (kind == at_stop) {
        if (stands_alone(world, now, slot, p, node)) return price_stop(world, now, slot, p, node);
    } else if ((kind == new_trip || kind == trip_from || kind == trip_until) &&
               is_simple(world, now, slot) && !is_apart(world, now.route[slot].type)) {
        return more_trips_fit(world, now, slot, p, node, kind) ? least : infeasible;
    }
    return price_move(world, now, move, node, *searcher.acc);
}

}  // namespace

void offer_stops(const World& world, const Searcher& searcher, Int slot, Int first, Int last,
                 Int node) {
    const Fleet& now = searcher.now;
    const double best = searcher.bound->best;
    const Int k = now.route[slot].type;
    const View<const Stop, 1> stops = now.stop[slot];
    const Newcomer newcomer = newcomer_on(world, now, slot, k, node);
    const Slack slack{idle_time(now.route[slot]), now.early[slot]};
    const Int most = world.type[k].max_trip_distance - now.trip(slot, stops[first].trip).distance;
    for (Int p = first; p <= last; ++p) {
        const Detour detour = newcomer.behind(stops, p);
        double cost = stop_costs(world, k, newcomer, detour, stops, p, node, slack, best);
        if (cost < best && loads_cost(world, k)) {
            cost += load_more_behind(world, now, slot, p, node, detour.out.distance,
                                     detour.on.distance);
        }
        if (cost < best && detour.distance <= most && room_behind(newcomer.room, p)) {
            add_offer(searcher, cost, at_stop, slot, p);
        }
    }
}

void offer_sorties(const World& world, const Searcher& searcher, Int slot, Int first, Int last,
                   Int node) {
    const Fleet& now = searcher.now;
    const Route& route = now.route[slot];
    const Trip& trip = now.trip(slot, now.stop(slot, first).trip);
    const auto may_fly = [&](Int row) {
        return world.can(row, 1, node) &&
               has_battery(world.type, route, now.sortie[slot], trip, row);
    };
    const Int first_row = first_drone_row(world.type, route.type);
    if (next_drone_row(world.type, first_row) == no_row) {
        if (!may_fly(first_row)) return;
        const Flights flights(world, searcher, slot, first_row, node);
        for (Int launch = first; launch <= last; ++launch) flights.offer_from(launch);
        return;
    }
    for (Int launch = first; launch <= last; ++launch) {
        for (Int row = first_row; row >= 0; row = next_drone_row(world.type, row)) {
            if (may_fly(row)) Flights(world, searcher, slot, row, node).offer_from(launch);
        }
    }
}

void offer_joining(const World& world, const Searcher& searcher, Int slot, Int node) {
    const Fleet& now = searcher.now;
    const Int k = now.route[slot].type;
    const View<const Stop, 1> stops = now.stop[slot];
    const View<const Sortie, 1> sorties = now.sortie[slot];
    const double best = searcher.bound->best;
    for (Int s = 0; s < now.route[slot].sorties; ++s) {
        const Sortie& sortie = sorties[s];
        const Int row = row_of_drone(world.type, k, sortie.drone);
        const Int trip = stops[sortie.launch].trip;
        if (sortie.count >= world.visits[row] || !world.can(row, 1, node) ||
            !may_fit(world, now, slot, trip, k, node) ||
            !goods_may_join(world, now, slot, trip, node) ||
            !room_between(room_on(world, now, slot, k, node), sortie.launch, sortie.recovery)) {
            continue;
        }
        bool may_carry = can_carry(world, row, sortie, 0, node);
        if (!may_carry && tiers_of(world) == 0) continue;
        const TravelLegs flights = legs_of(world.leg, world.type[row].drone_travel);
        Int here = stops[sortie.launch].node;
        for (Int place = 0; place <= sortie.count; ++place) {
            const Int there =
                place < sortie.count ? sortie.nodes[place] : stops[sortie.recovery].node;
            const Int further = leg(flights, here, node).distance +
                                leg(flights, node, there).distance -
                                leg(flights, here, there).distance;
            const double cost = double(further) * world.rate[row].drone_distance - now.early[slot];
            here = there;
            if (cost >= best) continue;
            if (place > 0 && tiers_of(world) > 0) {
                may_carry = can_carry(world, row, sortie, place, node);
            }
            if (may_carry) add_offer(searcher, cost, on_sortie, slot, place).sortie = s;
        }
    }
}

void offer_flight_trips(const World& world, const Searcher& searcher, Int slot, Int node) {
    if (!world.loops) return;
    const Fleet& now = searcher.now;
    const Route& route = now.route[slot];
    const View<const Stop, 1> stops = now.stop[slot];
    const Int k = route.type, depot = world.type[k].depot;
    for (Int row = first_drone_row(world.type, k); row >= 0;
         row = next_drone_row(world.type, row)) {
        const TravelLegs flights = legs_of(world.leg, world.type[row].drone_travel);
        const Leg out = leg(flights, depot, node), home = leg(flights, node, depot);
        double cost = double(out.distance + home.distance) * world.rate[row].drone_distance;
        cost -= now.early[slot];
        if (unreachable(std::max(out.duration, home.duration)) || cost >= searcher.bound->best ||
            !world.can(row, 1, node) || !may_begin(world, k, node)) {
            continue;
        }
        for (Int p = -1; p < route.length; ++p) {
            if (p < 0 || stops[p].kind == end_stop) {
                add_offer(searcher, cost, flight_trip, slot, p).drone =
                    first_drone(world.type, k, row);
            }
        }
    }
}

void offer_trips(const World& world, const Searcher& searcher, Int slot, Int node) {
    const Fleet& now = searcher.now;
    const Route& route = now.route[slot];
    const View<const Stop, 1> stops = now.stop[slot];
    const double best = searcher.bound->best;
    const Int k = route.type, m = world.type[k].travel, depot = world.type[k].depot;
    const double rate = world.rate[k].distance;
    const TravelLegs legs = legs_of(world.leg, m);
    const LegRow inward = legs_to(world.back, m, node);
    const Int out = leg_from(inward, depot).distance, home = leg(legs, node, depot).distance;
    for (Int p = -1; p < route.length; ++p) {
        Int kind = new_trip;
        double cost = double(out + home) * rate;
        if (p >= 0 && stops[p].kind != end_stop) {
            if (stops[p].flying > 0 || stops[p].kind == start_stop ||
                stops[p + 1].kind == end_stop) {
                continue;
            }
            const Int here = stops[p].node, there = stops[p + 1].node;
            const double until = double(-stops[p].leg + leg_from(inward, here).distance + home +
                                        leg(legs, depot, there).distance) *
                                 rate;
            cost = double(-stops[p].leg + leg(legs, here, depot).distance + out +
                          leg(legs, node, there).distance) *
                   rate;
            kind = trip_from;
            if (until < cost) {
                kind = trip_until;
                cost = until;
            }
            if (cost < best && !part_fits(world, now, slot, p, node, kind == trip_until)) continue;
        }
        cost += world.rate[k].stop - now.early[slot];
        // Each of two trips carries less, at best next to nothing.
        if (kind != new_trip && loads_cost(world, k)) cost -= load_cost(world, now, slot);
        if (kind == new_trip && !may_begin(world, k, node)) continue;
        if (cost < best && (p < 0 || !too_late(world.place[0][node], stops[p].leave))) {
            add_offer(searcher, cost, kind, slot, p);
        }
    }
}

void offer_trips_apart(const World& world, const Searcher& searcher, Int slot, Int node) {
    const Fleet& now = searcher.now;
    const Route& route = now.route[slot];
    const View<const Stop, 1> stops = now.stop[slot];
    const double best = searcher.bound->best;
    const Int k = route.type, last = route.length - 1;
    const double rate = world.rate[k].distance;
    for (Int p = -1; p <= last; ++p) {
        Int kind = new_trip, here, there;
        if (p < 0) {
            here = stops[0].node;
            there = stops[1].node;
        } else if (p == last) {
            here = stops[p - 1].node;
            there = stops[p].node;
        } else if (stops[p].kind == end_stop) {
            here = stops[p].node;
            there = stops[p + 2].node;
        } else if (stops[p].flying > 0 || stops[p].kind == start_stop ||
                   stops[p + 1].kind == end_stop) {
            continue;
        } else {
            here = stops[p].node;
            there = stops[p + 1].node;
            kind = trip_until;
        }
        double cost = double(detour_by_reload(world, k, here, node, there, p != last)) * rate;
        if (kind == trip_until) {
            const double behind =
                double(detour_by_reload(world, k, here, node, there, false)) * rate;
            if (behind < cost) {
                kind = trip_from;
                cost = behind;
            }
        }
        cost += world.rate[k].stop - now.early[slot];
        // Whoever was served may be carried less far, at best next to nowhere.
        if (loads_cost(world, k)) cost -= load_cost(world, now, slot);
        if (kind == new_trip && !may_begin(world, k, node)) continue;
        if (cost < best) add_offer(searcher, cost, kind, slot, p);
    }
}

void take_cheapest(const World& world, const Searcher& searcher, Int node) {
    Bound& bound = *searcher.bound;
    const View<Move, 1> offer = searcher.offer;
    const View<double, 1> least = searcher.least;
    Int left = searcher.count->offers;
    Least cheapest(least, left);
    while (left > 0 && !world.deadline.passed()) {
        const Int first = cheapest.first();
        if (least[first] >= bound.best) break;
        const double cost = price_offer(world, searcher, offer[first], node, least[first]);
        if (cost < bound.best && uniform(searcher.rng) >= bound.blink) {
            bound.best = cost;
            *searcher.move = offer[first];
        }
        cheapest.take_out(first);
        offer[first] = offer[--left];
    }
    searcher.count->offers = 0;
}

}  // namespace tandem
