#include "search/search.h"

#include <algorithm>
#include <array>

#include "guard.h"
#include "search/route/state.h"

namespace tandem {
namespace {

// Room for what is kept of each customer's place on each route, if it is.
std::array<Int, 2> kept(const ProblemData& data, const SearchRoom& room) {
    return data.strategy.keep_places ? std::array{data.num_nodes, room.routes}
                                     : std::array{Int{0}, Int{0}};
}

}  // namespace

OwnFleet::OwnFleet(const ProblemData& data, const SearchRoom& room, Int nodes)
    : route({room.routes + scratch_slots}),
      cost({room.routes + scratch_slots}),
      early({room.routes + scratch_slots}),
      stop({room.routes + scratch_slots, room.stops}, Filling::sparse),
      stop_load({room.routes + scratch_slots, data.amount.shape(1), room.stops}, Filling::sparse),
      trip({room.routes + scratch_slots, room.trips}, Filling::sparse),
      sortie({room.routes + scratch_slots, room.sorties}, Filling::sparse),
      where({nodes}),
      used({data.num_types}) {
    std::fill(where.begin(), where.end(), Place{nowhere, nowhere, nowhere});
}

Search::Search(const ProblemData& data, const SearchRoom& room)
    : now(data, room, data.num_nodes),
      before(data, room, 0),
      best(data, room, 0),
      rng({1}),
      active({room.routes}),
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
      kept_cost(kept(data, room)) {
    count.focus = nowhere;
}

Searcher searcher_of(const tandem_searcher& from) {
    const Search& own = *from.own;
    return {from,           own.before.view(), own.rank,      own.changed,
            own.is_changed, own.absent,        own.touched,   own.marked,
            own.hit,        own.kept_stamp,    own.kept_move, own.kept_cost};
}

Searcher looking(const ProblemData& data, const tandem_searcher& from) {
    Searcher searcher = searcher_of(from);
    std::unique_ptr<Scratch>& scratch = from.own->scratch;
    if (!scratch || !scratch->is_enough_for(data, searcher)) {
        scratch = std::make_unique<Scratch>(data, searcher);
    }
    scratch->offers = 0;
    searcher.scratch = scratch.get();
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

int tandem_look_into(tandem_search* search, tandem_searcher* seen) {
    return guarded([&] {
        Search& own = *search;
        *seen = {own.now.view(), own.best.view(),  &own.count,   &own.value, own.rng, own.active,
                 own.missing,    own.best_missing, own.absences, {},         search};
    });
}

int tandem_missing_cost(const tandem_problem_data* data, const tandem_searcher* searcher,
                        double* cost) {
    return guarded([&] { *cost = missing_cost(data_of(*data), searcher_of(*searcher)); });
}

int tandem_go_back(const tandem_searcher* searcher) {
    return guarded([&] { go_back(searcher_of(*searcher)); });
}

int tandem_kept_place(const tandem_searcher* searcher, int64_t node, int64_t slot, double* cost,
                      int64_t* found) {
    return guarded([&] {
        const Search& own = *searcher->own;
        const bool is_kept = own.kept_stamp(node, slot) == searcher->now.route[slot].stamp;
        *found = is_kept ? own.kept_move(node, slot).kind : elsewhere;
        *cost = own.kept_cost(node, slot);
    });
}
