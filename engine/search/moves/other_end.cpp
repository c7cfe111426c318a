#include "search/moves/other_end.h"

#include <algorithm>

#include "rules/load.h"
#include "rules/pair.h"
#include "search/insertion/cheapest.h"
#include "search/insertion/trip_scan.h"
#include "search/route/hubs.h"
#include "search/route/rarer.h"
#include "search/route/refresh.h"
#include "search/route/state.h"

namespace tandem {
namespace {

constexpr Int most_timed = 16;  // places of the end
constexpr Int by_wheels = -1;   // instead of a row of drones

// Where an end may be served: by truck behind stop `first`, or by a drone of a row from `first` to
// `last`.
struct OtherPlace {
    double cost;
    Int row, first, last;

    bool operator<(const OtherPlace& other) const { return cost < other.cost; }
};

// Whether drones may serve an end of a shipment by vehicles of a type.
bool flies_some_end(const ProblemData& data, Int k, Int node) {
    return is_paired(data.pair, node) && !is_gathered(data.pair, node) &&
           (data.can(k, 1, node) || data.can(k, 1, data.pair[node].partner));
}

bool launches_or_recovers(const Fleet& fleet, Int slot, Int p) {
    const View<const Sortie, 1> sorties = fleet.sortie[slot].first(fleet.route[slot].sorties);
    return std::any_of(sorties.begin(), sorties.end(), [&](const Sortie& sortie) {
        return sortie.launch == p || sortie.recovery == p;
    });
}

// Takes out a stop where no drone is launched or recovered. In place.
void take_out_stop(const Fleet& fleet, Int slot, Int p) {
    Route& route = fleet.route[slot];
    const View<Stop, 1> stops = fleet.stop[slot];
    --fleet.trip(slot, stops[p].trip).last;
    std::copy(&stops[p + 1], &stops[0] + route.length, &stops[p]);
    --route.length;
    for (Sortie& sortie : fleet.sortie[slot].first(route.sorties)) {
        if (sortie.launch > p) --sortie.launch;
        if (sortie.recovery > p) --sortie.recovery;
    }
}

// Takes a customer out of a sortie, and the sortie if it serves nobody else. In place.
void take_out_visit(const Fleet& fleet, Int slot, Int index, Int node) {
    Route& route = fleet.route[slot];
    const View<Sortie, 1> sorties = fleet.sortie[slot].first(route.sorties);
    Sortie& sortie = sorties[index];
    sortie.count = std::remove(sortie.nodes, sortie.nodes + sortie.count, node) - sortie.nodes;
    if (sortie.count > 0) return;
    std::copy(&sorties[index] + 1, sorties.end(), &sorties[index]);
    --route.sorties;
}

// The places of an end, taken out, on the trip of the other.
class OtherEnd : TripScan {
public:
    OtherEnd(const Insertion& insertion, Int of_slot, const Trip& tried)
        : TripScan(insertion, of_slot, tried), comes_first_(is_pickup(data.pair, node)) {
        note_partner();
    }

    // Finds the cheapest of the places that look so. In place.
    void find(const OtherPlace& but) {
        Cheapest<OtherPlace, most_timed> places;
        const auto add = [&](const OtherPlace& place) {
            if (place.row != but.row || place.first != but.first || place.last != but.last) {
                places.add(place);
            }
        };
        drive(add);
        fly(add);
        places.sort();
        for (const OtherPlace& place : places.items()) {
            if (data.deadline.passed()) return;
            price(place);
        }
    }

private:
    // Notes from when to when the shipment is aboard at the other end, in half stops. In place.
    void note_partner() {
        const Int partner = data.pair[node].partner;
        for (Int p = trip.first; p <= trip.last; ++p) {
            if (stops[p].kind == customer_stop && stops[p].node == partner) other_ = 2 * p;
        }
        for (const Sortie& sortie : fleet.sortie[slot].first(route.sorties)) {
            const Int* end = sortie.nodes + sortie.count;
            if (std::find(sortie.nodes + 0, end, partner) == end) continue;
            other_ = 2 * (comes_first_ ? sortie.launch : sortie.recovery);
        }
    }

    // Whether the end may be served so that the shipment is aboard from when, or until when.
    bool is_in_order(Int aboard, Int leaves) const {
        return comes_first_ ? aboard < other_ : other_ < leaves;
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

    void price(const OtherPlace& place) {
        const bool flies = place.row >= 0;
        Move move = move_of(flies ? by_sortie : at_stop, place.first, place.last);
        if (flies) {
            move.drone =
                free_drone(data, fleet, slot, {2 * place.first, 2 * place.last}, place.row);
            if (move.drone < 0) return;
        }
        best.try_move(price_move(data, fleet, move, node, best.cost), move);
    }

    const bool comes_first_;
    Int other_ = 0;
};

}  // namespace

bool may_fly_shipments(const ProblemData& data) {
    if (!some_paired(data.pair) || !(data.strategy.loops || data.strategy.crossings)) return false;
    for (Int k = 0; k < data.num_types; ++k) {
        for (Int node = data.num_depots; node < data.num_nodes; ++node) {
            if (flies_some_end(data, k, node)) return true;
        }
    }
    return false;
}

bool move_end(const ProblemData& data, const Searcher& searcher, double rise) {
    const Fleet& now = searcher.now;
    const Int node = draw_customer(data, now, searcher.count->focus, searcher.rng);
    const Place place = now.where[node];
    if (place.slot < 0 || !flies_some_end(data, now.route[place.slot].type, node)) return false;
    const Int slot = place.slot, p = stop_beside(now, node);
    const Trip& trip = now.trip(slot, now.stop(slot, p).trip);
    OtherPlace former{0.0, by_wheels, p - 1, p - 1};
    if (place.position >= 0) {
        if (launches_or_recovers(now, slot, p)) return false;
        touch(searcher, slot);
        take_out_stop(now, slot, p);
    } else {
        const Sortie& sortie = now.sortie(slot, place.sortie);
        if (sortie.count == 1) {
            const Int row = row_of_drone(data.type, now.route[slot].type, sortie.drone);
            former = {0.0, row, sortie.launch, sortie.recovery};
        }
        touch(searcher, slot);
        take_out_visit(now, slot, place.sortie, node);
    }
    Best best{data.strategy.blink, searcher.rng};
    OtherEnd({data, searcher, node, false, best}, slot, trip).find(former);
    if (best.cost >= rise) return false;
    apply(data.type[now.route[slot].type].depot, sequence_in(now, slot), best.move, node,
          data.pair);
    const bool allowed = refresh(data, now, slot);
    locate(now, slot);
    return allowed && hubs_suffice(data, searcher);
}

}  // namespace tandem
