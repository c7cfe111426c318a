#include "search/insertion/passing.h"

#include <algorithm>

#include "randomness.h"
#include "search/insertion/cheapest_stop.h"

namespace tandem {

void scan_passing(const Insertion& insertion) {
    const auto& [data, searcher, node, enlarge, best] = insertion;
    const Fleet& fleet = searcher.now;
    const Int active = searcher.count->active;
    const Int begin = below(searcher.rng, active);
    const Int number = std::min(most_drawn, active / each_drawn);
    for (Int index = begin; index < begin + number; ++index) {
        const Int slot = searcher.active[index < active ? index : index - active];
        Joining joins;
        if (!data.can(fleet.route[slot].type, 0, node) || !may_join(insertion, slot, 0, joins)) {
            continue;
        }
        const Int last = fleet.trip(slot, 0).last - 1;
        scan_trip(insertion, joins, 0, 0);
        scan_trip(insertion, joins, last, last);
    }
}

}  // namespace tandem
