// Where an end of a shipment is served on a trip.
#pragma once

#include "problem/instance.h"

namespace tandem {

constexpr Int by_wheels = -1;  // instead of a row of drones
constexpr Int by_same = -2;    // likewise, of a delivery by the sortie that fetches

// By truck behind stop `first`, or by a drone of a row from `first` to `last`.
struct EndPlace {
    double cost;
    Int row, first, last;

    // From where on a pickup is aboard, and where a delivery leaves, in half stops.
    Int aboard() const { return row == by_wheels ? 2 * first + 1 : 2 * last; }
    Int leaves() const { return row == by_wheels ? 2 * first + 1 : 2 * first; }

    bool is_flown() const { return row >= 0; }

    bool operator<(const EndPlace& other) const { return cost < other.cost; }
};

}  // namespace tandem
