#include "simulation/cost.h"

#include "rules/drone_types.h"
#include "rules/load.h"
#include "rules/shift.h"
#include "rules/window.h"
#include "simulation/vehicle_log.h"

namespace tandem {
namespace {

double in_hours(Int duration) { return static_cast<double>(duration) / ms_per_hour; }
double in_km(double distance) { return distance / mm_per_km; }

// Add what lateness and earliness at a customer cost.
void add_window_cost(const Instance& instance, Int b, Int node, Int arrival, Int start,
                     Cost& cost) {
    const Int late = lateness(instance.node[b][0][node], arrival);
    const Price& price = instance.price(b, node);
    cost.lateness += in_hours(late) * price.lateness;
    cost.earliness += in_hours(start - arrival) * price.waiting;
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
                load += aboard_at(setting, sortie.node, sortie.launch_stop, sortie.recovery_stop,
                                  index);
            }
        }
        const Int leg = legs(log.stop[index].node, log.stop[index + 1].node);
        carried += static_cast<double>(load) * static_cast<double>(leg);
    }
    return carried;
}

// Add the cost of the flights by drones whose type is at a row.
void add_flights(const Instance& instance, const VehicleLog& log, Int b, Int row, Cost& cost) {
    const Rate& rate = instance.rate(b, row);
    const View<const Int, 2> flights = instance.distance[b][instance.type(b, row).drone_travel];
    Int flown = 0;
    Int airborne = 0;
    for (const LoggedSortie& sortie : log.sortie.first(log.count.sorties)) {
        if (sortie.row != row) continue;
        flown += flights(log.stop[sortie.launch_stop].node, sortie.node);
        flown += flights(sortie.node, log.stop[sortie.recovery_stop].node);
        airborne += sortie.recovery_end - sortie.takeoff;
        add_window_cost(instance, b, sortie.node, sortie.arrival, sortie.start, cost);
    }
    cost.distance += in_km(static_cast<double>(flown)) * rate.drone_distance;
    cost.time += in_hours(airborne) * rate.drone_time;
}

}  // namespace

void add_cost(const Instance& instance, const Setting& setting, const VehicleLog& log, Int b, Int k,
              Cost& cost) {
    const Rate& rate = instance.rate(b, k);
    const View<const Int, 2> legs = instance.distance[b][setting.type.travel];
    Int driven = 0;
    for (Int index = 1; index < log.count.stops; ++index) {
        const LoggedStop& stop = log.stop[index];
        driven += legs(log.stop[index - 1].node, stop.node);
        if (stop.node >= instance.size[b].depots) {
            add_window_cost(instance, b, stop.node, stop.arrival, stop.start, cost);
        }
    }
    const Int end = log.stop[log.count.stops - 1].leave;
    const Int working = end - first_departure(setting, log, log.trip[0].start);
    const Int served = log.count.stops - 2 * log.count.trips;
    cost.fixed += rate.fixed;
    cost.distance += in_km(static_cast<double>(driven)) * rate.distance;
    if (rate.load > 0.0) {
        double carried = 0.0;
        for (Int trip = 0; trip < log.count.trips; ++trip) {
            carried += load_distance(legs, setting, log, trip);
        }
        cost.distance += in_km(carried) * rate.load;
    }
    cost.stops += static_cast<double>(served) * rate.stop;
    cost.time += in_hours(working) * rate.time;
    cost.overtime += in_hours(overtime(setting.type, end, working)) * rate.overtime;
    for (Int row = first_drone_row(setting.types, k); row >= 0;
         row = next_drone_row(setting.types, row)) {
        add_flights(instance, log, b, row, cost);
    }
}

}  // namespace tandem
