// Both ends of a shipment, where they cost least on one trip.
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

}  // namespace tandem
