// Routes of one trip where distance alone costs: only loads, departures and latest arrivals.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// Write what a lean route needs. In place; false if it breaks a rule.
bool refresh_lean(const ProblemData& data, const Fleet& fleet, Int slot);

// Insert a customer behind stop `p` where that is known to keep all rules. In place.
void insert_lean(const ProblemData& data, const Fleet& fleet, Int slot, Int p, Int node);

}  // namespace tandem
