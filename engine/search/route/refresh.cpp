#include "search/route/refresh.h"

#include <algorithm>
#include <limits>

#include "randomness.h"
#include "rules/breaks.h"
#include "rules/clock.h"
#include "rules/driving.h"
#include "rules/hours.h"
#include "rules/hub.h"
#include "rules/load.h"
#include "rules/pair.h"
#include "rules/shift.h"
#include "rules/start.h"
#include "rules/window.h"
#include "search/route/breaks.h"
#include "search/route/charging.h"
#include "search/route/ends.h"
#include "search/route/freshness.h"
#include "search/route/goods.h"
#include "search/route/lags.h"
#include "search/route/least_cost.h"
#include "search/route/rarer.h"
#include "search/route/resting.h"
#include "search/route/routes.h"
#include "search/route/state.h"
#include "search/route/stop_loads.h"

namespace tandem {
namespace {

// Attempts to find out how late a trip may begin whose drones come in another order if it waits.
constexpr Int halvings = 6;

// Attempts likewise where breaks may then be due, or not any more.
constexpr Int halvings_with_breaks = 20;

// Attempts likewise, to the millisecond, where customers may then be served too soon behind others.
constexpr Int halvings_with_lags = 40;

// How many more instants are tried at most from which a route might better begin.
constexpr Int most_begins = 16;

// How often a trip with breaks is held back again since it has lost some.
constexpr Int settled_again = 3;

// Draws after which a search for one of few customers ends.
constexpr Int most_draws = 64;

// Tell whether a drone is launched or recovered at a stop or in the air meanwhile.
bool has_sortie(View<const Sortie, 1> sorties, Int p) {
    return std::any_of(sorties.begin(), sorties.end(), [&](const Sortie& sortie) {
        return sortie.launch <= p && p <= sortie.recovery;
    });
}

// Return the latest start of a trip that costs nothing, by each stop's last arrival.
//
// Where lags count, stops note by when service may begin.
Int latest_by_stops(const ProblemData& data, const Route& route, View<Stop, 1> stops,
                    View<const Sortie, 1> sorties, Int first) {
    const Int k = route.type, last = route.length - 1;
    const VehicleType& type = data.type[k];
    const NodeTable places = data.place.by_truck(type);
    Int leave = far;
    for (Int p = last; p >= first; --p) {
        Stop& stop = stops[p];
        const bool plain = !has_sortie(sorties.first(route.sorties), p);
        Int arrival = stop.arrival;
        if (p == last && plain) leave = stop.leave;
        if (lags_count(data) && stop.kind == customer_stop) {
            stop.free_start = stop.start;
            if (plain) {
                const Int service = places[stop.node].service_duration();
                leave = std::min(leave, latest_leave(data, route, stops, sorties, p, service));
                stop.free_start = leave - service;
            }
        }
        if (plain) {
            arrival = has_window(stop) ? places[stop.node].latest_free_arrival(stop.arrival, leave)
                                       : std::min(leave, leaves_by(type, places, stop.node));
        }
        leave = arrival;
        if (p == first) break;
        const Stop& before = stops[p - 1];
        if (stop.kind == start_stop) {
            leave = arrival - before.gap;
        } else {
            arrival -= setup_beside(type, data.setup, before.node, stop.node);
            const auto back = [&](Int time) {
                return leg_start(type, data.profile_time[k], data.profile_factor[k], before.gap,
                                 time);
            };
            // Who leaves later may rest while it is slow, or needn't.
            leave = follows_driver(type) ? arrival - before.gap
                    : has_breaks(type)   ? departure_before(type, Rests(before.rests),
                                                            begin_of(type, stops), arrival, back)
                                         : back(arrival);
        }
    }
    return leave;
}

// Return the latest start of the trip that begins at stop `first` which costs nothing.
//
// If all is retimed, either by moving the whole trip within the windows that are met, or stop by
// stop, which may reach others but leaves blocks with sorties as they are.
Int latest_hold(const ProblemData& data, const Route& route, View<Stop, 1> stops,
                View<const Sortie, 1> sorties, Int first) {
    Int hold = none;
    if (is_steady(data.type[route.type]) && !has_breaks(data.type[route.type]) &&
        (!lags_count(data) || route.sorties > 0)) {
        const Int base = stops[first].before;
        hold = route.end - (route.cum - base);
        for (Int p = first; p < route.length; p = stops[p].last + 1) {
            hold = std::min(hold, stops[p].dep - (stops[p].before - base));
        }
    }
    if (data.evaluation[route.type].retimed) {
        hold = std::max(hold, latest_by_stops(data, route, stops, sorties, first));
    }
    return hold;
}

// Let a trip of a timed route whose driver is followed begin as late as `hold` at most, where it
// ends no later. In place; false if a rule is broken.
//
// Later beginnings are tried with the rests that are placed, and that which is chosen with others.
bool settle_followed(const ProblemData& data, Route& route, View<Stop, 1> stops, Stop& stop,
                     View<Sortie, 1> sorties, Int hold) {
    const Int end = route.end, before = stop.hold;
    const Int soonest = std::max({stop.arrival, stop.release, stop.hold});
    Int found = before, failed = hold, tried = hold;
    for (Int attempt = 0; attempt <= halvings_with_breaks && found != hold; ++attempt) {
        stop.hold = tried;
        const bool done = drive_as_placed(data, route, stops, sorties) && route.end <= end;
        (done ? found : failed) = tried;
        tried = (std::max(found, soonest) + failed) >> 1;
    }
    stop.hold = found;
    if (drive_forward(data, route, stops, sorties) && route.end <= end) return true;
    stop.hold = before;
    return drive_forward(data, route, stops, sorties);
}

// Return when truck or drone first leaves the depot on a settled route.
Int settled_departure(const ProblemData& data, const Route& route, View<const Stop, 1> stops,
                      View<const Sortie, 1> sorties) {
    return counted_from(data.type[route.type], departure_of(data, route, stops, sorties, 0));
}

// Tell whether a route with drones works too long unless it begins later than it could.
//
// Whether they then come in the order that its times were found by has to be seen.
bool has_to_wait(const ProblemData& data, const Route& route, View<const Stop, 1> stops,
                 View<const Sortie, 1> sorties) {
    if (route.sorties == 0) return false;
    const Int soonest = settled_departure(data, route, stops, sorties);
    return !may_work(data.type[route.type], route.end - soonest - route.unpaid);
}

// Tell whether all shipments on a trip are whole, by its sorties among some; `node_at` tells who
// is served at each stop.
template <class NodeAt>
bool keep_pairs(const ProblemData& data, View<const Sortie, 1> sorties, const Trip& trip,
                const NodeAt& node_at) {
    const auto comes_before = [&](Int pickup, Int behind) {
        for (Int p = behind - 1; p > trip.first; --p) {
            if (node_at(p) == pickup) return true;
        }
        return std::any_of(sorties.begin(), sorties.end(), [&](const Sortie& sortie) {
            return sortie.launch >= trip.first && sortie.recovery < behind &&
                   std::find(sortie.nodes, sortie.nodes + sortie.count, pickup) !=
                       sortie.nodes + sortie.count;
        });
    };
    WholePairs pairs(data.pair);
    const auto serve = [&](Int node, Int stop) {
        pairs.serve(node, [&](Int pickup) { return comes_before(pickup, stop); });
    };
    for (Int p = trip.first + 1; p < trip.last; ++p) {
        if (node_at(p) >= 0) serve(node_at(p), p);
    }
    for (const Sortie& sortie : sorties) {
        if (sortie.launch < trip.first || sortie.launch > trip.last) continue;
        for (Int visit = 0; visit < sortie.count; ++visit) {
            pairs.serve(sortie.nodes[visit], [&](Int pickup) {
                return is_brought_within(data.pair, sortie.nodes, visit) ||
                       comes_before(pickup, sortie.launch);
            });
        }
    }
    return pairs.are_kept();
}

// Tell whether each trip serves whole shipments, each picked up first, and unloads from a stack
// what lies on it.
bool keep_pairs(const ProblemData& data, const Route& route, View<const Stop, 1> stops,
                View<const Trip, 1> trips, View<const Sortie, 1> sorties) {
    const View<const Trip, 1> made = trips.first(route.trips);
    const auto node_at = [&](Int p) {
        return stops[p].kind == customer_stop ? stops[p].node : nowhere;
    };
    return std::all_of(made.begin(), made.end(), [&](const Trip& trip) {
        return keep_pairs(data, sorties.first(route.sorties), trip, node_at) &&
               (!is_stack(data.type[route.type]) ||
                keeps_stack(data.pair, trip.first + 1, trip.last, node_at));
    });
}

// As `price_as_is`, of a route whose trips are timed, and held as long as they have to be.
bool price_timed(const ProblemData& data, const Fleet& fleet, Int slot, bool& settled) {
    Route& route = fleet.route[slot];
    const View<Stop, 1> stops = fleet.stop[slot];
    const View<Trip, 1> trips = fleet.trip[slot];
    const View<Sortie, 1> sorties = fleet.sortie[slot];
    const VehicleType& type = data.type[route.type];
    const bool held_back = data.evaluation[route.type].held_back;
    Int departure = first_departure(data, route, stops, sorties);
    settled = held_back || has_to_wait(data, route, stops, sorties);
    if (settled) {
        if (!settle(data, route, stops, trips, sorties)) return false;
        departure = settled_departure(data, route, stops, sorties);
    }
    if (lags_count(data) && !keeps_all_lags(data, route, stops, sorties)) return false;
    route.working = route.end - departure - route.unpaid;
    if (!may_work(type, route.working)) return false;
    const auto [cost, early] = price_route(data, route, stops, trips, sorties);
    fleet.cost[slot] = cost;
    if (loads_cost(data, route.type)) fleet.cost[slot] += load_cost(data, fleet, slot);
    fleet.early[slot] = held_back ? early : 0.0;
    return true;
}

// As `price_as_is`, of a route whose loads are known and whose first trip begins no sooner than its
// release says.
bool price_loaded(const ProblemData& data, const Fleet& fleet, Int slot, bool& settled) {
    Route& route = fleet.route[slot];
    const View<Stop, 1> stops = fleet.stop[slot];
    const View<Trip, 1> trips = fleet.trip[slot];
    const View<Sortie, 1> sorties = fleet.sortie[slot];
    const VehicleType& type = data.type[route.type];
    clear_holds(route, stops, trips);
    if (!drive_forward(data, route, stops, sorties)) return false;
    if (holds_count(data, route.type) && !hold_trips(data, route, stops, trips, sorties)) {
        return false;
    }
    if (shares_chargers(type) && !charge_in_turn(data, fleet, slot)) return false;
    return price_timed(data, fleet, slot, settled);
}

// Return the first instant later than `begin` at which a route had better begin, perhaps: once a
// break is over, or the speed changes. `far`: there is none.
Int next_begin(const ProblemData& data, Int k, Int begin) {
    const VehicleType& type = data.type[k];
    const Int later = later_begin(type, begin), changes = num_changes(type);
    if (!limits_timed_travel(type) && !follows_driver(type)) return later;
    const View<const Int, 1> times = data.profile_time[k];
    const Int change = changes_until(times, changes, begin);
    return change < changes ? std::min(later, times[change]) : later;
}

// As `price_loaded`, where a driver who begins later may have had breaks before, or may not have to
// rest, or isn't on the way for so long.
//
// That is tried where time counts and the route may cost less, `least`, or nothing else goes.
bool price_later(const ProblemData& data, const Fleet& fleet, Int slot, double least,
                 bool& settled) {
    Route& route = fleet.route[slot];
    const View<Stop, 1> stops = fleet.stop[slot];
    const VehicleType& type = data.type[route.type];
    const Int release = stops[0].release;
    Int begin = std::max(release, type.shift_earliest), chosen = none;
    double best = 0.0;
    bool may_gain = has_breaks(type);
    for (Int tried = 0;; ++tried) {
        const bool possible = price_loaded(data, fleet, slot, settled);
        if (possible && (chosen == none || fleet.cost[slot] < best)) {
            chosen = begin;
            best = fleet.cost[slot];
            may_gain = has_breaks(type) || any_rest(type, route);
        }
        const bool is_enough =
            chosen != none && (!possible || !may_gain || best <= least ||
                               !data.evaluation[route.type].timed || tried >= most_begins);
        const Int later = next_begin(data, route.type, begin);
        if (is_enough || !may_end(type, later)) {
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
    Route& route = fleet.route[slot];
    const View<Stop, 1> stops = fleet.stop[slot];
    if (routes_meet(data)) plan_starts(route, stops);
    if (settled) {
        clear_holds(route, stops, fleet.trip[slot]);
        drive_forward(data, route, stops, fleet.sortie[slot]);
    }
    if (data.evaluation[route.type].retimed || any_rest(data.type[route.type], route)) {
        open_up(route, stops);
    } else {
        look_back(data, route, stops);
    }
}

// As `refresh`, with trips that end where they do.
bool refresh_as_is(const ProblemData& data, const Fleet& fleet, Int slot) {
    bool settled = false;
    if (!price_as_is(data, fleet, slot, no_bar, settled)) return false;
    look_around(data, fleet, slot, settled);
    return true;
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

// Let the trips of a route end, one of them elsewhere, while depots are open. In place; false if
// they can't.
bool find_open(const ProblemData& data, const Fleet& fleet, Int slot) {
    for (Int p = 1; p < fleet.route[slot].length - 1; ++p) {
        if (fleet.stop(slot, p).kind != end_stop) continue;
        if (choose_open(data, fleet, slot, p, true)) return true;
    }
    return false;
}

// Let the trips of a route end, and the next begin, where that costs least. In place.
void choose_reloads(const ProblemData& data, const Fleet& fleet, Int slot) {
    const Route& route = fleet.route[slot];
    const View<Stop, 1> stops = fleet.stop[slot];
    for (Int p = 1; p < route.length - 1; ++p) {
        if (stops[p].kind != end_stop) continue;
        if (keeps_hours(data.type[route.type])) {
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
    Route& route = fleet.route[slot];
    const View<Stop, 1> stops = fleet.stop[slot];
    const View<Trip, 1> trips = fleet.trip[slot];
    const View<Sortie, 1> sorties = fleet.sortie[slot];
    if (!load_trips(data, route, stops, trips, sorties)) return false;
    if (orders_cross(data)) note_spans(data, fleet, slot);
    if (some_paired(data.pair) && !keep_pairs(data, route, stops, trips, sorties)) return false;
    if (goods_count(data) && !take_goods(data.goods, route, stops, trips, sorties)) return false;
    return tiers_aboard(fleet) == 0 || weigh(data, fleet, slot);
}

}  // namespace

bool price_as_is(const ProblemData& data, const Fleet& fleet, Int slot, double bar, bool& settled) {
    if (!load_route(data, fleet, slot)) return false;
    const VehicleType& type = data.type[fleet.route[slot].type];
    if (may_rest(type)) {
        const double least = least_cost(data, fleet, slot);
        if (least >= bar) return false;
        if (rests_in_time(type)) return price_later(data, fleet, slot, least, settled);
    }
    return limits_timed_travel(type) ? price_later(data, fleet, slot, no_bar, settled)
                                     : price_loaded(data, fleet, slot, settled);
}

void clear_holds(const Route& route, View<Stop, 1> stops, View<const Trip, 1> trips) {
    for (const Trip& trip : trips.first(route.trips)) stops[trip.first].hold = none;
}

bool settle(const ProblemData& data, Route& route, View<Stop, 1> stops, View<const Trip, 1> trips,
            View<Sortie, 1> sorties) {
    const bool resting = rests_in_time(data.type[route.type]);
    Int index = 0, again = resting ? settled_again : 0;
    const Int most = lags_count(data) ? halvings_with_lags
                     : resting        ? halvings_with_breaks
                                      : halvings;
    while (index < route.trips) {
        const Trip& trip = trips[index++];
        Stop& stop = stops[trip.first];
        const Int hold = latest_hold(data, route, stops, sorties, trip.first);
        const Int soonest = std::max({stop.arrival, stop.release, stop.hold});
        if (hold <= soonest) continue;
        if (any_rest(data.type[route.type], route) && follows_driver(data.type[route.type])) {
            const Int before = stop.hold;
            if (!settle_followed(data, route, stops, stop, sorties, hold)) return false;
            if (stop.hold > before && again-- > 0) --index;
            continue;
        }
        const Int end = route.end, before = stop.hold;
        Int found = before, failed = hold, tried = hold;
        for (Int attempt = 0; attempt <= most && found != hold; ++attempt) {
            stop.hold = tried;
            if (drive_forward(data, route, stops, sorties) && route.end <= end &&
                !any_too_long(data, route, stops, trips, sorties)) {
                found = tried;
            } else {
                // Drones in another order of arrival took longer, or breaks that are due.
                failed = tried;
            }
            tried = (std::max(found, soonest) + failed) >> 1;
        }
        if (stop.hold != found) {
            stop.hold = found;
            if (!drive_forward(data, route, stops, sorties)) return false;
        }
        // Without some breaks it may begin even later.
        if (found > before && again-- > 0) --index;
    }
    return true;
}

bool refresh(const ProblemData& data, const Fleet& fleet, Int slot) {
    const Route& route = fleet.route[slot];
    if (!refresh_as_is(data, fleet, slot) &&
        !(is_apart(data, route.type) && keeps_hours(data.type[route.type]) &&
          find_open(data, fleet, slot))) {
        return false;
    }
    if (is_apart(data, route.type) && route.trips > 1) choose_reloads(data, fleet, slot);
    return true;
}

bool refresh_as_planned(const ProblemData& data, const Fleet& fleet, Int slot) {
    Route& route = fleet.route[slot];
    const View<Stop, 1> stops = fleet.stop[slot];
    const View<Trip, 1> trips = fleet.trip[slot];
    const View<Sortie, 1> sorties = fleet.sortie[slot];
    if (!load_route(data, fleet, slot)) return false;
    for (const Trip& trip : trips.first(route.trips)) {
        Stop& stop = stops[trip.first];
        stop.release = std::max(stop.release, stop.free_start);
        stop.hold = none;
    }
    bool settled = false;
    if (!drive_forward(data, route, stops, sorties) ||
        any_too_long(data, route, stops, trips, sorties) || !has_places(data, fleet, slot) ||
        !price_timed(data, fleet, slot, settled)) {
        return false;
    }
    look_around(data, fleet, slot, settled);
    return true;
}

void set_aside(const ProblemData& data, const Fleet& fleet, Int slot, Int to) {
    if (routes_meet(data)) {
        copy_route(fleet, slot, fleet, to);
    } else {
        keep_aside(fleet, slot, to);
    }
}

void put_back(const ProblemData& data, const Fleet& fleet, Int slot, Int from) {
    if (routes_meet(data)) {
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

void note_places(View<Place, 1> places, const Route& route, View<const Stop, 1> stops,
                 View<const Sortie, 1> sorties, Int slot) {
    for (Int p = 0; p < route.length; ++p) {
        if (stops[p].kind == customer_stop) places[stops[p].node] = {slot, p, nowhere};
    }
    for (Int s = 0; s < route.sorties; ++s) {
        const Sortie& sortie = sorties[s];
        for (Int visit = 0; visit < sortie.count; ++visit) {
            places[sortie.nodes[visit]] = {slot, nowhere, s};
        }
    }
}

}  // namespace tandem
