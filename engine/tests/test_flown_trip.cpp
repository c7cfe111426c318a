#include <doctest/doctest.h>

#include <vector>

#include "rules/flown_trip.h"

namespace tandem {
namespace {

// Takes 2 mW in cruise and 1 mW more for each part aboard, 3 mW in the air at customers.
VehicleType drone() {
    VehicleType type{};
    type.flies = 1;
    type.endurance = 100;
    type.launch_duration = 5;
    type.recovery_duration = 7;
    type.points = 2;
    type.battery = 1000;
    type.weights[1] = 10;
    type.cruise[0] = 2;
    type.cruise[1] = 12;
    type.hover[0] = type.hover[1] = 3;
    return type;
}

// A customer to whom 4 parts are brought in 10 ms of service, from whom one is taken.
struct Customer {
    std::vector<Node> rows{Node{50, far, 10, 0, far, {4, 1, 0}}};

    Windows windows() const { return Windows(View<const Node, 1>(rows.data(), {1})); }
};

TEST_CASE("a trip takes by what is aboard on each leg, without its launch and its recovery") {
    const VehicleType type = drone();
    const Customer customer;
    FlownTrip trip(type, 4);
    trip.fly_to(customer.windows(), 5 + 20, true, 0);
    CHECK(trip.left() == 1000 - 20 * 6 - 10 * 3);
    trip.fly_home(30 + 7, false);
    CHECK(trip.left() == 1000 - 20 * 6 - 10 * 3 - 30 * 3);
    CHECK(trip.excess() <= 0);
}

TEST_CASE("landing takes nothing at customers") {
    VehicleType type = drone();
    type.lands = 1;
    const Customer customer;
    FlownTrip trip(type, 4);
    trip.fly_to(customer.windows(), 5 + 20, true, 1000);
    CHECK(trip.left() == 1000 - 20 * 6);
}

TEST_CASE("who waits too long in the air has to begin later by what that takes too much") {
    const VehicleType type = drone();
    const Customer customer;
    FlownTrip trip(type, 4);
    trip.fly_to(customer.windows(), 5 + 20, true, 300);
    CHECK(trip.left() == 1000 - 120 - 30 - 900);
    CHECK(trip.excess() == 17);
}

TEST_CASE("a trip that takes too much without waiting can't be held back") {
    const VehicleType type = drone();
    const Customer customer;
    FlownTrip trip(type, 4);
    trip.fly_to(customer.windows(), 500, true, 0);
    CHECK(trip.left() < 0);
    CHECK(trip.excess() == far);
}

TEST_CASE("endurance counts from take-off to landing") {
    CHECK(longest_in_air(drone()) == 112);
    CHECK(bounds_trips(drone()));
    VehicleType truck = drone();
    truck.flies = 0;
    CHECK_FALSE(bounds_trips(truck));
}

}  // namespace
}  // namespace tandem
