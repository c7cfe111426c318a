#include "policy/rarer.h"

#include "rules/company.h"
#include "rules/lag.h"
#include "simulation/vehicle_log.h"

namespace tandem {
namespace {

// How little a limit leaves: 0 where there is none, 1 where nothing is left.
double hurry(Int limit, Int used, double scale) { return 1.0 - slack(limit, used, scale); }

// Squash a number of customers.
double few(Int number) { return ratio(number, 2.0); }

// Whether the driver of a type has to rest now and then.
bool rests(const VehicleType& type) { return has_breaks(type) || has_driving_rules(type); }

// How many unserved customers go with those of a trip, or with all of the vehicle.
Int num_bound(const Duty& duty, Int on_trip, Int by_vehicle) {
    if (!some_apart(duty.setting.goods) || (on_trip | by_vehicle) == 0) return 0;
    Int bound = 0;
    for (Int node = duty.setting.num_depots; node < duty.num_nodes; ++node) {
        bound += !duty.served[node] && goes_with(duty.setting.goods[node], on_trip, by_vehicle);
    }
    return bound;
}

// How much of shipments is aboard in the first dimension.
Int parcels_aboard(const Setting& setting, const VehicleLog& log) {
    Int aboard = 0;
    const Int first = log.trip[log.count.trips - 1].first_stop;
    const auto count = [&](Int node) {
        if (is_paired(setting.pair, node)) aboard += picked_of(setting.amount, node, 0)[0];
    };
    for (Int index = first; index < log.count.stops; ++index) count(log.stop[index].node);
    for (const LoggedSortie& sortie : log.sortie.first(log.count.sorties)) {
        if (sortie.launch_stop >= first) count(sortie.node);
    }
    return aboard;
}

// Describe a parcel's delivery, as if its pickup were followed by it.
void describe_pair(const Duty& duty, const Candidate& candidate, ActionFeatures& feature) {
    const Setting& setting = duty.setting;
    const Int node = candidate.node;
    if (is_delivery(setting.pair, node)) feature.delivers = 1;
    if (!is_pickup(setting.pair, node)) return;
    const Int delivery = setting.pair[node].partner;
    const Int way = setting.drive(node, delivery);
    const Int left = candidate.outlook.start + setting.node[node].service_duration();
    const Windows place = setting.node[delivery];
    double rush = hurry(place.closing(), left + way, duty.unit.time);
    if (some_limited(setting.max_between)) {
        const Int start = place.start_of_service(left + way);
        const Int excess = excess_between(setting.max_between, node, left, start);
        if (excess > -unlimited) rush = std::max(rush, hurry(0, excess, duty.unit.time));
    }
    feature.delivery_way = to_float(ratio(way, duty.unit.time));
    feature.delivery_hurry = to_float(rush);
}

// How long the driver rests on the leg to a customer.
double rest_on_leg(const Duty& duty, const Candidate& candidate) {
    const Vehicle& vehicle = duty.vehicle;
    if (!rests(duty.setting.type) || vehicle.idle != 0 || candidate.by_air) return 0;
    const Int leave = std::max(vehicle.service_end, vehicle.free);
    const Int way = duty.setting.drive(candidate.here, candidate.node);
    return ratio(candidate.outlook.arrival - leave - way, duty.unit.time);
}

}  // namespace

void describe_rarer(const Duty& duty, const Candidate& candidate, ActionFeatures& feature) {
    const Setting& setting = duty.setting;
    const Vehicle& vehicle = duty.vehicle;
    const Int node = candidate.node;
    feature.price =
        to_float(ratio(vehicle_cost_at(duty.vehicle_cost, vehicle.type, node), duty.unit.cost));
    if (some_paired(setting.pair)) describe_pair(duty, candidate, feature);
    if (some_apart(setting.goods)) {
        feature.joins =
            goes_with(setting.goods[node], vehicle.kept_on_trip, vehicle.kept_by_vehicle) ? 1 : 0;
    }
    feature.forsaken = to_float(few(num_forestalled(
        lags_of(setting.lag, node), [&](Int other) { return duty.served[other]; })));
    feature.rest = to_float(rest_on_leg(duty, candidate));
}

void describe_parting(const Duty& duty, bool for_good, ActionFeatures& feature) {
    const Vehicle& vehicle = duty.vehicle;
    feature.forsaken = to_float(
        few(num_bound(duty, vehicle.kept_on_trip, for_good ? vehicle.kept_by_vehicle : 0)));
}

void describe_duty(const Duty& duty, Int now, VehicleFeatures& feature) {
    const auto& [setting, unit, vehicle, log, served, vehicle_cost, num_nodes] = duty;
    const VehicleType& type = setting.type;
    feature.bound = to_float(few(num_bound(duty, vehicle.kept_on_trip, vehicle.kept_by_vehicle)));
    if (log.count.trips == 0) return;
    if (some_paired(setting.pair) && vehicle.idle == 0) {
        const auto whole = double(std::max(Int{1}, capacity_in(type, 0)[0]));
        feature.aboard = to_float(double(parcels_aboard(setting, log)) / whole);
    }
    double due = 0;
    if (has_breaks(type)) {
        due = hurry(latest_rest(type, vehicle.rested, log.trip[0].start), now, unit.time);
    }
    if (has_driving_rules(type)) {
        Int driven = 0;
        const std::optional<Driver> driver = driver_of(setting, log, driven);
        const double rest = driver ? hurry(may_drive(type, *driver, now), 0, unit.time) : due;
        due = has_breaks(type) ? std::max(due, rest) : rest;
    }
    feature.rest_due = to_float(due);
}

}  // namespace tandem
