// The cheapest place for a customer among linked stops.
#pragma once

#include "search/linked/layout.h"

namespace tandem {

// Whether all were tried, and what routes cost more then.
struct Recreated {
    bool done;
    double added;
};

// Inserts the absent customers from number `first` on, each where it costs least; they are tried
// everywhere if `scan_all`, else nearby. As `recreate`.
Recreated recreate_linked(const ProblemData& data, Searcher& searcher, Linked& linked, Int first,
                          double spare, bool scan_all);

}  // namespace tandem
