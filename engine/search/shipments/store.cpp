#include <algorithm>
#include <limits>
#include <vector>

#include "guard.h"
#include "randomness.h"
#include "rules/pair.h"
#include "rules/rates.h"
#include "search/anneal.h"
#include "search/insertion/evaluate.h"
#include "search/moves/ruin.h"
#include "search/route/edit.h"
#include "search/route/rarer.h"
#include "search/route/refresh.h"
#include "search/route/state.h"
#include "search/scratch.h"
#include "search/shipments/cheapest_place.h"
#include "search/shipments/rows.h"

namespace tandem {
namespace {

// Holds routes of shipments as rows; what the search holds of them is written at the end.
class PairStore {
public:
    PairStore(const ProblemData& data, Searcher& searcher)
        : data_(data),
          searcher_(searcher),
          rate_(data.rate[0]),
          rows_(data, tiers_aboard(searcher.now)),
          finder_(data, rows_, searcher.rng, searcher.now.stop.shape(1)),
          row_(std::size_t(searcher.now.route.size())),
          before_(row_.size()),
          best_(row_.size()),
          touched_in_(row_.size(), nowhere),
          seen_(row_.size(), 0),
          written_best_(searcher.value->best) {}

    // Reads the routes. False if that can't be.
    bool read() {
        const Fleet& now = searcher_.now;
        const auto active = searcher_.active.first(searcher_.count->active);
        return std::all_of(active.begin(), active.end(),
                           [&](Int slot) { return read_row(rows_, now, slot, row_of(slot)); });
    }

    // Writes the best rows, if any were better, and those as they are. False, with the best routes,
    // if some break a rule.
    bool write() {
        SearchCounts& count = *searcher_.count;
        count.touched = 0;
        ++count.stamp;
        const std::vector<Int> missing(searcher_.missing.begin(),
                                       searcher_.missing.begin() + count.missing);
        const double cost = searcher_.value->cost;
        // Until they are written the best routes cost what they did.
        searcher_.value->best = written_best_;
        bool allowed = true;
        if (is_better_) {
            allowed = write_rows(data_, searcher_, [&](Int slot) -> const std::vector<Int>& {
                return best_[std::size_t(slot)];
            });
            if (allowed) {
                write_missing(data_, searcher_, best_missing_);
                count.changed = all_slots;
                searcher_.value->cost = best_cost_;
                tandem::keep_best(searcher_);
                ++count.stamp;
            }
        }
        allowed = allowed && write_rows(data_, searcher_, [&](Int slot) -> const std::vector<Int>& {
                      return row_of(slot).node;
                  });
        if (!allowed) {
            go_back(searcher_);
            return false;
        }
        write_missing(data_, searcher_, missing);
        searcher_.value->cost = cost;
        return true;
    }

    void ruin(Int first) {
        SearchCounts& count = *searcher_.count;
        const Int before = count.absent;
        added_ = 0.0;
        Removed removed{searcher_.marked, searcher_.absent, before, data_.pair};
        const Int seed = mark_strings(removed);
        if (first > 0) try_near(data_, searcher_, seed, first, before);
        for (const Int slot : searcher_.touched.first(count.touched)) remove_marked(slot, removed);
        for (Int index = before; index < removed.count; ++index) {
            const Int node = removed.absent[index];
            removed.unmark(node);
            leave_out(data_, searcher_.now, node);
            added_ -= price_of(node);
        }
        count.absent = removed.count;
    }

    bool recreate(Int first, double spare) {
        SearchCounts& count = *searcher_.count;
        const View<Int, 1> absent = searcher_.absent;
        bool opens = uniform(searcher_.rng) < opening_share;
        Int left = first;
        for (Int index = first; index < count.absent; ++index) {
            const Int node = absent[index];
            if (data_.deadline.passed()) {
                absent.at(left++) = node;
                continue;
            }
            const double price = price_of(node);
            const double left_out = data_.unassigned_cost + data_.unassigned_more[node];
            const double cost = place(node, left_out - price, opens && rate_.fixed < spare) + price;
            if (cost >= left_out) absent.at(left++) = node;
            opens = false;
            spare -= std::min(cost, left_out);
            if (spare < 0.0) return false;
        }
        count.absent = left;
        return true;
    }

    void retype() {}
    Int parts() const { return 0; }
    bool move_part(Int, double) { return false; }

    void insert_all(Int first) { recreate(first, std::numeric_limits<double>::infinity()); }

