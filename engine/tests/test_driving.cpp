// How long drivers rest at least.
#include <doctest/doctest.h>

#include "rules/driving.h"

namespace tandem {

TEST_CASE(
    "who would have to rest for longer than any number tells rests for longer than any route") {
    VehicleType type{};
    type.max_driving = unlimited;
    type.max_work = 1;
    type.rest_durations[whole_rest - most_breaks] = 1'000'000'000'000;
    CHECK(least_rest(type, Driver{}, 0, 0, 105'265'610) >= unlimited);
    CHECK(least_rest(type, Driver{}, 0, 0, 3) == 2'000'000'000'000);
}

}  // namespace tandem
