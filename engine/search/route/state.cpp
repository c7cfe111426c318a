#include "search/route/state.h"

#include "search/route/rarer.h"
#include "search/route/refresh.h"

namespace tandem {

void copy_route(const Fleet& source, Int slot, const Fleet& target, Int to) {
    const Route& route = source.route[slot];
    target.route.at(to) = route;
    target.cost[to] = source.cost[slot];
    target.early[to] = source.early[slot];
    for (Int tier = 0; tier < tiers_aboard(source); ++tier) {
        copy_first(source.stop_load[slot][tier], route.length, target.stop_load[to][tier]);
    }
    copy_first(source.stop[slot], route.length, target.stop[to]);
    copy_first(source.trip[slot], route.trips, target.trip[to]);
    copy_first(source.sortie[slot], route.sorties, target.sortie[to]);
}

bool is_same(const Fleet& fleet, Int slot, const Fleet& other, Int at) {
    const Route &route = fleet.route[slot], &before = other.route[at];
    if (route.length != before.length || route.type != before.type || route.sorties > 0 ||
        before.sorties > 0) {
        return false;
    }
    const View<Stop, 1> stops = fleet.stop[slot].first(route.length);
    return std::equal(stops.begin(), stops.end(), other.stop[at].begin(),
                      [](const Stop& stop, const Stop& former) {
                          return stop.node == former.node && stop.kind == former.kind;
                      });
}

void leave_out(const ProblemData& data, const Fleet& fleet, Int node) {
    for_each_place(data.pair, node, [&](Int place) { fleet.where[place].slot = nowhere; });
    if (is_paired(data.pair, node)) fleet.where[data.pair[node].partner].slot = nowhere;
}

void list_active(const Searcher& searcher) {
    Int found = 0;
    for (const bool used : {true, false}) {
        for (Int slot = 0; slot < searcher.active.size(); ++slot) {
            if ((searcher.now.route[slot].length > 0) == used) {
                searcher.active[found] = slot;
                searcher.rank[slot] = found++;
            }
        }
        if (used) searcher.count->active = found;
    }
}

void list_anew(const Searcher& searcher, Int slot, bool used) {
    Int& in_use = searcher.count->active;
    const Int place = searcher.rank[slot];
    if (used == (place < in_use)) return;
    if (!used) --in_use;
    const Int other = searcher.active[in_use];
    searcher.active[place] = other;
    searcher.rank[other] = place;
    searcher.active[in_use] = slot;
    searcher.rank[slot] = in_use;
    if (used) ++in_use;
}

void list_touched(const Searcher& searcher) {
    for (const Int slot : searcher.touched.first(searcher.count->touched)) {
        list_anew(searcher, slot, searcher.now.route[slot].length > 0);
    }
}

void touch(const Searcher& searcher, Int slot) {
    SearchCounts& count = *searcher.count;
    Route& route = searcher.now.route[slot];
    if (route.stamp == changing) return;
    copy_route(searcher.now, slot, searcher.before, count.touched);
    route.stamp = changing;
    searcher.touched.at(count.touched++) = slot;
}

void keep_aside(const Fleet& fleet, Int slot, Int to) {
    const Route& route = fleet.route[slot];
    fleet.route[to] = route;
    for (Int p = 0; p < route.length; ++p) copy_sequence(fleet.stop(slot, p), fleet.stop(to, p));
    copy_first(fleet.sortie[slot], route.sorties, fleet.sortie[to]);
}

void list_all_changed(const Searcher& searcher) {
    std::ranges::fill(searcher.is_changed, false);
    searcher.count->changed = searcher.active.size();
    for (Int slot = 0; slot < searcher.active.size(); ++slot) searcher.changed[slot] = slot;
}

void keep_best(const Searcher& searcher) {
    const SearchCounts& count = *searcher.count;
    if (count.changed == all_slots) list_all_changed(searcher);
    for (const Int slot : searcher.changed.first(count.changed)) {
        searcher.is_changed[slot] = false;
        if (searcher.now.route[slot].stamp != searcher.best.route[slot].stamp) {
            copy_route(searcher.now, slot, searcher.best, slot);
        }
    }
    keep_totals(searcher);
}

void keep_totals(const Searcher& searcher) {
    SearchCounts& count = *searcher.count;
    count.changed = 0;
    std::copy(searcher.now.used.begin(), searcher.now.used.end(), searcher.best.used.begin());
    count.best_missing = count.missing;
    copy_first(searcher.missing, count.missing, searcher.best_missing);
    searcher.value->best = searcher.value->cost;
}

double served_cost(const Searcher& searcher) {
    double cost = searcher.value->cost;
    for (Int index = 0; index < searcher.count->touched; ++index) {
        cost += searcher.now.cost[searcher.touched[index]] - searcher.before.cost[index];
    }
    return cost;
}

double unassigned_more(const ProblemData& data, View<const Int, 1> nodes, Int count) {
    double more = 0.0;
    for (const Int node : nodes.first(count)) more += data.unassigned_more[node];
    return more;
}

double left_out_cost(const ProblemData& data, View<const Int, 1> nodes, Int count) {
    return double(count) * data.unassigned_cost + unassigned_more(data, nodes, count);
}

double missing_cost(const ProblemData& data, const Searcher& searcher) {
    return left_out_cost(data, searcher.missing, searcher.count->missing);
}

void accept(const Searcher& searcher, double cost) {
    SearchCounts& count = *searcher.count;
    ++count.stamp;
    for (Int index = 0; index < count.touched; ++index) {
        const Int slot = searcher.touched[index];
        // What is kept of a route that is as it was still holds.
        const bool is_as_before =
            !searcher.kept_stamp.empty() && is_same(searcher.now, slot, searcher.before, index);
        searcher.now.route[slot].stamp =
            is_as_before ? searcher.before.route[index].stamp : count.stamp;
        note_changed(searcher, slot);
    }
    count.missing = count.absent;
    copy_first(searcher.absent, count.absent, searcher.missing);
    searcher.value->cost = cost;
}

void go_back(const Searcher& searcher) {
    const Fleet &now = searcher.now, &best = searcher.best;
    SearchCounts& count = *searcher.count;
    ++count.stamp;
    count.changed = all_slots;
    for (Int slot = 0; slot < searcher.active.size(); ++slot) {
        copy_route(best, slot, now, slot);
        now.route[slot].stamp = count.stamp;
    }
    std::copy(best.used.begin(), best.used.end(), now.used.begin());
    for (Place& place : now.where) place.slot = nowhere;
    list_active(searcher);
    for (const Int slot : searcher.active.first(count.active)) locate(now, slot);
    count.missing = count.best_missing;
    copy_first(searcher.best_missing, count.best_missing, searcher.missing);
    searcher.value->cost = searcher.value->best;
}

}  // namespace tandem
