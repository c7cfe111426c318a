#include <limits>

#include "rules/shift.h"
#include "search/moves/exchanges.h"
#include "search/route/edit.h"
#include "search/route/refresh.h"
#include "search/route/state.h"

namespace tandem {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

// Where a route is cut: behind a stop.
struct Cut {
    Int slot, stop;
};

// Return how far a route goes on from stop `p`.
Int rest_distance(const Fleet& fleet, Int slot, Int p) {
    Int distance = 0;
    for (Int q = p; q < fleet.route[slot].length; ++q) distance += fleet.stop(slot, q).leg;
    return distance;
}

// Return how much longer a route's last leg is to another end.
Int longer_home(const TravelLegs& legs, const Fleet& fleet, Int slot, Int home) {
    const Stop& last = fleet.stop(slot, fleet.route[slot].length - 2);
    return leg(legs, last.node, home).distance - last.leg;
}

// Tell whether type `k` may serve all customers of a route of one trip behind a cut.
bool may_serve_tail(const ProblemData& data, const Fleet& fleet, Int k, Cut cut) {
    for (Int p = cut.stop + 1; p < fleet.route[cut.slot].length - 1; ++p) {
        if (!data.can(k, 0, fleet.stop(cut.slot, p).node)) return false;
    }
    return true;
}

// Return what it costs to swap the tails behind two cuts.
//
// By distance alone; infinite where a tail would be reached too late.
double tail_saving(const ProblemData& data, const Fleet& fleet, Cut a, Cut b) {
    const Int k = fleet.route[a.slot].type;
    const Int by = fleet.route[b.slot].type;
    const TravelLegs legs = legs_of(data.leg, data.type[k].travel);
    const Stop& here = fleet.stop(a.slot, a.stop);
    const Stop& there = fleet.stop(b.slot, b.stop);
    const Stop& behind_here = fleet.stop(a.slot, a.stop + 1);
    const Stop& behind_there = fleet.stop(b.slot, b.stop + 1);
    Int after_here = behind_here.node, after_there = behind_there.node;
    const Int home = data.type[k].ends_at;
    const Int home_by = data.type[by].ends_at;
    if (home != home_by) {
        if (behind_here.kind == end_stop) after_here = home_by;
        if (behind_there.kind == end_stop) after_there = home;
    }
    const Leg to_other = leg(legs, here.node, after_there);
    const Leg to_one = leg(legs, there.node, after_here);
    if (here.leave + to_other.duration > behind_there.latest ||
        there.leave + to_one.duration > behind_here.latest) {
        return infinite;
    }
    const Rate& rate = data.rate[k];
    const Rate& rate_by = data.rate[by];
    double cost = double(to_other.distance - here.leg) * rate.distance +
                  double(to_one.distance - there.leg) * rate_by.distance;
    if (home != home_by) {
        if (behind_there.kind != end_stop) {
            cost += double(longer_home(legs, fleet, b.slot, home)) * rate.distance;
        }
        if (behind_here.kind != end_stop) {
            cost += double(longer_home(legs, fleet, a.slot, home_by)) * rate_by.distance;
        }
    }
    if (rate.distance != rate_by.distance) {
        const Int longer =
            rest_distance(fleet, b.slot, b.stop + 1) - rest_distance(fleet, a.slot, a.stop + 1);
        cost += double(longer) * (rate.distance - rate_by.distance);
    }
    const Int more = (fleet.route[b.slot].length - b.stop) - (fleet.route[a.slot].length - a.stop);
    return cost + double(more) * (rate.stop - rate_by.stop);
}

// Tell whether a trip up to cut `a`, which goes on behind cut `b`, may carry all.
bool is_cargo(const ProblemData& data, const Fleet& fleet, Cut a, Cut b, Int tier) {
    const VehicleType& type = data.type[fleet.route[a.slot].type];
    const Trip& one = fleet.trip(a.slot, fleet.stop(a.slot, a.stop).trip);
    const Trip& other = fleet.trip(b.slot, fleet.stop(b.slot, b.stop).trip);
    return may_be_joined(type, cargo_between(fleet.stop_load[a.slot][tier], one.first, a.stop + 1),
                         cargo_between(fleet.stop_load[b.slot][tier], b.stop + 1, other.last + 1),
                         tier);
}

// Tell whether the trip that begins before cut `a` and goes on behind cut `b` carries too much.
// Stops of the truck alone are counted, but where more than loads tells.
bool overloads(const ProblemData& data, const Fleet& fleet, Cut a, Cut b) {
    Amount load{};
    Int count = 0;
    const auto add = [&](const Stop& stop) {
        load = plus(load, demand_of(data.place[0][stop.node]));
        if (stop.kind == customer_stop) ++count;
    };
    for (Int p = a.stop; has_window(fleet.stop(a.slot, p)); --p) add(fleet.stop(a.slot, p));
    for (Int p = b.stop + 1; has_window(fleet.stop(b.slot, p)); ++p) {
        add(fleet.stop(b.slot, p));
    }
    const VehicleType& type = data.type[fleet.route[a.slot].type];
    if (!holds(type, load) || !allows_stops(type, count)) return true;
    for (Int tier = 0; tier < fleet.stop_load.shape(1); ++tier) {
        if (!is_cargo(data, fleet, a, b, tier)) return true;
    }
    return false;
}

// Tell whether goods clash on the trip that `overloads` is asked of.
bool clashes(const ProblemData& data, const Fleet& fleet, Cut a, Cut b) {
    if (data.goods.empty()) return false;
    Int barred = 0;
    for (Int p = a.stop; has_window(fleet.stop(a.slot, p)); --p) {
        barred |= barred_on_trip(data.goods[fleet.stop(a.slot, p).node]);
    }
    for (Int p = b.stop + 1; has_window(fleet.stop(b.slot, p)); ++p) {
        if (!go_together(data.goods[fleet.stop(b.slot, p).node], barred, 0)) return true;
    }
    return false;
}

// Tell whether the route up to cut `a`, then on behind cut `b`, has too many trips.
bool too_long(const ProblemData& data, const Fleet& fleet, Cut a, Cut b) {
    const Route& front = fleet.route[a.slot];
    const Route& rest = fleet.route[b.slot];
    const Int trips =
        fleet.stop(a.slot, a.stop).trip + rest.trips - fleet.stop(b.slot, b.stop).trip;
    return trips > data.type[front.type].max_trips;
}

// Tell whether the route up to cut `b`, then on behind cut `a`, has a trip to nobody.
bool leaves_nothing(const Fleet& fleet, Cut a, Cut b) {
    const bool nobody = fleet.stop(b.slot, b.stop).kind == start_stop &&
                        fleet.stop(a.slot, a.stop + 1).kind == end_stop;
    return nobody && !(b.stop == 0 && a.stop + 2 == fleet.route[a.slot].length);
}

// Tell whether tails may be swapped, by what trips carry, how many there are, and to whom.
bool may_swap(const ProblemData& data, const Fleet& fleet, Cut a, Cut b) {
    return !(leaves_nothing(fleet, a, b) || overloads(data, fleet, a, b) ||
             overloads(data, fleet, b, a) || clashes(data, fleet, a, b) ||
             clashes(data, fleet, b, a) || too_long(data, fleet, a, b) ||
             too_long(data, fleet, b, a));
}

// Return what it costs to serve a tail by a new route.
double cost_apart(const ProblemData& data, const Fleet& fleet, Cut a) {
    const Int k = fleet.route[a.slot].type;
    const VehicleType& type = data.type[k];
    const TravelLegs legs = legs_of(data.leg, type.travel);
    const Stop& stop = fleet.stop(a.slot, a.stop);
    const Int detour = leg(legs, stop.node, type.ends_at).distance - stop.leg +
                       leg(legs, type.begins_at, fleet.stop(a.slot, a.stop + 1).node).distance;
    return data.rate[k].fixed + double(detour) * data.rate[k].distance;
}

// Return the cut behind which a tail is best swapped with that behind `a`.
//
// Its route is `nowhere` if none is worth less than `limit`, or an empty slot for a new route.
Cut find_tail(const ProblemData& data, const Searcher& searcher, Cut a, double limit) {
    const Fleet& now = searcher.now;
    const Int k = now.route[a.slot].type;
    const View<const std::int32_t, 1> near = data.near[now.stop(a.slot, a.stop).node];
    Cut chosen{nowhere, 0};
    double best = limit;
    for (Int node : near.first(std::min(tail_neighbours, near.size()))) {
        if (node < 0) break;
        const Cut b{now.where[node].slot, now.where[node].position - 1};
        if (b.slot < 0 || b.stop < 0 || b.slot == a.slot || now.stop(b.slot, b.stop).flying > 0) {
            continue;
        }
        const Int by = now.route[b.slot].type;
        if (by != k && !data.splice(k, by)) continue;
        const double cost = tail_saving(data, now, a, b);
        if (cost >= best) continue;
        if (by != k && !data.swap(k, by) &&
            !(may_serve_tail(data, now, k, b) && may_serve_tail(data, now, by, a))) {
            continue;
        }
        // Where it matters who comes when, few tails fit: look for one that does.
        if (now.stop_load.shape(1) > 0 && !may_swap(data, now, a, b)) continue;
        chosen = b;
        best = cost;
    }
    if (has_window(now.stop(a.slot, a.stop + 1)) && cost_apart(data, now, a) < best) {
        const Int slot = free_slot(data, searcher, k);
        if (slot >= 0) return {slot, 0};
    }
    return chosen;
}

// Write a route up to cut `a`, then another's rest behind cut `b`, both kept aside, into a slot. In
// place; false if there is no room.
bool join(const ProblemData& data, Fleet& now, Int slot, Cut a, Cut b) {
    Route& route = now.route[slot];
    route.length = route.sorties = 0;
    if (!append(now, a.slot, 0, a.stop + 1, slot) ||
        !append(now, b.slot, b.stop + 1, now.route[b.slot].length, slot)) {
        return false;
    }
    // Whoever ends another's route still ends where its own type does.
    if (data.splice(route.type, route.type)) {
        now.stop(slot, route.length - 1).node = data.type[route.type].ends_at;
    }
    return true;
}

// Swap tails; `b` may be in an empty slot. In place; false if that breaks a rule.
bool swap_tails(const ProblemData& data, Searcher& searcher, Cut a, Cut b) {
    Fleet& now = searcher.now;
    touch(searcher, a.slot);
    touch(searcher, b.slot);
    const Int k = now.route[a.slot].type;
    Route& other = now.route[b.slot];
    if (other.length == 0) {
        if (!begin_empty(sequence_in(now, b.slot), data.type[k], k)) return false;
        ++now.used[k];
    }
    const Cut one{now.route.size() - 2, a.stop};
    const Cut two{now.route.size() - 1, b.stop};
    keep_aside(now, a.slot, one.slot);
    keep_aside(now, b.slot, two.slot);
    bool done = join(data, now, a.slot, one, two) && join(data, now, b.slot, two, one);
    for (Int slot : {a.slot, b.slot}) {
        Route& route = now.route[slot];
        if (route.length == 2 && route.sorties == 0) {
            route.length = route.trips = 0;
            now.cost[slot] = 0.0;
            --now.used[route.type];
        } else if (done) {
            done = refresh(data, now, slot);
            locate(now, slot);
        }
    }
    return done;
}

}  // namespace

