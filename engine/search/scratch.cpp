
#include <utility>

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
    const Int halts = data.near_halts.shape(1) * at_one_halt * rows;
    return std::max({(at_one_stop * rows + halts) * stops + sorties * (data.max_visits + 1),
                     data.num_nodes + fleet.route.size() *
                                          (2 + rows * (1 + data.near_halts.shape(1))) * (trips + 1),
                     2 * (at_one_stop * rows + halts) * data.granular.shape(1)});
}

// Returns how many slots a ruin touches at most, or stops move.
Int most_moved(const Fleet& fleet) { return std::max(fleet.route.size(), fleet.stop.shape(1)) + 2; }

// Returns how many places a line of two routes has at most.
Int longest_line(const ProblemData& data, const Fleet& fleet) {
    return data.num_nodes + 3 + (has_halts(data) ? 2 * fleet.stop.shape(1) : 0);
}

// Returns room for parts planned at best, which are those that may have stops at launch sites.
PartScratch part_scratch(const ProblemData& data) {
    if (!has_halts(data)) return {0, 0};
    const Int customers = data.num_nodes - data.num_depots;
    return {customers <= most_planned ? customers : usually_planned,
            std::min(most_sites, data.halts.shape(1))};
}

}  // namespace

SplitScratch::SplitScratch(Int longest)
    : cost(longest + at_once),
      loops(longest + at_once),
      looped_until(longest + at_once),
      drive(longest + at_once),
      distance(longest + at_once),
      out(longest) {}

PartScratch::PartScratch(Int most_customers, Int most_halts)
    : customers(most_customers),
      halts(most_halts),
      flight(places() * (customers + 1) * places()),
      way((Int{1} << customers) * places() * places()),
      across((Int{1} << customers) * places() * places()),
      reached((Int{1} << customers) * places()),
      planned((most_customers + 1) * (most_halts + 2)) {}

Scratch::Scratch(const ProblemData& data, const Searcher& searcher)
    : Scratch(longest_line(data, searcher.now), part_scratch(data), data.num_nodes,
              most_moved(searcher.now), most_offers(data, searcher.now)) {}

Scratch::Scratch(Int longest, PartScratch part, Int num_nodes, Int most_moved, Int most_offers)
    : line(longest),
      aside(longest),
      split(longest),
      changed(longest),
      part(std::move(part)),
      operations(2 * most_changing * (num_nodes + more_places)),
      drafts(2 * (num_nodes + more_places)),
      served(num_nodes),
      moved_customers(num_nodes),
      key(num_nodes),
      moved(most_moved),
      offer(most_offers),
      least(most_offers) {
    std::fill(served.view().begin(), served.view().end(), Served{nobody, 0, false});
}

bool Scratch::is_enough_for(const ProblemData& data, const Searcher& searcher) const {
    const Fleet& fleet = searcher.now;
    return line.size() >= longest_line(data, fleet) && key.size() >= data.num_nodes &&
           moved.size() >= most_moved(fleet) && offer.size() >= most_offers(data, fleet);
}

}  // namespace tandem
