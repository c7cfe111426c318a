// One end of a shipment served otherwise, while the others stay.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// Lets a truck or a drone serve an end of a random shipment elsewhere on its trip, if drones may
// serve some end and that costs less than so much more.
//
// Whom a drone brings may depend on where another's parcel is fetched, and this on where the first
// is, so that both leave together, and neither comes back as well alone. In place; tells whether a
// route was changed and keeps all rules; if not, it may be broken.
bool move_end(const ProblemData& data, const Searcher& searcher, double rise);

}  // namespace tandem
