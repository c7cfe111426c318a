#include "search/linked/store.h"

#include "search/anneal.h"
#include "search/linked/chain.h"
#include "search/linked/turn.h"
#include "search/search.h"

namespace tandem {

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

    bool recreate(Int first, double spare) {
        const auto [done, added] = recreate_linked(data_, searcher_, linked_, first, spare, false);
        added_ = added;
        return done;
    }

    void insert_all(Int first) {
        const bool scan_all = data_.num_nodes < built_beside_from;
        constexpr double infinite = std::numeric_limits<double>::infinity();
        saved_ = 0.0;
        added_ = recreate_linked(data_, searcher_, linked_, first, infinite, scan_all).added;
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

extern "C" int tandem_anneal_linked(const tandem_problem_data* data, tandem_search* search,
                                    tandem_linked* linked, int64_t turns) {
    return guarded([&] {
        const ProblemData problem = data_of(*data);
        Searcher& searching = looking(problem, *search);
        anneal_linked(problem, searching, *linked, turns);
    });
}

extern "C" int tandem_insert_linked(const tandem_problem_data* data, tandem_search* search,
                                    tandem_linked* linked, int64_t order) {
    return guarded([&] {
        const ProblemData problem = data_of(*data);
        Searcher& searching = looking(problem, *search);
        insert_linked(problem, searching, *linked, order);
    });
}
