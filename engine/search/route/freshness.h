// Trips held back so that nobody's parcel is aboard, nobody who flies by itself in the air, and
// nobody served behind another, for too long.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// Return when truck or drone first leaves the depot on the timed trip from stop `first` on.
Int departure_of(const ProblemData& data, const Route& route, View<const Stop, 1> stops,
                 View<const Sortie, 1> sorties, Int first);

// Tell whether trips of type `k` may have to be held back.
bool holds_count(const ProblemData& data, Int k);

// Tell whether somebody's parcel is too long aboard on a timed route, a trip too long in the air,
// or somebody served too soon or too late behind another.
bool any_too_long(const ProblemData& data, const Route& route, View<const Stop, 1> stops,
                  View<const Trip, 1> trips, View<const Sortie, 1> sorties);

// Let each trip of a timed route begin as soon as nothing lasts too long, and its battery is
// charged.
//
// In place; false if that doesn't help, or a rule is broken.
bool hold_trips(const ProblemData& data, Route& route, View<Stop, 1> stops,
                View<const Trip, 1> trips, View<Sortie, 1> sorties);

}  // namespace tandem
