#include "search/moves/halting.h"

#include "randomness.h"
#include "search/route/edit.h"
#include "search/route/refresh.h"
#include "search/route/state.h"
#include "search/scratch.h"

namespace tandem {

namespace {

constexpr double near_stop_share =
    0.5;  // how often a site is near the stop before, not the customer

// Go on from a route that was kept aside. In place.
void put_back(const ProblemData& data, const Fleet& now, Int slot, Int spare) {
    keep_aside(now, spare, slot);
    refresh(data, now, slot);
}

}  // namespace

void halt_for(const ProblemData& data, const Searcher& searcher, Int node) {
    const Fleet& now = searcher.now;
    const Int touched = searcher.count->touched;
    if (touched == 0) return;
    const Int slot = searcher.touched[below(searcher.rng, touched)];
    const Int length = now.route[slot].length;
    if (length == 0) return;
    const Int p = below(searcher.rng, length - 1);
    const Stop& stop = now.stop(slot, p);
    if (stop.kind == end_stop) return;
    const bool near_stop = stop.kind == customer_stop && uniform(searcher.rng) < near_stop_share;
    const View<const std::int32_t, 1> near = data.near_halts[near_stop ? stop.node : node];
    const Int halt = near[below(searcher.rng, near.size())];
    if (halt < 0) return;
    const Int spare = now.route.size() - 2;
    keep_aside(now, slot, spare);
    insert_stops(sequence_in(now, slot), p + 1, {{halt, halt_stop}});
    if (!refresh(data, now, slot)) put_back(data, now, slot, spare);
    locate(now, slot);
}

void drop_idle_halts(const ProblemData& data, const Searcher& searcher) {
    const Fleet& now = searcher.now;
    const Int spare = now.route.size() - 2;
    for (const Int slot : searcher.touched.first(searcher.count->touched)) {
        const Int length = now.route[slot].length;
        if (length == 0) continue;
        keep_aside(now, slot, spare);
        close_ranks(sequence_in(now, slot), searcher.marked, searcher.scratch->moved);
        if (now.route[slot].length == length) continue;
        if (!refresh(data, now, slot)) put_back(data, now, slot, spare);
        locate(now, slot);
    }
}

}  // namespace tandem
