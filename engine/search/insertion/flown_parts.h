// Several pickups of a shipment and its delivery, of which drones serve some.
#pragma once

#include "search/insertion/best.h"

namespace tandem {

// Tries a shipment of several pickups, by the first of them, on a trip of a route, so that drones
// fetch some, or deliver it.
//
// Of each pickup the cheapest places are combined for each of the delivery's, so that all are
// aboard before it leaves; the cheapest combinations are timed anew.
void scan_flown_parts(const Insertion& insertion, Int slot, const Trip& trip);

}  // namespace tandem
