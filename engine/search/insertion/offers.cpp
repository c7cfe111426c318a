#include "search/insertion/offers.h"

#include <algorithm>

#include "randomness.h"
#include "rules/breaks.h"
#include "rules/driving.h"
#include "rules/drone_types.h"
#include "rules/energy.h"
#include "rules/flight.h"
#include "rules/launch_place.h"
#include "rules/shift.h"
#include "search/insertion/cheapest_stop.h"
#include "search/insertion/evaluate.h"
#include "search/insertion/least.h"
#include "search/insertion/listing.h"
#include "search/insertion/new_trips.h"
#include "search/insertion/newcomer.h"
#include "search/route/drone_data.h"
#include "search/route/edit.h"
#include "search/route/ends.h"
#include "search/route/goods.h"
#include "search/route/least_cost.h"
#include "search/route/rarer.h"
#include "search/route/refresh.h"
#include "search/route/routes.h"
#include "search/route/stop_loads.h"
#include "search/route/vehicles.h"
#include "search/scratch.h"

namespace tandem {
namespace {

// What a customer more among the stops of a route costs at least.
struct LeastCost {
    const ProblemData& data;
    const Newcomer& newcomer;
    Int k;
    Int spare;     // how long the route could work longer at no cost
    double saved;  // at most, beside all that

