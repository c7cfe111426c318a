#include "search/insertion/flown_pairs.h"

#include <algorithm>

#include "rules/drone_types.h"
#include "rules/flight.h"
#include "rules/launch_place.h"
#include "rules/load.h"
#include "rules/pair.h"
#include "rules/shift.h"
#include "search/insertion/cheapest.h"
#include "search/insertion/newcomer.h"
#include "search/insertion/offers.h"
#include "search/route/drone_data.h"
#include "search/route/rarer.h"
#include "search/route/refresh.h"
#include "search/route/routes.h"
#include "search/route/vehicles.h"
#include "search/scratch.h"

namespace tandem {
namespace {

constexpr Int most_places = 96;  // of an end on a trip
constexpr Int most_priced = 64;  // of pairs of them
constexpr Int by_wheels = -1;    // instead of a row of drones
constexpr Int by_same = -2;      // likewise, of a delivery by the sortie that fetches

// Where an end is served: by truck behind stop `first`, or by a drone of a row from `first` to
// `last`.
struct EndPlace {
    double cost;
    Int row, first, last;

    // From where on a pickup is aboard, and where a delivery leaves, in half stops.
    Int aboard() const { return row == by_wheels ? 2 * first + 1 : 2 * last; }
    Int leaves() const { return row == by_wheels ? 2 * first + 1 : 2 * first; }

    bool operator<(const EndPlace& other) const { return cost < other.cost; }
};

// Where both ends are served.
struct PairPlace {
    double cost;
    EndPlace pickup, delivery;

    bool operator<(const PairPlace& other) const { return cost < other.cost; }
};

using EndPlaces = Cheapest<EndPlace, most_places>;

class FlownPairScan {
public:
    FlownPairScan(const Insertion& insertion, Int slot, const Trip& trip)
        : data_(insertion.data),
          fleet_(insertion.searcher.now),
          best_(insertion.best),
          slot_(slot),
          trip_(trip),
          route_(fleet_.route[slot]),
          stops_(fleet_.stop[slot]),
          type_(data_.type[route_.type]),
          rate_(data_.rate[route_.type]),
          pickup_(insertion.node),
          delivery_(data_.pair[pickup_].partner),
          fits_(insertion.searcher.scratch->fits) {}

    void scan() {
        EndPlaces pickups, deliveries;
        const bool fetches = fly(pickup_, pickups), brings = fly(delivery_, deliveries);
        if (brings) drive(pickup_, pickups);
        if (fetches) drive(delivery_, deliveries);
        if (fetches && brings) fly_both();
        for (const EndPlace& pickup : pickups.items()) {
            for (const EndPlace& delivery : deliveries.items()) join(pickup, delivery);
        }
        pairs_.sort();
        for (const PairPlace& place : pairs_.items()) {
            if (is_dear(place.cost) || data_.deadline.passed()) return;
            price(place);
        }
    }

private:
    // Whether an insertion that costs at least so much may be passed over.
    bool is_dear(double least) const { return data_.strategy.give_up_early && least >= best_.cost; }

    // Lists where the truck may serve an end. In place.
    void drive(Int node, EndPlaces& places) const {
        if (!allows_stops(type_, stops_on(trip_) + 1)) return;
        const Newcomer newcomer = newcomer_for(data_, type_, node);
        for (Int p = trip_.first; p < trip_.last; ++p) {
            const Stop& here = stops_[p];
            const auto [out, on, distance] =
                newcomer.detour(here.node, stops_[p + 1].node, here.leg);
            const double cost = double(distance) * rate_.distance + rate_.stop;
            if (is_dear(cost) || newcomer.place.too_late(here.leave + out.duration)) continue;
            places.add({cost, by_wheels, p, p});
        }
    }

    // Lists where drones may serve an end; false if nowhere. In place.
    bool fly(Int node, EndPlaces& places) const {
        if (!data_.can(route_.type, 1, node) ||
            !may_launch(type_, route_, fleet_.sortie[slot_], trip_)) {
            return false;
        }
        for_each_row(node, node, [&](Int row) { fly_by(row, node, places); });
        return !places.items().empty();
    }

    void fly_by(Int row, Int node, EndPlaces& places) const {
        const Windows place = data_.place.by_air(data_.type[row])[node];
        const auto note = [&](const Flown& flown) {
            const Flight flight{data_.type[row], place, flown.out, flown.home};
            if (flight.can_serve()) places.add({flown.cost, row, flown.launch, flown.recovery});
        };
        for_each_flight(row, node, node, 0, note);
    }

    // Lists sorties that serve both ends. In place.
    void fly_both() {
        for_each_row(pickup_, delivery_, [&](Int row) {
            if (data_.visits[row] < 2) return;
            const TravelLegs legs = legs_of(data_.leg, data_.type[row].drone_travel);
            const Int between = leg(legs, pickup_, delivery_).distance;
            for_each_flight(row, pickup_, delivery_, between, [&](const Flown& flown) {
                const EndPlace pickup{flown.cost, row, flown.launch, flown.recovery};
                pairs_.add({flown.cost, pickup, {0.0, by_same, 0, 0}});
            });
        });
    }

