

#include "guard.h"
#include "simulation/simulator.h"
#include "simulation/transition.h"
#include "simulation/vehicle_log.h"

namespace tandem {
namespace {

// Of drones that any vehicle has, at least one.
Int most_drones(const Instance& instance) {
    Int most = 1;
    for (const ProblemTables& problem : instance.problem) {
        for (const VehicleType& type : problem.type) most = std::max(most, type.drones);
    }
    return most;
}

Int most_customers(const Instance& instance) {
    Int most = 0;
    for (const ProblemTables& problem : instance.problem)
        most = std::max(most, customers_of(problem));
    return most;
}

}  // namespace

State::State(const Instance& instance, Int rows)
    : problem({rows}),
      served({rows, instance.problem[0].node.shape(1)}),
      num_unserved({rows}),
      used({rows, instance.problem[0].type.size()}),
      taken({rows, instance.problem[0].hub.size()}),
      starts({rows, !instance.problem[0].across.empty() ? instance.problem[0].node.shape(1) : 0}),
      done({rows}),
      vehicle({rows}),
      drone({rows, most_drones(instance)}),
      log(rows, most_customers(instance)),
      cost({rows}),
      fresh({instance.problem.size(), instance.problem[0].type.size(),
             instance.problem[0].node.shape(1)}) {
    for (Vehicle& each : vehicle) clear_vehicle(each);
    for (Int row = 0; row < rows; ++row) {
        std::ranges::fill(starts[row], none);
        for (Drone& each : drone[row]) each.sortie = in_flight;
    }
}

State::State(const Instance& instance, View<const Int, 1> problems, Int scratch)
    : State(instance, problems.size() + scratch) {
    mark_fresh(instance, *this, problems.size());
    for (Int r = 0; r < problems.size(); ++r) {
        problem[r] = problems[r];
        num_unserved[r] = customers_of(instance.problem.at(problems[r]));
    }
}

}  // namespace tandem

using namespace tandem;

extern "C" {

int tandem_open_state(const tandem_instance* instance, const tandem_i64_1d* problems,
                      std::int64_t scratch, tandem_state** state) {
    return guarded(
        [&] { *state = std::make_unique<tandem_state>(*instance, *problems, scratch).release(); });
}

int tandem_close_state(tandem_state* state) {
    return guarded([&] { const std::unique_ptr<tandem_state> owned(state); });
}

int tandem_look_at_state(tandem_state* state, tandem_state_seen* seen) {
    return guarded([&] {
        *seen = {state->served, state->num_unserved, state->used, state->done, state->cost};
    });
}

int tandem_look_at_vehicle(tandem_state* state, std::int64_t r, tandem_under_way* vehicle) {
    return guarded([&] {
        const Vehicle& open = state->vehicle.at(r);
        const Int type = open.idle != 0 ? no_vehicle : open.type;
        *vehicle = {type, open.node, open.service_end, open.distance, {}};
        std::ranges::copy(open.load, vehicle->load);
    });
}

}  // extern "C"
