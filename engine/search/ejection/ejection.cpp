#include <cmath>
#include <numeric>

#include "randomness.h"
#include "search/route/fairness.h"
#include "search/route/rarer.h"
#include "search/search.h"
#include "search/shipments/pair_row.h"

namespace tandem {
namespace {

constexpr Int moved_between = 100;  // shipments tried elsewhere after each ejection
constexpr Int one_at_random = 10;   // of so many; the others go where they take least time

// By how much of a leg a gentle move lengthens ways at most, on average of what is drawn.
constexpr double gentle_rise = 0.2;

// After how many rounds a shipment it is given up if so large a share is still left out.
constexpr Int hopeless_after = 20;
constexpr double hopeless_share = 0.05;

// Inserts shipments that are left out among routes that there are, by ejecting others.
//
// Whoever fits nowhere is inserted where those who are ejected for it, one shipment or two, were
// themselves inserted with the least trouble so far; then some shipments, drawn at random, are
// moved, most where they take least time; gently, only if ways become hardly longer.
class Ejection {
public:
    Ejection(const ProblemData& data, Searcher& searcher)
        : data_(data),
          searcher_(searcher),
          rows_(data, tiers_aboard(searcher.now)),
          slots_(searcher.active.begin(), searcher.active.begin() + searcher.count->active),
          row_(slots_.size()),
          trouble_(std::size_t(data.num_nodes), 1),
          pool_(searcher.missing.begin(), searcher.missing.begin() + searcher.count->missing) {}

    // Inserts all who are left out, in so many rounds at most. False if that doesn't come about.
    bool run(Int rounds, bool gently) {
        if (slots_.empty() || !read()) return false;
        is_shortening_ = true;
        if (gently) rise_ = gentle_rise * mean_gap();
        std::size_t fewest = pool_.size();
        while (!pool_.empty() && made_ < rounds && !is_hopeless(fewest)) {
            ++made_;
            if (!make_round()) return false;
            fewest = std::min(fewest, pool_.size());
        }
        return pool_.empty() && write();
    }

    // Moves so many shipments at random, as far as the search may go on, to a vehicle more, too, if
    // there is one. False if that fails.
    bool shuffle(Int moves, bool by_one_more) {
        if (slots_.empty() || !pool_.empty() || !read()) return false;
        const Int free = by_one_more ? free_slot(data_, searcher_, 0) : nowhere;
        if (free >= 0) {
            slots_.push_back(free);
            rows_.empty(row_.emplace_back());
        }
        for (Int moved = 0; moved < moves && !data_.deadline.passed(); ++moved) move_any();
        return write();
    }

    // How many rounds there were.
    Int made() const { return made_; }

private:
    // Where a shipment goes, and who is ejected for it.
    struct EjectionSpot {
        Int row = nowhere;
        PairPlace place{};
        Int one = nowhere, other = nowhere, trouble = 0;
    };

    // Inserts one who is left out, or tries to. False once the search must end.
    bool make_round() {
        if (data_.deadline.passed()) return false;
        const Int pickup = pool_.back();
        pool_.pop_back();
        if (insert_anywhere(pickup)) return true;
        ++trouble_[std::size_t(pickup)];
        if (!eject_for(pickup)) pool_.insert(pool_.begin(), pickup);
        for (Int moved = 0; moved < moved_between; ++moved) {
            if (data_.deadline.passed()) return false;
            move_any();
        }
        return true;
    }

    // Whether far too many were left out all the time.
    bool is_hopeless(std::size_t fewest) const {
        const Int shipments = searcher_.count->customers / 2;
        return made_ > hopeless_after * shipments &&
               double(fewest) > hopeless_share * double(shipments);
    }

    bool read() {
        for (std::size_t index = 0; index < row_.size(); ++index) {
            if (!read_row(rows_, searcher_.now, slots_[index], row_[index])) return false;
        }
        return true;
    }

    // One of the places where a shipment fits into a row, each as likely.
    std::optional<PairPlace> any_place(const PairRow& row, const PairToInsert& pair) const {
        Int found = 0;
        std::optional<PairPlace> chosen;
        rows_.for_each_place(row, pair, [&](PairPlace place) {
            if (below(searcher_.rng, ++found) == 0) chosen = place;
        });
        return chosen;
    }

    // That of them where it takes least time; of several such, some one.
    std::optional<PairPlace> nearest_place(const PairRow& row, const PairToInsert& pair) const {
        std::optional<PairPlace> chosen;
        Int least = 0;
        rows_.for_each_place(row, pair, [&](PairPlace place) {
            const Int longer = PairRows::more_by(row, pair, place).duration;
            if (!chosen || longer < least || (longer == least && below(searcher_.rng, 2) == 0)) {
                least = longer;
                chosen = place;
            }
        });
        return chosen;
    }

