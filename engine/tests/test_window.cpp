#include <doctest/doctest.h>

#include <array>

#include "rules/window.h"

namespace tandem {
namespace {

// Served for 5 from 10 to 20, at most 8 later at a price.
const Node single = {10, 28, 5, 0, 20, {}};

// Served for 5 from 10 to 20, from 30 to 40 and from 60 to 70, never later.
const std::array<Node, 3> several = {{
    {10, 70, 5, 0, 70, {}},
    {30, far, 0, 0, 20, {}},
    {60, far, 0, 0, 40, {}},
}};

Windows one_window() { return View<const Node, 1>(&single, {1}); }
Windows three_windows() { return View<const Node, 1>(several.data(), {3}); }

TEST_CASE("who comes early waits, who comes late is late, then too late") {
    const Windows place = one_window();
    CHECK(place.start_of_service(4) == 10);
    CHECK(place.waiting(4) == 6);
    CHECK(place.end_of_service(14) == 19);
    CHECK(place.lateness(20) == 0);
    CHECK(place.lateness(21) == 1);
    CHECK_FALSE(place.too_late(28));
    CHECK(place.too_late(29));
    CHECK(place.width() == 10);
}

TEST_CASE("who comes between two windows waits for the next") {
    const Windows place = three_windows();
    CHECK(place.start_of_service(20) == 20);
    CHECK(place.start_of_service(21) == 30);
    CHECK(place.start_of_service(41) == 60);
    CHECK(place.start_of_service(65) == 65);
    CHECK(place.closing() == 70);
    CHECK(place.width() == 30);
}

TEST_CASE("rows behind a customer's last gap say nothing") {
    std::array<Node, 3> rows = several;
    rows[0].window_latest = rows[0].arrival_limit = 40;
    rows[2] = {0, far, 0, 0, far, {}};
    const Windows place(View<const Node, 1>(rows.data(), {3}));
    CHECK(place.start_of_service(35) == 35);
    CHECK(place.width() == 20);
}

TEST_CASE("the last arrival that will do is in the window before a gap") {
    const Windows place = three_windows();
    CHECK(place.latest_arrival(40) == 35);
    CHECK(place.latest_arrival(34) == 20);
    CHECK(place.latest_arrival(90) == 70);
    CHECK(place.in_same_window(12) == 20);
    CHECK(place.in_same_window(21) == 40);
    CHECK(place.latest_free_arrival(12, 90) == 70);
    CHECK(one_window().as_late(24) == 24);
}

TEST_CASE("a time segment holds for all arrivals at the beginning of a block") {
    for (const Windows place : {one_window(), three_windows()}) {
        for (Int time = 0; time < 80; time += 3) {
            for (const TimeSegment at :
                 {TimeSegment{0, 0}, TimeSegment{7, 22}, TimeSegment{20, 5}, TimeSegment{2, 45}}) {
                if (place.too_late(at.c)) continue;
                const TimeSegment start = place.start_within(time, at);
                const auto [first, last] = place.allowed_within(time, at);
                const Int opens = place.opening(at.at(time));
                for (Int other = 0; other < 90; ++other) {
                    const Int arrival = at.at(other);
                    const bool same = place.opening(arrival) == opens;
                    const bool allowed = same && !place.too_late(arrival);
                    CHECK((first <= other && other <= last) == allowed);
                    if (allowed) CHECK(start.at(other) == place.start_of_service(arrival));
                }
            }
        }
    }
}

}  // namespace
}  // namespace tandem
