#include <doctest/doctest.h>

#include <array>

#include "rules/clock.h"
#include "rules/shift.h"
#include "rules/start.h"

namespace tandem {
namespace {

// Half as fast from 100 to 200.
const std::array<Int, 2> changes = {100, 200};
const std::array<Int, 3> speeds = {full_speed, full_speed / 2, full_speed};

VehicleType changing() {
    VehicleType type{};
    type.speed_changes = 2;
    return type;
}

Int end_of(Int duration, Int leave) {
    return leg_end(changing(), {changes.data(), {2}}, {speeds.data(), {3}}, duration, leave);
}

Int start_of(Int duration, Int arrival) {
    return leg_start(changing(), {changes.data(), {2}}, {speeds.data(), {3}}, duration, arrival);
}

TEST_CASE("legs take longer while traffic is slow") {
    CHECK(end_of(50, 0) == 50);
    CHECK(end_of(50, 80) == 160);   // 20, and 30 at half the speed
    CHECK(end_of(100, 90) == 240);  // 10, 50 in 100, 40
    CHECK(end_of(1, 150) == 152);
    CHECK(start_of(50, 160) == 80);
    CHECK(start_of(100, 240) == 90);
    CHECK(start_of(1, 151) == 149);
}

TEST_CASE("who leaves at the latest departure is in time, and no later one is") {
    for (Int arrival = 120; arrival < 300; ++arrival) {
        const Int leave = start_of(37, arrival);
        CHECK(end_of(37, leave) <= arrival);
        CHECK(end_of(37, leave + 1) > arrival);
    }
}

TEST_CASE("legs last as long as tables say where speeds don't change") {
    VehicleType type{};
    type.speed_changes = no_profile;
    CHECK(leg_end(type, {}, {}, 50, 80) == 130);
    CHECK(leg_start(type, {}, {}, 50, 80) == 30);
}

TEST_CASE("setups are told apart from legs only where speeds change") {
    const std::array<Setup, 3> rows = {{{1, 0}, {2, 30}, {2, 40}}};
    const View<const Setup, 1> setups(rows.data(), {3});
    VehicleType type = changing();
    CHECK(setup_beside(type, setups, 0, 1) == 30);
    CHECK(setup_beside(type, setups, 1, 2) == 0);
    CHECK(setup_beside(type, {}, 0, 1) == 0);
    type.speed_changes = no_profile;
    CHECK(setup_beside(type, setups, 0, 1) == 0);
}

TEST_CASE("a vehicle under way leaves later, and its work counts from before") {
    VehicleType type{};
    type.busy_until = 30;
    CHECK(leaves_first(type, 20) == 30);
    CHECK(leaves_first(type, 40) == 40);
    CHECK(counted_from(type, 40) == 40);
    type.begun = 1;
    type.shift_earliest = 5;
    CHECK(counted_from(type, 40) == 5);
}

TEST_CASE("overtime is past the shift or past the working duration, the longer") {
    VehicleType type{};
    type.usual_end = 100;
    type.usual_working = 60;
    CHECK(paid_work(type, 100, 60).overtime == 0);
    CHECK(paid_work(type, 110, 60).overtime == 10);
    CHECK(paid_work(type, 110, 75).overtime == 15);
    CHECK(paid_work(type, 110, 75).duration == 75);
}

TEST_CASE("overtime is paid on top of the hours worked, and makes less work worth more") {
    Rate rate{};
    rate.time = 2.0;
    rate.overtime = 3.0;
    const PaidWork usual{60, 0}, longer{75, 15};
    CHECK(work_cost(rate, longer) == 75 * 2.0 + 15 * 3.0);
    CHECK(work_cost(rate, longer - usual) == 15 * 2.0 + 15 * 3.0);
    CHECK(is_dearer(rate, longer));
    CHECK(!is_dearer(rate, usual));
    rate.overtime = 0.0;
    CHECK(!is_dearer(rate, longer));
}

}  // namespace
}  // namespace tandem
