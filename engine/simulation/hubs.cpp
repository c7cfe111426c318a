#include "rules/hub.h"
#include "simulation/simulator.h"

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
    const VehicleType& type = instance.type(state.problem[r], vehicle.type);
    const VehicleLog log = log_of(state.log, r);
    taken.batteries += batteries_of(type, log, depot);
    taken.chargers += chargers_of(type, log, depot);
    return taken;
}

}  // namespace

bool may_take_off(const Instance& instance, const State& state, Int r, Int k, Int depot,
                  Int trips) {
    if (state.taken.shape(1) == 0) return true;
    const Int b = state.problem[r];
    const VehicleType& type = instance.type(b, k);
    return has_battery_for(type, instance.hub(b, depot),
                           taken_at(instance, state, r, depot).batteries) &&
           (depot == type.depot || charges_away(type, instance.hub(b, depot), trips)) &&
           has_charger_for(type, instance.hub(b, type.depot), trips,
                           taken_at(instance, state, r, type.depot).chargers);
}

void note_taken(const Instance& instance, State& state, Int r) {
    for (Int depot = 0; depot < state.taken.shape(1); ++depot) {
        state.taken(r, depot) = taken_at(instance, state, r, depot);
    }
}

}  // namespace tandem
