// Timing of a block: the stops of a truck from one where all drones are aboard to the next.
//
// By pairs `(d, c)`, which docs/search.md derives under "Times on a route".
#pragma once

#include <algorithm>

#include "rules/clock.h"
#include "rules/leg.h"
#include "rules/start.h"
#include "rules/window.h"
#include "search/route/layout.h"

namespace tandem {

// Return the pair of an arrival at `time`, at the beginning of a block.
inline Pair origin(const World& world, Int k, Int time) {
    return is_steady(world.type[k]) ? Pair{0, none} : Pair{none, time};
}

// Return the pair at the end of a leg of `duration` at full speed, from `node` to another.
inline Pair travel(const World& world, Int k, Int node, Int to, Int duration, Int d, Int c) {
    const VehicleType& type = world.type[k];
    if (is_steady(type)) return {d + duration, c + duration};
    const Int arrival = leg_end(type, world.profile_time[k], world.profile_factor[k], duration, c);
    return {none, arrival + setup_beside(type, world.setup, node, to)};
}

// Return the pair at the end of what a truck does at a stop by itself, reached at (d, c).
inline Pair serve(const World& world, Int k, const Stop& stop, Int time, Int d, Int c) {
    if (stop.kind == customer_stop) {
        const NodeRows place = places_of(world.place, world.type[k])[stop.node];
        const auto [start_d, start_c] = start_within(place, time, d, c);
        return {start_d + service_duration(place), start_c + service_duration(place)};
    }
    if (stop.kind == start_stop) {
        const Int ready = std::max(c, std::max(stop.release, stop.hold));
        return {d, leaves_first(world.type[k], ready)};
    }
    return {d, c};
}

// Write the block of a stop without launches, reached at `time`. In place.
inline void plain_block(const World& world, Int k, Stop& stop, Int time) {
    const auto [d, c] = origin(world, k, time);
    const auto [end_d, end_c] = serve(world, k, stop, time, d, c);
    stop.d = end_d;
    stop.c = end_c;
    stop.lo = none;
    stop.hi = far;
    stop.dep = far;
    if (stop.kind == customer_stop) {
        const NodeRows place = world.place[0][stop.node];
        stop.hi = latest_allowed(place);
        stop.dep = in_same_window(place, time);
    } else if (stop.kind == end_stop) {
        stop.hi = world.type[k].shift_latest;
    }
}

// Have the sorties of a route wait for their launches. In place.
//
// And write how long each is held back: until windows let it be back within its limit. Where some
// have several, that hangs on when it could begin, and is for `soonest_takeoff`.
void make_ready(const World& world, Int k, View<const Stop, 1> stops, View<Sortie, 1> sorties,
                Int count);

// Write the block from stop `first`, which the truck reaches at `time`. In place.
//
// `oldest` is the first sortie not yet over. Returns the block's last stop, -1 if not allowed.
Int time_block(const World& world, Int k, View<Stop, 1> stops, Int length, View<Sortie, 1> sorties,
               Int count, Int first, Int oldest, Int time, BlockSums& acc);

}  // namespace tandem
