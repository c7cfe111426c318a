// The better parts of two plans, put together.
//
// While it cools, a search changes its plan here and there, to and fro: hardly ever are all parts
// at their best at once. Routes of one plan that serve the same customers as some of another may
// take their place whatever the others are (Whitley, Hains and Howe 2009, partition crossover). So
// the smallest such parts of the plan as it is take their places in the best one wherever they cost
// less; the search goes on as it would have. Where that would take too many vehicles or batteries,
// those parts alone are taken that need no more of any.

#include "rules/company.h"
#include "search/route/hubs.h"
#include "search/route/lags.h"
#include "search/route/state.h"
#include "search/search.h"

namespace tandem {

namespace {

constexpr double least_gain = 1e-9;  // costs that differ by less are the same

// Routes have a number each, by slot, and behind them each node left out, as if it were a route;
// behind those of the best plan come those of the plan as it is. A part is known by the least
// number that it has in the best plan.
class Recombination {
public:
    Recombination(const ProblemData& data, Searcher& searcher)
        : data_(data),
          searcher_(searcher),
          slots_(searcher.active.size()),
          numbers_(slots_ + data.num_nodes),
          parent_({2 * numbers_}) {}

    // Let the best plan take over what costs less. In place.
    void run();

private:
    void join_all();
    void join(Int number, Int other);
    Int part_of(Int number) const;
    void count(const Fleet& fleet, Int first, View<double, 1> cost, View<Int, 2> needed) const;
    bool is_too_much(View<const bool, 1> better, View<const Int, 2> needed) const;
    void exchange(View<const bool, 1> better);

