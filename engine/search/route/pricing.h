// What a route costs whose trips are where they are, and when they begin.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// What no route costs.
constexpr double no_bar = 1e300;

// Write what a route costs whose trips are timed, and held as long as they have to be. In place;
// false if it breaks a rule.
//
// Where that costs less, its trips are held back; `settled` tells.
bool price_timed(const ProblemData& data, const Fleet& fleet, Int slot, bool& settled);

// As `price_timed`, of a route that is timed as soon as possible, none of its trips held.
bool price_driven(const ProblemData& data, const Fleet& fleet, Int slot, bool& settled);

// Write times and cost of a route whose loads are known and whose first trip begins no sooner than
// its release says. In place, as `price_timed`.
bool price_loaded(const ProblemData& data, const Fleet& fleet, Int slot, bool& settled);

}  // namespace tandem
