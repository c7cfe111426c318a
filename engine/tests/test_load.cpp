#include <doctest/doctest.h>

#include <array>
#include <vector>

#include "rules/load.h"

namespace tandem {
namespace {

VehicleType truck(Int capacity, Int pickup_order) {
    VehicleType type{};
    type.capacity[0] = capacity;
    type.pickup_order = pickup_order;
    return type;
}

// A trip of one dimension, by what leaves and comes aboard at each stop.
std::vector<StopLoad> trip(const std::vector<std::pair<Int, Int>>& stops) {
    std::vector<StopLoad> stop_loads;
    for (const auto& [leaves, comes] : stops) {
        StopLoad stop_load{};
        add_left(stop_load, {leaves, 0, 0}, leaves);
        add_come(stop_load, {comes, 0, 0}, comes);
        stop_loads.push_back(stop_load);
    }
    return stop_loads;
}

bool weighed(const VehicleType& type, std::vector<StopLoad>& stop_loads) {
    return weigh_trip(type, stop_loads.begin(), stop_loads.end(), 0);
}

TEST_CASE("amounts are compared in each dimension") {
    CHECK(within({1, 2, 3}, {1, 2, 3}));
    CHECK_FALSE(within({1, 2, 4}, {9, 9, 3}));
    CHECK(larger({1, 5, 0}, {2, 3, 0}) == Amount{2, 5, 0});
    CHECK(smaller({1, 5, 0}, {2, 3, 0}) == Amount{1, 3, 0});
    CHECK(total(minus(plus({1, 2, 3}, {4, 5, 6}), {1, 1, 1})) == 18);
}

TEST_CASE("the most is aboard between deliveries and pickups") {
    // Leaves the depot with 7; behind the stops there are 4, 8 and 5 aboard.
    auto stop_loads = trip({{0, 0}, {3, 0}, {1, 5}, {3, 0}});
    CHECK(weighed(truck(8, pickups_any), stop_loads));
    CHECK(most_of(stop_loads[0]) == Amount{8, 0, 0});
    CHECK(stop_loads[2].before[0] == 7);
    CHECK(stop_loads[2].behind[0] == 8);
    CHECK(stop_loads[3].behind[0] == 5);
    CHECK(stop_loads[1].aboard[0] == 4);
    CHECK(stop_loads[3].picked == 5);
    CHECK(stop_loads[1].due == 4);
    CHECK(stop_loads[1].given == 7);
    CHECK_FALSE(weighed(truck(7, pickups_any), stop_loads));
}

TEST_CASE("pickups follow all deliveries where they have to") {
    auto stop_loads = trip({{0, 0}, {3, 0}, {1, 5}, {3, 0}});
    CHECK_FALSE(weighed(truck(9, pickups_last), stop_loads));
    auto ordered = trip({{0, 0}, {3, 0}, {4, 5}, {0, 1}});
    CHECK(weighed(truck(9, pickups_last), ordered));
    auto none_delivered = trip({{0, 0}, {0, 5}});
    CHECK_FALSE(weighed(truck(9, pickups_last), none_delivered));
    CHECK(weighed(truck(9, pickups_begun), none_delivered));
}

TEST_CASE("a customer more needs room before its stop and behind it") {
    auto stop_loads = trip({{0, 0}, {3, 0}, {1, 5}, {3, 0}});
    const VehicleType type = truck(8, pickups_any);
    REQUIRE(weighed(type, stop_loads));
    // Of two customers, one is brought 1, the other gives 2.
    std::vector<Int> amounts(16, 0);
    amounts[0] = amounts[6] = 1;
    amounts[8 + 3] = amounts[8 + 7] = 2;
    const View<const Int, 3> asked(amounts.data(), {2, 1, 8});
    const View<const StopLoad, 2> stops(stop_loads.data(), {1, 4});
    CHECK(has_room(type, stops, 1, 0, asked, 0));        // 8 aboard up to it
    CHECK(has_room(type, stops, 2, 1, asked, 0));        // behind the first stop, 5
    CHECK_FALSE(has_room(type, stops, 3, 2, asked, 0));  // with the 5 picked up, 9
    CHECK_FALSE(has_room(type, stops, 2, 1, asked, 1));
    CHECK(has_room(type, stops, 3, 3, asked, 1));
}

TEST_CASE("parts of a trip add up to the whole") {
    const std::vector<Int> amounts = {3, 0, 0, 0, 0, 0, 3, 0, 1, 0, 0, 5, 0, 0, 1, 5};
    const View<const Int, 3> asked(amounts.data(), {2, 1, 8});
    const Cargo first = cargo_for(asked, 0, 0), second = cargo_for(asked, 1, 0);
    const Cargo both = followed(first, second);
    CHECK(both.most == Amount{5, 0, 0});
    CHECK(followed(second, first).most == Amount{8, 0, 0});
    CHECK(both.total_delivered == 4);
    CHECK(both.total_picked == 5);
    CHECK(may_follow(truck(9, pickups_last), first, second));
    CHECK_FALSE(may_follow(truck(9, pickups_last), second, first));
    CHECK_FALSE(may_be_all(truck(4, pickups_any), both, 0));
    CHECK(followed(no_cargo, both).most == both.most);
}

TEST_CASE("goods are kept apart on a trip or on a vehicle") {
    const Goods food = {1, 2, 4, 0, 0};
    CHECK(go_together(food, 2, 4));
    CHECK_FALSE(go_together(food, 1, 0));
    CHECK_FALSE(go_together(food, 0, 3));
}

}  // namespace
}  // namespace tandem
