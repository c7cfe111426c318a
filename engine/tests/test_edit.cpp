#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "search/route/edit.h"

namespace tandem {
namespace {

constexpr Int depot = 0, site = 1, other_site = 2, served = 3, pickup = 4, second = 5, delivery = 6;
constexpr Int untouched = -77;

// A shipment with one pickup, or two.
std::array<Pair, 7> pairs_with(bool gathered) {
    std::array<Pair, 7> pairs{};
    for (Int node = 0; node < Int(pairs.size()); ++node) {
        pairs[std::size_t(node)] = {nowhere, 0, node, node};
    }
    pairs[pickup] = {delivery, 0, pickup, gathered ? second : pickup};
    pairs[delivery] = {pickup, 1, pickup, pickup};
    if (gathered) pairs[second] = {delivery, 0, pickup, pickup};
    return pairs;
}

// A route from depot to depot by way of a customer, with room for some stops and sorties more.
class Day {
public:
    Day(Int stops, Int sorties) : more_stops_(stops), more_sorties_(sorties) {
        for (Stop& stop : stop_) stop.node = untouched;
        for (Sortie& sortie : sortie_) sortie.drone = untouched;
        REQUIRE(begin_empty(sequence(), VehicleType{}, 0));
        REQUIRE(insert_stops(sequence(), 1, {{served, customer_stop}}));
    }

    Sequence sequence() {
        return {route_, {stop_.data(), {3 + more_stops_}}, {sortie_.data(), {more_sorties_}}};
    }

    // Whether nothing is written behind what there is room for.
    bool is_within() const {
        return route_.length <= 3 + more_stops_ && route_.sorties <= more_sorties_ &&
               std::all_of(stop_.begin() + 3 + more_stops_, stop_.end(),
                           [](const Stop& stop) { return stop.node == untouched; }) &&
               std::all_of(sortie_.begin() + more_sorties_, sortie_.end(),
                           [](const Sortie& sortie) { return sortie.drone == untouched; });
    }

    const Route& route() const { return route_; }

private:
    const Int more_stops_, more_sorties_;
    Route route_{};
    std::array<Stop, 16> stop_{};
    std::array<Sortie, 8> sortie_{};
};

// How a move adds a node, and how many stops and sorties that takes.
struct Addition {
    Move move;
    Int node;
    bool gathered;
    Int stops, sorties;
};

Move move_of(Int kind, Int drone = nowhere, Int sortie = nowhere) {
    Move move{};
    move.kind = kind;
    move.first = move.last = move.landing = 0;
    move.halt = site;
    move.drone = drone;
    move.sortie = sortie;
    return move;
}

std::vector<Addition> additions() {
    Move by_two = move_of(by_halts, 0);
    by_two.last = 1;
    by_two.landing = other_site;
    Move both_flown = move_of(by_drones, 0, 1);
    both_flown.halt = 0;
    Move parts = move_of(all_ends, 0);
    parts.drone = parts.halt = 0;
    parts.end[0] = picked_behind(0, 0);
    parts.end[1] = picked_behind(0, 1);
    Move trip_of_parts = parts;
    trip_of_parts.kind = parts_trip;
    Move flown_part = parts;
    note_fetched(flown_part, 0, 0, 0);
    Move brought = parts;
    brought.sortie = 0;
    brought.late = from_last_pickup;
    return {{move_of(at_stop), served, false, 1, 0},
            {move_of(by_sortie, 0), served, false, 0, 1},
            {move_of(new_trip), served, false, 3, 0},
            {move_of(flight_trip, 0), served, false, 2, 1},
            {move_of(trip_from), served, false, 3, 0},
            {move_of(trip_until), served, false, 3, 0},
            {move_of(from_halt, 0), served, false, 1, 1},
            {move_of(to_halt, 0), served, false, 1, 1},
            {by_two, served, false, 2, 1},
            {move_of(halt_trip, 0), served, false, 3, 1},
            {move_of(both_ends), pickup, false, 2, 0},
            {move_of(by_truck_and_drone, 0), pickup, false, 1, 1},
            {move_of(from_pickup, 0), pickup, false, 1, 1},
            {move_of(by_drone_and_truck, 0), pickup, false, 1, 1},
            {both_flown, pickup, false, 0, 2},
            {move_of(on_one_flight, 0), pickup, false, 0, 1},
            {move_of(pair_trip), pickup, false, 4, 0},
            {move_of(pair_trip, 0), pickup, false, 3, 1},
            {move_of(pair_trip, 0, 0), pickup, false, 2, 2},
            {move_of(pair_trip, 0, on_same_flight), pickup, false, 2, 1},
            {parts, pickup, true, 3, 0},
            {flown_part, pickup, true, 2, 1},
            {brought, pickup, true, 2, 1},
            {trip_of_parts, pickup, true, 5, 0}};
}

TEST_CASE("whatever is added to a route asks for room") {
    for (Addition& addition : additions()) {
        CAPTURE(addition.move.kind);
        std::array<Pair, 7> pairs = pairs_with(addition.gathered);
        const View<const Pair, 1> pair(pairs.data(), {Int(pairs.size())});
        for (Int stops = 0; stops <= addition.stops; ++stops) {
            for (Int sorties = 0; sorties <= addition.sorties; ++sorties) {
                Day day(stops, sorties);
                const bool fits = stops == addition.stops && sorties == addition.sorties;
                CHECK(apply(depot, day.sequence(), addition.move, addition.node, pair) == fits);
                CHECK(day.is_within());
                if (fits) {
                    CHECK(day.route().length == 3 + stops);
                    CHECK(day.route().sorties == sorties);
                }
            }
        }
    }
}

TEST_CASE("stops for which there is no room change nothing") {
    Day day(1, 0);
    CHECK_FALSE(insert_stops(day.sequence(), 1, {{site, halt_stop}, {other_site, halt_stop}}));
    CHECK(day.route().length == 3);
    CHECK(day.sequence().stops[1].node == served);
    CHECK(add_stop(day.sequence(), site, halt_stop));
    CHECK_FALSE(add_stop(day.sequence(), site, halt_stop));
    CHECK(day.is_within());
}

TEST_CASE("a sortie takes as many customers as it has room for") {
    Sortie sortie{};
    const Int most = Int(std::size(sortie.nodes));
    for (Int node = 0; node < most; ++node) CHECK(join_sortie(sortie, node, node));
    CHECK_FALSE(join_sortie(sortie, 0, most));
    CHECK(sortie.count == most);
    CHECK(sortie.nodes[0] == 0);
}

TEST_CASE("a route that begins anew asks for room") {
    Day day(0, 0);
    for (const Int way : {from_start, across, from_end, at_halt, start_to_halt, halt_to_end}) {
        CHECK_FALSE(begin_route(day.sequence(), VehicleType{}, 0, served, way, 0, site));
    }
    CHECK(begin_route(day.sequence(), VehicleType{}, 0, served, by_truck, 0, site));
    CHECK(day.is_within());
}

}  // namespace
}  // namespace tandem