    double served_cost() const {
        Int further = 0, more = 0;
        for (Int index = 0; index < searcher_.count->touched; ++index) {
            const PairRow &row = row_of(searcher_.touched[index]),
                          &before = before_[std::size_t(index)];
            further += way_of(row) - way_of(before);
            more += Int(row.serves_somebody()) - Int(before.serves_somebody());
        }
        return searcher_.value->cost + double(more) * rate_.fixed + drive_cost(rate_, further) +
               added_;
    }

    void accept(double cost) {
        SearchCounts& count = *searcher_.count;
        for (const Int slot : searcher_.touched.first(count.touched)) note_changed(searcher_, slot);
        count.missing = count.absent;
        copy_first(searcher_.absent, count.absent, searcher_.missing);
        searcher_.value->cost = cost;
    }

    void keep_best() {
        SearchCounts& count = *searcher_.count;
        if (count.changed == all_slots || !is_better_) list_all_changed(searcher_);
        for (const Int slot : searcher_.changed.first(count.changed)) {
            searcher_.is_changed[slot] = false;
            best_[std::size_t(slot)] = row_of(slot).node;
        }
        count.changed = 0;
        is_better_ = true;
        best_cost_ = searcher_.value->best = searcher_.value->cost;
        best_missing_.assign(searcher_.missing.begin(), searcher_.missing.begin() + count.missing);
    }

    void take_back() {
        const SearchCounts& count = *searcher_.count;
        for (Int index = 0; index < count.touched; ++index) {
            const Int slot = searcher_.touched[index];
            for (const Int node : row_of(slot).node) {
                if (node >= data_.num_depots) searcher_.now.where[node].slot = nowhere;
            }
        }
        for (Int index = 0; index < count.touched; ++index) {
            const Int slot = searcher_.touched[index];
            std::swap(row_of(slot), before_[std::size_t(index)]);
            place_nodes(slot);
            list(slot);
        }
    }

private:
    PairRow& row_of(Int slot) { return row_[std::size_t(slot)]; }
    const PairRow& row_of(Int slot) const { return row_[std::size_t(slot)]; }

    static Int way_of(const PairRow& row) { return row.serves_somebody() ? row.distance : 0; }

    // What it costs to serve a shipment, wherever that is.
    double price_of(Int pickup) const {
        return stops_cost(rate_, 2) + vehicle_cost_at(data_.vehicle_cost, 0, pickup) +
               vehicle_cost_at(data_.vehicle_cost, 0, data_.pair[pickup].partner);
    }

    // Keeps a row as it is before it changes this turn.
    void touch(Int slot) {
        SearchCounts& count = *searcher_.count;
        if (touched_in_[std::size_t(slot)] == count.turn) return;
        touched_in_[std::size_t(slot)] = count.turn;
        before_[std::size_t(count.touched)] = row_of(slot);
        searcher_.touched.at(count.touched++) = slot;
    }

    void place_nodes(Int slot) {
        for (const Int node : row_of(slot).node) {
            if (node >= data_.num_depots) searcher_.now.where[node].slot = slot;
        }
    }

    // Lists a slot among those in use, or those that are free, and counts vehicles.
    void list(Int slot) {
        const bool used = row_of(slot).serves_somebody();
        if (used == (searcher_.rank[slot] < searcher_.count->active)) return;
        list_anew(searcher_, slot, used);
        searcher_.now.used[0] += used ? 1 : -1;
    }

    // Marks strings near a customer, one a row at most, and returns him.
    Int mark_strings(Removed& removed) {
        const Fleet& now = searcher_.now;
        const double longest = longest_string(searcher_, searcher_.count->active);
        Int strings = draw_strings(longest, searcher_.rng);
        const Int seed = draw_seed(data_, searcher_, removed.absent.first(removed.count));
        const View<const std::int32_t, 1> near = data_.near[seed];
        Int node = seed;
        for (Int rank = 0; strings > 0 && node >= 0; ++rank) {
            const Int slot = now.where[node].slot;
            if (slot >= 0 && !removed.marked[node] &&
                touched_in_[std::size_t(slot)] != searcher_.count->turn) {
                touch(slot);
                mark_string(row_of(slot), node, longest, removed);
                --strings;
            }
            node = rank < near.size() ? near[rank] : nowhere;
        }
        return seed;
    }

