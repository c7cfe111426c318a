// A first plan by savings: routes of one customer each, joined end to end.
//
// References: Clarke and Wright (1964), scheduling of vehicles from a central depot to a number of
// delivery points, Operations Research 12:568-581.
#pragma once

#include "rules/load.h"
#include "search/route/layout.h"

namespace tandem {

// A customer in a chain: who comes before and behind; of its last, who comes first; the departure
// and the latest arrival; of its first, who comes last, how many there are, and how long to serve
// them and to drive from one to the next takes.
using Chain = tandem_chain;

// What a chain carries, by its first customer, in one tier.
using ChainCargo = tandem_chain_cargo;

// How far the routes of all whom a type may serve are.
Int length_of(const ProblemData& data, Int k, View<const Chain, 1> chain);

// Writes which type's trucks drive least for a customer alone: `nearest` (node,).
void write_nearest_types(const ProblemData& data, View<Int, 1> nearest);

// Writes how much more is driven if neighbours follow one another: less than 0, as a rule.
//
// Customer by customer, to the nearest `ranks`; 0 where there are not as many, and where the type
// may not serve both. The waiting or lateness that comes of it counts as a detour does that takes
// as long (`neighbourhood/tables`), at the speed of drives from where routes begin.
void write_excess(const ProblemData& data, Int k, Int ranks, View<Int, 1> excess);

// Makes keys of what pairs cost, but for its last `coarse` bits, and of their numbers. Sorted as
// they are, which processors do many at a time.
void number_pairs(View<Int, 1> excess, Int coarse);

// A customer and a neighbour, `nowhere` for none.
struct Neighbours {
    Int customer;
    Int neighbour;
};

// The customers that a number or key stands for.
Neighbours pair(const ProblemData& data, Int ranks, Int key);

// Lets a chain be one customer: `cargo` (tier,).
void set_up_cargo(const ProblemData& data, Int node, View<ChainCargo, 1> cargo);

// Whether a vehicle of a type may drive two chains as one, by their cargo (tier,).
bool may_join(const VehicleType& type, View<const ChainCargo, 1> front,
              View<const ChainCargo, 1> rear);

// Lets a chain carry what another does as well, which follows it: both (tier,).
void add_cargo(View<ChainCargo, 1> front, View<const ChainCargo, 1> rear);

// Joins the route that ends at one and that which begins at the other, pair after pair.
//
// `chain` (node,) and `cargo` (node, tier) are set up here.
void join(const ProblemData& data, Int k, Int ranks, View<const Int, 1> keys, View<Chain, 1> chain,
          const View<ChainCargo, 2>& cargo);

}  // namespace tandem
