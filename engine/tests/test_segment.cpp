#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <optional>

#include "randomness.h"
#include "rules/segment.h"

namespace tandem {
namespace {

constexpr Int num_stops = 4;
constexpr Int last = 110;  // end of all routes

// A row of stops with a window each, and how long the legs to them and the one behind them take.
struct Row {
    std::array<Node, num_stops> node;
    std::array<Int, num_stops + 1> gap;

    Windows place(Int stop) const { return View<const Node, 1>{&node[std::size_t(stop)], {1}}; }
    Int gap_before(Int stop) const { return gap[std::size_t(stop)]; }

    // A route that leaves at `time`, up to the leg to a stop; none if somebody is served too late.
    std::optional<PaidFront> front(Int time, Int stop) const {
        PaidFront front{time, 0, far};
        for (Int p = 0; p < stop; ++p) {
            if (!front.serve(place(p), gap_before(p))) return std::nullopt;
        }
        front.drive(gap_before(stop));
        return front;
    }

    // It from the coming to a stop on, which ends by `latest`.
    PaidRear rear(Int stop, Int latest) const {
        PaidRear rear{latest, none, 0, none};
        for (Int p = num_stops - 1; p >= stop; --p) {
            rear.drive(gap_before(p + 1));
            const Node& here = node[std::size_t(p)];
            const Int service = here.service_duration;
            rear.pass({service, here.window_earliest + service}, {none, here.arrival_limit});
        }
        return rear;
    }
};

Row draw_row(std::uint64_t& state) {
    const View<std::uint64_t, 1> rng{&state, {1}};
    Row row;
    for (Node& node : row.node) {
        const Int opens = below(rng, 60), closes = opens + below(rng, 40);
        node = {opens, closes, below(rng, 8), 0, closes, {}};
    }
    for (Int& gap : row.gap) gap = below(rng, 20);
    return row;
}

// The routes of some rows on which nobody is served too late who leaves at 0.
template <class Visit>
void for_each_route(std::uint64_t state, const Visit& visit) {
    Int found = 0;
    for (Int draw = 0; draw < 5000; ++draw) {
        const Row row = draw_row(state);
        const auto driven = row.front(0, num_stops);
        if (!driven || driven->time > last) continue;
        ++found;
        visit(row, *driven);
    }
    CHECK(found > 200);
}

TEST_CASE("a route is the same wherever its front and its rear are joined") {
    for_each_route(5, [](const Row& row, const PaidFront&) {
        for (const Int leave : {0, 4, 9, 20, 40}) {
            const auto driven = row.front(leave, num_stops);
            for (Int stop = 0; stop < num_stops; ++stop) {
                const auto front = row.front(leave, stop);
                const auto whole = front ? join(*front, row.rear(stop, last)) : std::nullopt;
                REQUIRE(whole.has_value() == (driven && driven->time <= last));
                if (!whole) continue;
                CHECK(whole->end == driven->time);
                CHECK(whole->depart == std::min(whole_of(*driven).depart, last - driven->busy));
            }
        }
    });
}

TEST_CASE("whoever departs as late as a whole route tells is not later anywhere") {
    for_each_route(6, [](const Row& row, const PaidFront& driven) {
        const Whole whole = whole_of(driven);
        const auto held = row.front(whole.depart, num_stops);
        REQUIRE(held);
        CHECK(held->time == whole.end);
        const auto later = row.front(whole.depart + 1, num_stops);
        CHECK((!later || later->time > whole.end));
    });
}

TEST_CASE("a rear may be reached as late as it tells, and no later") {
    for_each_route(7, [](const Row& row, const PaidFront&) {
        Rear rear{last};
        for (Int p = num_stops - 1; p >= 0; --p) {
            rear.serve(row.place(p), row.gap_before(p + 1));
        }
        CHECK(rear.latest == row.rear(0, last).latest);
        rear.drive(row.gap_before(0));
        const auto driven = row.front(rear.latest, num_stops);
        const auto later = row.front(rear.latest + 1, num_stops);
        CHECK((driven && driven->time <= last));
        CHECK((!later || later->time > last));
    });
}

}  // namespace
}  // namespace tandem
