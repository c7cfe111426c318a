#include "tests/rules.h"

#include <chrono>
#include <initializer_list>
#include <vector>

#include "rules/clock.h"
#include "rules/flight.h"
#include "rules/leg.h"
#include "rules/load.h"
#include "rules/shift.h"
#include "rules/start.h"

using namespace tandem;

namespace {

Windows rows_of(const tandem_node* place, Int rows) { return View<const Node, 1>(place, {rows}); }

void write(Int* found, std::initializer_list<Int> values) {
    std::copy(values.begin(), values.end(), found);
}

}  // namespace

void service_at(const tandem_node* place, int64_t rows, int64_t arrival, int64_t* found) {
    const Windows at = rows_of(place, rows);
    write(found, {at.start_of_service(arrival), at.end_of_service(arrival), at.waiting(arrival),
                  at.lateness(arrival), at.too_late(arrival)});
}

void last_arrivals(const tandem_node* place, int64_t rows, int64_t arrival, int64_t leave,
                   int64_t* found) {
    const Windows at = rows_of(place, rows);
    write(found, {at.as_late(arrival), at.latest_arrival(leave),
                  at.latest_free_arrival(arrival, leave), at.in_same_window(arrival)});
}

void within_block(const tandem_node* place, int64_t rows, int64_t time, int64_t d, int64_t c,
                  int64_t* found) {
    const auto [start_d, start_c] = rows_of(place, rows).start_within(time, {d, c});
    const auto [first, last] = rows_of(place, rows).allowed_within(time, {d, c});
    write(found, {start_d, start_c, first, last});
}

void window_of(const tandem_node* place, int64_t rows, int64_t arrival, int64_t* found) {
    *found = rows_of(place, rows).opening(arrival);
}

void extent_of(const tandem_node* place, int64_t rows, int64_t* found) {
    write(found, {rows_of(place, rows).closing(), rows_of(place, rows).width()});
}

void begun_at(const tandem_vehicle_type* type, int64_t time, int64_t* found) {
    const Int leave = leaves_first(*type, time);
    write(found, {leave, counted_from(*type, leave), has_begun(*type)});
}

void worked_until(const tandem_vehicle_type* type, int64_t departure, int64_t end, int64_t stops,
                  int64_t* found) {
    const Int working = end - counted_from(*type, departure);
    const bool allowed = may_end(*type, end) && may_work(*type, working);
    write(found, {paid_work(*type, end, working).overtime, allowed, allows_stops(*type, stops)});
}

void sorties_allowed(const tandem_vehicle_type* type, int64_t count, int64_t* found) {
    *found = allows_sorties(*type, count);
}

void energy_taken(const tandem_vehicle_type* type, int64_t weight, int64_t duration,
                  int64_t* found) {
    const Int left = battery_of(*type);
    write(found,
          {after_leg(*type, left, weight, duration), after_hovering(*type, left, weight, duration),
           longest_hover(*type, left, weight)});
}

void battery_limits(const tandem_vehicle_type* type, int64_t* found) {
    write(found, {is_limited(*type), hovers_at_customers(*type)});
}

void flown(const tandem_vehicle_type* type, const tandem_node* place, int64_t rows, int64_t begin,
           int64_t out, int64_t home, int64_t* found) {
    const Windows at = rows_of(place, rows);
    const Int takeoff = Flight{*type, at, out, home}.held_takeoff(take_off(*type, begin, 0));
    const Int back = at.end_of_service(takeoff + out) + home;
    write(found, {takeoff, takeoff + out, back, recovery_end(*type, back)});
}

void endures(const tandem_vehicle_type* type, int64_t takeoff, int64_t back, int64_t begin,
             int64_t* found) {
    *found = within_endurance(*type, takeoff, back, begin);
}

void lasts(const tandem_vehicle_type* type, const tandem_node* place, int64_t rows, int64_t out,
           int64_t home, int64_t* found) {
    write(found, {Flight{*type, rows_of(place, rows), out, home}.can_serve(),
                  unreachable(out) || unreachable(home)});
}

void enduring(const tandem_vehicle_type* type, int64_t takeoff_d, int64_t takeoff_c, int64_t d,
              int64_t c, int64_t* found) {
    const auto [first, last] = lasting_within(endurance_of(*type), {takeoff_d, takeoff_c}, {d, c});
    write(found, {first, last});
}

