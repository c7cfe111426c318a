#include "search/route/hubs.h"

#include "rules/hub.h"
#include "search/route/rarer.h"

namespace tandem {
namespace {

// Return how many batteries of a depot the routes take.
Int batteries_taken(const ProblemData& data, const Searcher& searcher, Int depot) {
    const Fleet& now = searcher.now;
    Int taken = 0;
    for (const Int slot : searcher.active) {
        const Route& route = now.route[slot];
        if (route.length == 0 || !takes_batteries(data.type[route.type])) continue;
        for (const Trip& trip : now.trip[slot].first(route.trips)) {
            if (now.stop(slot, trip.first).node == depot) ++taken;
        }
    }
    return taken;
}

}  // namespace

bool may_take_off(const ProblemData& data, const Searcher& searcher, Int k, Int depot) {
    if (!hubs_count(data)) return true;
    const VehicleType& type = data.type[k];
    const Hub& begun = data.hub[depot];
    return !takes_batteries(type) || begun.batteries >= unlimited ||
           has_battery_for(type, begun, batteries_taken(data, searcher, depot));
}

bool hubs_suffice(const ProblemData& data, const Searcher& searcher) {
    for (Int depot = 0; depot < data.hub.size(); ++depot) {
        const Hub& hub = data.hub[depot];
        if (hub.batteries < unlimited && batteries_taken(data, searcher, depot) > hub.batteries) {
            return false;
        }
    }
    return true;
}

}  // namespace tandem
