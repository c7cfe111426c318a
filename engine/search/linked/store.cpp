#include "search/linked/store.h"

#include "search/anneal.h"
#include "search/linked/aboard.h"
#include "search/linked/chain.h"
#include "search/linked/turn.h"
#include "search/route/refresh.h"
#include "search/search.h"

namespace tandem {
namespace {

// Writes how near a customer's neighbours are by vehicles of a type, if that is nearer than known.
void measure_near_by(const ProblemData& data, const Nearness& measured, Int k, Int node) {
    const LegRow inward = legs_to(data.back, data.type[k].travel, node);
    const LegRow onward = legs_from(data.leg, data.type[k].travel, node);
    for (Int rank = 0; rank < data.granular.shape(1); ++rank) {
        const Int other = data.granular(node, rank);
        if (other < 0) continue;
        std::int32_t& near = measured(node, rank);
        const Int distance = std::min(nearness(inward, onward, other), Int{near});
        near = std::int32_t(distance);
    }
}

// Links the stops of a route.
void link_route(const ProblemData& data, Linked& linked, const Fleet& fleet, Int slot) {
    const auto [route, stops, trips, sorties] = tour_of(fleet, slot);
    Run& run = linked.run[slot];
    Amount load = nothing;
    run.type = route.type;
    run.count = route.length - 2;
    run.distance = 0;
    for (Int p = 1; p < route.length; ++p) {
        run.distance += connect(data, linked, slot, stops[p - 1].node, stops[p].node);
        if (p < route.length - 1) {
            linked.link[stops[p].node].slot = slot;
            load = plus(load, demand_of(data.place[0][stops[p].node]));
        }
    }
    write_amount(load, run.load);
    if (linked.timed) retime(data, linked, slot);
}

// Links the stops of a route of the best plan.
void link_best(Linked& linked, const Fleet& best, Int slot) {
    const Route& route = best.route[slot];
    const View<Stop, 1> stops = best.stop[slot];
    linked.best_first[slot] = stops[1].node;
    linked.best_type[slot] = route.type;
    for (Int p = 1; p < route.length - 1; ++p) {
        linked.best_behind[stops[p].node] = stops[p + 1].node;
    }
}

// Writes the ends of a route whose customers are there, and all that follows.
void write_stops(const ProblemData& data, Fleet& fleet, Int slot, Int k, Int count) {
    const auto [route, stops, trips, sorties] = tour_of(fleet, slot);
    route.type = k;
    route.length = count + 2;
    route.sorties = 0;
    put(stops, 0, data.type[k].begins_at, start_stop);
    put(stops, count + 1, data.type[k].ends_at, end_stop);
    refresh(data, fleet, slot);
}

// Writes the routes as they are; returns what they cost.
double write_now(const ProblemData& data, Searcher& searcher, const Linked& linked) {
    Fleet& now = searcher.now;
    double cost = left_out_cost(data, searcher.missing, searcher.count->missing);
    for (const Int slot : searcher.active.first(searcher.count->active)) {
        const Run& run = linked.run[slot];
        Int node = run.first;
        for (Int p = 1; p <= run.count; ++p) {
            put(now.stop[slot], p, node, customer_stop);
            node = linked.link[node].behind;
        }
        write_stops(data, now, slot, run.type, run.count);
        locate(now, slot);
        cost += now.cost[slot];
    }
    return cost;
}

// Writes the routes of the best plan; returns what they cost.
double write_best(const ProblemData& data, Searcher& searcher, const Linked& linked) {
    Fleet& best = searcher.best;
    double cost = left_out_cost(data, searcher.best_missing, searcher.count->best_missing);
    for (Int slot = 0; slot < searcher.active.size(); ++slot) {
        Int node = linked.best_first[slot];
        if (node < 0) continue;
        Int count = 0;
        for (; node >= data.num_depots; node = linked.best_behind[node]) {
            put(best.stop[slot], ++count, node, customer_stop);
        }
        write_stops(data, best, slot, linked.best_type[slot], count);
        cost += best.cost[slot];
    }
    return cost;
}

// Empties a slot.
void clear_route(Fleet& fleet, Int slot, Int stamp) {
    Route& route = fleet.route[slot];
    route.length = route.trips = route.sorties = 0;
    route.stamp = stamp;
    fleet.cost[slot] = 0.0;
}

}  // namespace

std::shared_ptr<const Nearness> measured_near(const ProblemData& data) {
    auto nearness = std::make_shared<Nearness>(data.granular.shape());
    const bool one_travel = is_one_travel(data);
    for (Int node = data.num_depots; node < data.num_nodes; ++node) {
        data.deadline.go_on_late();
        for (std::int32_t& near : (*nearness)[node]) near = farthest;
        for (Int k = 0; k < data.num_types; ++k) {
            if (k == 0 || !one_travel) measure_near_by(data, *nearness, k, node);
        }
    }
    return nearness;
}

void tie(const ProblemData& data, Searcher& searcher, Linked& linked) {
    for (Int node = data.num_depots; node < data.num_nodes; ++node) {
        linked.link[node].slot = searcher.now.where[node].slot;
        linked.reach[node] = out_of_reach;
    }
    for (Int slot = 0; slot < searcher.active.size(); ++slot) {
        if (searcher.now.route[slot].length > 0) link_route(data, linked, searcher.now, slot);
        linked.best_first[slot] = nowhere;
        if (searcher.best.route[slot].length > 0) link_best(linked, searcher.best, slot);
    }
    note_amounts(data, linked);
    forget(linked);
    searcher.count->changed = all_slots;
}

void write_back(const ProblemData& data, Searcher& searcher, Linked& linked) {
    SearchCounts& count = *searcher.count;
    ++count.stamp;
    for (Int slot = 0; slot < searcher.active.size(); ++slot) {
        clear_route(searcher.now, slot, count.stamp);
        clear_route(searcher.best, slot, others);
    }
    searcher.value->cost = write_now(data, searcher, linked);
    // The sums of what turns changed differ in their last bits; the best cost never rises.
    searcher.value->best = std::min(searcher.value->best, write_best(data, searcher, linked));
    count.changed = all_slots;
}

namespace {

// Routes as linked stops, where a turn notes what it has changed.
class LinkedStore {
public:
    LinkedStore(const ProblemData& data, Searcher& searcher, Linked& linked)
        : data_(data), searcher_(searcher), linked_(linked) {}

