// Who goes with whom: customers whom relations keep together, on one trip or by one vehicle.
//
// A relation is a bit. Whoever is served notes those he is in; who is apart is so by goods
// (`rules/load.h`).
#pragma once

#include "problem/instance.h"

namespace tandem {

// The relations by which all others served go on a customer's trip.
inline Int kept_on_trip(const Goods& company) { return company.kept_on_trip; }

// The relations by which all others served go by a customer's vehicle.
inline Int kept_by_vehicle(const Goods& company) {
    return company.kept_on_trip | company.kept_on_vehicle;
}

// Whether a customer may go on a trip, by the relations of those on it, and of those on any trip of
// its vehicle.
inline bool joins_trip(const Goods& company, Int on_trip, Int by_vehicle) {
    return (kept_on_trip(company) & by_vehicle & ~on_trip) == 0;
}

// Whether a customer may be served although those of some relations can't be joined any more.
inline bool joins_anybody(const Goods& company, Int parted) {
    return (kept_by_vehicle(company) & parted) == 0;
}

// Whether a customer goes with those of some relations, on one trip or by one vehicle.
inline bool goes_with(const Goods& company, Int on_trip, Int by_vehicle) {
    return (kept_on_trip(company) & on_trip) != 0 || (kept_by_vehicle(company) & by_vehicle) != 0;
}

}  // namespace tandem