    // Where a shipment is moved to in a row.
    std::optional<PairPlace> place_to_move(const PairRow& row, const PairToInsert& pair) const {
        const bool near = is_shortening_ && (rise_ || below(searcher_.rng, one_at_random) > 0);
        return near ? nearest_place(row, pair) : any_place(row, pair);
    }

    void put_in(Int index, Int pickup, PairPlace place) {
        PairRow& row = row_[std::size_t(index)];
        rows_.insert(row, pickup, place);
        rows_.time(row);
    }

    bool insert_anywhere(Int pickup) {
        const PairToInsert pair = rows_.pair_of(pickup);
        Int found = 0;
        EjectionSpot chosen;
        for (std::size_t index = 0; index < row_.size(); ++index) {
            rows_.for_each_place(row_[index], pair, [&](PairPlace place) {
                if (below(searcher_.rng, ++found) == 0) chosen = {Int(index), place};
            });
        }
        if (chosen.row == nowhere) return false;
        put_in(chosen.row, pickup, chosen.place);
        return true;
    }

    // Lists the shipments of a row, those that fitted best first, otherwise by chance.
    void list_pickups(const PairRow& row, std::vector<Int>& pickups) {
        pickups.clear();
        for (const Int node : row.node) {
            if (node >= data_.num_depots && data_.pair[node].unit == node) pickups.push_back(node);
        }
        mix(pickups);
        ranked_.clear();
        for (const Int pickup : pickups) {
            ranked_.push_back({trouble_[std::size_t(pickup)], Int(ranked_.size()), pickup});
        }
        std::ranges::sort(ranked_);
        std::transform(ranked_.begin(), ranked_.end(), pickups.begin(),
                       [](const std::array<Int, 3>& ranked) { return ranked[2]; });
    }

    template <class T>
    void mix(std::vector<T>& items) const {
        for (Int index = Int(items.size()) - 1; index > 0; --index) {
            std::swap(items[std::size_t(index)],
                      items[std::size_t(below(searcher_.rng, index + 1))]);
        }
    }

    bool eject_for(Int pickup) {
        const PairToInsert pair = rows_.pair_of(pickup);
        EjectionSpot best;
        best.trouble = trouble_[std::size_t(pickup)];
        order_.resize(row_.size());
        std::iota(order_.begin(), order_.end(), Int{0});
        mix(order_);
        // One by one first: the less trouble somebody is by whom it fits, the fewer pairs are
        // tried.
        if (!try_each(pair, best) || !try_pairs(pair, best)) return false;
        if (best.row == nowhere) return false;
        take_out(best.row, best.one, best.other);
        put_in(best.row, pickup, best.place);
        pool_.push_back(best.one);
        if (best.other != nowhere) pool_.push_back(best.other);
        return true;
    }

    // Ejects each shipment that may be. False once the search must end.
    bool try_each(const PairToInsert& pair, EjectionSpot& best) {
        for (const Int index : order_) {
            list_pickups(row_[std::size_t(index)], pickups_);
            for (const Int one : pickups_) {
                if (trouble_[std::size_t(one)] >= best.trouble) break;
                if (data_.deadline.passed()) return false;
                try_without(index, pair, one, nowhere, best);
            }
        }
        return true;
    }

    // Ejects each two shipments of a route that may be. False once the search must end.
    bool try_pairs(const PairToInsert& pair, EjectionSpot& best) {
        for (const Int index : order_) {
            list_pickups(row_[std::size_t(index)], pickups_);
            for (std::size_t first = 1; first < pickups_.size(); ++first) {
                const Int one = pickups_[first];
                if (trouble_[std::size_t(one)] >= best.trouble) break;
                for (std::size_t second = 0; second < first; ++second) {
                    const Int other = pickups_[second];
                    if (trouble_[std::size_t(one)] + trouble_[std::size_t(other)] >= best.trouble)
                        break;
                    if (data_.deadline.passed()) return false;
                    try_without(index, pair, one, other, best);
                }
            }
        }
        return true;
    }

    void try_without(Int index, const PairToInsert& pair, Int one, Int other, EjectionSpot& best) {
        rows_.leave_out(row_[std::size_t(index)], one, other, without_);
        if (without_.node.empty()) return;
        const std::optional<PairPlace> place = any_place(without_, pair);
        if (!place) return;
        const Int more = other == nowhere ? 0 : trouble_[std::size_t(other)];
        best = {index, *place, one, other, trouble_[std::size_t(one)] + more};
    }

    void take_out(Int index, Int one, Int other) {
        rows_.leave_out(row_[std::size_t(index)], one, other, without_);
        std::swap(row_[std::size_t(index)], without_);
    }

