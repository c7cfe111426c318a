#include "search/scratch.h"

#include <algorithm>
#include <limits>

#include "rules/drone_types.h"
#include "search/insertion/offers.h"

namespace tandem {
namespace {

// Returns how many insertions are listed at most: on one route, by a trip more on any, or beside
// neighbours.
Int most_offers(const ProblemData& data, const Fleet& fleet) {
    Int rows = 1;
    for (Int k = 0; k < data.num_types; ++k) rows = std::max(rows, num_drone_rows(data.type, k));
    const Int stops = fleet.stop.shape(1), trips = fleet.trip.shape(1);
    const Int sorties = fleet.sortie.shape(1);
    return std::max({at_one_stop * rows * stops + sorties * (data.max_visits + 1),
                     data.num_nodes + fleet.route.size() * (2 + rows) * (trips + 1),
                     2 * at_one_stop * rows * data.granular.shape(1)});
}

}  // namespace

SplitScratch::SplitScratch(Int longest)
    : cost(longest + at_once),
      loops(longest + at_once),
      looped_until(longest + at_once),
      drive(longest + at_once),
      distance(longest + at_once),
      out{} {
    for (WaysOut& ways : out) ways.duration.fill(std::numeric_limits<double>::infinity());
}

Scratch::Scratch(const ProblemData& data, Searcher& searcher)
    : Scratch(data, searcher, most_offers(data, searcher.now)) {}

Scratch::Scratch(const ProblemData& data, Searcher& searcher, Int most_offers)
    : line(data.num_nodes + 3),
      split(data.num_nodes + 3),
      key(data.num_nodes),
      moved(std::max(searcher.now.route.size(), searcher.now.stop.shape(1)) + 2),
      offer(most_offers),
      least(most_offers) {
    searcher.scratch = this;
}

}  // namespace tandem
