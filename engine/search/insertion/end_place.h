// Where an end of a shipment is served on a trip.
#pragma once

#include "problem/instance.h"

namespace tandem {

constexpr Int by_wheels = -1;  // instead of a row of drones
constexpr Int by_same = -2;    // likewise, of a delivery by the sortie that fetches
constexpr Int at_stop_there = -1;

// By truck behind stop `first`, or by a drone of a row from `first` to `last`; a delivery perhaps
// from behind `first`, where the truck makes pickup number `from`, and back there if that is
// `last`.
struct EndPlace {
    double cost;
    Int row, first, last;
    Int from = at_stop_there;

    // From where on a pickup is aboard, and where a delivery leaves, in half stops.
    Int aboard() const { return row == by_wheels ? 2 * first + 1 : 2 * last; }
    Int leaves() const { return row == by_wheels ? 2 * first + 1 : launch(); }

    // From where to where a drone flies, in half stops.
    Int launch() const { return 2 * first + (flies_on() ? 1 : 0); }
    Int recovery() const { return std::max(launch(), 2 * last); }

    bool is_flown() const { return row >= 0; }
    bool flies_on() const { return from >= 0; }

    bool operator<(const EndPlace& other) const { return cost < other.cost; }
};

}  // namespace tandem
