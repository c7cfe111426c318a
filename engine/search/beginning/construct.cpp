#include "search/beginning/construct.h"

#include <algorithm>

#include "guard.h"
#include "rules/pair.h"
#include "search/route/state.h"

namespace tandem {

void disband(const ProblemData& data, Searcher& searcher) {
    const Fleet& now = searcher.now;
    SearchCounts& count = *searcher.count;
    ++count.stamp;
    count.changed = all_slots;
    count.absent = 0;
    for (Int slot = 0; slot < searcher.active.size(); ++slot) {
        Route& route = now.route[slot];
        route.stamp = count.stamp;
        route.length = route.sorties = route.trips = 0;
        now.cost[slot] = 0.0;
    }
    std::fill(now.used.begin(), now.used.end(), 0);
    for (Int node = 0; node < now.where.size(); ++node) {
        if (now.where[node].slot < 0) continue;
        now.where[node].slot = nowhere;
        if (!is_delivery(data.pair, node)) searcher.missing[count.missing++] = node;
    }
    list_active(searcher);
}

}  // namespace tandem

using namespace tandem;

extern "C" int tandem_disband(const tandem_problem_data* data, const tandem_searcher* searcher) {
    return guarded([&] {
        Searcher searching = searcher_of(*searcher);
        disband(data_of(*data), searching);
    });
}
