#include "plan/telling.h"

#include "guard.h"
#include "simulation/simulator.h"
#include "simulation/transition.h"
#include "simulation/vehicle_log.h"

namespace tandem {

namespace {

void tell_sortie(const Setting& setting, const VehicleLog& log, const LoggedSortie& sortie,
                 Int first, RouteTeller& told) {
    const Int setup = setup_after(setting.setup, log.stop[sortie.launch_stop].node, sortie.node);
    told.sortie({sortie.drone, sortie.launch_stop - first, sortie.recovery_stop - first,
                 sortie.takeoff, sortie.recovery_start, sortie.recovery_end, 1});
    told.visit({sortie.node, sortie.arrival - setup, sortie.start, sortie.ready, setup});
}

// A trip from stop `first` up to `behind`.
void tell_trip(const Setting& setting, const VehicleLog& log, Int first, Int behind,
               RouteTeller& told) {
    const View<LoggedStop, 1> stops = log.stop;
    told.trip(0, 0);
    for (Int p = first; p < behind; ++p) {
        const auto& [node, arrival, start, leave, rests] = stops[p];
        const Int setup = p > 0 ? setup_after(setting.setup, stops[p - 1].node, node) : 0;
        told.stop(with_handling(setting.type, {node, arrival - setup, start, leave, setup},
                                p == first, p == behind - 1));
    }
    for (const LoggedSortie& sortie : log.sortie.first(log.count.sorties)) {
        if (first <= sortie.launch_stop && sortie.launch_stop < behind) {
            tell_sortie(setting, log, sortie, first, told);
        }
    }
    for (Int p = first; p < behind - 1; ++p) {
        const Int here = stops[p].node, next = stops[p + 1].node;
        told.leg(p - first, {Rests(stops[p].rests), stops[p].leave, travel_of(setting, here, next),
                             stood_at(setting, here), setup_after(setting.setup, here, next)});
    }
}

// Tell the route of the open vehicle, if it has one.
void tell_vehicle(const OpenVehicle& open, Plan& plan) {
    const auto& [setting, vehicle, log, drones] = open;
    RouteTeller told(plan, speeds_of(setting), vehicle.type, vehicle.index, log.trip[0].start);
    for (Int trip = 0; trip < log.count.trips; ++trip) {
        const bool is_last = trip == log.count.trips - 1;
        tell_trip(setting, log, log.trip[trip].first_stop,
                  is_last ? log.count.stops : log.trip[trip + 1].first_stop, told);
    }
}

}  // namespace

void tell_rollout(const Instance& instance, State& state, Int r, View<const Int, 1> actions,
                  Plan& plan) {
    for (Int done = 0; done < actions.size();) {
        done = apply_route(instance, state, r, actions, done);
        const bool has_route = state.vehicle[r].type != no_vehicle && state.log.count[r].trips > 0;
        if (!has_route) continue;
        close_vehicle(instance, state, r);
        tell_vehicle(open_vehicle_of(instance, state.problem[r], state, r), plan);
    }
}

}  // namespace tandem

using namespace tandem;

extern "C" int tandem_tell_rollout(const tandem_instance* instance, tandem_state* state, int64_t r,
                                   const tandem_i64_1d* actions, tandem_plan* plan) {
    return guarded([&] { tell_rollout(*instance, *state, r, *actions, *plan); });
}
