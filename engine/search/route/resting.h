// Where those rest on a route whom rules ask to, and where they have breaks that aren't chosen by
// `break_choices`.
#pragma once

#include "rules/driving.h"
#include "search/route/layout.h"

namespace tandem {

// Tell whether a rest is taken on a timed route.
bool any_rest(const VehicleType& type, const Route& route);

// Tell whether a timed route may work for less if fewer or others are served on it, by more than
// the hours that they take.
bool may_save_more(const ProblemData& data, const Route& route);

// Write times as soon as possible, with breaks, and the rests that rules ask for, placed so that
// the route ends as soon as possible. In place; false if a rule is broken.
//
// Gaps between stops then hold rests. They are placed by dynamic programming along the route: of
// two ways to have come somewhere, one is no worse if the truck is there as soon, with no more
// driven or worked since the last rest, and the same drones out since the same instants. Who needs
// none is timed as any other.
bool drive_by_rules(const ProblemData& data, Route& route, View<Stop, 1> stops,
                    View<Sortie, 1> sorties);

// Tell whether somebody may have to rest on a route who serves a customer more behind stop `p`, or
// has to already.
bool may_have_to_rest(const ProblemData& data, const Fleet& fleet, Int slot, Int p, Int node);

}  // namespace tandem