    void ruin(Int first) {
        const Int before = searcher_.count->absent;
        const auto [saved, seed] = ruin_linked(data_, searcher_, linked_);
        if (first > 0) try_near(data_, searcher_, seed, first, before);
        saved_ = saved;
        added_ = 0.0;
    }

    bool recreate(Int first, Spare spare) {
        const auto [done, added] = recreate_linked(data_, searcher_, linked_, first, spare, false);
        added_ = added;
        return done;
    }

    void insert_all(Int first) {
        const bool scan_all = data_.num_nodes < built_beside_from;
        saved_ = 0.0;
        added_ = recreate_linked(data_, searcher_, linked_, first, {}, scan_all).added;
    }

    void retype() { added_ -= cheapen_runs(data_, searcher_, linked_); }

    Int parts() const { return 1; }

    // Swaps tails of routes, whose price is known before, so that what isn't worth it isn't done.
    bool move_part(Int, double rise) {
        const auto [slot, other, cost] = two_opt_star_linked(data_, searcher_, linked_, rise);
        if (slot < 0) return false;
        saved_ = 0.0;
        added_ = cost;
        note_changed(searcher_, slot);
        note_changed(searcher_, other);
        SearchCounts& count = *searcher_.count;
        count.absent = count.missing;
        copy_first(searcher_.missing, count.missing, searcher_.absent);
        if (data_.strategy.swap_vehicles && uniform(searcher_.rng) < retyped_share) {
            added_ -= cheapen_run(data_, searcher_, linked_, slot);
            added_ -= cheapen_run(data_, searcher_, linked_, other);
        }
        return true;
    }

