// Timing of a block: the stops of a truck from one where all drones are aboard to the next.
//
// By time segments `(d, c)`, which docs/develop/route-times.md derives.
#pragma once

#include "rules/driving.h"
#include "rules/hours.h"
#include "rules/segment.h"
#include "rules/start.h"
#include "search/route/drone_data.h"
#include "search/route/lags.h"

namespace tandem {

// What is known of a block that the truck reaches at `time`, as far as it is timed.
struct BlockSums {
    Int time = 0;
    Int free_d = 0;  // when the truck has nothing to do for drones
    Int free_c = 0;
    Int served_d = 0;  // when its own service at the stop is over
    Int served_c = 0;
    Int hi = far;  // the last arrival that keeps all rules
    Int lo = none;
    Int dep = far;         // the last that costs nothing
    Int oldest = 0;        // sortie not yet over
    Int flying = 0;        // drones
    Int launched = 0;      // on the trip so far
    Int first_sortie = 0;  // of the trip
    Int awaited = 0;       // on the route so far: how long launches wait for batteries
    Driver driver{};       // as it is left, where that is followed
};

// A truck of a type, and what it meets on its way, looked up once for a route.
struct Truck {
    Truck(const ProblemData& data_of_it, Int row) : data(data_of_it), k(row) {}

    const ProblemData& data;
    Int k;
    const VehicleType& type = data.type[k];
    NodeTable places = data.place.by_truck(type);  // as this type meets them
    NodeTable own = data.place[0];  // by the service durations that are customers' own
    // What its first drones meet.
    DroneData drones = drone_data_at(data, first_drone_row(data.type, k));
    Speeds speeds = speeds_of(data, k);
    bool alike = !are_several(type);            // all of its drones
    bool resting = rests_in_time(type);         // whether times hang on where its driver pauses
    bool follows = follows_driver(type);        // and on how far it has come before
    bool steady = is_steady(type) && !resting;  // whether all lasts as long at any time
    Int begin = none;                           // of the route, where times hang on pauses

    // Return what the drone of a sortie meets.
    DroneData drone_data(const Sortie& sortie) const {
        return alike ? drones : drone_data_at(data, row_of_drone(data.type, k, sortie.drone));
    }

    // Return when the truck arrives at the beginning of a block, at `time`.
    TimeSegment origin(Int time) const {
        return steady ? TimeSegment{0, none} : TimeSegment{none, time};
    }

    // Return when a leg of `duration` at full speed ends, from `node` to another.
    TimeSegment travel(Int node, Int to, Int duration, TimeSegment leave) const {
        if (steady) return {leave.d + duration, leave.c + duration};
        const Int arrival = leg_end(type, speeds.times, speeds.factors, duration, leave.c);
        return {none, arrival + setup_beside(type, data.setup, node, to)};
    }

    // Return how long a leg from a stop to a node is, without rests in its gap and setup.
    Int duration_of_leg(const Stop& from, Int to) const {
        return from.gap - (is_steady(type) ? setup_after(data.setup, from.node, to) : 0);
    }

    // Return how long its driver is at other work at a stop, however long he waits.
    Int stood_at(const Stop& stop) const {
        if (stop.kind == customer_stop) return places[stop.node].service_duration();
        return stop.kind == start_stop && stop.trip > 0 ? type.reload_duration : 0;
    }

    // Whether when a leg ends that begins at a stop hangs on pauses.
    bool pauses(const Stop& from) const { return follows || (resting && from.rests != 0); }

    // Return a leg from a stop to a node, left at `leave`, with the breaks there.
    PausedLeg leg_behind(const Stop& from, Int to, Int leave) const {
        return {speeds,
                Rests(from.rests),
                begin,
                leave,
                duration_of_leg(from, to),
                stood_at(from),
                setup_after(data.setup, from.node, to)};
    }