    const ProblemData& data_;
    Searcher& searcher_;
    Int slots_, numbers_;
    OwnRows<Int, 1>
        parent_;  // (number,) one of its part that is no larger, `nowhere` if it has none
};

// The number of the part that a number belongs to; `nowhere` if it is in none.
Int Recombination::part_of(Int number) const {
    while (parent_[number] != nowhere && parent_[number] != number) {
        number = parent_[number] = parent_[parent_[number]];
    }
    return parent_[number];
}

// Let two numbers be of one part. In place.
void Recombination::join(Int number, Int other) {
    for (const Int each : {number, other}) {
        if (parent_[each] == nowhere) parent_[each] = each;
    }
    const auto [least, more] = std::minmax({part_of(number), part_of(other)});
    parent_[more] = least;
}

// Find the smallest parts that serve the same customers in both plans. Who is to go with others
// stays in one part with them, so that no other part serves them too.
void Recombination::join_all() {
    std::ranges::fill(parent_, nowhere);
    const OwnRows<Int, 2> slot_of({2, data_.num_nodes});
    std::ranges::fill(slot_of[0], nowhere);
    for (Int slot = 0; slot < slots_; ++slot) {
        if (searcher_.best.route[slot].length == 0) continue;
        for_each_served(searcher_.best, slot, [&](Int node) { slot_of(0, node) = slot; });
    }
    for (Int node = 0; node < data_.num_nodes; ++node) {
        slot_of(1, node) = searcher_.now.where[node].slot;
        for (Int plan = 0; plan < 2; ++plan) {
            Int& slot = slot_of(plan, unit_of(data_.pair, node));
            slot = std::max(slot, slot_of(plan, node));
        }
    }
    std::array<Int, 64> company;
    company.fill(nowhere);
    for (Int node = data_.num_depots; node < data_.num_nodes; ++node) {
        const Int then = slot_of(0, node), now = slot_of(1, node);
        if (unit_of(data_.pair, node) != node || now == elsewhere) continue;
        const Int number = then == nowhere ? slots_ + node : then;
        join(number, numbers_ + (now == nowhere ? slots_ + node : now));
        if (data_.goods.empty()) continue;
        for (Int kept = kept_by_vehicle(data_.goods[node]), bit = 0; kept != 0; kept >>= 1, ++bit) {
            if ((kept & 1) == 0) continue;
            Int& other = company.at(std::size_t(bit));
            if (other != nowhere) join(number, other);
            other = number;
        }
    }
}

// Add what parts cost in a plan, and take. In place.
void Recombination::count(const Fleet& fleet, Int first, View<double, 1> cost,
                          View<Int, 2> needed) const {
    const Int sign = first == 0 ? -1 : 1;
    const OwnRows<Int, 2> batteries({slots_, data_.hub.size()});
    count_batteries(data_, fleet, batteries);
    for (Int number = 0; number < numbers_; ++number) {
        const Int part = part_of(first + number), node = number - slots_;
        if (part == nowhere) continue;
        if (node >= 0) {
            cost[part] += data_.unassigned_cost + data_.unassigned_more[node];
            continue;
        }
        cost[part] += fleet.cost[number];
        needed(part, fleet.route[number].type) += sign;
        for (Int depot = 0; depot < data_.hub.size(); ++depot) {
            needed(part, data_.num_types + depot) += sign * batteries(number, depot);
        }
    }
}

// Whether better parts together take more vehicles or batteries than there are.
bool Recombination::is_too_much(View<const bool, 1> better, View<const Int, 2> needed) const {
    const OwnRows<Int, 2> batteries({slots_, data_.hub.size()});
    count_batteries(data_, searcher_.best, batteries);
    Int vehicles = 0;
    for (Int kind = 0; kind < needed.shape(1); ++kind) {
        const Int depot = kind - data_.num_types;
        Int taken = depot < 0 ? searcher_.best.used[kind] : 0;
        for (Int slot = 0; depot >= 0 && slot < slots_; ++slot) taken += batteries(slot, depot);
        for (Int part = 0; part < numbers_; ++part) taken += better[part] ? needed(part, kind) : 0;
        if (taken > (depot < 0 ? data_.type[kind].count : data_.hub[depot].batteries)) return true;
        if (depot < 0) vehicles += taken;
    }
    return vehicles > slots_;
}

// Let routes and customers left out take the places of others in the best plan. In place.
void Recombination::exchange(View<const bool, 1> better) {
    const Fleet& best = searcher_.best;
    SearchCounts& count = *searcher_.count;
    const auto changes = [&](Int number) {
        const Int part = part_of(number);
        return part != nowhere && better[part];
    };
    for (Int slot = 0; slot < slots_; ++slot) {
        if (!changes(slot)) continue;
        best.route[slot].length = best.route[slot].sorties = best.route[slot].trips = 0;
        best.cost[slot] = 0.0;
    }
    for (Int slot = 0, free = 0; slot < slots_; ++slot) {
        if (!changes(numbers_ + slot)) continue;
        while (best.route[free].length > 0) ++free;
        copy_route(searcher_.now, slot, best, free);
    }
    for (Route& route : best.route) route.stamp = others;
    Int* const missing = searcher_.best_missing.data();
    count.best_missing = std::remove_if(missing, missing + count.best_missing,
                                        [&](Int node) { return changes(slots_ + node); }) -
                         missing;
    for (Int node = 0; node < data_.num_nodes; ++node) {
        if (changes(numbers_ + slots_ + node)) {
            searcher_.best_missing.at(count.best_missing++) = node;
        }
    }
    count.changed = all_slots;
}

void Recombination::run() {
    join_all();
    const OwnRows<double, 1> before({numbers_}), after({numbers_});
    const OwnRows<Int, 2> needed({numbers_, data_.num_types + data_.hub.size()});
    count(searcher_.best, 0, before, needed);
    count(searcher_.now, numbers_, after, needed);
    const OwnRows<bool, 1> better({numbers_});
    for (Int part = 0; part < numbers_; ++part)
        better[part] = before[part] - after[part] > least_gain;
    if (is_too_much(better, needed)) {
        for (Int part = 0; part < numbers_; ++part) {
            const View<Int, 1> more = needed[part];
            if (std::ranges::any_of(more, [](Int each) { return each > 0; })) better[part] = false;
        }
    }
    if (std::ranges::count(better, true) == 0) return;
    double saved = 0.0;
    for (Int part = 0; part < numbers_; ++part) {
        if (!better[part]) continue;
        saved += before[part] - after[part];
        for (Int k = 0; k < data_.num_types; ++k) searcher_.best.used[k] += needed(part, k);
    }
    searcher_.value->best -= saved;
    exchange(better);
}

}  // namespace
}  // namespace tandem

using namespace tandem;

extern "C" int tandem_take_better_parts(const tandem_problem_data* data, tandem_search* search) {
    return guarded([&] {
        const ProblemData problem = data_of(*data);
        const Fairness& fairness = problem.fairness;
        // Neither where the plan costs something as a whole, nor where orders or places to charge
        // bind routes.
        if (fairness.makespan > 0 || fairness.balance > 0 || fairness.min_vehicles > 0 ||
            orders_cross(problem) || !problem.plugging.empty()) {
            return;
        }
        Recombination(problem, *search).run();
    });
}
