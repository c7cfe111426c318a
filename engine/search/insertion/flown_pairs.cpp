#include <utility>

#include "search/insertion/shipments.h"
#include "search/insertion/trip_scan.h"
#include "search/route/refresh.h"

namespace tandem {
namespace {

constexpr Int most_end_places = 96;   // of an end on a trip
constexpr Int fewer_end_places = 24;  // likewise, of several pickups
constexpr Int most_combined = 64;  // of the cheapest of each pickup with one place of the delivery
constexpr Int most_combinations = 64;  // of all combinations
constexpr Int most_ends = most_pickups + 1;

using PartPlaces = Cheapest<EndPlace, most_end_places>;

// Which of the places of each pickup in turn is chosen, then which of the delivery.
using Choice = std::array<std::uint8_t, most_ends>;

struct Combination {
    double cost;
    Choice choice;

    bool operator<(const Combination& other) const { return cost < other.cost; }
};

class FlownScan : TripScan {
public:
    FlownScan(const Insertion& insertion, Int of_slot, const Trip& tried)
        : TripScan(insertion, of_slot, tried),
          pickups_(pickups_of(data.pair, node)),
          delivery_(data.pair[node].partner) {
        for (Int end = 0; end <= pickups_.count && pickups_.count > 1; ++end) {
            places(end) = PartPlaces(fewer_end_places);
        }
    }

    void scan() {
        bool flies = false;
        for (Int end = 0; end <= pickups_.count; ++end) {
            flies = add_flown(end_node(end), places(end)) || flies;
            add_driven(end_node(end), places(end));
        }
        PartPlaces& deliveries = places(pickups_.count);
        for (Int end = 0; end < pickups_.count; ++end) {
            for_each_flight_on(end_node(end), delivery_, [&](const EndPlace&, EndPlace delivery) {
                delivery.from = end;
                deliveries.add(delivery);
                flies = true;
            });
        }
        if (!flies) return;
        if (pickups_.count == 1) fly_both();
        for (Int end = 0; end <= pickups_.count; ++end) places(end).sort();
        for (Int last = 0; last < places(pickups_.count).items().size(); ++last) combine(last);
        combined_.sort();
        for (const Combination& each : combined_.items()) {
            if (is_dear(each.cost) || data.deadline.passed()) return;
            price(each.choice);
        }
    }

private:
    Int end_node(Int end) const {
        return end == pickups_.count ? delivery_ : pickups_.node[std::size_t(end)];
    }

    PartPlaces& places(Int end) { return places_[std::size_t(end)]; }

    const EndPlace& place_of(Int end, const Choice& choice) {
        return places(end).items()[choice[std::size_t(end)]];
    }

    // Tries sorties that serve both ends, the cheapest first. In place.
    void fly_both() {
        PartPlaces flights;
        for_each_row(node, delivery_, [&](Int row) {
            if (data.visits[row] < 2) return;
            const TravelLegs legs = legs_of(data.leg, data.type[row].drone_travel);
            const Int between = leg(legs, node, delivery_).distance;
            for_each_flight(row, node, delivery_, between, [&](const Flown& flown) {
                flights.add({flown.cost, row, flown.launch, flown.recovery});
            });
        });
        flights.sort();
        for (const EndPlace& flight : flights.items()) {
            if (is_dear(flight.cost) || data.deadline.passed()) return;
            const Int drone = drone_for(flight);
            if (drone < 0) continue;
            Move move{};
            move_between(move, flight.first, flight.last)
                .add(How::fly, node, flight.first, flight.last, drone);
            move.add(How::ride, delivery_, node);
            best.try_move(price_move(data, fleet, move, node, best.cost), move);
        }
    }

