#include "simulation/trial.h"

#include <utility>
#include <vector>

#include "rules/company.h"
#include "simulation/simulator.h"
#include "simulation/vehicle_log.h"

namespace tandem {
namespace {

constexpr std::size_t most_permuted = 3;  // stops for parcels aboard that are tried in all orders

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
    copy_rows<Int>(state.starts[r], state.starts[to], state.starts.shape(1));
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
    const Int working = vehicle.free - first_departure(setting, log, start);
    return may_work(setting.type, working - unpaid_in(setting, log));
}

// Who is served, in order, before the vehicle goes home.
using Order = std::vector<Int>;

// The deliveries of what is aboard, or fetched by drones, one for each part, in the order of their
// pickups, those by drones last.
Order parcels_aboard(const Setting& setting, const VehicleLog& log) {
    Order aboard;
    const Int first = log.trip[log.count.trips - 1].first_stop;
    const View<LoggedStop, 1> stops = log.stop.first(log.count.stops);
    for (Int index = first; index < log.count.stops; ++index) {
        const Int node = log.stop[index].node;
        if (is_pickup(setting.pair, node)) aboard.push_back(setting.pair[node].partner);
    }
    const View<LoggedSortie, 1> sorties = log.sortie.first(log.count.sorties);
    for (const LoggedSortie& sortie : sorties) {
        if (sortie.launch_stop >= first && is_pickup(setting.pair, sortie.node)) {
            aboard.push_back(setting.pair[sortie.node].partner);
        }
    }
    std::erase_if(aboard, [&](Int delivery) {
        return std::ranges::any_of(stops,
                                   [&](const LoggedStop& stop) { return stop.node == delivery; }) ||
               std::ranges::any_of(
                   sorties, [&](const LoggedSortie& sortie) { return sortie.node == delivery; });
    });
    return aboard;
}

// A shipment that is aboard, at least in part: where the rest is picked up, and the delivery.
struct Due {
    Order lacking;
    Int delivery;
};

using Dues = std::vector<Due>;

// What of a shipment isn't aboard yet.
Order lacking_of(const Setting& setting, const VehicleLog& log, Int delivery) {
    const auto stops = log.stop.first(log.count.stops);
    const auto sorties = log.sortie.first(log.count.sorties);
    Order lacking;
    for (const Int pickup : pickups_of(setting.pair, delivery)) {
        const auto is_there = [&](const auto& halt) { return halt.node == pickup; };
        if (std::ranges::none_of(stops, is_there) && std::ranges::none_of(sorties, is_there)) {
            lacking.push_back(pickup);
        }
    }
    return lacking;
}

// The shipments aboard, in the order in which their last parts came aboard.
Dues dues_of(const Setting& setting, const VehicleLog& log, const Order& aboard) {
    Dues dues;
    for (auto part = aboard.begin(); part != aboard.end(); ++part) {
        if (std::find(part + 1, aboard.end(), *part) != aboard.end()) continue;
        const Int fetched = Int(std::count(aboard.begin(), aboard.end(), *part));
        const bool is_whole = fetched == num_pickups(setting.pair, *part);
        dues.push_back({is_whole ? Order() : lacking_of(setting, log, *part), *part});
    }
    return dues;
}

// Tell whether the parts of each shipment lie on each other, with no other's between.
bool lie_together(const Order& aboard) {
    for (std::size_t part = 1; part < aboard.size(); ++part) {
        const auto below = aboard.begin() + Int(part) - 1;
        if (*below != aboard[part] && std::find(aboard.begin(), below, aboard[part]) != below) {
            return false;
        }
    }
    return true;
}

// All of some shipments, each picked up before it is delivered.
Order one_by_one(const Dues& dues) {
    Order order;
    for (const Due& due : dues) {
        order.insert(order.end(), due.lacking.begin(), due.lacking.end());
        order.push_back(due.delivery);
    }
    return order;
}

// Let who is nearest come next, from a node on, none delivered before it is picked up.
Order by_nearness(View<const Int, 2> legs, Int from, Dues dues) {
    Order order;
    while (!dues.empty()) {
        std::pair<Int, Int> nearest{unlimited, 0};
        for (const Due& due : dues) {
            for (const Int node : due.lacking) {
                nearest = std::min(nearest, {legs(from, node), node});
            }
            if (due.lacking.empty()) {
                nearest = std::min(nearest, {legs(from, due.delivery), due.delivery});
            }
        }
        from = nearest.second;
        order.push_back(from);
        for (Due& due : dues) std::erase(due.lacking, from);
        std::erase_if(dues, [&](const Due& due) { return due.delivery == from; });
    }
    return order;
}

// Tell whether an order delivers nothing before it is picked up.
bool is_in_order(const Dues& dues, const Order& order) {
    return std::ranges::all_of(dues, [&](const Due& due) {
        const auto delivery = std::ranges::find(order, due.delivery);
        return std::ranges::all_of(due.lacking, [&](Int pickup) {
            return std::find(order.begin(), delivery, pickup) != delivery;
        });
    });
}

// Calls `visit` with the orders of some nodes in which nothing is delivered before it is picked up,
// until one is legal.
template <class Visit>
bool any_permutation(const Dues& dues, Order order, const Visit& visit) {
    std::ranges::sort(order);
    do {
        if (is_in_order(dues, order) && visit(order)) return true;
    } while (std::next_permutation(order.begin(), order.end()));
    return false;
}

// As `any_order`, from a stack: all leave in one order, each once it is whole.
template <class Visit>
bool any_unstacking(Dues dues, const Visit& visit) {
    std::ranges::reverse(dues);
    Order lacking;
    for (const Due& due : dues) {
        lacking.insert(lacking.end(), due.lacking.begin(), due.lacking.end());
    }
    if (lacking.empty() || lacking.size() > most_permuted) return visit(one_by_one(dues));
    return any_permutation({}, lacking, [&](const Order& order) {
        for (Due& due : dues) {
            std::ranges::sort(due.lacking, {},
                              [&](Int node) { return std::ranges::find(order, node); });
        }
        return visit(one_by_one(dues));
    });
}

// Calls `visit` with orders in which what is aboard may be delivered until one is legal: all of few
// stops; of more, the nearest first, the one due soonest, and the last that came aboard. What is
// left of an order once its first is served is tried then as well, so that who has a way on always
// keeps one.
template <class Visit>
bool any_order(const Setting& setting, View<const Int, 2> legs, Int here, Dues dues,
               const Visit& visit) {
    if (is_stack(setting.type)) return any_unstacking(std::move(dues), visit);
    std::ranges::reverse(dues);
    const Order last_first = one_by_one(dues);
    if (last_first.size() <= most_permuted) return any_permutation(dues, last_first, visit);
    if (visit(last_first)) return true;
    std::ranges::sort(dues, {}, [&](const Due& due) {
        return std::pair(setting.node[due.delivery].closing(), due.delivery);
    });
    return visit(one_by_one(dues)) || visit(by_nearness(legs, here, std::move(dues)));
}

// How far a trip has come, and what the vehicle has driven on all its trips.
struct TripProgress {
    Int distance;
    Leg legs;

