#include "search/insertion/shipments.h"
#include "search/insertion/trip_scan.h"
#include "search/route/refresh.h"

namespace tandem {
namespace {

constexpr Int most_places = 96;  // of an end on a trip
constexpr Int most_priced = 64;  // of pairs of them

// Where both ends are served.
struct FlownPairPlace {
    double cost;
    EndPlace pickup, delivery;

    bool operator<(const FlownPairPlace& other) const { return cost < other.cost; }
};

using EndPlaces = Cheapest<EndPlace, most_places>;

class FlownPairScan : TripScan {
public:
    FlownPairScan(const Insertion& insertion, Int of_slot, const Trip& tried)
        : TripScan(insertion, of_slot, tried), delivery_(data.pair[node].partner) {}

    void scan() {
        EndPlaces pickups, deliveries;
        const bool fetches = add_flown(node, pickups), brings = add_flown(delivery_, deliveries);
        if (brings) add_driven(node, pickups);
        if (fetches) add_driven(delivery_, deliveries);
        if (fetches && brings) fly_both();
        fly_on();
        for (const EndPlace& pickup : pickups.items()) {
            for (const EndPlace& delivery : deliveries.items()) join(pickup, delivery);
        }
        pairs_.sort();
        for (const FlownPairPlace& place : pairs_.items()) {
            if (is_dear(place.cost) || data.deadline.passed()) return;
            price(place);
        }
    }

private:
    // Lists sorties that serve both ends. In place.
    void fly_both() {
        for_each_row(node, delivery_, [&](Int row) {
            if (data.visits[row] < 2) return;
            const TravelLegs legs = legs_of(data.leg, data.type[row].drone_travel);
            const Int between = leg(legs, node, delivery_).distance;
            for_each_flight(row, node, delivery_, between, [&](const Flown& flown) {
                const EndPlace pickup{flown.cost, row, flown.launch, flown.recovery};
                pairs_.add({flown.cost, pickup, {0.0, by_same, 0, 0}});
            });
        });
    }

    // Lists sorties that deliver from the stop where the truck picks up. In place.
    void fly_on() {
        for_each_flight_on(node, delivery_, [&](const EndPlace& pickup, EndPlace delivery) {
            delivery.from = 0;
            pairs_.add({pickup.cost + delivery.cost, pickup, delivery});
        });
    }

    // Lists a shipment at two places if the truck holds it between, and a drone flies one. In
    // place.
    void join(const EndPlace& pickup, const EndPlace& delivery) {
        const double cost = pickup.cost + delivery.cost;
        if ((pickup.row == by_wheels && delivery.row == by_wheels) ||
            pickup.aboard() > delivery.leaves() || is_dear(cost)) {
            return;
        }
        const Int first = pickup.aboard() / 2, behind = (delivery.leaves() + 1) / 2;
        for (Int p = first; p < behind; ++p) {
            if (!fits(p)) return;
        }
        pairs_.add({cost, pickup, delivery});
    }

    // Whether others are flown to from and to the same stops.
    bool flies_beside(const EndPlace& place) const {
        const View<const Sortie, 1> sorties = fleet.sortie[slot].first(route.sorties);
        return std::ranges::any_of(sorties, [&](const Sortie& sortie) {
            return sortie.launch == place.first && sortie.recovery == place.last;
        });
    }

    void price(const FlownPairPlace& place) {
        const auto& [cost, pickup, delivery] = place;
        const bool fetches = pickup.is_flown(), brings = delivery.is_flown();
        const Int fetching = fetches ? drone_for(pickup) : 0;
        const Int bringing = brings ? drone_for(delivery) : 0;
        if (fetching < 0 || bringing < 0) return;
        const Int driven = fetches ? 0 : 1;
        Move move{};
        move_between(move, pickup.first, std::max(pickup.last, delivery.last));
        if (!fetches) move.add(How::serve, node, pickup.first + 1);
        if (delivery.row == by_wheels) move.add(How::serve, delivery_, delivery.first + 1);
        if (fetches) move.add(How::fly, node, pickup.first, pickup.last, fetching);
        if (delivery.row == by_same) move.add(How::ride, delivery_, node);
        const bool relays = fetches && brings && pickup.last == delivery.first;
        if (brings) {
            // What is brought from elsewhere is aboard no longer than it need be.
            const How how = relays || delivery.flies_on() ? How::fly : How::fly_first;
            move.add(how, delivery_, delivery.first + driven, delivery.last + driven, bringing);
        }
        best.try_move(price_move(data, fleet, move, node, best.cost), move);
        if (!brings || relays || delivery.flies_on() || !flies_beside(delivery)) return;
        move.placement[std::size_t(move.count - 1)].how = How::fly;
        best.try_move(price_move(data, fleet, move, node, best.cost), move);
    }

    const Int delivery_;
    Cheapest<FlownPairPlace, most_priced> pairs_;
};

}  // namespace

void scan_flown(const Insertion& insertion, Int slot, const Trip& trip) {
    const ProblemData& data = insertion.data;
    const Int k = insertion.searcher.now.route[slot].type;
    if (flies_some_end(data, k, insertion.node)) {
        FlownPairScan(insertion, slot, trip).scan();
    }
}

}  // namespace tandem
