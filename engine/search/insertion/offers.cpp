#include "search/insertion/offers.h"

#include "rules/launch_place.h"
#include "search/insertion/cheapest_stop.h"
#include "search/insertion/sortie_times.h"
#include "search/route/ends.h"
#include "search/route/goods.h"
#include "search/route/refresh.h"
#include "search/route/stop_loads.h"

namespace tandem {
namespace {

// What a customer more among the stops of a route costs at least.
struct LeastCost {
    const ProblemData& data;
    const Newcomer& newcomer;
    Int k;
    Int spare;  // how long the route could work longer at no cost
    Speeds speeds;
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
            const Int left = speeds.left_of(std::max(Int{0}, longer - here.idle));
            cost += usual_work_cost(rate, std::max(Int{0}, left - spare));
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

// Returns where a stop is, in half stops of the route as it was: one placed there is between two.
Int half_stop(const Move& move, Int stop) {
    Int former = 2 * stop;
    for (const Placement& placed : move.placements()) {
        if (!is_stop(placed) || placed.from > stop) break;
        former -= placed.from == stop ? 1 : 2;
    }
    return former;
}

// Returns what an insertion costs, at least `least`; `infeasible` if it can't be, or perhaps if
// that is not below `best`.
//
// In place: a sortie's drone.
double price_offer(const ProblemData& data, const Searcher& searcher, Move& move, Int node,
                   double least, double best) {
    const Fleet& now = searcher.now;
    const Int slot = move.slot, p = move.first;
    Placement& placed = move.placement[std::size_t(move.count - 1)];
    if (is_one_stop(move)) {
        if (stands_alone(data, now, slot, p, node)) {
            const VehicleType& type = data.type[now.route[slot].type];
            return price_stop(data, now, slot, p, newcomer_for(data, type, node));
        }
    } else if (is_flight(placed) && !begins_trip(move)) {
        const Stretch stretch{half_stop(move, placed.from), half_stop(move, placed.to)};
        const Int row = row_of_drone(data.type, now.route[slot].type, placed.drone);
        placed.drone = std::int32_t(free_drone(data, now, slot, stretch, row));
        if (placed.drone < 0) return infeasible;
    } else if (is_stop(placed) && is_simple(data, now.route[slot]) &&
               !is_apart(data, now.route[slot].type)) {
        return more_trips_fit(data, now, move, node) ? least : infeasible;
    }
    return price_move(data, now, move, node, best);
}

// Where a trip more begins: before a customer whom the former trip's others follow, behind one whom
// they go before, or for a customer alone.
enum class Beginning { before, behind, alone };

// Lists a customer where a trip more begins behind stop `p`.
void offer_trip(const Insertion& insertion, Int slot, double cost, Int p, Beginning beginning) {
    const auto& [data, searcher, node, enlarge, best] = insertion;
    Offer& move = add_offer(searcher, cost, slot, p, p + 1);
    const Int depot = data.type[move.type].depot;
    if (beginning != Beginning::alone) {
        split_trip(move, p, depot, node, beginning == Beginning::behind);
        return;
    }
    move.add(How::begin, depot, p + 1);
    move.add(How::serve, node, p + 2);
    move.add(How::end, depot, p + 3);
}

}  // namespace

Int free_drone(const ProblemData& data, const Fleet& fleet, Int slot, Stretch stretch, Int row) {
    const View<const Sortie, 1> sorties = sorties_of(fleet, slot);
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
    const LeastCost least{data,
                          newcomer,
                          k,
                          spare_time(data, tour_of(now, slot)),
                          speeds_of(data, k),
                          most_saved(data, now, slot, node)};
    const Int most = longest_trip(data.type[k]) - now.trip(slot, stops[first].trip).distance;
    for (Int p = first; p <= last; ++p) {
        const Stop &here = stops[p], &behind = stops[p + 1];
        const Detour detour = newcomer.detour(here.node, behind.node, here.leg);
        double cost = least.between(here, behind, detour, best);
        if (cost < best && loads_cost(data, k)) {
            cost += load_more_behind(data, now, slot, p, node, detour);
        }
        if (cost < best && detour.distance <= most && room_behind(room, p)) {
            add_offer(searcher, cost, slot, p, p + 1).add(How::serve, node, p + 1);
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
    const Int idle = idle_time(now.route[slot]);
    const Speeds speeds = speeds_of(data, k);
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
        const TravelLegs homeward = legs_of(data.leg, data.type[row].home_travel);
        const Flying flying = flying_of(data, now, slot, row);
        const Int over =
            flying.end_of(sortie) + data.place.by_air(data.type[row])[node].service_duration();
        Int here = stops[sortie.launch].node;
        for (Int place = 0; place <= sortie.count; ++place) {
            const Int there =
                place < sortie.count ? sortie.nodes[place] : stops[sortie.recovery].node;
            const TravelLegs& onward = place < sortie.count ? flights : homeward;
            const Leg more =
                leg(flights, here, node) + leg(onward, node, there) - leg(onward, here, there);
            here = there;
            double cost =
                flown_cost(data.rate[row], more.distance) - most_saved(data, now, slot, node);
            if (cost >= best) continue;
            const Int longer = flying.delay(sortie.recovery, over + more.duration, s + 1);
            cost +=
                usual_work_cost(data.rate[row], std::max(Int{0}, speeds.left_of(longer) - idle));
            if (cost >= best) continue;
            if (place > 0 && tiers_of(data) > 0) {
                may_carry = can_carry(data, row, sortie, place, node);
            }
            if (!may_carry) continue;
            add_offer(searcher, cost, slot, sortie.launch, sortie.recovery)
                .add(How::join, node, s, place);
        }
    }
}

void offer_flight_trips(const Insertion& insertion, Int slot) {
    const auto [data, searcher, node, enlarge, best] = insertion;
    if (!data.strategy.loops) return;
    const Fleet& now = searcher.now;
    const auto [route, stops, trips, sorties] = tour_of(now, slot);
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
                fly_trip(add_offer(searcher, cost, slot, p, p + 1), p, depot, node,
                         first_drone(data.type, k, row));
            }
        }
    }
}

