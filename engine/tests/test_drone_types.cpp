#include <doctest/doctest.h>

#include <array>

#include "rules/drone_types.h"

namespace tandem {
namespace {

constexpr VehicleType with_drones(Int drones, Int drone_row) {
    VehicleType type{};
    type.drones = drones;
    type.drone_row = drone_row;
    return type;
}

// The first truck has 4 drones alike; the second 2, 1 and 3 of three types.
constexpr std::array<VehicleType, 5> rows = {with_drones(4, no_row), with_drones(6, 2),
                                             with_drones(2, 3), with_drones(1, 4),
                                             with_drones(3, no_row)};
View<const VehicleType, 1> types() { return {rows.data(), {5}}; }

TEST_CASE("a truck with drones of one type is told by its own row") {
    CHECK(num_drone_rows(types(), 0) == 1);
    CHECK(first_drone_row(types(), 0) == 0);
    CHECK(next_drone_row(types(), 0) == no_row);
    CHECK(row_of_drone(types(), 0, 3) == 0);
    CHECK(first_drone(types(), 0, 0) == 0);
}

TEST_CASE("a truck with drones of several types has a row for each") {
    CHECK(num_drone_rows(types(), 1) == 3);
    const std::array<Int, 6> expected = {2, 2, 3, 4, 4, 4};
    for (Int drone = 0; drone < 6; ++drone) {
        CHECK(row_of_drone(types(), 1, drone) == expected[std::size_t(drone)]);
    }
    CHECK(drone_row_at(types(), 1, 2) == 4);
    CHECK(first_drone(types(), 1, 2) == 0);
    CHECK(first_drone(types(), 1, 4) == 3);
}

}  // namespace
}  // namespace tandem