    static Int time_on(const PairRow& row) {
        return std::accumulate(row.gap.begin(), row.gap.end() - 1, Int{0});
    }

    // How long a leg takes on average.
    double mean_gap() const {
        Int all = 0, legs = 0;
        for (const PairRow& row : row_) {
            all += time_on(row);
            legs += Int(row.node.size()) - 1;
        }
        return double(all) / double(legs);
    }

    // Whether a shipment may move from a row to a place among others; anywhere but gently.
    bool may_move(const PairRow& from, const PairRow& others, const PairToInsert& pair,
                  PairPlace place) const {
        if (!rise_) return true;
        const Int saved = time_on(from) - time_on(without_);
        const Int longer = PairRows::more_by(others, pair, place).duration - saved;
        return double(longer) <= -*rise_ * std::log(1.0 - uniform(searcher_.rng));
    }

    // Moves a random shipment to a place of a random row, or exchanges it for one there.
    void move_any() {
        const Int index = below(searcher_.rng, Int(row_.size()));
        const Int to = below(searcher_.rng, Int(row_.size()));
        PairRow &from = row_[std::size_t(index)], &target = row_[std::size_t(to)];
        if (from.node.size() <= 2) return;
        const Int pickup = any_pickup(from);
        const PairToInsert pair = rows_.pair_of(pickup);
        rows_.leave_out(from, pickup, nowhere, without_);
        if (without_.node.empty()) return;
        const PairRow& others = index == to ? without_ : target;
        if (const auto place = place_to_move(others, pair)) {
            if (!may_move(from, others, pair, *place)) return;
            std::swap(from, without_);
            put_in(to, pickup, *place);
            return;
        }
        if (rise_ || index == to || target.node.size() <= 2) return;
        const Int other = any_pickup(target);
        rows_.leave_out(target, other, nowhere, other_without_);
        if (other_without_.node.empty()) return;
        const auto here = place_to_move(without_, rows_.pair_of(other));
        if (!here) return;
        const auto there = place_to_move(other_without_, pair);
        if (!there) return;
        std::swap(from, without_);
        std::swap(target, other_without_);
        put_in(index, other, *here);
        put_in(to, pickup, *there);
    }

    Int any_pickup(const PairRow& row) const {
        const Int p = 1 + below(searcher_.rng, Int(row.node.size()) - 2);
        return data_.pair[row.node[std::size_t(p)]].unit;
    }

    // Writes the rows as the routes; false, with the best routes, if one breaks a rule.
    bool write() {
        const Fleet& now = searcher_.now;
        SearchCounts& count = *searcher_.count;
        ++count.stamp;
        count.changed = all_slots;
        double cost = 0.0;
        bool allowed = true;
        for (std::size_t index = 0; index < row_.size(); ++index) {
            const Int slot = slots_[index];
            now.route[slot].stamp = count.stamp;
            allowed = write_row(data_, now, slot, row_[index].node);
            if (!allowed) break;
            cost += now.cost[slot];
        }
        list_active(searcher_);
        now.used[0] = count.active;
        if (!allowed) {
            go_back(searcher_);
            return false;
        }
        count.missing = 0;
        searcher_.value->cost = cost + plan_cost(data_, searcher_);
        if (searcher_.value->cost < searcher_.value->best) keep_best(searcher_);
        return true;
    }

    const ProblemData& data_;
    Searcher& searcher_;
    const PairRows rows_;
    std::vector<Int> slots_;
    std::vector<PairRow> row_;
    std::vector<Int> trouble_;  // (node,) of a pickup, how often it fitted nowhere
    std::vector<Int> pool_;     // pickups of those left out
    std::vector<Int> order_, pickups_;
    std::vector<std::array<Int, 3>> ranked_;  // (pickup,) its trouble, rank by chance, and node
    PairRow without_, other_without_;
    Int made_ = 0;
    bool is_shortening_ = false;  // most moves shorten ways, so that more fit
    std::optional<double> rise_;  // how much longer gentle moves make ways, as drawn
};

}  // namespace
}  // namespace tandem

using namespace tandem;

extern "C" int tandem_eject(const tandem_problem_data* data, tandem_search* search, int64_t rounds,
                            bool gently, int64_t* made, int64_t* done) {
    return guarded([&] {
        const ProblemData problem = data_of(*data);
        Ejection ejection(problem, *search);
        *done = ejection.run(rounds, gently) ? 1 : 0;
        *made = ejection.made();
    });
}

extern "C" int tandem_move_shipments(const tandem_problem_data* data, tandem_search* search,
                                     int64_t moves, bool by_one_more) {
    return guarded([&] {
        const ProblemData problem = data_of(*data);
        Ejection(problem, *search).shuffle(moves, by_one_more);
    });
}
