// Places for a customer on a route: behind a stop, on sorties, on trips of the customer's own.
//
// Each lists, in `Scratch::offer`, the insertions that may cost less than the best so far.
#pragma once

#include "search/insertion/best.h"
#include "search/scratch.h"

namespace tandem {

// What it saves at most that a route's vehicle serves a customer, beside all that it drives and
// flies further: what its waiting costs, less what it costs that it is this vehicle.
inline double most_saved(const ProblemData& data, const Fleet& fleet, Int slot, Int node) {
    return fleet.early[slot] - vehicle_cost_at(data.vehicle_cost, fleet.route[slot].type, node);
}

// Lists an insertion that costs at least `cost`; returns it, to complete it. Were there no room, it
// would take the place of the last one.
inline Offer& add_offer(const Searcher& searcher, double cost, Int slot, Int first, Int last) {
    Scratch& scratch = *searcher.scratch;
    if (scratch.offers < scratch.offer.size()) ++scratch.offers;
    const Int index = scratch.offers - 1;
    scratch.least[index] = cost;
    return scratch.offer[index].between(slot, searcher.now.route[slot].type, first, last);
}

// Tells whether a customer may join a trip's up to stop `p`, or the rest, by what is carried.
bool part_fits(const ProblemData& data, const Fleet& fleet, Int slot, Int p, Int node, bool front);

// Tells whether a vehicle of type `k` may serve a customer on a trip of its own, by loads.
bool may_begin(const ProblemData& data, Int k, Int node);

// Tells whether a simple route may have a trip more as a move says.
bool more_trips_fit(const ProblemData& data, const Fleet& fleet, const Move& move, Int node);

// From where to where a drone is wanted, in half stops: a stop to come is between two.
struct Stretch {
    Int launch, recovery;
};

// Returns a drone of a row that is aboard from launch to recovery; `nowhere`: there is none.
//
// That which flies least from and to these stops, so that drones fly side by side; on the trip, if
// drones are charged aboard.
Int free_drone(const ProblemData& data, const Fleet& fleet, Int slot, Stretch stretch, Int row);

constexpr Int max_span = 8;  // how many stops after its launch a sortie is recovered at most

// How many insertions begin at a stop at most, a customer behind it and sorties from there.
constexpr Int at_one_stop = max_span + 2;

constexpr Int max_landings = 2;  // launch sites where a sortie is recovered that begins at another

// How many begin or end at a launch site behind a stop at most, by each type of drones.
constexpr Int at_one_halt = (2 + max_landings) * max_span + 2;

// Lists a customer behind each stop of a trip from `first` to `last`, if that may be cheaper.
//
// For where more than distance counts.
void offer_stops(const Insertion& insertion, Int slot, Int first, Int last);

// Lists sorties to a customer from each stop of a trip from `first` to `last`, by each type of
// drones.
void offer_sorties(const Insertion& insertion, Int slot, Int first, Int last);

// Lists sorties to a customer for which the truck stops at a launch site near by more, between
// stops of a trip from `first` to the one behind `last`.
void offer_halts(const Insertion& insertion, Int slot, Int first, Int last);

// Lists a customer on each sortie of a route.
void offer_joining(const Insertion& insertion, Int slot);

// Lists trips that a drone flies alone to a customer.
void offer_flight_trips(const Insertion& insertion, Int slot);

// Lists trips of their own of a route's vehicle to launch sites, from where a customer is flown to.
void offer_halt_trips(const Insertion& insertion, Int slot);

// Lists trips of a route's vehicle to a customer alone.
void offer_trips_alone(const Insertion& insertion, Int slot);

// Lists a customer where a trip is split, at the end of the one part or the beginning of the other.
void offer_splits(const Insertion& insertion, Int slot);

// Takes the cheapest of the insertions listed, if it is the best and isn't overlooked.
//
// Those that may be cheapest are priced first, so that most need not be; none is once the search
// must end.
void take_cheapest(const Insertion& insertion);

}  // namespace tandem
