// A first plan by savings: routes of one customer each, joined end to end.
//
// References: Clarke and Wright (1964), scheduling of vehicles from a central depot to a number of
// delivery points, Operations Research 12:568-581.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// A customer in a chain of some that a route serves.
struct Chain {
    Int before, behind;
    Int route;   // of its last customer, the first
    Int leave;   // the departure
    Int latest;  // the latest arrival
    Int last;    // of its first customer, the last
    Int length;  // likewise, how many there are
    Int busy;    // likewise, how long to serve them and to drive from one to the next takes
    Leg legs;    // likewise, the legs between them as one
};

// Who comes before and behind each customer, (2, node).
using Beside = View<Int, 2>;

// Chains, and what they carry by their first customers, in tiers.
struct ChainCargo {
    explicit ChainCargo(const ProblemData& data);

    // Writes who is beside whom.
    void write(const Beside& beside) const;

    OwnRows<Chain, 1> chain;  // (node,)
    OwnRows<Cargo, 2> cargo;  // (node, tier)
};

// How far the routes of all whom a type may serve are.
Int length_of(const ProblemData& data, Int k, const Beside& beside);

// Writes which type's trucks drive least for a customer alone: `nearest` (node,).
void write_nearest_types(const ProblemData& data, View<Int, 1> nearest);

// Writes how much more is driven if neighbours follow one another: less than 0, as a rule.
//
// Customer by customer, to the nearest `ranks`; 0 where there are not as many, and where the type
// may not serve both. The waiting or lateness that comes of it counts as a detour does that takes
// as long (`neighbourhood/tables`), at the speed of drives from where routes begin.
void write_excess(const ProblemData& data, Int k, Int ranks, View<Int, 1> excess);

// Makes keys of what pairs cost, but for its last bits, and of their numbers. Sorted as they are,
// which processors do many at a time.
void number_pairs(View<Int, 1> excess);

// A customer and a neighbour, `nowhere` for none.
struct Neighbours {
    Int customer, neighbour;
};

// The customers that a number or key stands for.
Neighbours pair(const ProblemData& data, Int ranks, Int key);

// Lets a chain be one customer: `cargo` (tier,).
void set_up_cargo(const ProblemData& data, Int node, View<Cargo, 1> cargo);

// Whether a vehicle of a type may drive two chains as one, by their cargo (tier,).
bool may_join(const VehicleType& type, View<const Cargo, 1> front, View<const Cargo, 1> rear);

// Lets a chain carry what another does as well, which follows it: both (tier,).
void add_cargo(View<Cargo, 1> front, View<const Cargo, 1> rear);

// Joins the route that ends at one and that which begins at the other, pair after pair.
void join(const ProblemData& data, Int k, Int ranks, View<const Int, 1> keys, const Beside& beside);

// Joins routes at either end, pair after pair. As `join`.
void join_either_way(const ProblemData& data, Int k, Int ranks, View<const Int, 1> keys,
                     const Beside& beside);

}  // namespace tandem
