#include "search/insertion/evaluate.h"

#include <algorithm>
#include <optional>

#include "guard.h"
#include "randomness.h"
#include "rules/drone_types.h"
#include "rules/flown_trip.h"
#include "rules/leg.h"
#include "rules/load.h"
#include "rules/pair.h"
#include "rules/shift.h"
#include "rules/start.h"
#include "rules/window.h"
#include "search/insertion/parts_alone.h"
#include "search/insertion/proposal.h"
#include "search/route/block.h"
#include "search/route/edit.h"
#include "search/route/ends.h"
#include "search/route/flown_trips.h"
#include "search/route/rarer.h"
#include "search/route/refresh.h"
#include "search/route/resting.h"
#include "search/route/routes.h"
#include "search/route/vehicles.h"
#include "search/search.h"

namespace tandem {
namespace {

// The first and the last of the stops that a move changes.
struct ChangedStops {
    Int first;
    Int last;
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
    const Route& route = fleet.route[slot];
    const View<const Sortie, 1> sorties = fleet.sortie[slot];
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
    Int p = move.first, q = p + 1;
    if (move.kind == by_sortie) {
        q = move.last;
    } else if (uses_halt(move)) {
        q = std::max(q, move.last + (move.kind == from_halt ? 0 : 1));
    } else if (move.kind == on_sortie) {
        p = fleet.sortie(slot, move.sortie).launch;
        q = fleet.sortie(slot, move.sortie).recovery;
    }
    p = std::max(p, Int{0});
    q = std::min(q, fleet.route[slot].length - 1);
    const Trip& trip = fleet.trip(slot, stops[p].trip);
    const bool is_sortie = move.kind == by_sortie || uses_halt(move);
    if (is_sortie || move.kind == trip_from || move.kind == trip_until) {
        q = std::max(
            q, launch_changed(type, fleet.route[slot], fleet.sortie[slot], trip, p, is_sortie));
    }
    const bool whole = bounds_trips(type) && move.kind != new_trip;
    if (held || whole) p = trip.first;
    if (whole) q = std::max(q, trip.last);
    return {stops[p].block, stops[stops[q].block].last};
}

// The move as it is in a part of the route that begins so many stops and sorties later.
Move within(Move move, Int stops, Int sorties) {
    if (move.kind == on_sortie) {
        move.sortie -= sorties;
    } else {
        move.first -= stops;
        move.last -= stops;
    }
    return move;
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
    if (limits_travel(type)) {
        const Int changed = travel_on(data, type, fleet.stop[to], 0, fleet.route[to].length - 1) -
                            travel_on(data, type, old, part.first, part.last);
        if (!may_travel(type, route.travel + changed)) return infeasible;
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

// How many ways there are to deliver what a route fetches alone: by truck, on the sortie that
// fetches it, or by a drone of a row from where the route ends, or from the pickup's stop and back
// there or to the end.
Int ways_to_deliver(const ProblemData& data, Int k, Int node) {
    const bool flies = is_pickup(data.pair, node) && data.can(k, 1, data.pair[node].partner);
    return flies ? ways_to_bring * num_drone_rows(data.type, k) + 2 : 1;
}

// Lets a route deliver what it fetches alone in one of these ways; false if it may not. In place.
bool deliver_alone(const ProblemData& data, const Sequence& sequence, Int node, Int way) {
    if (!is_pickup(data.pair, node)) return true;
    const auto& [route, stops, sorties] = sequence;
    const Int delivery = data.pair[node].partner, end = route.length - 1;
    if (way == 0) return insert_stops(sequence, end, {{delivery, customer_stop}});
    const bool fetched = route.sorties > 0;
    if (way == 1) {
        const Int row = fetched ? row_of_drone(data.type, route.type, sorties[0].drone) : 0;
        return fetched && data.visits[row] >= 2 && data.can(row, 1, delivery) &&
               join_sortie(sorties[0], 1, delivery);
    }
    const Int row = drone_row_at(data.type, route.type, (way - 2) / ways_to_bring);
    const Int bringing = (way - 2) % ways_to_bring;
    if (!data.can(row, 1, delivery) || (bringing > 0 && fetched)) return false;
    const auto [launch, recovery] = bringing_flight(bringing, end);
    return add_sortie(sequence, launch, recovery, first_drone(data.type, route.type, row),
                      delivery);
}

// The ways in which a route of a type serves a customer alone, or a shipment, by its pickup.
class WaysAlone {
public:
    WaysAlone(const ProblemData& data, Int k, Int node, bool by_drone)
        : data_(data), k_(k), node_(node), by_drone_(by_drone) {}

    Int number() const { return begun_ * ways_to_deliver(data_, k_, node_); }

    // Writes a route that serves it in one of them; false if that may not be. In place.
    bool serve(const Fleet& fleet, Int slot, Int way) const {
        const Int option = way % begun_;
        const bool halting = option >= flights_;
        const Int place = halting ? (option - flights_) / ways_by_halt : option;
        const Int row = drone_row_at(data_.type, k_, place / (halting ? halts_ : options_));
        if (by_drone_ && !data_.can(row, 1, node_)) return false;
        Int begun = (by_drone_ ? from_start : by_truck) + option % options_, halt = nowhere;
        if (halting) {
            begun = at_halt + (option - flights_) % ways_by_halt;
            halt = data_.near_halts(node_, place % halts_);
            if (halt < 0) return false;
        }
        const Sequence sequence = sequence_in(fleet, slot);
        return begin_route(sequence, data_.type[k_], k_, node_, begun,
                           first_drone(data_.type, k_, row), halt) &&
               deliver_alone(data_, sequence, node_, way / begun_) && refresh(data_, fleet, slot);
    }

private:
    // Whether a drone may fly across an empty trip: a driver may have a break meanwhile.
    static bool may_cross(const VehicleType& type) {
        return type.begins_at != type.ends_at || has_breaks(type);
    }

    const ProblemData& data_;
    const Int k_;
    const Int node_;
    const bool by_drone_;
    const Int options_ = by_drone_ && may_cross(data_.type[k_]) ? ways - from_start : 1;
    const Int halts_ = by_drone_ && has_halts(data_) ? data_.near_halts.shape(1) : 0;
    const Int flights_ = by_drone_ ? options_ * num_drone_rows(data_.type, k_) : 1;
    const Int begun_ = flights_ + ways_by_halt * halts_ * num_drone_rows(data_.type, k_);
};

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

bool serve_alone(const ProblemData& data, const Fleet& fleet, Int slot, Int k, Int node,
                 bool by_drone) {
    if (is_gathered(data.pair, node))
        return serve_parts_alone(data, fleet, slot, k, node, by_drone);
    const WaysAlone all(data, k, node, by_drone);
    double best = infeasible;
    Int chosen = 0, end = far;
    bool done = false;
    // The last time, the best of them is written once more.
    for (Int tried = 0; tried < (all.number() == 1 ? 1 : all.number() + 1); ++tried) {
        const Int way = tried == all.number() ? chosen : tried;
        done = all.serve(fleet, slot, way);
        const bool is_sooner =
            data.fairness.makespan > 0.0 && fleet.cost[slot] == best && fleet.route[slot].end < end;
        if (done && (fleet.cost[slot] < best || is_sooner)) {
            best = fleet.cost[slot];
            end = fleet.route[slot].end;
            chosen = way;
        }
    }
    return done;
}

bool serve_alone_anyhow(const ProblemData& data, const Fleet& fleet, Int slot, Int k, Int node,
                        View<std::uint64_t, 1> rng) {
    if (is_gathered(data.pair, node)) return serve_parts_anyhow(data, fleet, slot, k, node, rng);
    const WaysAlone driven(data, k, node, false), flown(data, k, node, true);
    const Int way = below(rng, driven.number() + flown.number());
    return way < driven.number() ? driven.serve(fleet, slot, way)
                                 : flown.serve(fleet, slot, way - driven.number());
}

double price_move(const ProblemData& data, const Fleet& fleet, const Move& move, Int node,
                  double bar) {
    const Int slot = move.slot, to = fleet.route.size() - 1;
    const Int k = fleet.route[slot].type, kind = move.kind;
    const Int depot = data.type[k].depot;
    const bool whole = is_paired(data.pair, node);
    if (data.evaluation[k].priced || has_driving_rules(data.type[k]) ||
        (is_apart(data, k) && (kind >= new_trip || bounds_reach(data.type[k]))) || whole) {
        copy_part(fleet, slot, {0, fleet.route[slot].length - 1}, to);
        if (!apply(depot, sequence_in(fleet, to), move, node, data.pair) ||
            !refresh_cost(data, fleet, to, bar + fleet.cost[slot])) {
            return infeasible;
        }
        return fleet.cost[to] - fleet.cost[slot];
    }
    const Int there =
        kind == on_sortie ? fleet.sortie(slot, move.sortie).launch : std::max(move.first, Int{0});
    const Trip& trip = fleet.trip(slot, fleet.stop(slot, there).trip);
    const Int release = release_of(data.place[0][node]);
    const bool alone = kind == new_trip || kind == flight_trip || kind == halt_trip;
    const ChangedStops part =
        part_of(data.type[k], fleet, slot, move, !alone && release > trip.release);
    const Int skipped = copy_part(fleet, slot, part, to);
    const Move moved = within(move, part.first, skipped);
    if (!apply(depot, sequence_in(fleet, to), moved, node, data.pair)) return infeasible;
    give_releases(fleet, to, alone, trip, release);
    double cost =
        price_part(data, fleet, slot, part, to) + vehicle_cost_at(data.vehicle_cost, k, node);
    if (kind == at_stop || kind == new_trip || kind == trip_from || kind == trip_until) {
        cost += data.rate[k].stop;
    } else if (uses_halt(move) || kind == halt_trip) {
        cost += data.halt_cost[move.halt];
        if (move.kind == by_halts) cost += data.halt_cost[move.landing];
    }
    return cost;
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

using namespace tandem;

int tandem_price_move(const tandem_problem_data* data, tandem_search* search, int64_t kind,
                      int64_t slot, int64_t first, int64_t last, int64_t node, double* cost) {
    return guarded([&] {
        Move move{};
        move.kind = kind;
        move.slot = slot;
        move.first = first;
        move.last = last;
        move.drone = 1;
        *cost = price_move(data_of(*data), search->now, move, node, infeasible);
    });
}
