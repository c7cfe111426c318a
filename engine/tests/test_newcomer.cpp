#include <doctest/doctest.h>

#include <array>
#include <vector>

#include "search/insertion/best.h"
#include "search/insertion/newcomer.h"

namespace tandem {
namespace {

// Served for 5 from 10 to 20.
const Node window = {10, 20, 5, 0, 20, {}};

// Legs to the customer, node 2, from nodes 0 and 1, and from there: durations and distances.
const std::array<std::int32_t, 6> there = {4, 40, 6, 60, 0, 0};
const std::array<std::int32_t, 6> onward = {3, 30, 7, 70, 0, 0};

Newcomer newcomer() {
    const View<const Node, 1> rows{&window, {1}};
    return {2, rows, {.stated = there.data()}, {.stated = onward.data()}};
}

// The state of a generator.
std::array<std::uint64_t, 1> seed() { return {7}; }

TEST_CASE("a detour is as long as both legs less the direct one") {
    CHECK(newcomer().further(0, 1, 25) == 40 + 70 - 25);
    const auto [out, on, distance] = newcomer().detour(1, 0, 25);
    CHECK(out.duration == 6);
    CHECK(on.duration == 3);
    CHECK(distance == 60 + 30 - 25);
}

TEST_CASE("a customer may come between two if neither window is missed") {
    const Newcomer customer = newcomer();
    CHECK(customer.comes_between(0, {16}, 1, {20 + 5 + 7}));
    CHECK_FALSE(customer.comes_between(0, {17}, 1, {far}));
    CHECK_FALSE(customer.comes_between(0, {16}, 1, {20 + 5 + 7 - 1}));
    // Who comes early waits.
    CHECK(customer.comes_between(0, {0}, 1, {10 + 5 + 7}));
    CHECK_FALSE(customer.comes_between(0, {0}, 1, {10 + 5 + 7 - 1}));
}

TEST_CASE("the first of places that cost the same is the best") {
    auto state = seed();
    Best best{0.0, {state.data(), {1}}};
    const auto may_come = [] { return true; };
    CHECK(best.try_behind({9, 3, 0, 2.0, 10.0}, 5, 20, may_come));
    CHECK_FALSE(best.try_behind({9, 4, 1, 2.0, 10.0}, 6, 20, may_come));
    CHECK(best.cost == 50.0);
    CHECK(is_one_stop(best.move));
    CHECK(best.move.placement[0].node == 9);
    CHECK(best.move.placement[0].from == 6);
    CHECK(best.move.slot == 3);
    CHECK(best.move.first == 5);
    CHECK(best.try_behind({9, 4, 1, 2.0, 10.0}, 6, 19, may_come));
    CHECK(best.move.slot == 4);
    CHECK(best.move.type == 1);
}

TEST_CASE("whether a customer may come is asked of cheaper places alone") {
    auto state = seed();
    Best best{0.0, {state.data(), {1}}, 50.0};
    Int asked = 0;
    const auto may_come = [&] { return ++asked == 0; };
    CHECK_FALSE(best.try_behind({9, 3, 0, 2.0, 10.0}, 5, 20, may_come));
    CHECK(asked == 0);
    CHECK_FALSE(best.try_behind({9, 3, 0, 2.0, 10.0}, 5, 19, may_come));
    CHECK(asked == 1);
    CHECK(best.cost == 50.0);
    // Nor is anything drawn of places where he may not come.
    CHECK(state == seed());
}

TEST_CASE("a place that is overlooked isn't taken") {
    auto state = seed();
    Best best{1.0, {state.data(), {1}}};
    CHECK_FALSE(best.takes(1.0));
    CHECK(best.cost == infeasible);
    best.blink = 0.0;
    CHECK(best.takes(1.0));
    CHECK(best.cost == 1.0);
}

TEST_CASE("places that are overlooked are listed where they are wanted, the cheapest first") {
    auto state = seed();
    PricedPlaces places;
    Best best{1.0, {state.data(), {1}}};
    best.listed = &places;
    Move flight{};
    flight.between(3, 0, 1, 2).add(How::fly, 9, 1, 2);
    best.try_move(3.0, flight);
    best.try_move(infeasible, flight);
    best.try_made(7.0, [](Move& move) { move.between(3, 0, 4, 5).add(How::serve, 9, 5); });
    CHECK_FALSE(best.try_behind({9, 3, 0, 2.0, 1.0}, 5, 2, [] { return true; }));
    CHECK_FALSE(best.try_behind({9, 3, 0, 2.0, 1.0}, 6, 1, [] { return false; }));
    std::vector<double> costs;
    std::vector<Int> stops;
    places.for_each([&](const PricedPlaces::Priced& priced) {
        costs.push_back(priced.cost);
        stops.push_back(priced.move.placement[0].from);
    });
    CHECK(costs == std::vector{5.0, 7.0, 3.0});
    CHECK(stops == std::vector<Int>{6, 5, 1});
    CHECK(best.cost == infeasible);
}

}  // namespace
}  // namespace tandem
