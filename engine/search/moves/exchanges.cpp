#include "search/moves/exchanges.h"

#include <utility>

#include "search/insertion/trip_scan.h"
#include "search/route/refresh.h"
#include "search/route/stop_loads.h"

namespace tandem {
namespace {

constexpr double least_saving = 1e-9;  // by less, nothing is cheaper

// Swap vehicles with another route where that is cheaper. In place.
void trade(const ProblemData& data, Searcher& searcher, Int slot) {
    Fleet& now = searcher.now;
    for (Int other : searcher.active.first(searcher.count->active)) {
        const Int k = now.route[slot].type;
        const Int by = now.route[other].type;
        if (by == k || !data.swap(k, by)) continue;
        const double cost = route_cost(data, by, haul_of(now.trip(slot, 0))) +
                            route_cost(data, k, haul_of(now.trip(other, 0)));
        if (cost < now.cost[slot] + now.cost[other] - least_saving &&
            can_take(data, now, slot, by) && can_take(data, now, other, k)) {
            touch(searcher, other);
            change_type(data, now, slot, by);
            change_type(data, now, other, k);
        }
    }
}

// Tell whether the drones of type `k` may fly a sortie of a truck.
bool may_fly(const ProblemData& data, Int k, const Sortie& sortie) {
    const Int row = row_of_drone(data.type, k, sortie.drone);
    if (sortie.drone >= data.type[k].drones || sortie.count > data.visits[row] ||
        !can_carry(data, row, sortie, nowhere, nowhere)) {
        return false;
    }
    for (const Int node : sortie.customers()) {
        if (!data.can(row, 1, node)) return false;
    }
    return true;
}

// Tell whether type `k` has the places, trips, drones and skills that a route needs.
bool may_drive(const ProblemData& data, const Fleet& fleet, Int slot, Int k) {
    const Route& route = fleet.route[slot];
    const VehicleType& former = data.type[route.type];
    const VehicleType& type = data.type[k];
    if (type.begins_at != former.begins_at || type.ends_at != former.ends_at ||
        route.trips > type.max_trips || (route.trips > 1 && type.depot != former.depot)) {
        return false;
    }
    for (const Stop& stop : stops_of(fleet, slot)) {
        if (stop.kind == customer_stop && !data.can(k, 0, stop.node)) return false;
        if (stop.kind == halt_stop && !may_halt(data.halts, k, stop.node)) return false;
    }
    for (const Sortie& sortie : sorties_of(fleet, slot)) {
        if (!may_fly(data, k, sortie)) return false;
    }
    return true;
}

// Let another type drive a touched route, if that keeps all rules. In place.
//
// `cheaper`: and only if it costs less.
void give_type(const ProblemData& data, Searcher& searcher, Int slot, Int k, bool cheaper) {
    Fleet& now = searcher.now;
    const Int former = now.route[slot].type;
    const double cost = now.cost[slot];
    if (k == former || data.swap(former, k) || !is_left(data, now, k) ||
        !may_drive(data, now, slot, k)) {
        return;
    }
    const Int spare = now.route.size() - 2;
    set_aside(data, now, slot, spare);
    now.route[slot].type = k;
    if (refresh(data, now, slot) && !(cheaper && now.cost[slot] >= cost - least_saving)) {
        --now.used[former];
        ++now.used[k];
    } else {
        put_back(data, now, slot, spare);
    }
}

}  // namespace

void improve_types(const ProblemData& data, Searcher& searcher) {
    Fleet& now = searcher.now;
    // Trading touches others, which get the cheapest vehicles in their turn.
    for (Int index = 0; index < searcher.count->touched; ++index) {
        const Int slot = searcher.touched[index];
        const Route& route = now.route[slot];
        if (route.length == 0 || !data.evaluation[route.type].by_distance) continue;
        const Haul haul = haul_of(now.trip(slot, 0));
        for (Int k = 0; k < data.num_types; ++k) {
            if (data.swap(route.type, k) && is_left(data, now, k) &&
                route_cost(data, k, haul) < now.cost[slot] - least_saving &&
                can_take(data, now, slot, k)) {
                change_type(data, now, slot, k);
            }
        }
        trade(data, searcher, slot);
    }
}

void draw_type(const ProblemData& data, Searcher& searcher) {
    const Int slot = searcher.touched[below(searcher.rng, searcher.count->touched)];
    if (searcher.now.route[slot].length > 0) {
        give_type(data, searcher, slot, below(searcher.rng, data.num_types), false);
    }
}

void cheapen_types(const ProblemData& data, Searcher& searcher) {
    for (Int slot : searcher.touched.first(searcher.count->touched)) {
        if (searcher.now.route[slot].length == 0) continue;
        for (Int k = 0; k < data.num_types; ++k) {
            if (data.deadline.passed()) return;
            give_type(data, searcher, slot, k, true);
        }
    }
}

namespace {

constexpr Int most_timed = 16;  // places of the end

// Lets drones be launched and recovered at one stop instead of another beside it. In place.
void shift_flights(const Fleet& fleet, Int slot, Int from, Int to) {
    const View<Sortie, 1> sorties = sorties_of(fleet, slot);
    for (Sortie& sortie : sorties) {
        if (sortie.launch == from) sortie.launch = to;
        if (sortie.recovery == from) sortie.recovery = to;
    }
    // Few, and mostly in order; as they were where they begin and end alike.
    for (Int last = 1; last < sorties.size(); ++last) {
        for (Int s = last; s > 0 && std::pair(sorties[s].launch, sorties[s].recovery) <
                                        std::pair(sorties[s - 1].launch, sorties[s - 1].recovery);
             --s) {
            std::swap(sorties[s], sorties[s - 1]);
        }
    }
}

// Takes an end out of a route, where no drone is launched or recovered. In place.
//
// What is known of the trip's stops, but for times, stays so.
void take_out(const Searcher& searcher, Int slot, Trip& trip, Int node) {
    const Sequence sequence = sequence_in(searcher.now, slot);
    const View<Int, 1> moved = searcher.scratch->moved;
    searcher.marked[node] = true;
    drop_visits(sequence, searcher.marked);
    close_ranks(sequence, searcher.marked, moved);
    searcher.marked[node] = false;
    trip.first = moved[trip.first];
    trip.last = moved[trip.last];
}

// The places of an end, taken out, on the trip of the other.
class OtherEnd : TripScan {
public:
    OtherEnd(const Insertion& insertion, Int of_slot, const Trip& tried)
        : TripScan(insertion, of_slot, tried), comes_first_(is_pickup(data.pair, node)) {
        note_others();
    }

