#include "policy/features.h"

#include "guard.h"
#include "policy/lookahead.h"
#include "simulation/aboard.h"
#include "simulation/simulator.h"
#include "simulation/vehicle_log.h"

namespace tandem {
namespace {

constexpr double ms_per_hour = 3'600'000;
constexpr double mm_per_km = 1'000'000;

constexpr double furthest = 5;  // what ways and durations are clipped to, by the problem's unit
constexpr Int most_trips = 4;   // trips left beyond these are not told apart

double quotient(Int part, Int whole) { return double(part) / double(whole); }

// Raise a feature to a value, if that is more.
void raise(float& feature, double value) { feature = to_float(std::max(double(feature), value)); }

// The units of a problem.
Unit unit_of(const Scales& scale, Int b) { return {scale.time[b], scale.near[b], scale.cost[b]}; }

// Which part of a limit is used, 2 at most; 0 where there is no limit.
double share(Int used, Int limit) {
    return limit >= unlimited ? 0 : std::min(quotient(used, std::max(Int{1}, limit)), 2.0);
}

// What the vehicle could still carry in the first dimension, from here on.
Int room(const VehicleType& type, const Vehicle& vehicle) {
    return std::min(vehicle.load[0], type.capacity[0] - vehicle.aboard[0]);
}

// How many customers the truck may still serve on its trip.
//
// Without drones, that is, which may serve others whatever it has served.
Int stops_left(const VehicleType& type, const VehicleLog& log, bool idle) {
    const Int most = type.drones > 0 ? unlimited : most_stops(type);
    if (most >= unlimited || idle) return most;
    return most - (log.count.stops - log.trip[log.count.trips - 1].first_stop - 1);
}

// Which part of the customers that a trip may have is left, 1 if any number may be.
double share_of_stops(const VehicleType& type, const VehicleLog& log, bool idle) {
    const Int stops = stops_left(type, log, idle);
    return stops >= unlimited ? 1 : quotient(stops, std::max(Int{1}, most_stops(type)));
}

// The open vehicle of a rollout, and what its candidates have in common.
struct Situation {
    Duty duty;
    const Rate& rate;
    Int since;    // when the trip begins
    Int nearest;  // shortest drive to a candidate
};

// Describe which share of the room a customer takes in one tier, both ways.
void describe_amounts(const Situation& now, Int node, Int tier_number, ActionFeatures& feature) {
    const auto& [setting, unit, vehicle, log, served] = now.duty;
    const Amount delivered = delivered_of(setting.amount, node, tier_number);
    const Amount picked = picked_of(setting.amount, node, tier_number);
    const Amount whole = capacity_in(setting.type, tier_number);
    const Amount left = part_of(vehicle.load, tier_number);
    const Amount aboard = part_of(vehicle.aboard, tier_number);
    for (std::size_t d = 0; d < whole.size(); ++d) {
        const Int most = std::max(Int{1}, whole[d]);
        raise(feature.load_share,
              std::max(quotient(delivered[d], std::max(Int{1}, left[d])),
                       quotient(picked[d], std::max(Int{1}, whole[d] - aboard[d]))));
        raise(feature.capacity_share,
              std::max(quotient(delivered[d], most), quotient(picked[d], most)));
    }
}

// Describe which share of the load left, and of the capacity, a customer asks for.
void describe_demand(const Situation& now, Int node, ActionFeatures& feature) {
    const Setting& setting = now.duty.setting;
    const Amount demand = demand_of(setting.node[node]);
    for (std::size_t d = 0; d < demand.size(); ++d) {
        if (demand[d] <= 0) continue;
        raise(feature.load_share, quotient(demand[d], now.duty.vehicle.load[d]));
        raise(feature.capacity_share, quotient(demand[d], setting.type.capacity[d]));
    }
    for (Int t = 0; t < num_tiers(setting.amount); ++t) describe_amounts(now, node, t, feature);
}

// Describe what serving a customer next means, by truck or drone alike.
void describe_customer(const Situation& now, Int node, const Outlook& outlook,
                       ActionFeatures& feature) {
    const auto& [setting, unit, vehicle, log, served] = now.duty;
    const Windows place = setting.node[node];
    const Price& price = setting.price[node];
    const Int wait = outlook.start - outlook.arrival;
    const Int late = place.lateness(outlook.arrival);
    feature.waiting = to_float(ratio(wait, unit.time));
    double left = slack(place.closing(), outlook.arrival, unit.time);
    feature.window_slack = to_float(left);
    if (some_limited(setting.max_time_aboard)) {
        const Int excess = excess_aboard(setting.max_time_aboard, node, now.since, outlook.start);
        left = std::min(double(feature.window_slack), slack(0, excess, unit.time));
        feature.window_slack = to_float(left);
    }
    if (some_limited(setting.between) && is_delivery(setting.pair, node)) {
        const Int excess = excess_under_way(setting, log, node, log.count.stops, outlook.start);
        left = std::min(double(feature.window_slack), slack(0, excess, unit.time));
        feature.window_slack = to_float(left);
    }
    const double hourly = double(late) * price.lateness + double(wait) * price.waiting;
    const double once = once_late_cost(price, place, outlook.arrival);
    feature.lateness = to_float(ratio(hourly / ms_per_hour + once, unit.cost));
    describe_demand(now, node, feature);
    feature.shift_slack = to_float(slack(usual_end(setting.type), outlook.end, unit.time));
    const Int departure = log.count.trips > 0 ? vehicle.departure_best : vehicle.next_start;
    feature.working_slack =
        to_float(slack(usual_working(setting.type), outlook.end - departure, unit.time));
    if (limits_travel(setting.type)) {
        const Int used = vehicle.legs.duration + travel_of(setting, vehicle.node, node) +
                         travel_of(setting, node, setting.type.ends_at);
        left = std::min(double(feature.working_slack),
                        slack(longest_travel(setting.type), used, unit.time));
        feature.working_slack = to_float(left);
    }
    feature.release_delay = to_float(ratio(release_of(place) - vehicle.next_start, unit.time));
}

// Describe the way to a place, at a price per km and per hour.
void describe_leg(const Unit& unit, Int duration, Int distance, double km, double hour,
                  ActionFeatures& feature) {
    feature.duration = to_float(std::min(double(duration) / unit.time, furthest));
    feature.nearness = to_float(ratio(duration, unit.near));
    const double cost = double(distance) / mm_per_km * km + double(duration) / ms_per_hour * hour;
    feature.cost = to_float(std::min(cost / unit.cost, furthest));
}

// Describe what a drive to a customer leaves of the trip, and its detour.
void describe_drive(const Situation& now, Int node, ActionFeatures& feature) {
    const auto& [setting, unit, vehicle, log, served] = now.duty;
    const VehicleType& type = setting.type;
    const Int here = vehicle.node, home = type.ends_at;
    const Int way = setting.drive(here, node), way_home = setting.drive(node, home);
    const Int used = vehicle.distance + setting.ways(here, node) + setting.ways(node, home);
    feature.distance_slack =
        to_float(slack(longest_trip(type), used, double(setting.ways(home, node))));
    const double detour = double(way + way_home - setting.drive(here, home)) / unit.time;
    feature.detour = to_float(std::max(std::min(detour, furthest), -furthest));
    feature.excess = to_float(ratio(way - now.nearest, unit.near));
    const Int stops = stops_left(type, log, vehicle.idle != 0);
    if (stops >= unlimited) return;
    feature.load_share = to_float(1.0 / double(std::max(Int{1}, stops)));
    feature.capacity_share = to_float(1.0 / double(std::max(Int{1}, most_stops(type))));
}

// Describe the flight to a customer, as if the drone came back here.
void describe_flight(const Situation& now, Int node, ActionFeatures& feature) {
    const auto& [setting, unit, vehicle, log, served] = now.duty;
    const Int here = vehicle.node;
    const Int there = setting.fly(here, node);
    const Int back = std::min(setting.fly_home(node, here), 10 * there);
    const Int flown = setting.distances(setting.type.drone_travel, here, node);
    describe_leg(unit, there, 2 * flown, now.rate.drone_distance, 2 * now.rate.drone_time, feature);
    feature.endurance_share = to_float(share(there + back, longest_flight(setting.type)));
}

// Describe returning to the depot.
void describe_return(const Situation& now, ActionFeatures& feature) {
    const VehicleType& type = now.duty.setting.type;
    const Int left = type.max_trips - now.duty.log.count.trips;
    feature.load_share =
        to_float(quotient(room(type, now.duty.vehicle), std::max(Int{1}, type.capacity[0])));
    feature.capacity_share = to_float(quotient(std::min(left, most_trips), most_trips));
}

// Describe opening a vehicle of a type of which so many are used already.
void describe_open(const VehicleType& type, double fixed, Int used, double unserved,
                   const Unit& unit, ActionFeatures& feature) {
    const auto left = double(type.count - used);
    feature.cost = to_float(ratio(fixed, unit.cost));
    feature.load_share = to_float(left / (left + 4.0));
    feature.capacity_share =
        to_float(std::min(double(type.capacity[0]) / std::max(1.0, unserved), 2.0));
    feature.distance_slack = type.drones > 0 ? 1 : 0;
}

// The shortest drive from here among the actions.
Int nearest_drive(View<const Int, 1> onward, View<const Int, 1> actions) {
    Int nearest = unlimited;
    for (const Int action : actions) {
        if (kind_of(action) == ActionKind::drive) {
            nearest = std::min(nearest, onward[target_of(action)]);
        }
    }
    return nearest;
}

// The demand left in the first dimension: what is delivered or, if more, picked up.
double unserved_demand(const Instance& instance, const State& state, Int r) {
    const Int b = state.problem[r];
    const ProblemTables& problem = instance.problem[b];
    const View<const Node, 2> nodes = problem.node[0];
    const View<const bool, 1> served = state.served[r];
    const bool some_picked = num_tiers(problem.amount) > 0;
    double total = 0, picked = 0;
    for (Int node = problem.num_depots; node < problem.num_nodes; ++node) {
        if (served[node]) continue;
        total += double(demand_of(nodes[node])[0]);
        // What is brought somewhere was picked up before.
        if (some_picked) {
            picked += double(std::max(Int{0}, picked_of(problem.amount, node, 0)[0]));
        }
    }
    return std::max(total, picked);
}

// What the vehicles that are not open yet can carry in the first dimension, on all their trips.
double closed_reserve(const Instance& instance, const State& state, Int r) {
    const ProblemTables& problem = instance.problem[state.problem[r]];
    double reserve = 0;
    for (Int k = 0; k < problem.num_types; ++k) {
        const VehicleType& type = problem.type[k];
        reserve += double(type.count - state.used(r, k)) * double(type.max_trips) *
                   double(type.capacity[0]);
    }
    return reserve;
}

// Describe the open vehicle, when all vehicles not open yet can carry so much.
void describe_vehicle(const Scene& scene, const State& state, Int r, double unserved,
                      double reserve, VehicleFeatures& seen) {
    const auto& [instance, scale, type_token] = scene;
    const Int b = state.problem[r];
    const Vehicle& vehicle = state.vehicle[r];
    const VehicleType& type = instance.problem[b].type[vehicle.type];
    const VehicleLog log = log_of(state.log, r);
    const auto capacity = double(std::max(Int{1}, type.capacity[0]));
    const auto free = double(room(type, vehicle));
    const bool idle = vehicle.idle != 0;
    const Int trips_left = type.max_trips - log.count.trips;
    reserve += double(trips_left) * capacity;
    Int clock = vehicle.next_start;
    if (!idle) {
        clock = std::max(vehicle.service_end, vehicle.free);
        const Int home = instance.duration[b][type.travel](vehicle.node, type.ends_at);
        seen.way_home = to_float(std::min(double(home) / scale.time[b], furthest));
        reserve += free;
    }
    const Int working = log.count.trips > 0 ? clock - vehicle.departure_best : 0;
    seen.demand_by_reserve = to_float(std::min(unserved / std::max(1.0, reserve), 2.0));
    seen.idle = idle ? 1 : 0;
    seen.clock = to_float(std::min(double(clock) / scale.horizon[b], 2.0));
    seen.load_left = to_float(std::min(free / capacity, share_of_stops(type, log, idle)));
    seen.spare_reserve = to_float(std::max(std::min((reserve - unserved) / capacity, 2.0), -2.0));
    seen.trips_left = to_float(quotient(std::min(trips_left, most_trips), most_trips));
    seen.shift_slack = to_float(slack(usual_end(type), clock, scale.time[b]));
    seen.working_slack = to_float(slack(usual_working(type), working, scale.time[b]));
    seen.flying = to_float(quotient(vehicle.flying, std::max(Int{1}, type.drones)));
    seen.drone_aboard = type.drones > vehicle.flying ? 1 : 0;
    seen.load_by_demand = to_float(std::min(free / std::max(1.0, unserved), 2.0));
    std::copy_n(type_token[b][vehicle.type].data(), std::size(seen.type), seen.type);
    const Setting setting(instance, b, vehicle.type);
    const Unit unit = unit_of(scale, b);
    if (limits_travel(type)) {
        const double left = slack(longest_travel(type), vehicle.legs.duration, unit.time);
        seen.working_slack = to_float(std::min(double(seen.working_slack), left));
    }
    describe_duty({setting, unit, vehicle, log, state.served[r]}, clock, seen);
}

// Describe the open vehicle and what is left to do.
void describe_state(const Scene& scene, const State& state, Int r, double unserved,
                    VehicleFeatures& seen) {
    const Int b = state.problem[r];
    seen = {};
    const Int customers = std::max(Int{1}, customers_of(scene.instance.problem[b]));
    seen.unserved = to_float(quotient(state.num_unserved[r], customers));
    seen.unserved_demand = to_float(unserved / scene.scale.amount[b]);
    const double reserve = closed_reserve(scene.instance, state, r);
    if (state.vehicle[r].type == no_vehicle) {
        seen.demand_by_reserve = to_float(std::min(unserved / std::max(1.0, reserve), 2.0));
    } else {
        describe_vehicle(scene, state, r, unserved, reserve, seen);
    }
}

// Begin to describe a candidate.
ActionFeatures& begin_candidate(const Seen& seen, Int index, Int token) {
    ActionFeatures& feature = seen.feature[index];
    feature = {};
    feature.kind[seen.action[index] % num_kinds] = 1;
    seen.token[index] = token;
    return feature;
}

// Describe the vehicles that may be opened.
void describe_opens(const Scene& scene, const State& state, Int r, double unserved,
                    const Seen& seen) {
    const Instance& instance = scene.instance;
    const Int b = state.problem[r];
    const ProblemTables& problem = instance.problem[b];
    const Unit unit = unit_of(scene.scale, b);
    for (Int index = 0; index < seen.count; ++index) {
        const Int action = seen.action[index];
        if (kind_of(action) != ActionKind::open) continue;
        const Int k = target_of(action);
        ActionFeatures& feature = begin_candidate(seen, index, problem.node.shape(1) + k);
        describe_open(problem.type[k], problem.rate[k].fixed, state.used(r, k), unserved, unit,
                      feature);
        if (state.vehicle[r].type == no_vehicle) continue;
        const Setting setting(instance, b, state.vehicle[r].type);
        const VehicleLog log = log_of(state.log, r);
        describe_parting({setting, unit, state.vehicle[r], log, state.served[r]}, true, feature);
    }
}

// Describe the drives, the launches and the return of the open vehicle.
void describe_moves(const Instance& instance, const Scales& scale, const State& state, Int r,
                    const Seen& seen) {
    const Int b = state.problem[r];
    const Vehicle& vehicle = state.vehicle[r];
    const Setting setting(instance, b, vehicle.type);
    const VehicleLog log = log_of(state.log, r);
    const Unit unit = unit_of(scale, b);
    const View<const Int, 1> actions = seen.action.first(seen.count);
    const View<const Int, 2> neighbour = instance.neighbour[b];
    const Int here = vehicle.node, load = room(setting.type, vehicle);
    const Situation now{
        .duty = {setting, unit, vehicle, log, state.served[r]},
        .rate = setting.rate[vehicle.type],
        .since = vehicle.idle != 0 ? vehicle.next_start : log.trip[log.count.trips - 1].start,
        .nearest = nearest_drive(setting.drive[here], actions),
    };
    for (Int index = 0; index < actions.size(); ++index) {
        const ActionKind kind = kind_of(actions[index]);
        const Int node = target_of(actions[index]);
        if (kind == ActionKind::open) continue;
        ActionFeatures& feature = begin_candidate(seen, index, node);
        if (kind == ActionKind::launch) {
            describe_flight(now, node, feature);
        } else {
            describe_leg(unit, setting.drive(here, node), setting.ways(here, node),
                         now.rate.distance, now.rate.time, feature);
        }
        if (kind == ActionKind::end_trip) {
            describe_return(now, feature);
            describe_parting(now.duty, log.count.trips >= setting.type.max_trips, feature);
            continue;
        }
        feature.way_home = to_float(
            std::min(double(setting.drive(node, setting.type.ends_at)) / unit.time, furthest));
        if (kind == ActionKind::drive) describe_drive(now, node, feature);
        const Outlook& outlook = seen.outlook[index];
        const Candidate candidate{here, node, kind == ActionKind::launch, load, outlook};
        describe_customer(now, node, outlook, feature);
        describe_neighbours(setting, neighbour[node], now.duty.served, candidate, unit, feature);
        describe_rarer(now.duty, candidate, feature);
    }
}

}  // namespace

void observe(const Scene& scene, State& state, Int r, Int scratch, const Seen& seen) {
    seen.count = 0;
    if (state.done[r]) return;
    seen.count = legal_actions(scene.instance, state, r, scratch, seen.action, seen.outlook);
    if (seen.count == 0) {
        finish(scene.instance, state, r);
        return;
    }
    seen.here = state.vehicle[r].node;
    const double unserved = unserved_demand(scene.instance, state, r);
    describe_state(scene, state, r, unserved, seen.vehicle);
    describe_opens(scene, state, r, unserved, seen);
    if (state.vehicle[r].type != no_vehicle) {
        describe_moves(scene.instance, scene.scale, state, r, seen);
    }
}

}  // namespace tandem