void battery_left(const tandem_vehicle_type* type, const tandem_node* place, int64_t rows,
                  int64_t out, int64_t home, int64_t takeoff, int64_t served, int64_t begin,
                  int64_t* found) {
    *found = Flight{*type, rows_of(place, rows), out, home}.left_after(takeoff, served, begin);
}

void handled(const tandem_vehicle_type* type, int64_t time, int64_t launched, int64_t* found) {
    const Int takeoff = take_off(*type, time, launched);
    write(found, {launch_begin(*type, takeoff, launched), takeoff - time, handling_duration(*type),
                  counted_until(*type, time, time + 1), launches_differ(*type)});
}

void demands_held(const tandem_vehicle_type* type, const tandem_node* places, int64_t count,
                  int64_t rows, int64_t* found) {
    const NodeTable all(View<const Node, 2>(places, {count, rows}));
    Amount load = nothing;
    for (Int index = 0; index < count - 1; ++index) load = plus(load, demand_of(all[index]));
    const Amount everything = plus(load, demand_of(all[count - 1]));
    write(found, {holds(*type, everything), fits(*type, load, all[count - 1]),
                  lifts(*type, everything, 0)});
}

void capacity_left(const tandem_vehicle_type* type, const tandem_node* place, int64_t* found) {
    const Amount capacity = capacity_of(*type), demand = demand_of(rows_of(place, 1));
    write(found, {within(demand, capacity), total(demand), total(minus(capacity, demand))});
}

void rooms_between(const tandem_vehicle_type* type, const int64_t* amounts, int64_t nodes,
                   int64_t tiers, const int64_t* route, int64_t length, int64_t more,
                   int64_t* found) {
    const View<const Int, 3> asked(amounts, {nodes, tiers, 8});
    std::vector<StopLoad> loads(std::size_t(tiers * (length + 2)));
    const View<StopLoad, 2> stops(loads.data(), {tiers, length + 2});
    bool allowed = true;
    for (Int tier = 0; tier < tiers; ++tier) {
        for (Int p = 1; p <= length; ++p) {
            const Int node = route[p - 1];
            add_left(stops(tier, p), delivered_of(asked, node, tier), total_delivered(asked, node));
            add_come(stops(tier, p), picked_of(asked, node, tier), total_picked(asked, node));
        }
        allowed = weigh_trip(*type, &stops(tier, 0), &stops(tier, 0) + length + 2, tier) && allowed;
    }
    found[0] = allowed;
    for (Int p = 0; p <= length; ++p) {
        found[p + 1] = has_room(*type, stops, p + 1, p, asked, more);
    }
}

void clocked(const tandem_vehicle_type* type, const int64_t* times, int64_t changes,
             const int64_t* factors, int64_t duration, int64_t time, int64_t* found) {
    const View<const Int, 1> when(times, {changes}), speed(factors, {changes + 1});
    write(found, {leg_end(*type, when, speed, duration, time),
                  leg_start(*type, when, speed, duration, time), is_steady(*type)});
}

void all_legs(const tandem_legs* legs, const tandem_legs* back, int64_t travel, int64_t nodes,
              int64_t* found) {
    const View<Int, 4> entry(found, {3, nodes, nodes, 2});
    const View<Int, 2> near(found + 3 * nodes * nodes * 2, {nodes, nodes});
    const auto note = [&](Int way, Int origin, Int to, const Leg& one) {
        write(&entry(way, origin, to, 0), {one.duration, one.distance});
    };
    const TravelLegs every = legs_of(*legs, travel);
    for (Int here = 0; here < nodes; ++here) {
        const LegRow onward = legs_from(*legs, travel, here);
        const LegRow inward = legs_to(*back, travel, here);
        for (Int there = 0; there < nodes; ++there) {
            note(0, here, there, leg(every, here, there));
            note(1, here, there, leg_to(onward, there));
            note(2, there, here, leg_from(inward, there));
            near(here, there) = nearness(inward, onward, there);
        }
    }
}

void all_distances(const tandem_legs* legs, const tandem_legs* back, int64_t travel, int64_t nodes,
                   int64_t* found) {
    const View<Int, 3> entry(found, {2, nodes, nodes});
    for (Int here = 0; here < nodes; ++here) {
        const LegRow onward = legs_from(*legs, travel, here);
        const LegRow inward = legs_to(*back, travel, here);
        for (Int there = 0; there < nodes; ++there) {
            entry(0, here, there) = distance_to(onward, there);
            entry(1, there, here) = distance_from(inward, there);
        }
    }
}

void steady_clock_at(int64_t* found) {
    *found = std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}
