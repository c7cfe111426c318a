// Exchanges routes of one plan for as many of another.
//
// References: Nagata and Kobayashi (2010), a memetic algorithm for the pickup and delivery problem
// with time windows using selective route exchange crossover, PPSN XI.

#include "randomness.h"
#include "search/route/fairness.h"
#include "search/route/rarer.h"
#include "search/search.h"
#include "search/shipments/pair_row.h"

namespace tandem {
namespace {

constexpr double come_whole_share = 0.5;  // how often who is served twice leaves routes that stay

// Lets routes of one plan give way to as many of another that serve nearly the same shipments.
//
// Whoever is served twice then leaves those that came or those that stayed; whoever is left out is
// inserted where that is cheapest, if it fits somewhere.
class Exchange {
public:
    Exchange(const ProblemData& data, Searcher& searcher, View<const Int, 1> one,
             View<const Int, 1> other)
        : data_(data),
          searcher_(searcher),
          rows_(data, tiers_aboard(searcher.now)),
          one_(rows_of(one)),
          other_(rows_of(other)),
          server_(std::size_t(data.num_nodes), nowhere),
          comes_along_(std::size_t(data.num_nodes), false),
          goes_(one_.size(), false),
          comes_(other_.size(), false) {}

    // Makes the plan, and lets it be the routes as they are. False if it breaks a rule.
    bool run() {
        if (one_.empty() || other_.empty()) return false;
        count_common();
        choose();
        mark_who_comes();
        for (std::size_t a = 0; a < one_.size(); ++a) leave(one_[a], goes_[a]);
        for (std::size_t b = 0; b < other_.size(); ++b) {
            if (comes_[b]) come(other_[b]);
        }
        for (PairRow& row : made_) {
            if (!rows_.time(row)) return false;
        }
        insert_missing();
        return write();
    }

private:
    // Reads the ends that each route serves, which `nowhere` ends.
    std::vector<PairRow> rows_of(View<const Int, 1> nodes) const {
        std::vector<PairRow> rows;
        bool begins = true;
        for (const Int node : nodes) {
            if (begins) rows_.empty(rows.emplace_back());
            begins = node == nowhere;
            std::vector<Int>& row = rows.back().node;
            if (!begins) row.insert(row.end() - 1, node);
        }
        return rows;
    }

    bool is_end(Int node) const { return node >= data_.num_depots; }
    Int pickup_of(Int end) const { return data_.pair[end].unit; }
    bool is_pickup(Int node) const { return is_end(node) && pickup_of(node) == node; }
    Int common(std::size_t a, std::size_t b) const { return common_[a * other_.size() + b]; }

    // Counts the shipments that routes of both plans have in common.
    void count_common() {
        for (std::size_t a = 0; a < one_.size(); ++a) {
            for (const Int node : one_[a].node) {
                if (is_pickup(node)) server_[std::size_t(node)] = Int(a);
            }
        }
        common_.assign(one_.size() * other_.size(), 0);
        for (std::size_t b = 0; b < other_.size(); ++b) {
            for (const Int node : other_[b].node) {
                if (!is_pickup(node) || server_[std::size_t(node)] == nowhere) continue;
                ++common_[std::size_t(server_[std::size_t(node)]) * other_.size() + b];
            }
        }
    }

    // Chooses a random route and one that has most in common with it; then by turns more of both
    // plans that have most in common with those chosen.
    void choose() {
        const Int fewest = Int(std::min(one_.size(), other_.size()));
        const Int number = 1 + below(searcher_.rng, std::max(Int{1}, fewest - 1));
        std::vector<Int> with_coming(one_.size(), 0), with_going(other_.size(), 0);
        std::size_t going = std::size_t(below(searcher_.rng, Int(one_.size())));
        for (Int chosen = 1;; ++chosen) {
            goes_[going] = true;
            for (std::size_t b = 0; b < other_.size(); ++b) with_going[b] += common(going, b);
            const std::size_t coming = most_common(comes_, with_going);
            comes_[coming] = true;
            if (chosen == number) return;
            for (std::size_t a = 0; a < one_.size(); ++a) with_coming[a] += common(a, coming);
            going = most_common(goes_, with_coming);
        }
    }

