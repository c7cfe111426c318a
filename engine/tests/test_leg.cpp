#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "rules/leg.h"

namespace tandem {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// 2 m to a unit, 3 ms to a metre and 7 to a leg, setups counted.
constexpr LegLaw straight = {-1, 0, 7, unreachable_leg, 1, 2.0, 3.0};

TEST_CASE("computed legs are rounded once, and hold what is set up where somebody comes to") {
    const Point here = {0, 4, 100, 0.0, 0.0, 0.0}, there = {1, 5, 20, 3.0, 4.0, 0.0};
    const Leg found = straight_leg(here, there, straight);
    CHECK(found.duration == 30 + 7 + 20);
    CHECK(found.distance == 10'000);
    CHECK(straight_distance(there, here, straight) == 10'000);
    CHECK(straight_leg(here, here, straight).duration == 0);

    const Point beside = {2, 4, 20, 0.1, 0.0, 0.0};
    CHECK(straight_leg(here, beside, straight).duration == 1 + 7);
    CHECK(straight_leg(here, beside, straight).distance == 200);
}

TEST_CASE("no leg leads nowhere") {
    const Point here = {0, 0, 0, 0.0, 0.0, 0.0}, nowhere = {1, 1, 5, nan, nan, nan};
    CHECK(straight_leg(here, nowhere, straight).duration == unreachable_leg + 5);
    CHECK(straight_leg(here, nowhere, straight).distance == unreachable_leg);
    CHECK(straight_distance(nowhere, here, straight) == unreachable_leg);
}

TEST_CASE("distances in the plane are rounded as instances say") {
    const Point here = {0, 0, 0, 0.0, 0.0, 0.0}, there = {1, 1, 0, 1.65625, 0.0, 0.0};
    const std::array<Int, 5> expected = {1656, 2000, 1000, 1600, 1656};
    for (Int rounding = 0; rounding < 5; ++rounding) {
        CHECK(straight_distance(here, there, {-1, rounding, 0, 0, 0, 1.0, 1.0}) ==
              expected[std::size_t(rounding)]);
    }
}

TEST_CASE("angles are exact from next to nothing to the antipode") {
    const LegLaw globe = {-1, -1, 0, unreachable_leg, 0, 1e6, 1.0};
    const Point east = {0, 0, 0, 1.0, 0.0, 0.0};
    for (const double angle : {1e-6, 0.1, 0.3, 1.0, 1.57, 1.58, 2.0, 3.0, std::numbers::pi}) {
        const Point there = {1, 1, 0, std::cos(angle), std::sin(angle), 0.0};
        CHECK(std::abs(double(straight_distance(east, there, globe)) - angle * 1e9) <= 1.0);
    }
}

TEST_CASE("stated legs are looked up both ways, and sums of them fit") {
    // From node 0 to 1 in 8 over 9, back in 6 over 5; nobody flies from 1 to 2.
    std::vector<std::int32_t> there(3 * 3 * 2, 0), back(3 * 3 * 2, 0);
    const auto state = [&](Int from, Int to, std::int32_t duration, std::int32_t distance) {
        for (const auto& [legs, at] : {std::pair{&there, from * 3 + to}, {&back, to * 3 + from}}) {
            (*legs)[std::size_t(2 * at)] = duration;
            (*legs)[std::size_t(2 * at + 1)] = distance;
        }
    };
    state(0, 1, 8, 9);
    state(1, 0, 6, 5);
    state(1, 2, no_leg, no_leg);
    state(2, 1, no_leg - 1, 2);
    const Legs legs{{there.data(), {1, 3, 3, 2}}, {}, {}, {}};
    const Legs backs{{back.data(), {1, 3, 3, 2}}, {}, {}, {}};
    const TravelLegs every = legs_of(legs, 0);
    const LegRow onward = legs_from(legs, 0, 1), inward = legs_to(backs, 0, 1);
    CHECK(leg(every, 0, 1).duration == 8);
    CHECK(leg_to(onward, 0).duration == 6);
    CHECK(leg_from(inward, 0).duration == 8);
    CHECK(distance_to(onward, 0) == 5);
    CHECK(distance_from(inward, 0) == 9);
    CHECK(nearness(inward, onward, 0) == 5);
    CHECK(leg_to(onward, 2).duration == unreachable_leg);
    CHECK(leg_from(inward, 2).duration + leg(every, 2, 1).duration == Int{2} * (no_leg - 1));
}

TEST_CASE("some travels have tables where others are computed") {
    std::vector<Int> table = {0, 0, 1, 2, 3, 4, 0, 0};  // of both nodes, one direction
    const std::array<LegLaw, 2> laws = {straight, LegLaw{0, 0, 0, 0, 0, 0.0, 0.0}};
    const std::array<Point, 2> points = {{{0, 0, 0, 0.0, 0.0, 0.0}, {1, 1, 0, 3.0, 4.0, 0.0}}};
    const Legs legs{{}, {table.data(), {1, 1, 2, 2, 2}}, {points.data(), {2}}, {laws.data(), {2}}};
    CHECK(leg(legs_of(legs, 0), 1, 0).duration == 37);
    CHECK(leg(legs_of(legs, 1), 1, 0).duration == 3);
    CHECK(distance_to(legs_from(legs, 0, 1), 0) == 10'000);
    CHECK(distance_to(legs_from(legs, 1, 1), 0) == 4);
    std::vector<Int> both = {0, 0, 1, 2, 3, 4, 0, 0, 0, 0, 3, 4, 1, 2, 0, 0};
    const Legs turned{{}, {both.data(), {2, 1, 2, 2, 2}}, {points.data(), {2}}, {laws.data(), {2}}};
    CHECK(leg_from(legs_to(turned, 1, 1), 0).duration == 1);
    CHECK(leg_to(legs_from(turned, 1, 1), 0).duration == 3);
    CHECK(nearness(legs_to(turned, 1, 1), legs_from(turned, 1, 1), 0) == 2);
}

}  // namespace
}  // namespace tandem
