#include "search/route/refresh.h"

#include "randomness.h"
#include "search/route/charging.h"
#include "search/route/ends.h"
#include "search/route/freshness.h"
#include "search/route/goods.h"
#include "search/route/hubs.h"
#include "search/route/rests.h"
#include "search/route/stop_loads.h"

namespace tandem {
namespace {

// How many more instants are tried at most from which a route might better begin.
constexpr Int most_begins = 16;

// Draws after which a search for one of few customers ends.
constexpr Int most_draws = 64;

// As `price_loaded`, where a driver who begins later may have had breaks before, or may not have to
// rest, or isn't on the way for so long.
//
// That is tried where time counts and the route may cost less, `least`, or nothing else goes; but
// not once the search must end, since a driver may begin at each of a thousand changes of speed.
bool price_later(const ProblemData& data, const Fleet& fleet, Int slot, double least,
                 bool& settled) {
    const auto [route, stops, trips, sorties] = tour_of(fleet, slot);
    const VehicleType& type = data.type[route.type];
    const Int release = stops[0].release;
    Int begin = std::max(release, type.shift_earliest), chosen = none;
    double best = 0.0;
    Int end = far;
    const bool end_costs = data.fairness.makespan > 0.0;
    bool may_gain = has_breaks(type);
    for (Int tried = 0;; ++tried) {
        const bool possible = price_loaded(data, fleet, slot, settled);
        // A trip that was held lasts too long from any instant in between.
        begin = std::max(begin, stops[0].release);
        const double cost = possible ? fleet.cost[slot] : no_bar;
        if (possible && (chosen == none || cost < best || (cost == best && route.end < end))) {
            chosen = begin;
            best = cost;
            end = route.end;
            may_gain = has_breaks(type) || any_rest(type, route);
        }
        const bool is_enough =
            chosen != none && (!possible || !may_gain || (best <= least && !end_costs) ||
                               !data.evaluation[route.type].timed || tried >= most_begins);
        const Int later = next_begin(data, route.type, begin);
        if (is_enough || !may_end(type, later) || data.deadline.passed()) {
            if (chosen == none || (possible && chosen == begin)) return chosen != none;
            break;
        }
        begin = stops[0].release = later;
    }
    stops[0].release = chosen;
    return price_loaded(data, fleet, slot, settled);
}

// Write all else that follows from when a route's trips begin, of one that has a price. In place.
void look_around(const ProblemData& data, const Fleet& fleet, Int slot, bool settled) {
    const Tour tour = tour_of(fleet, slot);
    const auto& [route, stops, trips, sorties] = tour;
    if (routes_meet(data)) plan_starts(tour);
    if (joins_breaks(data, route) && (settled || route.placed == breaks_kept)) {
        // Whoever is inserted behind a stop may be reached by other breaks.
        stops[0].release = fleet.trip(slot, 0).release;
        clear_rests(data.type[route.type], stops.first(route.length));
        clear_holds(tour);
        drive_as_placed(data, tour);
        if (lacks_break(data.type[route.type], tour)) note_soonest(data, tour);
    } else if (settled) {
        clear_holds(tour);
        drive_forward(data, tour);
    }
    if (data.evaluation[route.type].retimed || any_rest(data.type[route.type], route)) {
        open_up(tour);
    } else {
        look_back(data, tour);
    }
}

// As `refresh`, with trips that end where they do.
bool refresh_as_is(const ProblemData& data, const Fleet& fleet, Int slot) {
    bool settled = false;
    if (!price_as_is(data, fleet, slot, no_bar, settled)) return false;
    look_around(data, fleet, slot, settled);
    return true;
}

// Tell whether trips of a type may end at one depot and not at another, however far they are.
bool depots_differ(const ProblemData& data, Int k) {
    const VehicleType& type = data.type[k];
    return keeps_hours(type) || (hubs_count(data) && takes_batteries(type)) || bounds_reach(type);
}

// Let a trip end at stop `p`, and the next begin, where that costs least of all places, which may
// be `closed` where they do now. In place; false if all are.
bool choose_open(const ProblemData& data, const Fleet& fleet, Int slot, Int p, bool closed) {
    const Int k = fleet.route[slot].type;
    const View<Stop, 1> stops = fleet.stop[slot];
    const Int now = stops[p].node;
    Int best = closed ? nowhere : now;
    double cost = closed ? std::numeric_limits<double>::infinity() : fleet.cost[slot];
    for (Int node = 0; node < data.num_depots; ++node) {
        if (node == now || !data.reload(k, node)) continue;
        stops[p].node = node;
        if (refresh_as_is(data, fleet, slot) && fleet.cost[slot] < cost) {
            best = node;
            cost = fleet.cost[slot];
        }
    }
    stops[p].node = best == nowhere ? now : best;
    return refresh_as_is(data, fleet, slot);
}

// Let the trips of a route end, one of them elsewhere, at depots that are open, near enough and
// have batteries. In place; false if they can't.
bool find_open(const ProblemData& data, const Fleet& fleet, Int slot) {
    for (Int p = 1; p < fleet.route[slot].length - 1; ++p) {
        if (fleet.stop(slot, p).kind != end_stop) continue;
        if (choose_open(data, fleet, slot, p, true)) return true;
    }
    return false;
}

// Let the trips of a route end, and the next begin, where that costs least. In place.
void choose_reloads(const ProblemData& data, const Fleet& fleet, Int slot) {
    const auto [route, stops, trips, sorties] = tour_of(fleet, slot);
    for (Int p = 1; p < route.length - 1; ++p) {
        if (stops[p].kind != end_stop) continue;
        if (depots_differ(data, route.type)) {
            choose_open(data, fleet, slot, p, false);
            continue;
        }
        const Int node = stops[p].node;
        const double cost = fleet.cost[slot];
        const Int place =
            nearest_reload(data, route.type, stops[p - 1].node, stops[p + 2].node).node;
        if (place == node) continue;
        for (const Int end : {place, node}) {
            stops[p].node = end;
            if (refresh_as_is(data, fleet, slot) && fleet.cost[slot] < cost) break;
        }
    }
}

// Write what a route carries, and what other routes let it do. In place; false if it breaks a rule.
bool load_route(const ProblemData& data, const Fleet& fleet, Int slot) {
    const Tour tour = tour_of(fleet, slot);
    if (!load_trips(data, tour)) return false;
    if (!has_batteries(data, fleet, slot)) return false;
    if (orders_cross(data)) note_spans(data, fleet, slot);
    if (some_paired(data.pair) && !keeps_pairs(data, tour)) return false;
    if (goods_count(data) && !take_goods(data.goods, tour)) return false;
    return tiers_aboard(fleet) == 0 || weigh(data, fleet, slot);
}

// Tell whether a route that is set aside is copied with its times: where others' hang on them, or
// where it might not find them again once the search must end.
bool is_copied(const ProblemData& data, const Route& route) {
    const VehicleType& type = data.type[route.type];
    return routes_meet(data) || is_timed_slowly(type);
}

}  // namespace

bool price_as_is(const ProblemData& data, const Fleet& fleet, Int slot, double bar, bool& settled) {
    if (!load_route(data, fleet, slot)) return false;
    const VehicleType& type = data.type[fleet.route[slot].type];
    if (may_pause(type)) {
        const auto [in_time, working] = least_cost(data, fleet, slot);
        if (in_time >= bar) return false;
        if (joins_breaks(data, fleet.route[slot])) {
            return price_choices(data, fleet, slot, {in_time, bar, working}, settled);
        }
        if (rests_in_time(type)) {
            return (price_later(data, fleet, slot, in_time, settled) ||
                    begin_late(data, fleet, slot, settled)) &&
                   (!may_move_breaks(data, fleet, slot, in_time) ||
                    move_breaks(data, fleet, slot, bar, settled));
        }
    }
    return limits_timed_travel(type) ? price_later(data, fleet, slot, no_bar, settled)
                                     : price_loaded(data, fleet, slot, settled);
}

bool refresh(const ProblemData& data, const Fleet& fleet, Int slot) {
    const Route& route = fleet.route[slot];
    if (!refresh_as_is(data, fleet, slot) &&
        !(is_apart(data, route.type) && depots_differ(data, route.type) &&
          find_open(data, fleet, slot))) {
        return false;
    }
    if (is_apart(data, route.type) && route.trips > 1) choose_reloads(data, fleet, slot);
    return true;
}

bool refresh_as_planned(const ProblemData& data, const Fleet& fleet, Int slot) {
    const Tour tour = tour_of(fleet, slot);
    if (!load_route(data, fleet, slot)) return false;
    for (const Trip& trip : tour.trips.first(tour.route.trips)) {
        Stop& stop = tour.stops[trip.first];
        stop.release = std::max(stop.release, stop.free_start);
        stop.hold = none;
    }
    bool settled = false;
    if (!drive_forward(data, tour) || any_too_long(data, tour) || !has_places(data, fleet, slot) ||
        !price_timed(data, fleet, slot, settled)) {
        return false;
    }
    look_around(data, fleet, slot, settled);
    return true;
}

void set_aside(const ProblemData& data, const Fleet& fleet, Int slot, Int to) {
    if (is_copied(data, fleet.route[slot])) {
        copy_route(fleet, slot, fleet, to);
    } else {
        keep_aside(fleet, slot, to);
    }
}

void put_back(const ProblemData& data, const Fleet& fleet, Int slot, Int from) {
    if (is_copied(data, fleet.route[from])) {
        copy_route(fleet, from, fleet, slot);
    } else {
        keep_aside(fleet, from, slot);
        refresh(data, fleet, slot);
    }
}

bool refresh_cost(const ProblemData& data, const Fleet& fleet, Int slot, double bar) {
    const Route& route = fleet.route[slot];
    if (is_apart(data, route.type)) return refresh(data, fleet, slot);
    bool settled = false;
    return price_as_is(data, fleet, slot, bar, settled);
}

Int any_customer(const ProblemData& data, const Fleet& fleet, View<std::uint64_t, 1> rng) {
    const Int number = data.num_nodes - data.num_depots;
    Int node = data.num_depots;
    for (Int draw = 0; draw < most_draws; ++draw) {
        node = data.num_depots + below(rng, number);
        if (fleet.where[node].slot != elsewhere) break;
    }
    return node;
}

Int draw_customer(const ProblemData& data, const Fleet& fleet, Int focus,
                  View<std::uint64_t, 1> rng) {
    if (focus >= 0) {
        const Int rank = below(rng, data.near.shape(1) + 1);
        const Int node = rank > 0 ? data.near(focus, rank - 1) : focus;
        if (node >= 0 && fleet.where[node].slot != elsewhere) return node;
    }
    return any_customer(data, fleet, rng);
}

void note_places(View<Place, 1> places, const Tour& tour, Int slot) {
    const auto& [route, stops, trips, sorties] = tour;
    for (Int p = 0; p < route.length; ++p) {
        if (stops[p].kind == customer_stop) places[stops[p].node] = {slot, p, nowhere};
    }
    for (Int s = 0; s < route.sorties; ++s) {
        const Sortie& sortie = sorties[s];
        for (const Int node : sortie.customers()) places[node] = {slot, nowhere, s};
    }
}

}  // namespace tandem
