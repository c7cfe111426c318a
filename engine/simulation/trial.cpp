#include "simulation/trial.h"

#include <algorithm>

#include "rules/load.h"
#include "rules/shift.h"
#include "simulation/hubs.h"
#include "simulation/transition.h"
#include "simulation/vehicle_log.h"

namespace tandem {
namespace {

template <class T>
void copy_rows(View<const T, 1> from, View<T, 1> to, Int count) {
    std::copy_n(from.begin(), count, to.begin());
}

// Copy the open vehicle of one row to another.
void copy_vehicle(State& state, Int r, Int to) {
    const VehicleLogs& logs = state.log;
    const LogLengths& count = logs.count[r];
    state.vehicle[to] = state.vehicle[r];
    logs.count[to] = count;
    copy_rows<Drone>(state.drone[r], state.drone[to], state.drone.shape(1));
    copy_rows<LoggedTrip>(logs.trip[r], logs.trip[to], count.trips);
    copy_rows<LoggedStop>(logs.stop[r], logs.stop[to], count.stops);
    copy_rows<Operation>(logs.op[r], logs.op[to], count.ops);
    copy_rows<LoggedSortie>(logs.sortie[r], logs.sortie[to], count.sorties);
}

// Tell whether a vehicle come home could have left so late as to keep its working duration. Cheaper
// than `improve_departure`.
bool works_within(OpenVehicle& open) {
    auto& [setting, vehicle, log, drones] = open;
    const Int start = start_within_work(setting, log, vehicle.start_best);
    return may_work(setting.type, vehicle.free - first_departure(setting, log, start));
}

}  // namespace

bool legal_by_trial(const Rollout& rollout, Int reload, Service service, Outlook& outlook) {
    const auto& [instance, state, r, scratch] = rollout;
    const auto [node, by_drone] = service;
    copy_vehicle(state, r, scratch);
    OpenVehicle open = open_vehicle_of(instance, state.problem[r], state, scratch);
    const auto& [setting, vehicle, log, drones] = open;
    if (reload != no_reload && !drive(open, reload)) return false;
    if (!(by_drone ? launch(open, node) : drive(open, node))) return false;
    const Int here = log.count.stops - 1;
    if (!drive(open, setting.type.ends_at)) return false;
    if (by_drone) {
        const LoggedSortie& sortie = log.sortie[log.count.sorties - 1];
        outlook = {sortie.arrival, sortie.start, vehicle.free};
    } else {
        outlook = {log.stop[here].arrival, log.stop[here].start, vehicle.free};
    }
    return may_end(setting.type, vehicle.free) && works_within(open);
}

bool may_reload(const Rollout& rollout, Int place, Outlook& outlook) {
    const auto& [instance, state, r, scratch] = rollout;
    const Int b = state.problem[r];
    const Vehicle& vehicle = state.vehicle[r];
    const Int k = vehicle.type;
    const VehicleType& type = instance.type(b, k);
    const View<const Int, 2> legs = instance.distance[b][type.travel];
    const Int home = type.ends_at;
    const Int reach = longest_trip(type);
    if (vehicle.distance + legs(vehicle.node, place) > reach ||
        !may_take_off(instance, state, r, k, place, state.log.count[r].trips)) {
        return false;
    }
    const Size& size = instance.size[b];
    const View<const Goods, 1> goods = instance.goods[b];
    for (Int node = size.depots; node < size.depots + size.customers; ++node) {
        if (state.served(r, node)) continue;
        if (some_apart(goods) && !go_together(goods[node], 0, vehicle.barred_on_vehicle)) continue;
        if (instance.can_drive(b, k, node) && legs(place, node) + legs(node, home) <= reach &&
            legal_by_trial(rollout, place, {node, false}, outlook)) {
            return true;
        }
        if (instance.can_fly(b, k, node) && legs(place, home) <= reach &&
            legal_by_trial(rollout, place, {node, true}, outlook)) {
            return true;
        }
    }
    return false;
}

}  // namespace tandem