    void drive(Int far, Leg counted) {
        distance += far;
        legs = legs + counted;
    }
};

// How many customers the truck has served on its trip.
Int served_on_trip(const VehicleLog& log) {
    return log.count.stops - log.trip[log.count.trips - 1].first_stop - 1;
}

// Tell whether a trip may be so long, and stop so often, that serves some more before it is home.
bool is_within_reach(const OpenVehicle& open, View<const Int, 2> legs, TripProgress way,
                     const Order& order) {
    const VehicleType& type = open.setting.type;
    Int here = open.vehicle.node;
    for (const Int node : order) {
        way.drive(legs(here, node), leg_of(open.setting, here, node));
        here = node;
    }
    return way.distance + legs(here, type.ends_at) <= longest_trip(type) &&
           may_drive_home(open.setting, way.legs, here) &&
           allows_stops(type, served_on_trip(open.log) + Int(order.size()));
}

// Tell whether who has been served lets a customer come next.
bool may_join(const Setting& setting, const Vehicle& vehicle, Int node) {
    if (!some_apart(setting.goods)) return true;
    const Goods& company = setting.goods[node];
    return go_together(company, vehicle.barred_on_trip, vehicle.barred_on_vehicle) &&
           joins_anybody(company, vehicle.parted) &&
           joins_trip(company, vehicle.kept_on_trip, vehicle.kept_by_vehicle);
}

// Serve some and go home, from where the trip has come so far; false if that isn't legal.
bool serve_and_end(OpenVehicle& open, View<const Int, 2> legs, TripProgress way,
                   const Order& order) {
    auto& [setting, vehicle, log, drones] = open;
    if (!is_within_reach(open, legs, way, order)) return false;
    for (const Int node : order) {
        if (!may_join(setting, vehicle, node) || !drive(open, node)) return false;
    }
    return drive(open, setting.type.ends_at) && may_end(setting.type, vehicle.free) &&
           none_due(setting.type, vehicle.rested, log.trip[0].start, vehicle.free) &&
           has_rested(setting, log) && has_travelled_within(setting, log) && works_within(open);
}

// Do an action on a scratch row, after the end of the trip before if that is at a node.
bool attempt(const Rollout& rollout, OpenVehicle& open, Int reload, Service service) {
    copy_vehicle(rollout.state, rollout.r, rollout.scratch);
    if (reload != no_reload && !drive(open, reload)) return false;
    return service.by_drone ? launch(open, service.node) : drive(open, service.node);
}

// Tell whether a customer may go on a further trip of a vehicle, by who has gone before.
bool may_follow(const Goods& company, const Vehicle& vehicle) {
    return go_together(company, 0, vehicle.barred_on_vehicle) &&
           joins_anybody(company, vehicle.parted | vehicle.kept_on_trip);
}

}  // namespace

