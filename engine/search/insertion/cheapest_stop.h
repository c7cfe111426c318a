// The cheapest stop for a customer where only the distance of the detour counts.
#pragma once

#include "search/insertion/best.h"

namespace tandem {

// Tells whether an insertion into a route costs its detour alone.
bool is_simple(const ProblemData& data, const Fleet& fleet, Int slot);

// Tells whether somebody may serve a customer more on a trip, and who that is: a larger type if
// that may be.
bool may_join(const Insertion& insertion, Int slot, Int index, Joining& joins);

// Tries the customer behind some stops of a trip where only distance counts, but for one.
void scan_trip(const Insertion& insertion, const Joining& joins, Int first, Int last,
               Int skipped = nowhere);

// Tries the customer on all trips of a route where only distance counts.
void scan_simple(const Insertion& insertion, Int slot);

// Tries the customer beside neighbours where only distance counts.
void scan_beside(const Insertion& insertion);

// Tries the customer on all routes where all are lean. In place: also what is kept.
void scan_lean(const Insertion& insertion);

}  // namespace tandem
