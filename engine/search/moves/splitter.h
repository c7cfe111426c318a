// An order of customers, cut at best into what a truck and its drone do together.
//
// The order is cut into operations that begin and end with truck and drone together, by dynamic
// programming. Waiting for windows is left to the exact timing that follows.
//
// References: Agatz, Bouman and Schmidt (2018), optimization approaches for the traveling salesman
// problem with drone, Transportation Science 52:965-981.
#pragma once

#include "search/moves/split.h"

namespace tandem {

// Cut the line into operations at least cost; return that. In place; infinite if it can't be cut.
double split(const ProblemData& data, Int k, View<Line, 1> line, Int length, SplitScratch& scratch);

// Which places of a line were changed, how it was split before, and how much more it may cost at
// most.
struct Changed {
    Places places;
    const SplitScratch& before;
    double most;
};

// Cut a changed line as `split` does; infinite if it would cost more than it may.
//
// What comes before the change isn't looked at again, nor what comes behind it once that tells.
double split_changed(const ProblemData& data, Int k, View<Line, 1> line, Int length,
                     const Changed& changed, SplitScratch& scratch);

}  // namespace tandem
