#include "simulation/aboard.h"

#include "rules/company.h"
#include "simulation/meeting.h"

namespace tandem {
namespace {

void write_part(const Amount& amount, Int* row, Int number) {
    write_amount(amount, row + number * dimensions_per_tier);
}

// What drones in flight have picked up that are recovered at a place.
Amount brought(const Setting& setting, const Vehicle& vehicle, View<const Drone, 1> drones,
               Recovery place, Int number) {
    Amount amount = nothing;
    if (vehicle.flying == 0) return amount;
    for (const Drone& drone : drones) {
        if (is_recovered(drone, place) && !is_delivery(setting.pair, drone.node)) {
            amount = plus(amount, picked_of(setting.amount, drone.node, number));
        }
    }
    return amount;
}

// The sum over all dimensions of what is `brought`.
Int total_brought(const Setting& setting, const Vehicle& vehicle, View<const Drone, 1> drones,
                  Recovery place) {
    Int amount = 0;
    if (vehicle.flying == 0) return amount;
    for (const Drone& drone : drones) {
        if (is_recovered(drone, place)) amount += total_picked(setting.amount, drone.node);
    }
    return amount;
}

// Of one tier, what a next stop takes, and what of pickups is aboard on leaving this stop and when
// the truck is done at the next.
struct Burden {
    Amount demand, here, there;
};

Burden burden_of(const Setting& setting, const Vehicle& vehicle, View<const Drone, 1> drones,
                 Int node, bool is_customer, Int number) {
    Burden burden{};
    burden.here = plus(part_of(vehicle.aboard, number),
                       brought(setting, vehicle, drones, Recovery::loop, number));
    burden.there = plus(burden.here, brought(setting, vehicle, drones, Recovery::meet, number));
    if (is_customer) {
        burden.demand = delivered_of(setting.amount, node, number);
        burden.there = plus(burden.there, picked_of(setting.amount, node, number));
    }
    return burden;
}

// The sums over all dimensions of what was picked up before and at the next stop, and what of it
// comes aboard at both.
struct PickedUp {
    Int before, there, comes_here, comes_there;
};

PickedUp total_there(const Setting& setting, const Vehicle& vehicle, View<const Drone, 1> drones,
                     Int node, bool is_customer) {
    const Int here = total_brought(setting, vehicle, drones, Recovery::loop);
    const Int there = total_brought(setting, vehicle, drones, Recovery::meet) +
                      (is_customer ? total_picked(setting.amount, node) : 0);
    const Int before = vehicle.taken + here;
    return {before, before + there, here, there};
}

// How many shipments lie on a stack once a node is served.
Int stacked_behind(const Setting& setting, const Vehicle& vehicle, Int node, bool is_customer) {
    const bool counts = is_customer && is_stack(setting.type);
    return vehicle.stacked + (counts ? stacked_at(setting.pair, node) : 0);
}

// Bar what a customer's goods must not go with, and keep together who goes with him.
void take_company(const Setting& setting, Vehicle& vehicle, Int node) {
    if (!some_apart(setting.goods)) return;
    vehicle.kept_on_trip |= kept_on_trip(setting.goods[node]);
    vehicle.kept_by_vehicle |= kept_by_vehicle(setting.goods[node]);
    vehicle.barred_on_trip |= barred_on_trip(setting.goods[node]);
    vehicle.barred_on_vehicle |= barred_on_vehicle(setting.goods[node]);
}

// Tell whether a customer's parcel is within the load left.
bool is_within(const Setting& setting, const Vehicle& vehicle, Int node) {
    for (Int number = 1; number < num_tiers(setting.amount); ++number) {
        if (!within(delivered_of(setting.amount, node, number), part_of(vehicle.load, number))) {
            return false;
        }
    }
    return within(demand_of(setting.node[node]), part_of(vehicle.load, 0));
}

// Take a parcel from the load left, where no tiers are looked at.
void take_demand(const Setting& setting, Vehicle& vehicle, Int node) {
    write_part(minus(part_of(vehicle.load, 0), demand_of(setting.node[node])), vehicle.load, 0);
}

}  // namespace

void empty(const VehicleType& type, Vehicle& vehicle) {
    vehicle.given = vehicle.picked = vehicle.taken = vehicle.stacked = 0;
    for (Int number = 0; number < max_tiers; ++number) {
        write_part(capacity_in(type, number), vehicle.load, number);
        write_part(nothing, vehicle.aboard, number);
    }
}

bool holds_all(const Setting& setting, const Vehicle& vehicle, View<const Drone, 1> drones,
               Int node, bool is_customer) {
    if (num_tiers(setting.amount) == 0) return true;
    for (Int number = 0; number < num_tiers(setting.amount); ++number) {
        const auto [demand, here, there] =
            burden_of(setting, vehicle, drones, node, is_customer, number);
        if (!holds_in(setting.type, plus(here, demand), number) ||
            !holds_in(setting.type, there, number)) {
            return false;
        }
    }
    const Int delivered = is_customer ? total_delivered(setting.amount, node) : 0;
    const auto [before, taken, here, there] =
        total_there(setting, vehicle, drones, node, is_customer);
    return !out_of_order(setting.type, before + vehicle.stacked, delivered) &&
           !out_of_order(setting.type, here, vehicle.stacked) &&
           !out_of_order(setting.type, there,
                         stacked_behind(setting, vehicle, node, is_customer)) &&
           !comes_first(setting.type, taken, vehicle.given + delivered);
}

void load_stop(const Setting& setting, Vehicle& vehicle, View<const Drone, 1> drones, Int node,
               bool is_customer, Rests rests) {
    if (is_customer) take_company(setting, vehicle, node);
    if (num_tiers(setting.amount) == 0) {
        if (is_customer) take_demand(setting, vehicle, node);
        return;
    }
    const PickedUp sums = total_there(setting, vehicle, drones, node, is_customer);
    for (Int number = 0; number < num_tiers(setting.amount); ++number) {
        const auto [demand, here, there] =
            burden_of(setting, vehicle, drones, node, is_customer, number);
        Amount most = capacity_in(setting.type, number);
        if (has_breaks(setting.type)) {
            for (Int index = 0; index < rests.count(); ++index) {
                if (!is_stated(rests.number(index))) continue;
                most = smaller(most, most_during(setting.type, rests.number(index), number));
            }
        }
        const Amount left = smaller(part_of(vehicle.load, number), minus(most, here));
        write_part(minus(left, demand), vehicle.load, number);
        write_part(there, vehicle.aboard, number);
    }
    vehicle.picked = sums.before + vehicle.stacked;
    vehicle.taken = sums.there;
    vehicle.stacked = stacked_behind(setting, vehicle, node, is_customer);
    if (is_customer) vehicle.given += total_delivered(setting.amount, node);
}

Int too_heavy(const Setting& setting, const Vehicle& vehicle, View<const Drone, 1> drones, Int node,
              bool is_customer) {
    Int heavy = 0;
    for (Int number = 0; number < num_tiers(setting.amount); ++number) {
        const Burden burden = burden_of(setting, vehicle, drones, node, is_customer, number);
        heavy |= too_heavy_for(setting.type, plus(burden.here, burden.demand), number);
    }
    return heavy;
}

bool may_carry(const Setting& setting, const Vehicle& vehicle, Int node) {
    return is_within(setting, vehicle, node) &&
           (!some_apart(setting.goods) ||
            (go_together(setting.goods[node], vehicle.barred_on_trip, vehicle.barred_on_vehicle) &&
             joins_anybody(setting.goods[node], vehicle.parted)));
}

bool may_launch(const Setting& setting, const Vehicle& vehicle, Int node) {
    return num_tiers(setting.amount) == 0 ||
           !out_of_order(setting.type, vehicle.picked, total_delivered(setting.amount, node));
}

Int given_by_flight(const Setting& setting, Int node) {
    return num_tiers(setting.amount) > 0 ? total_delivered(setting.amount, node) : 0;
}

void load_flight(const Setting& setting, Vehicle& vehicle, Int node) {
    take_company(setting, vehicle, node);
    vehicle.given += given_by_flight(setting, node);
    if (num_tiers(setting.amount) == 0) take_demand(setting, vehicle, node);
    for (Int number = 0; number < num_tiers(setting.amount); ++number) {
        const Amount delivered = delivered_of(setting.amount, node, number);
        write_part(minus(part_of(vehicle.load, number), delivered), vehicle.load, number);
        if (!is_delivery(setting.pair, node)) continue;
        const Amount change = picked_of(setting.amount, node, number);
        write_part(plus(part_of(vehicle.aboard, number), change), vehicle.aboard, number);
    }
}

}  // namespace tandem
