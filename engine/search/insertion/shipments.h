// Shipments, of one pickup or several, where they cost least.
#pragma once

#include "search/insertion/best.h"

namespace tandem {

// Tries a shipment, by its pickup, on the trips of a route.
//
// Each pickup's detour bounds all deliveries behind it. Where routes are timed by what is known of
// their stops, a walk from the pickup on prices all of its deliveries in the time of the walk; else
// each that may be the best is timed anew.
void scan_pair(const Insertion& insertion, Int slot);

// Tries a shipment on the routes of neighbours of either end.
void scan_pair_beside(const Insertion& insertion);

// Tries a shipment on trips of its own of a route.
void try_pair_trips(const Insertion& insertion, Int slot);

// Tries a shipment, by its pickup, on a trip of a truck with drones, that fly one end at least.
//
// Of the places of each end the cheapest are kept, of their pairs the cheapest timed anew.
void scan_flown(const Insertion& insertion, Int slot, const Trip& trip);

// Tries a shipment of several pickups, by the first of them, on a trip of a route.
//
// A walk along the trip may take any pickup that is left behind each stop, and deliver once none
// is. Each pickup alone is tried behind those stops beside which it costs least. What a way has
// cost so far bounds all that may become of it; those that may be the best are timed anew.
void scan_parts(const Insertion& insertion, Int slot, const Trip& trip, bool is_walked);

// Tries a shipment of several pickups, by the first of them, on a trip of a route, so that drones
// fetch some, or deliver it.
//
// Of each pickup the cheapest places are combined for each of the delivery's, so that all are
// aboard before it leaves; the cheapest combinations are timed anew.
void scan_flown_parts(const Insertion& insertion, Int slot, const Trip& trip);

// Tries such a shipment, by the first pickup, on a trip of its own behind a stop of a route, in
// several orders and ways.
void try_parts_trip(const Insertion& insertion, Int slot, Int behind);

// Writes a route that serves such a shipment alone, in the best of several orders, by truck or in
// ways in which drones serve some end. False if none keeps the rules. In place.
bool serve_parts_alone(const ProblemData& data, const Fleet& fleet, Int slot, Int k, Int node,
                       bool by_drone);

// Likewise, in some way, drawn of all. False if it may not.
bool serve_parts_anyhow(const ProblemData& data, const Fleet& fleet, Int slot, Int k, Int node,
                        View<std::uint64_t, 1> rng);

}  // namespace tandem
