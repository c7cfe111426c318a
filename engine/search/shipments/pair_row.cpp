#include "search/shipments/pair_row.h"

#include "search/route/edit.h"
#include "search/route/refresh.h"

namespace tandem {

PairToInsert PairRows::pair_of(Int pickup) const {
    const Int delivery = data_.pair[pickup].partner;
    return {newcomer_for(data_, type_, pickup), newcomer_for(data_, type_, delivery),
            leg(legs_, pickup, delivery)};
}

void PairRows::empty(PairRow& row) const {
    row.node = {type_.begins_at, type_.ends_at};
    time(row);
}

bool PairRows::time(PairRow& row) const {
    const std::size_t stops = row.node.size(), last = stops - 1;
    row.front.resize(stops);
    row.rear.resize(stops);
    row.gap.resize(stops);
    row.way.resize(stops);
    row.load.resize(stops * std::size_t(tiers_));
    Front front{begin_};
    row.front[0] = front;
    row.distance = 0;
    for (std::size_t p = 0; p < last; ++p) {
        const Leg next = leg(legs_, row.node[p], row.node[p + 1]);
        row.gap[p] = next.duration;
        row.way[p] = next.distance;
        row.distance += next.distance;
        front.drive(next.duration);
        if (p + 1 < last && !front.serve(places_[row.node[p + 1]])) return false;
        row.front[p + 1] = front;
    }
    Rear rear{end_};
    row.rear[last] = rear;
    for (std::size_t p = last; p-- > 1;) {
        rear.serve(places_[row.node[p]], row.gap[p]);
        row.rear[p] = rear;
    }
    for (Int tier = 0; tier < tiers_; ++tier) {
        Amount load = nothing;
        for (std::size_t p = 0; p < stops; ++p) {
            if (p > 0 && p < last) load = plus(load, picked_of(data_.amount, row.node[p], tier));
            row.load[p * std::size_t(tiers_) + std::size_t(tier)] = load;
        }
    }
    return row.rear[last].allows(front);
}

void PairRows::leave_out(const PairRow& row, Int one, Int other, PairRow& without) const {
    without.node.clear();
    for (std::size_t p = 0; p < row.node.size(); ++p) {
        const Int node = row.node[p];
        if (node >= data_.num_depots) {
            const Int unit = data_.pair[node].unit;
            if (unit == one || unit == other) continue;
        }
        without.node.push_back(node);
    }
    // By the triangle inequality it comes no later anywhere; where that does not hold it may.
    if (!time(without)) without.node.clear();
}

void PairRows::insert(PairRow& row, Int pickup, PairPlace place) const {
    const Int delivery = data_.pair[pickup].partner;
    row.node.insert(row.node.begin() + place.q + 1, delivery);
    row.node.insert(row.node.begin() + place.p + 1, pickup);
}

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