using namespace tandem;

namespace {

// Observe rollouts one after another; returns the largest count.
Int observe_all(const Scene& scene, State& state, Int first, Int behind, Int scratch,
                const Observation& seen) {
    Int most = 0;
    for (Int r = first; r < behind; ++r) {
        observe(scene, state, r, scratch, seen_of(seen, r));
        most = std::max(most, seen.count[r]);
    }
    return most;
}

}  // namespace

int tandem_observe(const tandem_scene* scene, tandem_state* state, int64_t first, int64_t behind,
                   int64_t scratch, const tandem_observation* seen, int64_t* most) {
    return guarded([&] { *most = observe_all(*scene, *state, first, behind, scratch, *seen); });
}

int tandem_step(const tandem_scene* scene, tandem_state* state, int64_t first, int64_t behind,
                int64_t scratch, const tandem_i64_1d* choice, const tandem_observation* seen,
                int64_t* most) {
    return guarded([&] {
        const Instance& instance = scene->instance;
        const Observation& observation = *seen;
        const View<Int, 1> chosen(*choice);
        for (Int r = first; r < behind; ++r) {
            // Rollouts without a candidate stay as they are.
            if (observation.count[r] == 0) continue;
            apply(instance, *state, r, observation.action(r, chosen[r]));
        }
        *most = observe_all(*scene, *state, first, behind, scratch, observation);
    });
}