    // Calls `visit` with each row of drones that may serve two customers and has a battery.
    template <class Visit>
    void for_each_row(Int first, Int last, const Visit& visit) const {
        for (Int row = first_drone_row(data_.type, route_.type); row >= 0;
             row = next_drone_row(data_.type, row)) {
            if (data_.can(row, 1, first) && data_.can(row, 1, last) &&
                has_battery(data_.type, route_, fleet_.sortie[slot_], trip_, row)) {
                visit(row);
            }
        }
    }

    // From which stop to which a drone flies, how long its first and last leg take, and what it
    // costs.
    struct Flown {
        Int launch, recovery, out, home;
        double cost;
    };

    // Calls `visit` with each flight of a row that serves one customer first and one last,
    // `between` whom it is so far, from stops where it may be launched to where it may be
    // recovered.
    template <class Visit>
    void for_each_flight(Int row, Int first, Int last, Int between, const Visit& visit) const {
        const VehicleType& drone = data_.type[row];
        const Rate& rate = data_.rate[row];
        const LegRow inward = legs_to(data_.back, drone.drone_travel, first);
        const LegRow onward = legs_from(data_.leg, drone.home_travel, last);
        const bool crosses = data_.strategy.crossings && !waits_for_drones(type_);
        for (Int launch = trip_.first; launch <= trip_.last; ++launch) {
            const Leg out = leg_from(inward, stops_[launch].node);
            const Int far_out = out.distance + between;
            if (is_dear(flown_cost(rate, far_out)) ||
                !may_meet(drone, stops_[launch].node, first)) {
                continue;
            }
            const Int latest = crosses ? std::min(trip_.last, launch + max_span) : launch;
            for (Int recovery = data_.strategy.loops ? launch : launch + 1; recovery <= latest;
                 ++recovery) {
                const Leg home = leg_to(onward, stops_[recovery].node);
                const double cost = flown_cost(rate, far_out + home.distance);
                if (!is_dear(cost) && may_meet(drone, stops_[recovery].node, last)) {
                    visit({launch, recovery, out.duration, home.duration, cost});
                }
            }
        }
    }

    // Whether drones of a type that serve a customer may be launched or recovered at a node.
    bool may_meet(const VehicleType& drone, Int here, Int customer) const {
        return is_launch_place(data_.no_launch, here) && in_range(data_, drone, here, customer);
    }

    // Lists a shipment at two places if the truck holds it between, and a drone flies one. In
    // place.
    void join(const EndPlace& pickup, const EndPlace& delivery) {
        const double cost = pickup.cost + delivery.cost;
        if ((pickup.row == by_wheels && delivery.row == by_wheels) ||
            pickup.aboard() >= delivery.leaves() || is_dear(cost)) {
            return;
        }
        const Int first = pickup.aboard() / 2, behind = (delivery.leaves() + 1) / 2;
        if (std::all_of(&fits_[first], &fits_[first] + (behind - first),
                        [](bool fits) { return fits; })) {
            pairs_.add({cost, pickup, delivery});
        }
    }

    Int drone_for(const EndPlace& place) const {
        if (place.row < 0) return nowhere;
        return free_drone(data_, fleet_, slot_, {2 * place.first, 2 * place.last}, place.row);
    }

    void price(const PairPlace& place) {
        const auto& [cost, pickup, delivery] = place;
        Move move{};
        move.slot = slot_;
        move.type = route_.type;
        const Int fetching = drone_for(pickup), bringing = drone_for(delivery);
        if ((pickup.row != by_wheels && fetching < 0) || (delivery.row >= 0 && bringing < 0)) {
            return;
        }
        move.first = pickup.first;
        if (pickup.row == by_wheels) {
            move.kind = by_truck_and_drone;
            move.last = delivery.first;
            move.landing = delivery.last;
            move.drone = bringing;
        } else if (delivery.row == by_same) {
            move.kind = on_one_flight;
            move.last = pickup.last;
            move.drone = fetching;
        } else if (delivery.row == by_wheels) {
            move.kind = by_drone_and_truck;
            move.last = delivery.first;
            move.landing = pickup.last;
            move.drone = fetching;
        } else {
            move.kind = by_drones;
            move.last = pickup.last;
            move.halt = delivery.first;
            move.landing = delivery.last;
            move.drone = fetching;
            move.sortie = bringing;
        }
        if (best_.takes(price_move(data_, fleet_, move, pickup_))) best_.move = move;
    }

    const ProblemData& data_;
    const Fleet& fleet_;
    Best& best_;
    const Int slot_;
    const Trip& trip_;
    const Route& route_;
    const View<const Stop, 1> stops_;
    const VehicleType& type_;
    const Rate& rate_;
    const Int pickup_;
    const Int delivery_;
    const View<bool, 1> fits_;
    Cheapest<PairPlace, most_priced> pairs_;
};

}  // namespace

void scan_flown(const Insertion& insertion, Int slot, const Trip& trip) {
    const ProblemData& data = insertion.data;
    const Int k = insertion.searcher.now.route[slot].type;
    if (data.can(k, 1, insertion.node) || data.can(k, 1, data.pair[insertion.node].partner)) {
        FlownPairScan(insertion, slot, trip).scan();
    }
}

}  // namespace tandem
