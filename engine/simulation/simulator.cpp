#include "simulation/simulator.h"

#include <vector>

#include "guard.h"
#include "rules/company.h"
#include "rules/hours.h"
#include "rules/lag.h"
#include "rules/start.h"
#include "simulation/aboard.h"
#include "simulation/trial.h"
#include "simulation/vehicle_log.h"

namespace tandem {
namespace {

enum class Verdict { no, yes, unsure };

// Judge the return home: within the shift and, leaving at `departure`, the working duration.
//
// `rigid` tells that the vehicle could not leave later than `departure` without ending later.
Verdict judge_end(const Setting& setting, Int end, Int departure, bool rigid) {
    if (!may_end(setting.type, end)) return Verdict::no;
    const Int working = end - counted_from(setting.type, departure);
    if (may_work(setting.type, working)) return Verdict::yes;
    return rigid || has_begun(setting.type) ? Verdict::no : Verdict::unsure;
}

// Judge driving to a customer whose parcel the trip carries already. Writes `outlook`.
//
// `earliest` is the vehicle's earliest departure, none if it has none yet.
Verdict judge_drive(const OpenVehicle& open, std::optional<Int> earliest, Int node,
                    Outlook& outlook) {
    const auto& [setting, vehicle, log, drones] = open;
    const Windows place = setting.node[node];
    Int leave = vehicle.next_start, arrival = 0, free = 0;
    if (vehicle.idle != 0) {
        leave = std::max(leave, release_of(place));
        arrival = travel_arrival(setting, vehicle.node, node, leaves_first(setting.type, leave));
        free = arrival;
    } else {
        const Leaving leaving = leave_for(setting, log, vehicle, drones, node);
        if (leaving.arrival < 0) return Verdict::no;
        arrival = leaving.arrival;
        free = leaving.free;
    }
    if (!holds_all(setting, vehicle, drones, node, true)) return Verdict::no;
    if (place.too_late(arrival)) return Verdict::no;
    const Int start = place.start_of_service(arrival);
    const Int served = std::max(free, setting.served_at(node, arrival));
    const Int end = travel_arrival(setting, node, setting.type.ends_at, served);
    outlook = {arrival, start, end};
    Int departure = leaves_first(setting.type, leave);
    if (earliest) departure = vehicle.flying == 0 ? vehicle.departure_best : *earliest;
    const bool rigid = start == arrival && vehicle.flying == 0 && leave == vehicle.next_start &&
                       is_steady(setting.type);
    return judge_end(setting, end, departure, rigid);
}

// Judge a launch during a trip that carries the parcel already. Writes `outlook`.
//
// `departure` is the vehicle's earliest.
Verdict judge_launch(const OpenVehicle& open, Int departure, Int node, Outlook& outlook) {
    const auto& [setting, vehicle, log, drones] = open;
    const Int chosen = next_drone(setting, log, vehicle, drones, node);
    if (chosen < 0) return Verdict::no;
    Drone& drone = drones[chosen];
    const Windows place = setting.node[node];
    const DroneKind drone_kind = drone_kind_of(setting, drone.row);
    const Int flight = drone_kind.out(vehicle.node, node);
    const auto [takeoff, soonest] = takeoffs(setting, vehicle, drone_kind.type, node);
    if (unreachable(flight) || !drone_kind.in_range(vehicle.node, node) ||
        place.too_late(soonest + flight)) {
        return Verdict::no;
    }

    // As if it flew and the vehicle went home.
    const Int home = setting.type.ends_at, free = vehicle.free;
    const Int delivered = given_by_flight(setting, node);
    board(open, drone, 0, node, takeoff);
    vehicle.given += delivered;
    const Leaving leaving = leave_for(setting, log, vehicle, drones, home);
    const bool is_held = leaving.arrival >= 0 && holds_all(setting, vehicle, drones, home, false);
    drone.sortie = in_flight;
    vehicle.given -= delivered;
    --vehicle.flying;
    vehicle.free = free;
    if (!is_held) return Verdict::no;
    const Int arrival = drone.takeoff + flight;
    outlook = {arrival, place.start_of_service(arrival), leaving.free};
    return judge_end(setting, leaving.free, departure, false);
}

// Which services may be added to a trip, or the next one, by their number.
struct ServicesLeft {
    bool stop, sortie;
};

ServicesLeft room_of(const OpenVehicle& open) {
    const auto& [setting, vehicle, log, drones] = open;
    Int served = 0;
    if (vehicle.idle == 0) {
        served = log.count.stops - log.trip[log.count.trips - 1].first_stop - 1;
    }
    const Int flown = vehicle.launched + vehicle.flying;
    return {allows_stops(setting.type, served + 1),
            vehicle.flying < setting.type.drones && allows_sorties(setting.type, flown + 1)};
}

// Tell whether all of a shipment has been picked up.
bool is_all_aboard(View<const Pair, 1> pairs, View<const bool, 1> served, Int delivery) {
    return std::ranges::all_of(pickups_of(pairs, delivery),
                               [&](Int pickup) { return served[pickup]; });
}

// Write the legal drives and launches of a rollout with an open vehicle; return how many.
Int legal_services(const Rollout& rollout, View<Int, 1> actions, View<Outlook, 1> outlooks) {
    const auto& [instance, state, r, scratch] = rollout;
    const Int b = state.problem[r];
    const OpenVehicle open = open_vehicle_of(instance, b, state, r);
    const auto& [setting, vehicle, log, drones] = open;
    const Int k = vehicle.type;
    const bool is_idle = vehicle.idle != 0;
    const Int trips = log.count.trips;
    if (is_idle && trips > 0 &&
        !(trips < setting.type.max_trips && setting.reload(k, vehicle.node) &&
          may_take_off(instance, state, r, k, vehicle.node, trips))) {
        return 0;
    }
    const View<const Int, 2> legs = setting.ways;
    const Int here = vehicle.node, home = setting.type.ends_at;
    const Int reach = longest_trip(setting.type) - vehicle.distance;
    const Int began = is_idle ? 0 : log.trip[trips - 1].start;
    ServicesLeft room = room_of(open);
    if (is_idle && !may_drive_home(setting, vehicle.legs, here)) room.sortie = false;
    std::optional<Int> earliest;
    if (trips > 0) earliest = first_departure(setting, log, log.trip[0].start);
    const Int last = last_aboard(open);
    const bool laden = last != no_delivery;
    const bool trying = holds_count(setting) || order_is_open(setting, vehicle) || laden ||
                        is_timed_slowly(setting.type) || keeps_hours(setting.type);
    Int found = 0;
    const auto add_if_legal = [&](Verdict verdict, Service service) {
        const bool is_legal = verdict == Verdict::yes ||
                              (verdict == Verdict::unsure &&
                               legal_by_trial(rollout, no_reload, service, outlooks[found]));
        const ActionKind kind = service.by_drone ? ActionKind::launch : ActionKind::drive;
        if (is_legal) actions.at(found++) = encode_action(kind, service.node);
    };
    for (Int node = setting.num_depots; node < setting.num_nodes; ++node) {
        if (state.served(r, node) || !may_carry(setting, vehicle, node)) continue;
        if (is_delivery(setting.pair, node) &&
            !(laden && is_all_aboard(setting.pair, state.served[r], node) &&
              (node == last || !is_stack(setting.type)))) {
            continue;
        }
        const bool is_held = trying || is_pickup(setting.pair, node) ||
                             (!is_idle && began < release_of(setting.node[node]));
        // Whoever has parcels aboard goes home by their places, maybe where no way leads straight.
        const bool is_near = laden || is_pickup(setting.pair, node) ||
                             (legs(here, node) + legs(node, home) <= reach &&
                              may_drive_by(setting, vehicle.legs, here, node));
        if (room.stop && instance.can_drive(b, k, node) && is_near) {
            const Verdict verdict =
                is_held ? Verdict::unsure : judge_drive(open, earliest, node, outlooks[found]);
            add_if_legal(verdict, {node, false});
        }
        if (room.sortie && instance.can_fly(b, k, node) && may_launch(setting, vehicle, node) &&
            (!is_delivery(setting.pair, node) || is_aboard(open, node))) {
            const Verdict verdict = is_held || is_idle
                                        ? Verdict::unsure
                                        : judge_launch(open, *earliest, node, outlooks[found]);
            add_if_legal(verdict, {node, true});
        }
    }
    return found;
}

// Write, behind those found, where the vehicle's trip may end; return how many there are.
Int legal_returns(const Rollout& rollout, View<Int, 1> actions, View<Outlook, 1> outlooks,
                  Int found) {
    const auto& [instance, state, r, scratch] = rollout;
    const Int b = state.problem[r];
    const Int k = state.vehicle[r].type;
    const ProblemTables& problem = instance.problem[b];
    const VehicleType& type = problem.type[k];
    actions.at(found++) = encode_action(ActionKind::end_trip, type.ends_at);
    if (type.changes_ends == 0 || state.log.count[r].trips >= type.max_trips) return found;
    for (Int place = 0; place < problem.num_depots; ++place) {
        if (place != type.ends_at && problem.reload(k, place) &&
            may_reload(rollout, place, outlooks[found])) {
            actions.at(found++) = encode_action(ActionKind::end_trip, place);
        }
    }
    return found;
}

template <class T>
std::vector<T> copied(View<const T, 1> row) {
    return {row.begin(), row.end()};
}

template <class T>
void put_back(const std::vector<T>& from, View<T, 1> row) {
    std::ranges::copy(from, row.begin());
}

// What opening a vehicle changes of a rollout, to be put back.
class Aside {
public:
    Aside(State& state, Int r)
        : state_(state),
          r_(r),
          vehicle_(state.vehicle[r]),
          count_(state.log.count[r]),
          cost_(state.cost[r]),
          used_(copied<Int>(state.used[r])),
          starts_(copied<Int>(state.starts[r])),
          taken_(copied<Hub>(state.taken[r])),
          drone_(copied<Drone>(state.drone[r])),
          trip_(copied<LoggedTrip>(state.log.trip[r].first(count_.trips))),
          stop_(copied<LoggedStop>(state.log.stop[r].first(count_.stops))),
          sortie_(copied<LoggedSortie>(state.log.sortie[r].first(count_.sorties))) {}

