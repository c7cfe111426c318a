#include <doctest/doctest.h>

#include <algorithm>

#include "rules/flight.h"

namespace tandem {
namespace {

VehicleType endurant(Int endurance) {
    VehicleType type{};
    type.endurance = endurance;
    type.launch_duration = type.relaunch_duration = 2;
    type.recovery_duration = 3;
    return type;
}

// A battery of 1000; flying empty takes 10 of it in a unit of time, with 4 aboard 7, so that with 1
// it is 9.25, rounded down.
VehicleType powered() {
    VehicleType type = endurant(1000);
    type.points = 2;
    type.battery = 1000;
    type.weights[1] = 4;
    type.cruise[0] = 10;
    type.cruise[1] = 7;
    type.hover[0] = type.hover[1] = 20;
    return type;
}

const Node customer = {50, far, 5, 0, 60, {1, 0, 0}};
Windows place() { return View<const Node, 1>(&customer, {1}); }

TEST_CASE("powers are linear between points, and on beyond the last") {
    const VehicleType type = powered();
    CHECK(power_at(type, type.cruise, 0) == 10);
    CHECK(power_at(type, type.cruise, 1) == 9);
    CHECK(power_at(type, type.cruise, 4) == 7);
    CHECK(power_at(type, type.cruise, 8) == 4);
    CHECK(power_at(type, type.cruise, 100) == 0);
}

TEST_CASE("quotients are rounded down on both sides of zero") {
    CHECK(floor_quotient(7, 2) == 3);
    CHECK(floor_quotient(-7, 2) == -4);
    CHECK(floor_quotient(-8, 2) == -4);
}

TEST_CASE("a battery is empty once more is asked of it than it holds") {
    CHECK(discharge(100, 10, 10) == 0);
    CHECK(discharge(100, 10, 11) == empty_battery);
    CHECK(discharge(empty_battery, 0, 0) == empty_battery);
    CHECK(discharge(100, 10, far) == empty_battery);
    CHECK(discharge(100, 0, far) == 100);
}

TEST_CASE("climbs and descents are part of a leg") {
    VehicleType type = powered();
    type.climb_duration = 4;
    type.descent_duration = 3;
    type.climb[0] = 30;
    type.descent[0] = 5;
    CHECK(after_leg(type, 1000, 0, 10) == 1000 - 30 - 120 - 15);
    CHECK(after_leg(type, 1000, 0, 5) == 1000 - 120 - 15);
}

TEST_CASE("a battery is charged aboard up to what it holds") {
    VehicleType type = powered();
    type.charge = 30;
    CHECK(charged(type, 100, 10, 10) == 100);
    CHECK(charged(type, 100, 10, 30) == 700);
    CHECK(charged(type, 100, 10, 40) == 1000);
    CHECK(charged(type, 100, 10, far) == 1000);
    CHECK(time_charged(type, 100, 10, 600) == 20);  // 400 are needed, 300 of them in 10
    CHECK(time_charged(type, 100, 10, 950) == 10);  // it has them
    CHECK(time_charged(type, 100, 10, -1) == 10);   // nobody can fly that
    CHECK(time_charged(type, 100, 10, 599) == 21);
}

TEST_CASE("a drone is held back until its window lets it be back in time") {
    // It is back 5 + 20 after the window has opened at 50.
    CHECK(Flight{endurant(30), place(), 10, 20}.held_takeoff(0) == 45);
    CHECK(Flight{endurant(80), place(), 10, 20}.held_takeoff(0) == 0);
    CHECK(Flight{endurant(30), place(), 10, 20}.held_takeoff(48) == 48);
}

TEST_CASE("a drone is held back while it storms, or while a zone is closed to which it flies") {
    VehicleType type = endurant(80);
    type.storms = 3;
    const Int begins[] = {30, 60, 200}, ends[] = {100, 70, unlimited}, zones[] = {2, 0, 4};
    std::copy_n(begins, 3, type.storm_from);
    std::copy_n(ends, 3, type.storm_until);
    std::copy_n(zones, 3, type.storm_zones);
    // There and back in 10 + 5 + 20, no sooner than the window allows that opens at 50.
    CHECK(Flight{type, place(), 10, 20}.held_takeoff(0) == 70);
    CHECK(Flight{type, place(), 10, 20, 2}.held_takeoff(0) == 100);
    CHECK(Flight{type, place(), 10, 20, 1 + 4}.held_takeoff(0) == 70);
    CHECK(Flight{type, place(), 10, 20, 4}.held_takeoff(190) == 190);  // it stays closed
    CHECK(calm_until(type, 100, 2) == far);
    CHECK(calm_until(type, 100, 4) == 200);
    CHECK(calm_until(type, 0, 0) == 60);
}

TEST_CASE("where it hovers, its battery lets it wait no longer") {
    // Out 10 with 1 aboard, hover 5 in service, home 20: 1000 - 90 - 100 - 200 are left, 30 at 20.
    const VehicleType type = powered();
    CHECK(Flight{type, place(), 10, 20}.left() == 610);
    CHECK(Flight{type, place(), 10, 20}.held_takeoff(0) == 75 - (35 + 30));
    CHECK(Flight{type, place(), 10, 20}.can_wait(30));
    CHECK_FALSE(Flight{type, place(), 10, 20}.can_wait(31));
    CHECK(Flight{type, place(), 10, 20}.left_after(30, 55, 80) == 610 - 10 * 20 - 5 * 20);
    VehicleType landing = type;
    landing.lands = 1;
    CHECK(Flight{landing, place(), 10, 20}.held_takeoff(0) == 0);
}

TEST_CASE("all launches of a trip but the first may take longer") {
    VehicleType type = endurant(100);
    CHECK_FALSE(launches_differ(type));
    CHECK(gone_by(type, 40) == 40);
    type.relaunch_duration = 7;
    CHECK(take_off(type, 40, 0) == 42);
    CHECK(take_off(type, 40, 1) == 47);
    CHECK(launch_begin(type, 47, 3) == 40);
    CHECK(gone_by(type, 40) == 47);
    CHECK(handling_duration(type) == 10);
    type.charge = 1;
    CHECK(gone_by(type, 40) == far);
}

TEST_CASE("waiting for the recovery counts where it is said to") {
    VehicleType type = endurant(20);
    CHECK(within_endurance(type, 10, 30, 50));
    type.waiting_counts = 1;
    CHECK_FALSE(within_endurance(type, 10, 30, 31));
}

TEST_CASE("an endurance allows an interval of arrivals at the beginning of a block") {
    for (const TimeSegment takeoff : {TimeSegment{0, 0}, TimeSegment{3, 20}, TimeSegment{10, 5}}) {
        for (const TimeSegment more :
             {TimeSegment{0, 0}, TimeSegment{4, 15}, TimeSegment{15, 4}, TimeSegment{20, 20}}) {
            const TimeSegment back = {takeoff.d + more.d, takeoff.c + more.c};
            const auto [first, last] = lasting_within(10, takeoff, back);
            for (Int time = -40; time < 60; ++time) {
                const Int aloft = back.at(time) - takeoff.at(time);
                CHECK((first <= time && time <= last) == (aloft <= 10));
            }
        }
    }
}

}  // namespace
}  // namespace tandem
