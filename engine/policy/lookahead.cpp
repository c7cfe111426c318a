#include "policy/lookahead.h"

#include "rules/company.h"
#include "rules/lag.h"
#include "simulation/vehicle_log.h"

namespace tandem {
namespace {

constexpr Int num_company = 3;    // unserved neighbours that are looked at for how near they are
constexpr Int num_prospects = 8;  // those that are timed

// Clip a difference to three times `scale`, -1..1; 1 where there is nothing to compare.
double excess(Int value, double scale) {
    if (value >= unlimited) return 1;
    return std::max(std::min(double(value) / scale / 3.0, 1.0), -1.0);
}

// Squash a duration; 1 where there is none.
double soon(Int duration, double scale) {
    return duration >= unlimited ? 1 : ratio(duration, scale);
}

// What a customer asks to be carried in the first dimension, whichever way is more.
Int asked(const Setting& setting, Int node) {
    const Int delivered = demand_of(setting.node[node])[0];
    if (num_tiers(setting.amount) == 0) return delivered;
    return std::max(delivered, picked_of(setting.amount, node, 0)[0]);
}

// Whether nobody can be served at a node once a candidate is: a parcel isn't aboard, or he is the
// same customer elsewhere.
bool is_out(View<const Pair, 1> pairs, View<const bool, 1> served, Int candidate, Int other) {
    if (is_delivery(pairs, other)) {
        return std::ranges::any_of(pickups_of(pairs, other), [&](Int pickup) {
            return pickup != candidate && !served[pickup];
        });
    }
    return unit_of(pairs, other) == unit_of(pairs, candidate) && !is_paired(pairs, other);
}

// Run for each neighbour who is unserved behind a candidate, the nearest first, as many as are
// wanted.
template <class Look>
void look_around(View<const Int, 1> neighbours, View<const bool, 1> served,
                 View<const Pair, 1> pairs, Int candidate, Int wanted, Look&& look) {
    const bool some_out = some_paired(pairs);
    Int seen = 0;
    for (const Int other : neighbours) {
        if (other < 0 || seen == wanted) return;
        if (served[other] || (some_out && is_out(pairs, served, candidate, other))) continue;
        ++seen;
        look(other);
    }
}

// Describe how close a candidate's unserved neighbours are.
void describe_company(const Setting& setting, View<const Int, 1> neighbours,
                      View<const bool, 1> served, const Candidate& candidate, const Unit& unit,
                      ActionFeatures& feature) {
    const View<const Int, 1> onward = setting.drive[candidate.node];
    const Int past = setting.drive(candidate.here, candidate.node);
    bool is_first = true;
    feature.next_way = feature.third_way = feature.next_excess = 1;
    look_around(neighbours, served, setting.pair, candidate.node, num_company, [&](Int other) {
        const Int way = onward[other];
        feature.third_way = to_float(ratio(way, unit.near));
        if (!is_first) return;
        is_first = false;
        feature.next_way = feature.third_way;
        feature.next_excess = to_float(excess(way - past, unit.near));
    });
}

// Describe which neighbours could be driven to after a candidate, and from which to it.
//
// By fixed speeds, the first dimension of the load left, and without drones: a guess.
void describe_drive(const Setting& setting, View<const Int, 1> neighbours,
                    View<const bool, 1> served, const Candidate& candidate, const Unit& unit,
                    ActionFeatures& feature) {
    const Windows place = setting.node[candidate.node];
    const View<const Int, 1> from_here = setting.drive[candidate.here];
    const View<const Int, 1> onward = setting.drive[candidate.node];
    const Int arrival = candidate.outlook.arrival;
    const Int way = from_here[candidate.node];
    const Int leave = candidate.outlook.start + place.service_duration();
    const Int left = candidate.load - asked(setting, candidate.node);
    Int soonest = unlimited, tightest = unlimited, detour = unlimited, later = unlimited;
    Int seen = 0, lost = 0;
    look_around(neighbours, served, setting.pair, candidate.node, num_prospects, [&](Int other) {
        ++seen;
        const Windows there = setting.node[other];
        const Int latest = there.closing();
        const Int past = from_here[other], back = setting.drive(other, candidate.node);
        const Int then = leave + onward[other], directly = arrival - way + past;
        if (place.lateness(setting.served_at(other, none) + back) == 0) {
            later = std::min(later, back + place.waiting(latest + there.service_duration() + back));
        }
        if (then <= latest && asked(setting, other) <= left) {
            soonest = std::min(soonest, there.start_of_service(then) - leave);
            if (latest < unlimited) tightest = std::min(tightest, latest - then);
        } else if (directly <= latest) {
            ++lost;
        }
        if (directly <= latest && place.lateness(setting.served_at(other, directly) + back) == 0) {
            detour = std::min(detour, past + back - way);
        }
    });
    feature.next_duration = to_float(soon(soonest, unit.near));
    feature.next_slack = to_float(slack(tightest, 0, unit.time));
    feature.lost = to_float(double(lost) / double(std::max(Int{1}, seen)));
    feature.detour_before = to_float(excess(detour, unit.near));
    feature.later_duration = to_float(soon(later, unit.near));
}

// Describe at which neighbours the drone could meet the truck.
//
// How soon, how long the truck would wait, and the least detour of the truck to serve the candidate
// itself on its way to one.
void describe_flight(const Setting& setting, View<const Int, 1> neighbours,
                     View<const bool, 1> served, const Candidate& candidate, const Unit& unit,
                     ActionFeatures& feature) {
    const Int here = candidate.here, node = candidate.node;
    const View<const Int, 1> from_here = setting.drive[here];
    const View<const Int, 1> onward = setting.drive[node], home = setting.fly_home[node];
    const Int takeoff = candidate.outlook.arrival - setting.fly(here, node);
    const Int ready = candidate.outlook.start + setting.node_by_air[node].service_duration();
    Int soonest = unlimited, wait = unlimited, detour = unlimited, seen = 0;
    for (const Int other : neighbours) {
        if (other < 0 || seen == num_prospects) break;
        if (served[other] || unreachable(home[other])) continue;
        ++seen;
        const Int drone = ready + home[other] - takeoff, truck = from_here[other];
        soonest = std::min(soonest, std::max(drone, truck));
        wait = std::min(wait, std::max(Int{0}, drone - truck));
        detour = std::min(detour, from_here[node] + onward[other] - truck);
    }
    feature.next_duration = to_float(soon(soonest, unit.near));
    feature.next_slack = to_float(soon(wait, unit.near));
    feature.detour_before = to_float(excess(detour, unit.near));
}

}  // namespace

void describe_neighbours(const Setting& setting, View<const Int, 1> neighbours,
                         View<const bool, 1> served, const Candidate& candidate, const Unit& unit,
                         ActionFeatures& feature) {
    describe_company(setting, neighbours, served, candidate, unit, feature);
    if (candidate.by_air) {
        describe_flight(setting, neighbours, served, candidate, unit, feature);
    } else {
        describe_drive(setting, neighbours, served, candidate, unit, feature);
    }
}

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
    for (Int node = duty.setting.num_depots; node < duty.setting.num_nodes; ++node) {
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
    if (some_limited(setting.between)) {
        const Int start = place.start_of_service(left + way);
        const Int excess = excess_between(setting.between, node, left, start);
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
        to_float(ratio(vehicle_cost_at(setting.vehicle_cost, vehicle.type, node), duty.unit.cost));
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
    const auto& [setting, unit, vehicle, log, served] = duty;
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