    // Finds the cheapest of the places that look so. In place.
    void find(const EndPlace& but) {
        Cheapest<EndPlace, most_timed> places;
        const auto add = [&](const EndPlace& place) {
            if (place.row != but.row || place.first != but.first || place.last != but.last) {
                places.add(place);
            }
        };
        drive(add);
        fly(add);
        places.sort();
        for (const EndPlace& place : places.items()) {
            if (data.deadline.passed()) return;
            price(place);
        }
    }

private:
    // Notes until when the shipment is aboard by the other end, or from when by the others, in half
    // stops: until before the stop where the truck delivers it. In place.
    void note_others() {
        const auto is_other = [&](Int there) {
            return comes_first_ ? there == data.pair[node].partner
                                : is_paired(data.pair, there) && brings(data.pair, there, node);
        };
        for (Int p = trip.first; p <= trip.last; ++p) {
            if (stops[p].kind == customer_stop && is_other(stops[p].node)) {
                other_ = 2 * p - (comes_first_ ? 1 : 0);
            }
        }
        for (const Sortie& sortie : fleet.sortie[slot].first(route.sorties)) {
            if (!std::any_of(sortie.nodes, sortie.nodes + sortie.count, is_other)) continue;
            other_ = std::max(other_, 2 * (comes_first_ ? sortie.launch : sortie.recovery));
        }
    }

    // Whether the end may be served so that the shipment is aboard from when, or until when.
    bool is_in_order(Int aboard, Int leaves) const {
        return comes_first_ ? aboard <= other_ : other_ <= leaves;
    }

    template <class Add>
    void drive(const Add& add) const {
        if (!data.can(route.type, 0, node) || !allows_stops(type, stops_on(trip) + 1)) return;
        const Newcomer driven = newcomer(node);
        const TravelLegs legs = legs_of(data.leg, type.travel);
        for (Int p = trip.first; p < trip.last; ++p) {
            if (!is_in_order(2 * p + 1, 2 * p + 1)) continue;
            const Int here = stops[p].node, behind = stops[p + 1].node;
            const Int apart = leg(legs, here, behind).distance;
            const double detour = double(driven.further(here, behind, apart));
            add({detour * rate.distance + rate.stop, by_wheels, p, p});
        }
    }

    template <class Add>
    void fly(const Add& add) const {
        for_each_single_flight(node, [&](Int row, const Flown& flown) {
            if (is_in_order(2 * flown.recovery, 2 * flown.launch)) {
                add({flown.cost, row, flown.launch, flown.recovery});
            }
        });
    }

    void price(const EndPlace& place) {
        const bool flies = place.row >= 0;
        Move move{};
        if (flies) {
            const Int drone = drone_for(place);
            if (drone < 0) return;
            move_between(move, place.first, place.last)
                .add(How::fly, node, place.first, place.last, drone);
        } else {
            move_between(move, place.first, place.first + 1).add(How::serve, node, place.first + 1);
        }
        best.try_move(price_move(data, fleet, move, node, best.cost), move);
    }

    const bool comes_first_;
    Int other_ = 0;  // where it leaves, or all is aboard
};

}  // namespace

bool move_end(const ProblemData& data, const Searcher& searcher, double rise) {
    const Fleet& now = searcher.now;
    const Int node = draw_customer(data, now, searcher.count->focus, searcher.rng);
    const Place place = now.where[node];
    if (place.slot < 0 || !is_paired(data.pair, node) ||
        !flies_some_end(data, now.route[place.slot].type, node)) {
        return false;
    }
    const Int slot = place.slot, p = stop_beside(now, node);
    Trip& trip = now.trip(slot, now.stop(slot, p).trip);
    EndPlace former{0.0, by_wheels, p - 1, p - 1};
    if (place.position < 0) {
        const Sortie& sortie = now.sortie(slot, place.sortie);
        if (sortie.count == 1) {
            const Int row = row_of_drone(data.type, now.route[slot].type, sortie.drone);
            former = {0.0, row, sortie.launch, sortie.recovery};
        }
    }
    touch(searcher, slot);
    const bool drives = place.position >= 0;
    if (drives) shift_flights(now, slot, p, below(searcher.rng, 2) == 0 ? p - 1 : p + 1);
    take_out(searcher, slot, trip, node);
    Best best{data.strategy.blink, searcher.rng};
    OtherEnd({data, searcher, node, false, best}, slot, trip).find(former);
    if (best.cost >= rise) return false;
    const bool allowed = apply(sequence_in(now, slot), best.move) && refresh(data, now, slot);
    locate(now, slot);
    return allowed;
}

}  // namespace tandem
