#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <utility>
#include <vector>

#include "search/route/edit.h"

namespace tandem {
namespace {

constexpr Int depot = 0, site = 1, other_site = 2, served = 3, other = 4;
constexpr Int untouched = -77;

// A route from depot to depot by way of a customer, with room for some stops and sorties more.
class Day {
public:
    Day(Int stops, Int sorties) : more_stops_(stops), more_sorties_(sorties) {
        for (Stop& stop : stop_) stop.node = untouched;
        for (Sortie& sortie : sortie_) sortie.drone = untouched;
        REQUIRE(begin_empty(sequence(), VehicleType{}, 0));
        REQUIRE(insert_stop(sequence(), 1, served, customer_stop));
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

// A move, and how many stops and sorties it takes.
struct Addition {
    Move move;
    Int stops, sorties;
};

Addition adding(std::initializer_list<Placement> placements) {
    Addition addition{};
    addition.move.between(0, 0, 0, 1);
    for (const Placement& placed : placements) {
        addition.move.add(placed.how, placed.node, placed.from, placed.to, placed.drone);
        if (is_stop(placed)) ++addition.stops;
        if (is_flight(placed)) ++addition.sorties;
    }
    return addition;
}

std::vector<Addition> additions() {
    Addition flown = adding({}), split = adding({});
    fly_trip(flown.move, 0, depot, other, 0);
    flown.stops = 2, flown.sorties = 1;
    split_trip(split.move, 0, depot, other, true);
    split.stops = 3;
    return {flown,
            split,
            adding({{other, How::serve, 1, 0, 0}}),
            adding({{site, How::halt, 1, 0, 0}, {other, How::fly, 1, 2, 0}}),
            adding({{site, How::halt, 1, 0, 0},
                    {other_site, How::halt, 3, 0, 0},
                    {other, How::fly_first, 1, 3, 0}}),
            adding({{served, How::fly, 0, 1, 0}, {other, How::ride, served, 0, 0}}),
            adding({{served, How::fly, 0, 1, 0}, {other, How::fly_first, 0, 1, 1}})};
}

TEST_CASE("whatever is added to a route asks for room") {
    for (const Addition& addition : additions()) {
        CAPTURE(int(addition.move.placement[0].how));
        for (Int stops = 0; stops <= addition.stops; ++stops) {
            for (Int sorties = 0; sorties <= addition.sorties; ++sorties) {
                Day day(stops, sorties);
                const bool fits = stops == addition.stops && sorties == addition.sorties;
                CHECK(apply(day.sequence(), addition.move) == fits);
                CHECK(day.is_within());
                if (fits) {
                    CHECK(day.route().length == 3 + stops);
                    CHECK(day.route().sorties == sorties);
                }
            }
        }
    }
}

TEST_CASE("placements are where they say once all are placed") {
    Day day(3, 3);
    const Sequence route = day.sequence();
    REQUIRE(apply(route, adding({{served, How::fly, 0, 1, 0}}).move));
    Move move = adding({{site, How::halt, 1, 0, 0},
                        {other_site, How::halt, 3, 0, 0},
                        {other, How::fly_first, 0, 2, 1},
                        {site, How::join, 0, 1, 0}})
                    .move;
    REQUIRE(apply(route, move));
    for (const auto& [p, node] : {std::pair{1, site}, {2, served}, {3, other_site}, {4, depot}}) {
        CHECK(route.stops[p].node == node);
    }
    const Sortie &first = route.sorties[0], &second = route.sorties[1];
    CHECK((first.nodes[0] == other && first.nodes[1] == site && first.drone == 1));
    CHECK((second.nodes[0] == served && second.launch == 0 && second.recovery == 2));
}

TEST_CASE("stops for which there is no room change nothing") {
    Day day(1, 0);
    CHECK(add_stop(day.sequence(), site, halt_stop));
    CHECK_FALSE(insert_stop(day.sequence(), 1, other_site, halt_stop));
    CHECK(day.route().length == 4);
    CHECK(day.sequence().stops[1].node == served);
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

}  // namespace
}  // namespace tandem
