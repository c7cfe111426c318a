// Shipments of which drones fly one end or both, where they cost least on a trip.
#pragma once

#include "search/insertion/best.h"

namespace tandem {

// Tries a shipment, by its pickup, on a trip of a truck with drones, that fly one end at least.
//
// Of the places of each end the cheapest are kept, of their pairs the cheapest timed anew.
void scan_flown(const Insertion& insertion, Int slot, const Trip& trip);

}  // namespace tandem
