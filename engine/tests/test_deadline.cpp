#include <doctest/doctest.h>

#include <array>
#include <chrono>
#include <ctime>
#include <limits>
#include <thread>

#include "deadline.h"

namespace tandem {
namespace {

constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

TEST_CASE("what is over already ends at once") {
    const std::array<std::int64_t, 3> alarm = {0, 0, CLOCK_MONOTONIC};
    CHECK(Deadline({alarm.data(), {3}}).passed());
}

TEST_CASE("what nobody wants any more ends at the next look, for good") {
    std::array<std::int64_t, 3> alarm = {0, never, CLOCK_MONOTONIC};
    const Deadline deadline({alarm.data(), {3}});
    for (int look = 0; look < 100; ++look) CHECK_FALSE(deadline.passed());
    alarm[0] = 1;
    CHECK(deadline.passed());
    alarm[0] = 0;
    CHECK(deadline.passed());
}

TEST_CASE("the clock is looked at after some calls") {
    std::array<std::int64_t, 3> alarm = {0, never, CLOCK_MONOTONIC};
    const Deadline deadline({alarm.data(), {3}});
    CHECK_FALSE(deadline.passed());
    alarm[1] = 0;
    int calls = 1;
    while (!deadline.passed()) ++calls;
    CHECK(calls == 16);
}

TEST_CASE("time that a process sleeps is not processor time") {
    timespec used;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
    constexpr std::int64_t second = 1'000'000'000;
    const std::array<std::int64_t, 3> alarm = {0, used.tv_sec * second + used.tv_nsec + second / 20,
                                               CLOCK_PROCESS_CPUTIME_ID};
    const Deadline deadline({alarm.data(), {3}});
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    CHECK_FALSE(deadline.passed());
    while (!deadline.passed()) {
    }
}

}  // namespace
}  // namespace tandem
