#include <doctest/doctest.h>

#include <array>
#include <limits>

#include "deadline.h"

namespace tandem {
namespace {

constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

TEST_CASE("what is over already ends at once") {
    const std::array<std::int64_t, 2> alarm = {0, 0};
    CHECK(Deadline({alarm.data(), {2}}).passed());
}

TEST_CASE("what nobody wants any more ends at the next look, for good") {
    std::array<std::int64_t, 2> alarm = {0, never};
    const Deadline deadline({alarm.data(), {2}});
    for (int look = 0; look < 100; ++look) CHECK_FALSE(deadline.passed());
    alarm[0] = 1;
    CHECK(deadline.passed());
    alarm[0] = 0;
    CHECK(deadline.passed());
}

TEST_CASE("the clock is looked at after some calls") {
    std::array<std::int64_t, 2> alarm = {0, never};
    const Deadline deadline({alarm.data(), {2}});
    CHECK_FALSE(deadline.passed());
    alarm[1] = 0;
    int calls = 1;
    while (!deadline.passed()) ++calls;
    CHECK(calls == 16);
}

}  // namespace
}  // namespace tandem
