#include <utility>

#include "search/insertion/trip_scan.h"
#include "search/moves/exchanges.h"
#include "search/route/refresh.h"

namespace tandem {
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