    // Return when it comes from a stop to a node, with the breaks between; `far` if one can't be.
    //
    // In place: what is counted of its driver, where that is followed.
    Int come(const Stop& from, Int to, Int leave, Driver& driver) const {
        return leg_behind(from, to, leave).end(driver).value_or(far);
    }

    // Return when a stop is left that is reached at an instant, as far as it is served alone.
    Int served_at(const Stop& stop, Int time) const {
        return has_window(stop) ? places[stop.node].end_of_service(time) : time;
    }

    // Return when what it does at a stop by itself ends.
    TimeSegment serve(const Stop& stop, Int time, TimeSegment reached) const {
        if (has_window(stop)) {
            const Windows place = places[stop.node];
            return behind(place.start_within(time, reached), place.service_duration());
        }
        if (stop.kind == start_stop) {
            const Int ready = std::max(reached.c, std::max(stop.release, stop.hold));
            return {reached.d, leaves_first(type, ready)};
        }
        return {reached.d, let_in(type, places, stop.node, reached.c)};
    }

    // Write the block of a stop without launches, reached at `time`. In place.
    void time_alone(Stop& stop, Int time) const {
        const auto [d, c] = serve(stop, time, origin(time));
        stop.d = d;
        stop.c = c;
        stop.lo = none;
        stop.hi = far;
        stop.dep = far;
        if (has_window(stop)) {
            const Windows place = own[stop.node];
            stop.hi = place.latest_allowed();
            stop.dep = place.in_same_window(time);
        } else if (stop.kind == end_stop) {
            stop.hi = last_end(type);
        }
        if (keeps_hours(type) && !has_window(stop)) {
            const Int closes = stop.kind == end_stop ? closes_at(type, places, stop.node)
                                                     : leaves_by(type, places, stop.node);
            stop.dep = closes - d;
            stop.hi = c > closes ? none : std::min(stop.hi, stop.dep);
        }
    }
};

// Have the sorties of a route wait for their launches. In place.
//
// And write how long each is held back: until windows let it be back within its limit. Where some
// have several, that hangs on when it could begin, and is for `soonest_takeoff`.
void make_ready(const Truck& truck, View<const Stop, 1> stops, View<Sortie, 1> sorties);

// Write the block from stop `first` of a route, which the truck reaches at `sums.time`. In place.
//
// `sums.oldest` is the first sortie not yet over. Returns the block's last stop, -1 if not allowed.
Int time_block(const Truck& truck, View<Stop, 1> stops, View<Sortie, 1> sorties, Int first,
               BlockSums& sums);

// Write the block from stop `first`, to which a truck has come, and go through it. In place.
//
// Sorties before `sums.oldest` are over. Returns the block's last stop, -1 if not allowed.
inline Int pass_block(const Truck& truck, View<Stop, 1> stops, View<Sortie, 1> sorties, Int first,
                      BlockSums& sums, PaidFront& front) {
    Stop& stop = stops[first];
    const Int time = front.time;
    Int last = first;
    if (stop.kind == start_stop) {
        sums.launched = 0;
        sums.first_sortie = sums.oldest;
    }
    if (sums.oldest < sorties.size() && sorties[sums.oldest].launch == first) {
        sums.time = time;
        last = time_block(truck, stops, sorties, first, sums);
        if (last < 0) return -1;
    } else {
        truck.time_alone(stop, time);
        stop.flying = stop.idle = 0;
        stop.block = first;
        if (lags_count(truck.data)) {
            const Int leave = await_others(truck, stops, sorties, first, time);
            if (leave == far) return -1;
            stop.c = std::max(stop.c, leave);
        }
    }
    if (time > stop.hi || time < stop.lo) return -1;
    stop.arrival = time;
    stop.before = front.busy;
    stop.last = last;
    front.pass({stop.d, stop.c}, stop.dep);
    stops[last].leave = front.time;
    stops[last].cum = front.busy;
    stops[last].depart = front.depart;
    return last;
}

}  // namespace tandem