    // A random one of the routes that have most in common with those of the other plan, of those
    // not chosen.
    std::size_t most_common(const std::vector<bool>& chosen, const std::vector<Int>& number) const {
        std::size_t best = 0;
        Int most = -1, found = 0;
        for (std::size_t index = 0; index < chosen.size(); ++index) {
            if (chosen[index]) continue;
            if (number[index] > most) found = 0;
            if (number[index] < most || below(searcher_.rng, ++found) > 0) continue;
            most = number[index];
            best = index;
        }
        return best;
    }

    // Marks who is served by routes that come: all of them, or those alone whose routes go.
    void mark_who_comes() {
        const bool come_whole = uniform(searcher_.rng) < come_whole_share;
        for (std::size_t b = 0; b < other_.size(); ++b) {
            if (!comes_[b]) continue;
            for (const Int node : other_[b].node) {
                if (!is_end(node)) continue;
                const Int server = server_[std::size_t(pickup_of(node))];
                comes_along_[std::size_t(node)] =
                    come_whole || server == nowhere || goes_[std::size_t(server)];
            }
        }
    }

    // Keeps what stays of a route, if it does; who is served nowhere then is left out.
    void leave(PairRow& row, bool goes) {
        if (goes) {
            std::copy_if(
                row.node.begin(), row.node.end(), std::back_inserter(missing_),
                [&](Int node) { return is_pickup(node) && !comes_along_[std::size_t(node)]; });
            return;
        }
        std::erase_if(row.node, [&](Int node) { return comes_along_[std::size_t(node)]; });
        made_.push_back(row);
    }

    void come(PairRow& row) {
        std::erase_if(row.node,
                      [&](Int node) { return is_end(node) && !comes_along_[std::size_t(node)]; });
        made_.push_back(row);
    }

    // Inserts those left out in a random order.
    void insert_missing() {
        for (Int index = Int(missing_.size()) - 1; index > 0; --index) {
            std::swap(missing_[std::size_t(index)],
                      missing_[std::size_t(below(searcher_.rng, index + 1))]);
        }
        std::erase_if(missing_, [&](Int pickup) { return insert(pickup); });
    }

    // Inserts a shipment where it is least further, unless that is overlooked.
    bool insert(Int pickup) {
        const PairToInsert pair = rows_.pair_of(pickup);
        PairRow* chosen = nullptr;
        PairPlace best{};
        Int least = 0;
        for (PairRow& row : made_) {
            rows_.for_each_place(row, pair, [&](PairPlace place) {
                const Int further = PairRows::more_by(row, pair, place).distance;
                if (chosen != nullptr && further >= least) return;
                if (uniform(searcher_.rng) < data_.strategy.blink) return;
                chosen = &row;
                best = place;
                least = further;
            });
        }
        if (chosen == nullptr) return false;
        rows_.insert(*chosen, pickup, best);
        rows_.time(*chosen);
        return true;
    }

    bool write() {
        SearchCounts& count = *searcher_.count;
        if (Int(made_.size()) > searcher_.active.size()) return false;
        made_.resize(std::size_t(searcher_.active.size()));
        ++count.stamp;
        const bool allowed = write_rows(data_, searcher_, [&](Int slot) -> const std::vector<Int>& {
            return made_[std::size_t(slot)].node;
        });
        if (!allowed) {
            go_back(searcher_);
            return false;
        }
        write_missing(data_, searcher_, missing_);
        double cost = missing_cost(data_, searcher_) + plan_cost(data_, searcher_);
        for (const Int slot : searcher_.active.first(count.active)) {
            cost += searcher_.now.cost[slot];
        }
        searcher_.value->cost = cost;
        if (cost < searcher_.value->best) keep_best(searcher_);
        return true;
    }

    const ProblemData& data_;
    Searcher& searcher_;
    const PairRows rows_;
    std::vector<PairRow> one_, other_, made_;
    std::vector<Int> common_;  // (route, route of the other) shipments that both serve
    std::vector<Int> server_;  // (node,) of a pickup, which of the one plan's routes serves it
    std::vector<bool> comes_along_;  // (node,) an end is served by routes that come
    std::vector<bool> goes_, comes_;
    std::vector<Int> missing_;
};

}  // namespace
}  // namespace tandem

using namespace tandem;

extern "C" int tandem_exchange_routes(const tandem_problem_data* data, tandem_search* search,
                                      const tandem_i64_1d* one, const tandem_i64_1d* other,
                                      int64_t* done) {
    return guarded([&] {
        const ProblemData problem = data_of(*data);
        *done = Exchange(problem, *search, *one, *other).run() ? 1 : 0;
    });
}