    double served_cost() const { return searcher_.value->cost - saved_ + added_; }

    void accept(double cost) {
        list_changes();
        SearchCounts& count = *searcher_.count;
        const auto missing = searcher_.missing.first(count.missing);
        const auto absent = searcher_.absent.first(count.absent);
        for (const Int node : missing) searcher_.now.where[node].slot = 0;
        for (const Int node : absent) searcher_.now.where[node].slot = nowhere;
        count.missing = count.absent;
        copy_first(absent, count.absent, searcher_.missing);
        searcher_.value->cost = cost;
    }

    void keep_best() {
        const SearchCounts& count = *searcher_.count;
        if (count.changed == all_slots) list_all_changed(searcher_);
        for (const Int slot : searcher_.changed.first(count.changed)) {
            searcher_.is_changed[slot] = false;
            linked_.best_first[slot] = nowhere;
            if (searcher_.rank[slot] < count.active) keep_run(slot);
        }
        keep_totals(searcher_);
    }

    void take_back() { tandem::take_back(data_, searcher_, linked_); }

private:
    // Lists the routes of this turn as changed since the best, and notes nothing more.
    void list_changes() {
        const NoteCounts& noted = linked_.noted;
        for (const Piece& piece : linked_.piece.first(noted.pieces)) {
            note_changed(searcher_, piece.slot);
        }
        for (const Entry& entry : linked_.entry.first(noted.entries)) {
            note_changed(searcher_, linked_.link[entry.node].slot);
        }
        for (const Int slot : linked_.retyped.first(noted.retyped)) note_changed(searcher_, slot);
        forget(linked_);
    }

    // Takes a route for that of the best plan.
    void keep_run(Int slot) {
        const Run& run = linked_.run[slot];
        linked_.best_first[slot] = run.first;
        linked_.best_type[slot] = run.type;
        Int node = run.first;
        for (Int number = 0; number < run.count; ++number) {
            const Int behind = linked_.link[node].behind;
            linked_.best_behind[node] = behind;
            node = behind;
        }
    }

    const ProblemData& data_;
    Searcher& searcher_;
    Linked& linked_;
    double saved_ = 0.0, added_ = 0.0;
};

}  // namespace

void anneal_linked(const ProblemData& data, Searcher& searcher, Linked& linked, Int turns) {
    LinkedStore routes(data, searcher, linked);
    anneal(data, searcher, routes, turns);
}

void insert_linked(const ProblemData& data, Searcher& searcher, Linked& linked, Int order) {
    tie(data, searcher, linked);
    LinkedStore routes(data, searcher, linked);
    insert_all(data, searcher, routes, order);
    write_back(data, searcher, linked);
}

}  // namespace tandem

using namespace tandem;

extern "C" int tandem_tie(const tandem_problem_data* data, tandem_search* search,
                          tandem_linked* linked) {
    return guarded([&] {
        const ProblemData problem = data_of(*data);
        problem.deadline.go_on();
        tie(problem, *search, *linked);
    });
}

extern "C" int tandem_write_back(const tandem_problem_data* data, tandem_search* search,
                                 tandem_linked* linked) {
    return guarded([&] { write_back(data_of(*data), *search, *linked); });
}

extern "C" int tandem_anneal_linked(const tandem_problem_data* data, tandem_search* search,
                                    tandem_linked* linked, int64_t turns, int64_t order) {
    return guarded([&] {
        const ProblemData problem = data_of(*data);
        Searcher& searching = looking(problem, *search);
        if (order < 0) return anneal_linked(problem, searching, *linked, turns);
        insert_linked(problem, searching, *linked, order);
    });
}