    // Returns that between two stops; `best` if it is no less, or not allowed.
    double between(const Stop& here, const Stop& behind, const Detour& detour, double best) const {
        const Rate& rate = data.rate[k];
        double cost = drive_cost(rate, detour.distance) - saved;
        cost += rate.stop;
        const Evaluation& evaluation = data.evaluation[k];
        if (evaluation.timed) {
            // While drones fly, the truck may have time before they are back.
            const Int longer = detour.out.duration + detour.on.duration +
                               newcomer.place.service_duration() - here.gap;
            cost += usual_work_cost(rate, std::max(Int{0}, longer - spare - here.idle));
        }
        if (cost >= best) return best;
        Front front{here.leave + detour.out.duration};
        const Int arrival = front.time;
        const bool allowed = front.serve(newcomer.place);
        front.drive(detour.on.duration);
        if (!allowed || !Rear{behind.latest}.allows(front)) return best;
        if (evaluation.priced) {
            cost += lateness_cost(data, newcomer.node, arrival) +
                    lateness_cost(data, behind.node, front.time) -
                    lateness_cost(data, behind.node, behind.arrival);
        }
        return cost;
    }
};

// Returns how long a route could work longer at no cost.
Int spare_time(const ProblemData& data, const Route& route, View<const Stop, 1> stops) {
    return rests_in_time(data.type[route.type]) ? route.working - least_working(data, route, stops)
                                                : idle_time(route);
}

Stretch stretch_of(const Move& move) {
    const Int first = 2 * move.first, last = 2 * move.last;
    if (move.kind == by_halts) return {first + 1, last + 1};
    if (move.kind == to_halt) return {first, last + 1};
    if (move.kind == from_halt) return {first + 1, move.last == move.first ? first + 1 : last};
    return {first, last};
}

// Returns what an insertion costs, at least `least`; `infeasible` if it can't be, or perhaps if
// that is not below `best`.
//
// In place: a sortie's drone.
double price_offer(const ProblemData& data, const Searcher& searcher, Move& move, Int node,
                   double least, double best) {
    const Fleet& now = searcher.now;
    const Int kind = move.kind, slot = move.slot, p = move.first;
    if (kind == by_sortie || uses_halt(move)) {
        move.drone = free_drone(data, now, slot, stretch_of(move), move.type);
        if (move.drone < 0) return infeasible;
    } else if (kind == at_stop) {
        if (stands_alone(data, now, slot, p, node)) {
            const VehicleType& type = data.type[now.route[slot].type];
            return price_stop(data, now, slot, p, newcomer_for(data, type, node));
        }
    } else if ((kind == new_trip || kind == trip_from || kind == trip_until) &&
               is_simple(data, now, slot) && !is_apart(data, now.route[slot].type)) {
        return more_trips_fit(data, now, slot, p, node, kind) ? least : infeasible;
    }
    return price_move(data, now, move, node, best);
}

}  // namespace

Int free_drone(const ProblemData& data, const Fleet& fleet, Int slot, Stretch stretch, Int row) {
    const View<const Sortie, 1> sorties = fleet.sortie[slot].first(fleet.route[slot].sorties);
    const View<const Stop, 1> stops = fleet.stop[slot];
    const auto [launch, recovery] = stretch;
    const Int trip = stops[launch / 2].trip;
    const bool charging = charges_aboard(data.type[row]);
    Int chosen = nowhere, fewest = 0;
    const Int number = first_drone(data.type, fleet.route[slot].type, row);
    for (Int drone = number; drone < number + data.type[row].drones; ++drone) {
        bool free = true;
        Int beside = 0;
        for (const Sortie& sortie : sorties) {
            if (sortie.drone != drone) continue;
            const Int first = 2 * sortie.launch, last = 2 * sortie.recovery;
            // Sorties are in the order of their launches.
            if (first > recovery && !charging) break;
            const bool same_trip = charging && stops[sortie.launch].trip == trip;
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

void offer_stops(const Insertion& insertion, Int slot, Int first, Int last) {
    const auto [data, searcher, node, enlarge, found] = insertion;
    const double best = found.cost;
    const Fleet& now = searcher.now;
    const Int k = now.route[slot].type;
    const View<const Stop, 1> stops = now.stop[slot];
    const Newcomer newcomer = newcomer_for(data, data.type[k], node);
    const Room room = room_on(data, now, slot, k, node);
    const LeastCost least{data, newcomer, k, spare_time(data, now.route[slot], stops),
                          most_saved(data, now, slot, node)};
    const Int most = longest_trip(data.type[k]) - now.trip(slot, stops[first].trip).distance;
    for (Int p = first; p <= last; ++p) {
        const Stop &here = stops[p], &behind = stops[p + 1];
        const Detour detour = newcomer.detour(here.node, behind.node, here.leg);
        double cost = least.between(here, behind, detour, best);
        if (cost < best && loads_cost(data, k)) {
            cost +=
                load_more_behind(data, now, slot, p, node, detour.out.distance, detour.on.distance);
        }
        if (cost < best && detour.distance <= most && room_behind(room, p)) {
            add_offer(searcher, cost, at_stop, slot, p);
        }
    }
}

void offer_joining(const Insertion& insertion, Int slot) {
    const auto [data, searcher, node, enlarge, found] = insertion;
    const double best = found.cost;
    const Fleet& now = searcher.now;
    const Int k = now.route[slot].type;
    const View<const Stop, 1> stops = now.stop[slot];
    const View<const Sortie, 1> sorties = now.sortie[slot];
    for (Int s = 0; s < now.route[slot].sorties; ++s) {
        const Sortie& sortie = sorties[s];
        const Int row = row_of_drone(data.type, k, sortie.drone);
        const Int trip = stops[sortie.launch].trip;
        if (sortie.count >= data.visits[row] || !data.can(row, 1, node) ||
            !may_fit(data, now, slot, trip, k, node) ||
            !goods_may_join(data, now, slot, trip, node) ||
            !room_between(room_on(data, now, slot, k, node), sortie.launch, sortie.recovery)) {
            continue;
        }
        bool may_carry = can_carry(data, row, sortie, 0, node);
        if (!may_carry && tiers_of(data) == 0) continue;
        const TravelLegs flights = legs_of(data.leg, data.type[row].drone_travel);
        Int here = stops[sortie.launch].node;
        for (Int place = 0; place <= sortie.count; ++place) {
            const Int there =
                place < sortie.count ? sortie.nodes[place] : stops[sortie.recovery].node;
            const Int further = leg(flights, here, node).distance +
                                leg(flights, node, there).distance -
                                leg(flights, here, there).distance;
            const double cost =
                flown_cost(data.rate[row], further) - most_saved(data, now, slot, node);
            here = there;
            if (cost >= best) continue;
            if (place > 0 && tiers_of(data) > 0) {
                may_carry = can_carry(data, row, sortie, place, node);
            }
            if (may_carry) add_offer(searcher, cost, on_sortie, slot, place).sortie = s;
        }
    }
}

void offer_flight_trips(const Insertion& insertion, Int slot) {
    const auto [data, searcher, node, enlarge, best] = insertion;
    if (!data.strategy.loops) return;
    const Fleet& now = searcher.now;
    const Route& route = now.route[slot];
    const View<const Stop, 1> stops = now.stop[slot];
    const Int k = route.type, depot = data.type[k].depot;
    for (Int row = first_drone_row(data.type, k); row >= 0; row = next_drone_row(data.type, row)) {
        const TravelLegs flights = legs_of(data.leg, data.type[row].drone_travel);
        const Leg out = leg(flights, depot, node), home = leg(flights, node, depot);
        double cost = flown_cost(data.rate[row], out.distance + home.distance);
        cost -= most_saved(data, now, slot, node);
        if (unreachable(std::max(out.duration, home.duration)) || cost >= best.cost ||
            !data.can(row, 1, node) || !may_begin(data, k, node) ||
            !in_range(data, data.type[row], depot, node) ||
            !is_launch_place(data.no_launch, depot)) {
            continue;
        }
        for (Int p = -1; p < route.length; ++p) {
            if (p < 0 || stops[p].kind == end_stop) {
                add_offer(searcher, cost, flight_trip, slot, p).drone =
                    first_drone(data.type, k, row);
            }
        }
    }
}

void offer_trips(const Insertion& insertion, Int slot) {
    const auto [data, searcher, node, enlarge, found] = insertion;
    const double best = found.cost;
    const Fleet& now = searcher.now;
    const Route& route = now.route[slot];
    const View<const Stop, 1> stops = now.stop[slot];
    const Int k = route.type, m = data.type[k].travel, depot = data.type[k].depot;
    const double rate = data.rate[k].distance;
    const TravelLegs legs = legs_of(data.leg, m);
    const LegRow inward = legs_to(data.back, m, node);
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
            if (cost < best && !part_fits(data, now, slot, p, node, kind == trip_until)) continue;
        }
        cost += data.rate[k].stop - most_saved(data, now, slot, node);
        // Each of two trips carries less, at best next to nothing.
        if (kind != new_trip && loads_cost(data, k)) cost -= load_cost(data, now, slot);
        if (kind == new_trip && !may_begin(data, k, node)) continue;
        if (cost < best && (p < 0 || !data.place[0][node].too_late(stops[p].leave))) {
            add_offer(searcher, cost, kind, slot, p);
        }
    }
}

void offer_trips_apart(const Insertion& insertion, Int slot) {
    const auto [data, searcher, node, enlarge, found] = insertion;
    const double best = found.cost;
    const Fleet& now = searcher.now;
    const Route& route = now.route[slot];
    const View<const Stop, 1> stops = now.stop[slot];
    const Int k = route.type, last = route.length - 1;
    const double rate = data.rate[k].distance;
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
        double cost = double(detour_by_reload(data, k, here, node, there, p != last)) * rate;
        if (kind == trip_until) {
            const double behind =
                double(detour_by_reload(data, k, here, node, there, false)) * rate;
            if (behind < cost) {
                kind = trip_from;
                cost = behind;
            }
        }
        cost += data.rate[k].stop - most_saved(data, now, slot, node);
        // Whoever was served may be carried less far, at best next to nowhere.
        if (loads_cost(data, k)) cost -= load_cost(data, now, slot);
        if (kind == new_trip && !may_begin(data, k, node)) continue;
        if (cost < best) add_offer(searcher, cost, kind, slot, p);
    }
}

void take_cheapest(const Insertion& insertion) {
    const auto [data, searcher, node, enlarge, best] = insertion;
    const View<Move, 1> offer = searcher.scratch->offer;
    const View<double, 1> least = searcher.scratch->least;
    Int left = searcher.scratch->offers;
    Least cheapest(least, left);
    while (left > 0 && !data.deadline.passed()) {
        const Int first = cheapest.first();
        if (least[first] >= best.cost) break;
        const double cost =
            price_offer(data, searcher, offer[first], node, least[first], best.cost);
        best.try_move(cost, offer[first]);
        cheapest.take_out(first);
        offer[first] = offer[--left];
    }
    searcher.scratch->offers = 0;
}

}  // namespace tandem