bool append(const Fleet& source, Int slot, Int first, Int behind, Int to) {
    const auto& [route, stops, sorties] = sequence_in(source, to);
    const Int shift = route.length - first;
    for (Int p = first; p < behind; ++p) {
        const Stop& stop = source.stop(slot, p);
        if (!add_stop(sequence_in(source, to), stop.node, stop.kind)) return false;
    }
    for (const Sortie& sortie : sorties_of(source, slot)) {
        if (sortie.launch < first || sortie.launch >= behind) continue;
        if (route.sorties >= sorties.size()) return false;
        Sortie& copy = sorties[route.sorties++];
        copy = sortie;
        copy.launch += shift;
        copy.recovery += shift;
    }
    return true;
}

bool two_opt_star(const ProblemData& data, Searcher& searcher, double limit) {
    const Fleet& now = searcher.now;
    const Int node = draw_customer(data, now, searcher.count->focus, searcher.rng);
    const Cut a{now.where[node].slot, now.where[node].position};
    if (a.slot < 0 || a.stop < 0 || now.stop(a.slot, a.stop).flying > 0) return false;
    const Cut b = find_tail(data, searcher, a, limit);
    if (b.slot < 0) return false;
    if (now.route[b.slot].length > 0 && !may_swap(data, now, a, b)) return false;
    return swap_tails(data, searcher, a, b);
}

}  // namespace tandem
