// Ways along a route on which a driver rests as late as allowed, or while waiting: mostly one of
// them is the best of all.
#pragma once

#include "search/route/best_rests.h"
#include "search/route/rest_labels.h"

namespace tandem {

// Follow such ways along a route without flights or orders until one is as good as any can be. In
// place: `best`. Tell whether it is.
bool rest_late(const RestRoute& route, BestRests& best, TakenRests& taken);

}  // namespace tandem