void offer_trips_alone(const Insertion& insertion, Int slot) {
    const auto [data, searcher, node, enlarge, found] = insertion;
    const auto [route, stops, trips, sorties] = tour_of(searcher.now, slot);
    const Int k = route.type, last = route.length - 1;
    if (!may_begin(data, k, node)) return;
    const TravelLegs legs = legs_of(data.leg, data.type[k].travel);
    double further = 0.0;
    for (Int p = -1; p <= last; ++p) {
        if (p >= 0 && stops[p].kind != end_stop) continue;
        // It is as far from anywhere where trips begin and end at one place.
        if (p < 0 || is_apart(data, k)) {
            const Int from = p == last ? p - 1 : std::max(p, Int{0});
            const Int to = p == last ? p : p + 2;
            const Int here = stops[from].node, there = stops[to].node;
            const Int direct = to == from + 1 ? stops[from].leg : leg(legs, here, there).distance;
            further = double(way_by_reload(data, k, here, node, there, p != last) - direct);
        }
        double cost = further * data.rate[k].distance + data.rate[k].stop -
                      most_saved(data, searcher.now, slot, node);
        // The others carry less far, at best next to nothing.
        if (loads_cost(data, k) && is_apart(data, k)) cost -= load_cost(data, searcher.now, slot);
        if (cost < found.cost && (p < 0 || !data.place[0][node].too_late(stops[p].leave))) {
            offer_trip(insertion, slot, cost, p, Beginning::alone);
        }
    }
}

void offer_splits(const Insertion& insertion, Int slot) {
    const auto [data, searcher, node, enlarge, found] = insertion;
    const double best = found.cost;
    const Fleet& now = searcher.now;
    const auto [route, stops, trips, sorties] = tour_of(now, slot);
    const Int k = route.type;
    const Rate& rate = data.rate[k];
    const bool apart = is_apart(data, k);
    // Where all trips begin and end at one place, its legs are looked up once.
    const Newcomer newcomer = newcomer_for(data, data.type[k], node);
    const Newcomer depot = newcomer_for(data, data.type[k], data.type[k].depot);
    const auto way_by = [&](Int here, Int there, bool first) {
        if (apart) return way_by_reload(data, k, here, node, there, first);
        return first ? newcomer.further(here, depot.node, 0) + distance_to(depot.onward, there)
                     : depot.further(here, node, 0) + distance_to(newcomer.onward, there);
    };
    for (Int p = 0; p < route.length - 1; ++p) {
        if (stops[p].kind == end_stop || stops[p].kind == start_stop || stops[p].flying > 0 ||
            stops[p + 1].kind == end_stop) {
            continue;
        }
        const Int here = stops[p].node, there = stops[p + 1].node;
        const auto detour = [&](bool first) {
            return double(way_by(here, there, first) - stops[p].leg) * rate.distance;
        };
        double cost = detour(false);
        const double before = detour(true);
        const bool until = before < cost;
        const Beginning beginning = until ? Beginning::behind : Beginning::before;
        cost = std::min(cost, before);
        if (cost < best && !part_fits(data, now, slot, p, node, until)) continue;
        cost += rate.stop - most_saved(data, now, slot, node);
        // Each of two trips carries less, at best next to nothing.
        if (loads_cost(data, k)) cost -= load_cost(data, now, slot);
        if (cost < best && !data.place[0][node].too_late(stops[p].leave)) {
            offer_trip(insertion, slot, cost, p, beginning);
        }
    }
}

void take_cheapest(const Insertion& insertion) {
    const auto [data, searcher, node, enlarge, best] = insertion;
    const View<Offer, 1> offer = searcher.scratch->offer;
    Move move;
    const View<double, 1> least = searcher.scratch->least;
    Int left = searcher.scratch->offers;
    Least cheapest(least, left);
    while (left > 0 && !data.deadline.passed()) {
        const Int first = cheapest.first();
        if (least[first] >= best.cost) break;
        move.become(offer[first]);
        best.try_move(price_offer(data, searcher, move, node, least[first], best.cost), move);
        cheapest.take_out(first);
        if (first < --left) offer[first].become(offer[left]);
    }
    searcher.scratch->offers = 0;
}

}  // namespace tandem
