// The decision process: begin, list the legal actions, act, over a batch of rollouts.
//
// One action per step, vehicle after vehicle: drive to a customer, launch a drone to a customer,
// return to a depot, open a vehicle of a type. A sortie is recovered at the next stop, or at the
// stop that launched it when it could not be met at the next within endurance. An action is legal
// exactly when the plan so far, that action and a direct return to the depot make a legal plan, all
// as soon as possible but the first departure, which is as late as costs nothing: a working
// duration is not kept by being late. So no legal action leads into an illegal plan. Where a route
// may not end at a depot, a trip may only if a further one can follow.
#pragma once

#include "simulation/meeting.h"

namespace tandem {

// Add the cost of the vehicle in the log, of type `k`.
void add_cost(const Setting& setting, const VehicleLog& log, Int k, Cost& cost);

// Tell whether a vehicle of type `k` that has made so many trips may begin one at a depot, by what
// is left there.
bool may_take_off(const Instance& instance, const State& state, Int r, Int k, Int depot, Int trips);

// Add what the open vehicle has taken to what those closed before have. In place.
void note_taken(const Instance& instance, State& state, Int r);

enum class ActionKind : Int { drive, launch, end_trip, open };

constexpr Int num_kinds = 4;

// The code of an action; `target` is a customer's node, a depot's node or a type.
constexpr Int encode_action(ActionKind kind, Int target) { return target * num_kinds + Int(kind); }

constexpr ActionKind kind_of(Int action) { return static_cast<ActionKind>(action % num_kinds); }

constexpr Int target_of(Int action) { return action / num_kinds; }

// Write the codes of the legal actions of one rollout and what each leads to; return how many.
//
// `outlooks` (action,) is written for customers alone.
Int legal_actions(const Instance& instance, State& state, Int r, Int scratch, View<Int, 1> actions,
                  View<Outlook, 1> outlooks);

// Do one legal action of one rollout.
void apply(const Instance& instance, State& state, Int r, Int action);

// Do legal actions of one rollout, the `first` and all before the next vehicle opens.
//
// Returns the index of the action that opens it, or how many there are.
Int apply_route(const Instance& instance, State& state, Int r, View<const Int, 1> actions,
                Int first);

// Write what each vehicle costs, (vehicle,), as if there were no other.
//
// `actions` are legal ones of some plan.
void price_routes(const Instance& instance, State& state, Int r, View<const Int, 1> actions,
                  View<Cost, 1> price);

// End a rollout that has no legal action left: close its vehicle, count who is left.
void finish(const Instance& instance, State& state, Int r);

// Find who could be served alone by a fresh vehicle of each type. `scratch` and the row before it
// are scratch rows.
void mark_fresh(const Instance& instance, State& state, Int scratch);

}  // namespace tandem
