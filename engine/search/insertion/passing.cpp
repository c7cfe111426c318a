#include "search/insertion/passing.h"

#include <algorithm>

#include "randomness.h"
#include "search/insertion/cheapest_stop.h"

namespace tandem {

double scan_passing_lean(const ProblemData& data, const Searcher& searcher, Int node, double best,
                         bool enlarge) {
    const Fleet& fleet = searcher.now;
    const Int active = searcher.count->active;
    const Int begin = below(searcher.rng, active);
    const Int number = std::min(most_drawn, active / each_drawn);
    for (Int index = begin; index < begin + number; ++index) {
        const Int slot = searcher.active[index < active ? index : index - active];
        const Int k = fleet.route[slot].type;
        if (!data.can(k, 0, node)) continue;
        const Serving serving = serving_type(data, fleet, slot, 0, node, enlarge);
        if (serving.type < 0 || (serving.type != k && serving.cost >= best)) continue;
        const Int last = fleet.trip(slot, 0).last;
        best = take_cheaper(data, searcher, slot, {0, last - 1}, node, serving, best);
    }
    return best;
}

}  // namespace tandem
