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

// Tries a shipment on trips of its own of a route, in several orders and ways.
void try_pair_trips(const Insertion& insertion, Int slot);

// Tries a shipment of several pickups, by the first of them, on a trip of a route.
//
// A walk along the trip may take any pickup that is left behind each stop, and deliver once none
// is. Each pickup alone is tried behind those stops beside which it costs least. What a way has
// cost so far bounds all that may become of it; those that may be the best are timed anew.
void scan_parts(const Insertion& insertion, Int slot, const Trip& trip, bool is_walked);

// Tries a shipment, by its first pickup, on a trip of a route, so that drones fetch some of its
// parts, or deliver it.
//
// Of each pickup the cheapest places are combined for each of the delivery's, so that all are
// aboard before it leaves; the cheapest combinations are timed anew.
void scan_flown(const Insertion& insertion, Int slot, const Trip& trip);

}  // namespace tandem
