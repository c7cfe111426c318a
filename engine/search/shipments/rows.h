// Routes of shipments alone as rows, and back.
#pragma once

#include "search/route/state.h"
#include "search/shipments/pair_row.h"

namespace tandem {

// Reads the route in a slot. False if it breaks a rule.
bool read_row(const PairRows& rows, const Fleet& fleet, Int slot, PairRow& row);

// Tells whether the route in a slot has the stops of a row.
bool is_written(const Fleet& fleet, Int slot, const std::vector<Int>& nodes);

// Writes the route in a slot by its nodes, and where those are. False if it breaks a rule.
//
// How many routes there are is for the caller to say.
bool write_row(const ProblemData& data, const Fleet& fleet, Int slot,
               const std::vector<Int>& nodes);

// Writes all routes by the nodes of each slot. False if some break a rule.
template <class Nodes>
bool write_rows(const ProblemData& data, const Searcher& searcher, const Nodes& nodes_of) {
    const Fleet& now = searcher.now;
    for (Int slot = 0; slot < searcher.active.size(); ++slot) {
        const std::vector<Int>& nodes = nodes_of(slot);
        if (is_written(now, slot, nodes)) continue;
        now.route[slot].stamp = searcher.count->stamp;
        if (!write_row(data, now, slot, nodes)) return false;
        note_changed(searcher, slot);
    }
    list_active(searcher);
    now.used[0] = searcher.count->active;
    return true;
}

// Notes who is left out, by their pickups.
void write_missing(const ProblemData& data, const Searcher& searcher,
                   const std::vector<Int>& pickups);

}  // namespace tandem