    // Marks adjacent stops around a node, or all but some within.
    void mark_string(const PairRow& row, Int node, double longest, Removed& removed) {
        const Int stops = Int(row.node.size()) - 2;
        const Int p = Int(std::find(row.node.begin(), row.node.end(), node) - row.node.begin());
        draw_around(searcher_.rng, longest, stops, p - 1,
                    [&](Int place) { removed.mark(row.node[std::size_t(place + 1)]); });
    }

    // Takes those marked out of a row; all, if the rest breaks a rule.
    void remove_marked(Int slot, Removed& removed) {
        PairRow& row = row_of(slot);
        std::erase_if(row.node,
                      [&](Int node) { return node >= data_.num_depots && removed.marked[node]; });
        if (!rows_.time(row)) {
            for (const Int node : row.node) {
                if (node >= data_.num_depots) removed.mark(node);
            }
            rows_.empty(row);
        }
        list(slot);
    }

    // Inserts a shipment where it is cheapest, or on a row of its own, unless it costs so much;
    // returns what it costs.
    double place(Int pickup, double most, bool opens) {
        if (!data_.can(0, 0, pickup)) return infeasible;
        CheapestPlace best;
        finder_.begin(pickup);
        if (!opens) look_at_rows(pickup, best);
        double cost = best.slot == nowhere ? infeasible : drive_cost(rate_, best.further);
        const Int free = free_slot(data_, searcher_, 0);
        if (free >= 0 && (opens || rate_.fixed < cost)) {
            CheapestPlace alone;
            PairRow& row = row_of(free);
            rows_.empty(row);
            const Int idle = row.distance;
            finder_.scan(row, free, alone);
            if (alone.slot >= 0 && rate_.fixed + drive_cost(rate_, idle + alone.further) < cost) {
                best = alone;
                cost = rate_.fixed + drive_cost(rate_, idle + alone.further);
            }
        }
        if (cost >= most) return infeasible;
        put_in(pickup, best);
        return cost;
    }

    void put_in(Int pickup, const CheapestPlace& best) {
        touch(best.slot);
        PairRow& row = row_of(best.slot);
        rows_.insert(row, pickup, best.place);
        rows_.time(row);
        added_ += price_of(pickup);
        searcher_.now.where[pickup].slot = best.slot;
        searcher_.now.where[data_.pair[pickup].partner].slot = best.slot;
        list(best.slot);
    }

    void look_at_rows(Int pickup, CheapestPlace& best) {
        if (data_.strategy.scan_all) {
            for (const Int slot : searcher_.active.first(searcher_.count->active)) {
                finder_.scan(row_of(slot), slot, best);
            }
            return;
        }
        ++looks_;
        for (const Int end : {pickup, data_.pair[pickup].partner}) {
            for (const Int other : data_.granular[end]) {
                if (other < 0) break;
                const Int slot = searcher_.now.where[other].slot;
                if (slot < 0 || seen_[std::size_t(slot)] == looks_) continue;
                seen_[std::size_t(slot)] = looks_;
                finder_.scan(row_of(slot), slot, best);
            }
        }
    }

    const ProblemData& data_;
    Searcher& searcher_;
    const Rate& rate_;
    const PairRows rows_;
    PlaceFinder finder_;
    std::vector<PairRow> row_;            // (slot,)
    std::vector<PairRow> before_;         // (number,) those touched this turn
    std::vector<std::vector<Int>> best_;  // (slot,) nodes
    std::vector<Int> best_missing_;
    std::vector<Int> touched_in_;  // (slot,) the last turn that did
    std::vector<Int> seen_;        // (slot,) the last look at it
    Int looks_ = 0;
    double added_ = 0.0;  // this turn, wherever shipments are
    double best_cost_ = 0.0;
    const double written_best_;  // what the search's best routes cost at first
    bool is_better_ = false;
};

}  // namespace
}  // namespace tandem

using namespace tandem;

extern "C" int tandem_anneal_shipments(const tandem_problem_data* data,
                                       const tandem_searcher* searcher, tandem_scratch* scratch,
                                       int64_t turns, int64_t* done) {
    return guarded([&] {
        const ProblemData problem = data_of(*data);
        Searcher working = searcher_of(*searcher);
        scratch->lend_to(problem, working);
        PairStore routes(problem, working);
        *done = routes.read() ? 1 : 0;
        if (*done == 0) return;
        anneal(problem, working, routes, turns);
        *done = routes.write() ? 1 : 0;
    });
}
