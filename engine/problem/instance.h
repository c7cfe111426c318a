// Problems as Python packed them, a row per problem.
#pragma once

#include "include/tandem.h"
#include "view.h"

namespace tandem {

using Size = tandem_size;
using Node = tandem_node;
using Setup = tandem_setup;
using Price = tandem_price;
using Goods = tandem_goods;
using Hub = tandem_hub;
using Pair = tandem_pair;
using Lag = tandem_lag;
using Span = tandem_span;
using VehicleType = tandem_vehicle_type;
using Rate = tandem_rate;
using Cost = tandem_cost;
using LegLaw = tandem_leg_law;
using Point = tandem_point;

using Int = std::int64_t;

constexpr Int far = Int{1} << 58;       // an instant later than any that occurs
constexpr Int none = -far;              // and one earlier
constexpr Int dimensions_per_tier = 3;  // how many dimensions of load are looked at together
constexpr Int max_tiers = 3;            // for all eight dimensions

constexpr Int unlimited = Int{1} << 42;        // no limit on a time (ms) or a distance (mm)
constexpr Int unreachable_leg = Int{1} << 50;  // duration and distance of what can't be flown
constexpr std::int32_t no_leg = INT32_MAX;     // the same where legs are held in 32 bits
constexpr Int full_speed = 1'000'000;  // factor at which a leg takes the duration its table states

constexpr Int no_profile = -1;  // `speed_changes` of who drives as fast all day
constexpr Int no_row = -1;      // `drone_row` behind the last

// `pickup_order`: in any order, after all deliveries of which there is one, and so where there may
// be none, as some came before the trip began or all is one stack.
constexpr Int pickups_any = 0;
constexpr Int pickups_last = 1;
constexpr Int pickups_begun = 2;

struct Legs {
    View<const std::int32_t, 4> stated;  // (travel, origin, to, 2); none where some are computed
    View<const std::int64_t, 5>
        table;  // (direction, table, node, node, 2); one direction if they are the same back
    View<const Point, 1> point;  // (node,)
    View<const LegLaw, 1> law;   // (travel,)
};

inline Legs legs_of(const tandem_legs& from) {
    return {from.stated, from.table, from.point, from.law};
}

struct Instance {
    View<const Size, 1> size;  // (problem,)
    View<const Node, 4> node;  // (problem, variant, node, 1 + gaps)
    View<const std::int64_t, 4>
        amount;  // (problem, node, tier, entry); no tiers where the demand of nodes tells all
    View<const Price, 2> price;                   // (problem, node)
    View<const Goods, 2> goods;                   // (problem, node), or (problem, 0)
    View<const Setup, 2> setup;                   // (problem, node), or (problem, 0)
    View<const std::int64_t, 2> max_time_aboard;  // (problem, node) ms, FAR without limit, or
                                                  // (problem, 0) if nobody has one
    View<const Pair, 2> pair;                     // (problem, node), or (problem, 0)
    View<const std::int64_t, 3> max_between;      // (problem, type, node) ms from a pickup to its
                                                  // delivery, or (problem, 0, 0) if none is limited
    View<const Lag, 3> lag;     // (problem, node, rank), or (problem, 0, 0) if nobody has one
    View<const Lag, 3> across;  // (problem, node, rank) by any vehicle, or (problem, 0, 0) likewise
    View<const double, 3> vehicle_cost;  // (problem, type, node) of being served by it, or
                                         // (problem, 0, 0) if nobody states any
    View<const bool, 2> no_launch;  // (problem, node) no drone takes off or is recovered there, or
                                    // (problem, 0) where any may
    View<const std::int64_t, 2> zones;  // (problem, node) with hours that hold it, as bits, or
                                        // (problem, 0) where there are none
    View<const Hub, 2> hub;             // (problem, depot), or (problem, 0) where all have enough
    View<const VehicleType, 2> type;    // (problem, row); trucks first, as many as `size` says
    View<const Rate, 2> rate;           // (problem, row)
    View<const bool, 3> reload;  // (problem, type, node) where a trip may end and the next begin
    View<const bool, 3>
        can_drive;  // (problem, type, node) table, kind, skills and capacity allow a truck
    View<const bool, 3> can_fly;                 // (problem, type, node) likewise for its drones
    View<const std::int64_t, 3> profile_time;    // (problem, type, change)
    View<const std::int64_t, 3> profile_factor;  // (problem, type, change + 1)
    View<const std::int64_t, 4> duration;        // (problem, travel, node, node)
    View<const std::int64_t, 4> distance;        // (problem, travel, node, node)
    View<const double, 1> unassigned_cost;  // (problem,) of whoever it costs least to leave out
    View<const double, 2>
        unassigned_more;  // (problem, node) what leaving out another costs above that
    View<const std::int64_t, 3>
        neighbour;  // (problem, node, rank) nearest customers first, -1 behind the last
};

inline Instance instance_of(const tandem_instance& from) {
    return {from.size,
            from.node,
            from.amount,
            from.price,
            from.goods,
            from.setup,
            from.max_time_aboard,
            from.pair,
            from.max_between,
            from.lag,
            from.across,
            from.vehicle_cost,
            from.no_launch,
            from.zones,
            from.hub,
            from.type,
            from.rate,
            from.reload,
            from.can_drive,
            from.can_fly,
            from.profile_time,
            from.profile_factor,
            from.duration,
            from.distance,
            from.unassigned_cost,
            from.unassigned_more,
            from.neighbour};
}

}  // namespace tandem
