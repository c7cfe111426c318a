#include <utility>

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

namespace {

constexpr Int most_end_places = 24;  // of an end on a trip
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

class FlownPartsScan : TripScan {
public:
    FlownPartsScan(const Insertion& insertion, Int of_slot, const Trip& tried)
        : TripScan(insertion, of_slot, tried),
          pickups_(pickups_of(data.pair, node)),
          delivery_(data.pair[node].partner) {}

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
        add_all(0, least, least);
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

    // Adds a combination if drones serve some end. In place.
    void add(const Choice& choice) {
        double cost = 0.0;
        bool flies = false;
        for (Int end = 0; end <= pickups_.count; ++end) {
            cost += place_of(end, choice).cost;
            flies = flies || place_of(end, choice).is_flown();
        }
        if (flies && !is_dear(cost)) combined_.add({cost, choice});
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

void scan_flown_parts(const Insertion& insertion, Int slot, const Trip& trip) {
    const ProblemData& data = insertion.data;
    if (flies_some_end(data, insertion.searcher.now.route[slot].type, insertion.node)) {
        FlownPartsScan(insertion, slot, trip).scan();
    }
}

}  // namespace tandem