    ~Aside() {
        state_.vehicle[r_] = vehicle_;
        state_.log.count[r_] = count_;
        state_.cost[r_] = cost_;
        put_back<Int>(used_, state_.used[r_]);
        put_back<Int>(starts_, state_.starts[r_]);
        put_back<Hub>(taken_, state_.taken[r_]);
        put_back<Drone>(drone_, state_.drone[r_]);
        put_back<LoggedTrip>(trip_, state_.log.trip[r_]);
        put_back<LoggedStop>(stop_, state_.log.stop[r_]);
        put_back<LoggedSortie>(sortie_, state_.log.sortie[r_]);
    }

    Aside(const Aside&) = delete;
    Aside& operator=(const Aside&) = delete;

private:
    State& state_;
    Int r_;
    Vehicle vehicle_;
    LogLengths count_;
    Cost cost_;
    std::vector<Int> used_, starts_;
    std::vector<Hub> taken_;
    std::vector<Drone> drone_;
    std::vector<LoggedTrip> trip_;
    std::vector<LoggedStop> stop_;
    std::vector<LoggedSortie> sortie_;
};

// How many actions on customers are legal at most.
Int most_actions(const ProblemTables& problem) { return 2 * customers_of(problem) + 1; }

// Tell whether a vehicle of type `k` could serve anybody when others are served.
bool serves_behind_others(const Rollout& rollout, Int k) {
    const auto& [instance, state, r, scratch] = rollout;
    const Aside aside(state, r);
    if (state.vehicle[r].type != no_vehicle) close_vehicle(instance, state, r);
    open_vehicle(instance, state, r, k);
    const Int most = most_actions(instance.problem[state.problem[r]]);
    std::vector<Int> actions(static_cast<std::size_t>(most));
    std::vector<Outlook> outlooks(static_cast<std::size_t>(most));
    return legal_services(rollout, {actions.data(), {most}}, {outlooks.data(), {most}}) > 0;
}

// Tell whether a vehicle of type `k` may open: one is left and has a customer to serve.
bool open_legal(const Rollout& rollout, Int k) {
    const auto& [instance, state, r, scratch] = rollout;
    const Int b = state.problem[r];
    const ProblemTables& problem = instance.problem[b];
    const VehicleType& type = problem.type[k];
    if (state.used(r, k) >= type.count || !may_take_off(instance, state, r, k, type.begins_at, 0)) {
        return false;
    }
    const Int parted = state.vehicle[r].parted | state.vehicle[r].kept_by_vehicle;
    bool waits = false;
    for (Int node = problem.num_depots; node < problem.num_nodes; ++node) {
        if (state.fresh(b, k, node) && !state.served(r, node) &&
            (!some_apart(problem.goods) || joins_anybody(problem.goods[node], parted))) {
            if (!is_bound(problem.across, node)) return true;
            waits = true;
        }
    }
    return waits && serves_behind_others(rollout, k);
}

}  // namespace

Int legal_actions(const Instance& instance, State& state, Int r, Int scratch, View<Int, 1> actions,
                  View<Outlook, 1> outlooks) {
    if (state.done[r]) return 0;
    const Rollout rollout{instance, state, r, scratch};
    const Int b = state.problem[r];
    const Vehicle& vehicle = state.vehicle[r];
    Int found = 0;
    if (vehicle.type != no_vehicle) {
        found = legal_services(rollout, actions, outlooks);
        if (vehicle.idle == 0) {
            if (carries_parcels(open_vehicle_of(instance, b, state, r))) return found;
            return legal_returns(rollout, actions, outlooks, found);
        }
        if (state.log.count[r].trips == 0 ||
            vehicle.node != instance.problem[b].type[vehicle.type].ends_at) {
            return found;
        }
    }
    for (Int k = 0; k < instance.problem[b].num_types; ++k) {
        if (open_legal(rollout, k)) {
            actions.at(found++) = encode_action(ActionKind::open, k);
        }
    }
    return found;
}

void apply(const Instance& instance, State& state, Int r, Int action) {
    const ActionKind kind = kind_of(action);
    const Int target = target_of(action);
    if (kind == ActionKind::open) {
        if (state.vehicle[r].type != no_vehicle) close_vehicle(instance, state, r);
        open_vehicle(instance, state, r, target);
        return;
    }
    const Int b = state.problem[r];
    OpenVehicle open = open_vehicle_of(instance, b, state, r);
    if (kind == ActionKind::launch) {
        launch(open, target);
    } else {
        Vehicle& vehicle = open.vehicle;
        const Int travel = open.setting.type.travel;
        vehicle.distance += instance.distance(b, travel, vehicle.node, target);
        vehicle.legs = vehicle.legs + leg_of(open.setting, vehicle.node, target);
        drive(open, target);
    }
    improve_departure(open);
    if (kind != ActionKind::end_trip) {
        const auto serve = [&](Int place) {
            state.served(r, place) = true;
            --state.num_unserved[r];
        };
        if (is_paired(open.setting.pair, target)) {
            serve(target);
        } else {
            for_each_place(open.setting.pair, target, serve);
        }
    }
}

Int apply_route(const Instance& instance, State& state, Int r, View<const Int, 1> actions,
                Int first) {
    Int index = first;
    do {
        apply(instance, state, r, actions.at(index++));
    } while (index < actions.size() && kind_of(actions[index]) != ActionKind::open);
    return index;
}

void price_routes(const Instance& instance, State& state, Int r, View<const Int, 1> actions,
                  View<Cost, 1> price) {
    Int vehicle = 0;
    for (Int done = 0; done < actions.size(); ++vehicle) {
        state.cost[r] = {};
        std::ranges::fill(state.used[r], 0);
        std::ranges::fill(state.starts[r], none);
        done = apply_route(instance, state, r, actions, done);
        close_vehicle(instance, state, r);
        clear_vehicle(state.vehicle[r]);
        price[vehicle] = state.cost[r];
    }
}

void finish(const Instance& instance, State& state, Int r) {
    if (state.vehicle[r].type != no_vehicle) close_vehicle(instance, state, r);
    const ProblemTables& problem = instance.problem[state.problem[r]];
    double& unassigned = state.cost[r].unassigned;
    unassigned += double(state.num_unserved[r]) * problem.unassigned_cost;
    if (state.num_unserved[r] > 0) {
        for (Int node = problem.num_depots; node < problem.num_nodes; ++node) {
            if (!state.served(r, node)) unassigned += problem.unassigned_more[node];
        }
    }
    state.done[r] = true;
}

void mark_fresh(const Instance& instance, State& state, Int scratch) {
    const Int row = scratch - 1;
    std::vector<Int> actions;
    std::vector<Outlook> outlooks;
    for (Int b = 0; b < instance.problem.size(); ++b) {
        state.problem[row] = b;
        const Int most = most_actions(instance.problem[b]);
        actions.resize(std::size_t(most));
        outlooks.resize(std::size_t(most));
        for (Int k = 0; k < instance.problem[b].num_types; ++k) {
            open_vehicle(instance, state, row, k);
            const Int found = legal_services({instance, state, row, scratch},
                                             {actions.data(), {most}}, {outlooks.data(), {most}});
            for (Int index = 0; index < found; ++index) {
                state.fresh(b, k, target_of(actions[std::size_t(index)])) = true;
            }
        }
    }
    std::ranges::fill(state.used[row], 0);
    clear_vehicle(state.vehicle[row]);
}

}  // namespace tandem

