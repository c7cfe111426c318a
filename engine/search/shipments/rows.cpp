#include "search/shipments/rows.h"

#include "search/route/edit.h"
#include "search/route/refresh.h"

namespace tandem {

bool read_row(const PairRows& rows, const Fleet& fleet, Int slot, PairRow& row) {
    row.node.clear();
    for (const Stop& stop : stops_of(fleet, slot)) {
        row.node.push_back(stop.node);
    }
    return rows.time(row);
}

bool is_written(const Fleet& fleet, Int slot, const std::vector<Int>& nodes) {
    if (nodes.size() <= 2) return fleet.route[slot].length == 0;
    const View<Stop, 1> stops = stops_of(fleet, slot);
    return std::equal(stops.begin(), stops.end(), nodes.begin(), nodes.end(),
                      [](const Stop& stop, Int node) { return stop.node == node; });
}

bool write_row(const ProblemData& data, const Fleet& fleet, Int slot,
               const std::vector<Int>& nodes) {
    Route& route = fleet.route[slot];
    route.length = 0;
    if (nodes.size() <= 2) {
        route.trips = 0;
        fleet.cost[slot] = 0.0;
        return true;
    }
    for (const Int node : nodes) {
        if (!add_stop(sequence_in(fleet, slot), node,
                      node < data.num_depots ? end_stop : customer_stop)) {
            return false;
        }
    }
    fleet.stop(slot, 0).kind = start_stop;
    const bool allowed = refresh(data, fleet, slot);
    locate(fleet, slot);
    return allowed;
}

void write_missing(const ProblemData& data, const Searcher& searcher,
                   const std::vector<Int>& pickups) {
    searcher.count->missing = Int(pickups.size());
    const View<Int, 1> missing = searcher.missing.first(searcher.count->missing);
    std::copy(pickups.begin(), pickups.end(), missing.begin());
    for (const Int pickup : pickups) leave_out(data, searcher.now, pickup);
}

}  // namespace tandem
