#include "search/search.h"

#include "search/route/state.h"
#include "search/trace.h"

namespace tandem {
namespace {

// Room for what is kept of each customer's place on each route, if it is.
std::array<Int, 2> kept(const ProblemData& data, const SearchRoom& room) {
    return data.strategy.keep_places ? std::array{data.num_nodes, room.routes}
                                     : std::array{Int{0}, Int{0}};
}

}  // namespace

Fleet::Fleet(const ProblemData& data, const SearchRoom& room, Int nodes)
    : route({room.routes + scratch_slots}),
      cost({room.routes + scratch_slots}),
      early({room.routes + scratch_slots}),
      stop({room.routes + scratch_slots, room.stops}, Filling::sparse),
      stop_load({room.routes + scratch_slots, data.amount.shape(1), room.stops}, Filling::sparse),
      trip({room.routes + scratch_slots, room.trips}, Filling::sparse),
      sortie({room.routes + scratch_slots, room.sorties}, Filling::sparse),
      where({nodes}),
      used({data.num_types}) {
    std::ranges::fill(where, Place{nowhere, nowhere, nowhere});
}

Searcher::Searcher(const ProblemData& data, const SearchRoom& room)
    : now(data, room, data.num_nodes),
      before(data, room, 0),
      best(data, room, 0),
      count(std::make_unique<SearchCounts>()),
      value(std::make_unique<SearchValues>()),
      rng({1}),
      slots({room.routes}),
      active(slots),
      rank({room.routes}),
      changed({room.routes}),
      is_changed({room.routes}),
      missing({data.num_nodes}),
      best_missing({data.num_nodes}),
      absent({data.num_nodes}),
      touched({room.routes}),
      marked({data.num_nodes}),
      absences({data.num_nodes}),
      hit({room.routes, room.trips}),
      kept_stamp(kept(data, room)),
      kept_move(kept(data, room)),
      kept_cost(kept(data, room)),
      alone(data.can.shape()) {
    count->focus = nowhere;
}

Searcher& looking(const ProblemData& data, Searcher& searcher) {
    if (!searcher.scratch || !searcher.scratch->is_enough_for(data, searcher)) {
        searcher.scratch = std::make_shared<Scratch>(data, searcher);
    }
    searcher.scratch->offers = 0;
    return searcher;
}

}  // namespace tandem

using namespace tandem;

int tandem_open_search(const tandem_problem_data* data, int64_t routes, int64_t stops,
                       int64_t trips, int64_t sorties, tandem_search** search) {
    return guarded([&] {
        const SearchRoom room{routes, stops, trips, sorties};
        *search = std::make_unique<tandem_search>(data_of(*data), room).release();
    });
}

int tandem_close_search(tandem_search* search) {
    return guarded([&] { const std::unique_ptr<tandem_search> owned(search); });
}

int tandem_look_into(tandem_search* search, tandem_seen* seen) {
    return guarded([&] {
        const Fleet &now = search->now, &best = search->best;
        *seen = {search->count.get(), search->value.get(),
                 search->rng,         search->active,
                 search->missing,     search->best_missing,
                 search->absences,    now.used,
                 best.used,           now.cost,
                 best.cost,           search->alone};
    });
}

int tandem_go_back(tandem_search* search) {
    return guarded([&] { go_back(*search); });
}

int tandem_take_trace(int64_t* digest) {
    return guarded([&] { *digest = std::bit_cast<std::int64_t>(priced_digest.exchange(0)); });
}