using namespace tandem;

extern "C" {

int tandem_legal_actions(const tandem_instance* instance, tandem_state* state, std::int64_t r,
                         std::int64_t scratch, const tandem_i64_1d* actions,
                         const tandem_outlook_1d* outlooks, std::int64_t* found) {
    return guarded(
        [&] { *found = legal_actions(*instance, *state, r, scratch, *actions, *outlooks); });
}

int tandem_apply(const tandem_instance* instance, tandem_state* state, std::int64_t r,
                 std::int64_t action) {
    return guarded([&] { apply(*instance, *state, r, action); });
}

int tandem_apply_route(const tandem_instance* instance, tandem_state* state, std::int64_t r,
                       const tandem_i64_1d* actions, std::int64_t first, std::int64_t* behind) {
    return guarded([&] { *behind = apply_route(*instance, *state, r, *actions, first); });
}

int tandem_price_routes(const tandem_instance* instance, tandem_state* state, std::int64_t r,
                        const tandem_i64_1d* actions, const tandem_cost_1d* price) {
    return guarded([&] { price_routes(*instance, *state, r, *actions, *price); });
}

int tandem_finish(const tandem_instance* instance, tandem_state* state, std::int64_t r) {
    return guarded([&] { finish(*instance, *state, r); });
}

}  // extern "C"
