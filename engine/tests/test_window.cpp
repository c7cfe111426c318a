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

NodeRows one_window() { return {&single, {1}}; }
NodeRows three_windows() { return {several.data(), {3}}; }

Int with(const Pair& pair, Int time) { return std::max(time + pair.d, pair.c); }

TEST_CASE("who comes early waits, who comes late is late, then too late") {
    const NodeRows place = one_window();
    CHECK(start_of_service(place, 4) == 10);
    CHECK(waiting(place, 4) == 6);
    CHECK(end_of_service(place, 14) == 19);
    CHECK(lateness(place, 20) == 0);
    CHECK(lateness(place, 21) == 1);
    CHECK_FALSE(too_late(place, 28));
    CHECK(too_late(place, 29));
    CHECK(width(place) == 10);
}

TEST_CASE("who comes between two windows waits for the next") {
    const NodeRows place = three_windows();
    CHECK(start_of_service(place, 20) == 20);
    CHECK(start_of_service(place, 21) == 30);
    CHECK(start_of_service(place, 41) == 60);
    CHECK(start_of_service(place, 65) == 65);
    CHECK(closing(place) == 70);
    CHECK(width(place) == 30);
}

TEST_CASE("rows behind a customer's last gap say nothing") {
    std::array<Node, 3> rows = several;
    rows[0].window_latest = rows[0].arrival_limit = 40;
    rows[2] = {0, far, 0, 0, far, {}};
    const NodeRows place(rows.data(), {3});
    CHECK(start_of_service(place, 35) == 35);
    CHECK(width(place) == 20);
}

TEST_CASE("the last arrival that will do is in the window before a gap") {
    const NodeRows place = three_windows();
    CHECK(latest_arrival(place, 40) == 35);
    CHECK(latest_arrival(place, 34) == 20);
    CHECK(latest_arrival(place, 90) == 70);
    CHECK(in_same_window(place, 12) == 20);
    CHECK(in_same_window(place, 21) == 40);
    CHECK(latest_free_arrival(place, 12, 90) == 70);
    CHECK(as_late(one_window(), 24) == 24);
}

TEST_CASE("a pair stands for all arrivals at the beginning of a block") {
    for (const NodeRows place : {one_window(), three_windows()}) {
        for (Int time = 0; time < 80; time += 3) {
            for (const Pair at : {Pair{0, 0}, Pair{7, 22}, Pair{20, 5}, Pair{2, 45}}) {
                if (too_late(place, at.c)) continue;
                const Pair start = start_within(place, time, at.d, at.c);
                const auto [first, last] = allowed_within(place, time, at.d, at.c);
                const Int opens = opening(place, with(at, time));
                for (Int other = 0; other < 90; ++other) {
                    const Int arrival = with(at, other);
                    const bool same = opening(place, arrival) == opens;
                    const bool allowed = same && !too_late(place, arrival);
                    CHECK((first <= other && other <= last) == allowed);
                    if (allowed) CHECK(with(start, other) == start_of_service(place, arrival));
                }
            }
        }
    }
}

}  // namespace
}  // namespace tandem
