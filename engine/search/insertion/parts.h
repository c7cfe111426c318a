// Several pickups of a shipment and its delivery, where they cost least on one trip.
#pragma once

#include "search/insertion/best.h"

namespace tandem {

// Tries a shipment of several pickups, by the first of them, on a trip of a route.
//
// A walk along the trip may take any pickup that is left behind each stop, and deliver once none
// is. Each pickup alone is tried behind those stops beside which it costs least. What a way has
// cost so far bounds all that may become of it; those that may be the best are timed anew.
void scan_parts(const Insertion& insertion, Int slot, const Trip& trip, bool is_walked);

}  // namespace tandem
