#include "rules/drone_types.h"
#include "rules/hub.h"
#include "simulation/simulator.h"
#include "simulation/vehicle_log.h"

namespace tandem {
namespace {

// Return how many batteries the open vehicle has taken from a depot.
Int batteries_of(const VehicleType& type, const VehicleLog& log, Int depot) {
    if (!takes_batteries(type)) return 0;
    Int taken = 0;
    for (const LoggedTrip& trip : log.trip.first(log.count.trips)) {
        if (log.stop[trip.first_stop].node == depot) ++taken;
    }
    return taken;
}

// Return how many places to charge the open vehicle has taken at a depot.
Int chargers_of(const VehicleType& type, const VehicleLog& log, Int depot) {
    return type.depot == depot && needs_charger(type, log.count.trips) ? 1 : 0;
}

// Return what all vehicles so far have taken at a depot.
Hub taken_at(const Instance& instance, const State& state, Int r, Int depot) {
    Hub taken = state.taken(r, depot);
    const Vehicle& vehicle = state.vehicle[r];
    if (vehicle.type == no_vehicle) return taken;
    const VehicleType& type = instance.problem[state.problem[r]].type[vehicle.type];
    const VehicleLog log = log_of(state.log, r);
    taken.batteries += batteries_of(type, log, depot);
    taken.chargers += chargers_of(type, log, depot);
    return taken;
}

}  // namespace

bool may_take_off(const Instance& instance, const State& state, Int r, Int k, Int depot,
                  Int trips) {
    if (state.taken.shape(1) == 0) return true;
    const View<const Hub, 1> hub = instance.problem[state.problem[r]].hub;
    const VehicleType& type = instance.problem[state.problem[r]].type[k];
    return has_battery_for(type, hub[depot], taken_at(instance, state, r, depot).batteries) &&
           (depot == type.depot || charges_away(type, hub[depot], trips)) &&
           has_charger_for(type, hub[type.depot], trips,
                           taken_at(instance, state, r, type.depot).chargers);
}

void note_taken(const Instance& instance, State& state, Int r) {
    for (Int depot = 0; depot < state.taken.shape(1); ++depot) {
        state.taken(r, depot) = taken_at(instance, state, r, depot);
    }
}

namespace {

// Add what lateness and earliness cost at a customer, whose service begins at `start`.
void add_window_cost(const ProblemTables& problem, Int node, Int arrival, Int start, Cost& cost) {
    const Windows place = problem.node[0][node];
    const Price& price = problem.price[node];
    cost.lateness += lateness_cost(price, place, start, hours_and_km);
    cost.earliness += waiting_cost(price, place, arrival, hours_and_km);
}

// Add what it costs by whom customers are served.
void add_vehicle_cost(View<const double, 1> price, const VehicleLog& log, Cost& cost) {
    for (const LoggedStop& stop : log.stop.first(log.count.stops)) cost.stops += price[stop.node];
    for (const LoggedSortie& sortie : log.sortie.first(log.count.sorties)) {
        cost.stops += price[sortie.node];
    }
}

// What of a customer's is on the truck when it leaves a stop, in the first dimension. The parcel
// leaves it at stop `left`, what is picked up comes aboard at stop `came`.
Int aboard_at(const Setting& setting, Int node, Int left, Int came, Int stop) {
    Int aboard = 0;
    if (left > stop) aboard += delivered_of(setting.amount, node, 0)[0];
    if (came <= stop) aboard += picked_of(setting.amount, node, 0)[0];
    return aboard;
}

// The load in the first dimension times the way it is driven, on one trip.
double load_distance(View<const Int, 2> legs, const Setting& setting, const VehicleLog& log,
                     Int trip) {
    const Int first = log.trip[trip].first_stop;
    const bool is_last = trip + 1 == log.count.trips;
    const Int behind = is_last ? log.count.stops : log.trip[trip + 1].first_stop;
    double carried = 0.0;
    for (Int index = first; index < behind - 1; ++index) {
        Int load = setting.type.carried;
        for (Int other = first + 1; other < behind - 1; ++other) {
            load += aboard_at(setting, log.stop[other].node, other, other, index);
        }
        for (const LoggedSortie& sortie : log.sortie.first(log.count.sorties)) {
            if (first <= sortie.launch_stop && sortie.launch_stop < behind) {
                // What a drone delivers of a shipment leaves with it, what it picks up comes back.
                const Int came = is_delivery(setting.pair, sortie.node) ? sortie.launch_stop
                                                                        : sortie.recovery_stop;
                load += aboard_at(setting, sortie.node, sortie.launch_stop, came, index);
            }
        }
        const Int leg = legs(log.stop[index].node, log.stop[index + 1].node);
        carried += double(load) * double(leg);
    }
    return carried;
}

// Add the cost of the flights by drones whose type is at a row.
void add_flights(const Setting& setting, const VehicleLog& log, Int row, Cost& cost) {
    const Rate& rate = setting.rate[row];
    const View<const Int, 2> flights = setting.distances[setting.types[row].drone_travel];
    Int flown = 0, airborne = 0;
    for (const LoggedSortie& sortie : log.sortie.first(log.count.sorties)) {
        if (sortie.row != row) continue;
        flown += flights(log.stop[sortie.launch_stop].node, sortie.node);
        flown += flights(sortie.node, log.stop[sortie.recovery_stop].node);
        airborne += sortie.recovery_end - sortie.takeoff;
        add_window_cost(setting, sortie.node, sortie.arrival, sortie.start, cost);
    }
    cost.distance += flown_cost(rate, flown, hours_and_km);
    cost.time += airborne_cost(rate, airborne, hours_and_km);
}

}  // namespace

void add_cost(const Setting& setting, const VehicleLog& log, Int k, Cost& cost) {
    const Rate& rate = setting.rate[k];
    const View<const Int, 2> legs = setting.ways;
    Int driven = 0;
    for (Int index = 1; index < log.count.stops; ++index) {
        const LoggedStop& stop = log.stop[index];
        driven += legs(log.stop[index - 1].node, stop.node);
        if (stop.node >= setting.num_depots) {
            add_window_cost(setting, stop.node, stop.arrival, stop.start, cost);
        }
    }
    const Int end = log.stop[log.count.stops - 1].leave;
    const Int working =
        end - first_departure(setting, log, log.trip[0].start) - unpaid_in(setting, log);
    const Int served = log.count.stops - 2 * log.count.trips;
    cost.fixed += rate.fixed;
    cost.distance += drive_cost(rate, driven, hours_and_km);
    if (rate.load > 0.0) {
        double carried = 0.0;
        for (Int trip = 0; trip < log.count.trips; ++trip) {
            carried += load_distance(legs, setting, log, trip);
        }
        cost.distance += load_cost(rate, carried, hours_and_km);
    }
    cost.stops += stops_cost(rate, served);
    if (!setting.vehicle_cost.empty()) add_vehicle_cost(setting.vehicle_cost[k], log, cost);
    add_work_cost(rate, paid_work(setting.type, end, working), hours_and_km, cost);
    for (Int row = first_drone_row(setting.types, k); row >= 0;
         row = next_drone_row(setting.types, row)) {
        add_flights(setting, log, row, cost);
    }
}

}  // namespace tandem