    // Combines the pickups' places with one of the delivery: the cheapest of each that are aboard
    // before it leaves, or those but for one pickup. In place.
    void combine(Int last) {
        Choice least{};
        least[std::size_t(pickups_.count)] = std::uint8_t(last);
        for (Int end = 0; end < pickups_.count; ++end) {
            const Int place = next_place(end, 0, least);
            if (place < 0) return;
            least[std::size_t(end)] = std::uint8_t(place);
        }
        if (pickups_.count == 1) {
            add(least);
        } else {
            add_all(0, least, least);
        }
        for (Int end = 0; end < pickups_.count; ++end) {
            Choice choice = least;
            for (Int place = least[std::size_t(end)] + 1;
                 (place = next_place(end, place, choice)) >= 0; ++place) {
                choice[std::size_t(end)] = std::uint8_t(place);
                add(choice);
            }
        }
    }

    // The next place of a pickup, from one on, where it is aboard before the delivery leaves.
    Int next_place(Int end, Int from, const Choice& choice) {
        const EndPlace& delivery = place_of(pickups_.count, choice);
        const View<const EndPlace, 1> items = places(end).items();
        for (Int place = from; place < items.size(); ++place) {
            const EndPlace& pickup = items[place];
            const bool is_last = delivery.from == end;
            if (is_last ? !pickup.is_flown() && pickup.aboard() == delivery.leaves()
                        : pickup.aboard() <= delivery.leaves()) {
                return place;
            }
        }
        return nowhere;
    }

    // Adds all combinations of the few cheapest places of the pickups from one on. In place.
    void add_all(Int end, Choice choice, const Choice& least) {
        if (end == pickups_.count) {
            add(choice);
            return;
        }
        Int each = 1;
        for (Int combined = 1; combined <= most_combined; ++each) {
            combined = 1;
            for (Int other = 0; other < pickups_.count; ++other) combined *= each + 1;
        }
        Int place = least[std::size_t(end)];
        for (Int tried = 0; tried + 1 < each && place >= 0; ++tried) {
            choice[std::size_t(end)] = std::uint8_t(place);
            add_all(end + 1, choice, least);
            place = next_place(end, place + 1, choice);
        }
    }

    // Adds a combination if drones serve some end, and the truck holds what comes first. In place.
    void add(const Choice& choice) {
        double cost = 0.0;
        bool flies = false;
        for (Int end = 0; end <= pickups_.count; ++end) {
            cost += place_of(end, choice).cost;
            flies = flies || place_of(end, choice).is_flown();
        }
        if (!flies || is_dear(cost)) return;
        const Int first = place_of(0, choice).aboard() / 2;
        const Int behind = (place_of(pickups_.count, choice).leaves() + 1) / 2;
        for (Int p = first; p < behind; ++p) {
            if (!fits(p)) return;
        }
        combined_.add({cost, choice});
    }

    // Whether others are flown to from and to the same stops.
    bool flies_beside(const EndPlace& place) const {
        const View<const Sortie, 1> sorties = fleet.sortie[slot].first(route.sorties);
        return std::ranges::any_of(sorties, [&](const Sortie& sortie) {
            return sortie.launch == place.first && sortie.recovery == place.last;
        });
    }

    void price(const Choice& choice) {
        const EndPlace& delivery = place_of(pickups_.count, choice);
        taken_ = 0;
        const Int bringing = delivery.is_flown() ? drone_for(delivery) : 0;
        Move move{};
        move_between(move, delivery.last, delivery.last + 1);
        if (bringing < 0 || !fetch(choice, move)) return;
        const Int driven = move.count;
        if (!delivery.is_flown()) move.add(How::serve, delivery_, delivery.first + 1 + driven);
        for (Int flight = 0; flight < taken_; ++flight) {
            const auto& [pickup, drone, first, last] = flights_[std::size_t(flight)];
            move.add(How::fly, pickup, first + driven_before(move, first),
                     last + driven_before(move, last), drone);
        }
        if (delivery.is_flown()) {
            // All pickups come before.
            move.add(How::fly, delivery_, delivery.first + driven, delivery.last + driven,
                     bringing);
        }
        best.try_move(price_move(data, fleet, move, node, best.cost), move);
        if (!delivery.is_flown() || delivery.flies_on() || !flies_beside(delivery)) return;
        // What is brought from elsewhere is aboard no longer than it need be.
        move.placement[std::size_t(move.count - 1)].how = How::fly_first;
        best.try_move(price_move(data, fleet, move, node, best.cost), move);
    }

