// What is aboard along linked stops, where more than the load of a route tells: loads both ways, or
// of more dimensions than three.
#pragma once

#include "search/insertion/best.h"
#include "search/linked/layout.h"

namespace tandem {

// Whether what is aboard has to be looked at from stop to stop.
inline bool looks_aboard(const Linked& linked) { return !linked.aboard.empty(); }

// Lets rows tell what leaves and comes aboard at each customer.
void note_amounts(const ProblemData& data, Linked& linked);

// Writes the rows of a route. False if that breaks a rule.
bool weigh_run(const ProblemData& data, const Linked& linked, Int slot);

// Whether there is room for a customer who joins a route between two.
bool has_room_between(const ProblemData& data, const Linked& linked, const Joining& joins,
                      Int before, Int behind);

// Whether a vehicle of a type may hold what a route carries and a customer's amounts, wherever he
// is served; parcels alone aren't looked at.
bool may_hold_more(const ProblemData& data, const Linked& linked, Int slot, const VehicleType& type,
                   Int node);

// Whether a vehicle of a type holds what a route carries, and may stop so often.
bool can_take(const ProblemData& data, const Linked& linked, Int slot, const VehicleType& type);

// Whether a vehicle of a type may carry what the head of a route up to a customer does, then a tail
// that another leads, by what is aboard alone. Depots stand for nobody.
bool may_carry_both(const ProblemData& data, const Linked& linked, const VehicleType& type,
                    Int head, Int tail);

}  // namespace tandem
