
#include <utility>

#include "search/linked/store.h"
#include "search/linked/turn.h"
#include "search/search.h"

namespace tandem {
namespace {

// Customers that are noted in a turn: it removes the most, to the last string.
Int most_noted(const ProblemData& data) { return std::min(data.num_nodes, 2 * most_removed); }

CheapestVehicle cheapest_of(const ProblemData& data) {
    CheapestVehicle least{data.rate[0].distance, data.rate[0].stop};
    for (const Rate& rate : data.rate.first(data.num_types)) {
        least = {std::min(least.distance, rate.distance), std::min(least.stop, rate.stop)};
    }
    return least;
}

}  // namespace

bool is_one_travel(const ProblemData& data) {
    const auto types = data.type.first(data.num_types);
    return std::ranges::all_of(
        types, [&](const VehicleType& type) { return type.travel == types[0].travel; });
}

Linked::Linked(const ProblemData& data, const Searcher& searcher, Int moments,
               std::shared_ptr<const Nearness> nearness)
    : link({data.num_nodes}),
      run({searcher.active.size()}),
      piece({most_noted(data)}),
      removed({most_noted(data)}),
      removed_node({most_noted(data)}),
      entry({data.num_nodes}),
      moment({moments}),
      retyped({searcher.active.size()}),
      former({searcher.active.size()}),
      hit({searcher.active.size()}),
      measured(std::move(nearness)),
      near(*measured),
      best_first({searcher.active.size()}),
      best_type({searcher.active.size()}),
      best_behind({data.num_nodes}),
      cheapest(cheapest_of(data)),
      timed(moments > 0),
      reach({data.num_nodes}),
      aboard({data.amount.shape(1), data.num_nodes + 2 * searcher.active.size()}),
      stale({searcher.active.size()}),
      one_travel(is_one_travel(data)) {
    std::ranges::fill(former, nowhere);
    std::ranges::fill(best_first, nowhere);
    std::ranges::fill(stale, true);
}

}  // namespace tandem

using namespace tandem;

int tandem_open_linked(const tandem_problem_data* data, tandem_search* search, int64_t moments,
                       const tandem_linked* like, tandem_linked** linked) {
    return guarded([&] {
        const ProblemData problem = data_of(*data);
        auto measured = like == nullptr ? measured_near(problem) : like->measured;
        *linked = std::make_unique<tandem_linked>(problem, *search, moments, std::move(measured))
                      .release();
    });
}

int tandem_close_linked(tandem_linked* linked) {
    return guarded([&] { const std::unique_ptr<tandem_linked> owned(linked); });
}