bool carries_parcels(const OpenVehicle& open) { return last_aboard(open) != no_delivery; }

Int last_aboard(const OpenVehicle& open) {
    const auto& [setting, vehicle, log, drones] = open;
    if (!some_paired(setting.pair) || vehicle.idle != 0 || log.count.trips == 0) return no_delivery;
    const Order aboard = parcels_aboard(setting, log);
    return aboard.empty() ? no_delivery : aboard.back();
}

bool is_aboard(const OpenVehicle& open, Int delivery) {
    const auto& [setting, vehicle, log, drones] = open;
    const View<LoggedStop, 1> stops = log.stop.first(log.count.stops);
    const View<LoggedSortie, 1> sorties = log.sortie.first(log.count.sorties);
    return std::ranges::all_of(pickups_of(setting.pair, delivery), [&](Int pickup) {
        return std::ranges::any_of(stops,
                                   [&](const LoggedStop& stop) { return stop.node == pickup; }) ||
               std::ranges::any_of(sorties, [&](const LoggedSortie& sortie) {
                   return sortie.node == pickup && sortie.recovery_stop != in_flight;
               });
    });
}

bool legal_by_trial(const Rollout& rollout, Int reload, Service service, Outlook& outlook) {
    const auto& [instance, state, r, scratch] = rollout;
    const auto [node, by_drone] = service;
    copy_vehicle(state, r, scratch);
    const Int b = state.problem[r];
    OpenVehicle open = open_vehicle_of(instance, b, state, scratch);
    const auto& [setting, vehicle, log, drones] = open;
    const View<const Int, 2> legs = setting.ways;
    const Int start = reload == no_reload ? vehicle.node : reload;
    TripProgress way = {reload == no_reload ? vehicle.distance : 0, vehicle.legs};
    if (reload != no_reload) way.legs = way.legs + leg_of(setting, vehicle.node, reload);
    if (!by_drone) way.drive(legs(start, node), leg_of(setting, start, node));
    if (!attempt(rollout, open, reload, service)) return false;
    const Int here = log.count.stops - 1;
    const Order aboard = some_paired(setting.pair) ? parcels_aboard(setting, log) : Order();
    if (is_stack(setting.type) && !lie_together(aboard)) return false;
    bool is_first = true;
    const Dues dues = dues_of(setting, log, aboard);
    const bool legal = any_order(setting, legs, vehicle.node, dues, [&](const Order& order) {
        if (!std::exchange(is_first, false)) attempt(rollout, open, reload, service);
        return serve_and_end(open, legs, way, order);
    });
    if (!legal) return false;
    if (by_drone) {
        const LoggedSortie& sortie = log.sortie[log.count.sorties - 1];
        outlook = {sortie.arrival, sortie.start, vehicle.free};
    } else {
        outlook = {log.stop[here].arrival, log.stop[here].start, vehicle.free};
    }
    return true;
}

bool may_reload(const Rollout& rollout, Int place, Outlook& outlook) {
    const auto& [instance, state, r, scratch] = rollout;
    const Int b = state.problem[r];
    const Vehicle& vehicle = state.vehicle[r];
    const Int k = vehicle.type;
    const VehicleType& type = instance.problem[b].type[k];
    const View<const Int, 2> legs = instance.distance[b][type.travel];
    const Int home = type.ends_at;
    const Int reach = longest_trip(type);
    if (vehicle.distance + legs(vehicle.node, place) > reach ||
        !may_take_off(instance, state, r, k, place, state.log.count[r].trips)) {
        return false;
    }
    const Setting setting(instance, b, k);
    const Leg driven = vehicle.legs + leg_of(setting, vehicle.node, place);
    for (Int node = setting.num_depots; node < setting.num_nodes; ++node) {
        if (state.served(r, node) || is_delivery(setting.pair, node)) continue;
        if (some_apart(setting.goods) && !may_follow(setting.goods[node], vehicle)) continue;
        if (instance.can_drive(b, k, node) && legs(place, node) + legs(node, home) <= reach &&
            may_drive_by(setting, driven, place, node) &&
            legal_by_trial(rollout, place, {node, false}, outlook)) {
            return true;
        }
        if (instance.can_fly(b, k, node) && legs(place, home) <= reach &&
            may_drive_home(setting, driven, place) &&
            legal_by_trial(rollout, place, {node, true}, outlook)) {
            return true;
        }
    }
    return false;
}

}  // namespace tandem