    // How many stops are placed before what was one.
    static Int driven_before(const Move& move, Int stop) {
        Int number = 0;
        while (number < move.count && is_stop(move.placement[std::size_t(number)]) &&
               move.placement[std::size_t(number)].from <= stop + number) {
            ++number;
        }
        return number;
    }

    // Places the pickups by truck, and takes a drone for each of the others. In place; false if
    // there are none left.
    bool fetch(const Choice& choice, Move& move) {
        // Behind those that there are, none.
        std::array<std::pair<Int, Int>, most_pickups> order;
        order.fill({far, 0});
        for (Int end = 0; end < pickups_.count; ++end) {
            // Of those behind a stop that is last from where the delivery is flown on.
            const Int last = place_of(pickups_.count, choice).from == end ? 1 : 0;
            order[std::size_t(end)] = {2 * place_of(end, choice).first + last, end};
        }
        std::ranges::sort(order);
        for (Int rank = 0; rank < pickups_.count; ++rank) {
            const Int end = order[std::size_t(rank)].second;
            const EndPlace& place = place_of(end, choice);
            move.first = std::int32_t(std::min(Int{move.first}, place.first));
            if (!place.is_flown()) {
                move.add(How::serve, end_node(end), place.first + 1 + move.count);
                continue;
            }
            const Int drone = idle_drone_for(place);
            if (drone < 0) return false;
            flights_[std::size_t(taken_++)] = {end_node(end), drone, place.first, place.last};
        }
        return true;
    }

    // A flight to a pickup, by the stops as they were.
    struct FlownPickup {
        Int node, drone, first, last;

        // Whether it takes a drone while that were to fly from and to these stops.
        bool takes(Int other, const EndPlace& place) const {
            return drone == other && place.first < last && first < place.last;
        }
    };

    // Whether a drone is taken for another pickup while it were to fly from and to these stops.
    bool is_taken(Int drone, const EndPlace& place) const {
        return std::any_of(flights_.begin(), flights_.begin() + taken_,
                           [&](const FlownPickup& flight) { return flight.takes(drone, place); });
    }

    // A drone of a place's row that is free then; `nowhere` if there is none.
    Int idle_drone_for(const EndPlace& place) const {
        const Int drone = drone_for(place);
        if (drone < 0 || !is_taken(drone, place)) return drone;
        const Int first = first_drone(data.type, route.type, place.row);
        for (Int other = first; other < first + data.type[place.row].drones; ++other) {
            if (!is_taken(other, place) && is_idle(other, place)) return other;
        }
        return nowhere;
    }

    // Whether a drone flies to nobody else while it were to fly from and to these stops.
    bool is_idle(Int drone, const EndPlace& place) const {
        const View<const Sortie, 1> sorties = fleet.sortie[slot].first(route.sorties);
        return std::ranges::none_of(sorties, [&](const Sortie& sortie) {
            return sortie.drone == drone && sortie.launch <= place.last &&
                   place.first <= sortie.recovery;
        });
    }

    const Pickups pickups_;
    const Int delivery_;
    std::array<PartPlaces, std::size_t(most_ends)> places_;
    Cheapest<Combination, most_combinations> combined_;
    std::array<FlownPickup, most_pickups> flights_{};
    Int taken_ = 0;  // of these
};

}  // namespace

void scan_flown(const Insertion& insertion, Int slot, const Trip& trip) {
    const ProblemData& data = insertion.data;
    if (flies_some_end(data, insertion.searcher.now.route[slot].type, insertion.node)) {
        FlownScan(insertion, slot, trip).scan();
    }
}

}  // namespace tandem
