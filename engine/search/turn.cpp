#include "search/turn.h"

#include <cmath>
#include <utility>

#include "randomness.h"
#include "search/route/refresh.h"
#include "search/route/state.h"

namespace tandem {
namespace {

// How likely each of those near the ruin is tried before others, where there are more.
constexpr double tried_near_share = 0.5;

// How many of some customers have to be served.
Int num_obliged(const ProblemData& data, View<const Int, 1> nodes) {
    if (data.all_optional) return 0;
    return std::count_if(nodes.begin(), nodes.end(),
                         [&](Int node) { return bool(data.must_serve[node]); });
}

// How many more of those a turn may leave out than were before it.
Int most_more(const ProblemData& data, const Searcher& searcher, Int lacking) {
    const SearchCounts& count = *searcher.count;
    if (count.to_drop == 0) return 0;
    const Int fewest = num_obliged(data, searcher.best_missing.first(count.best_missing));
    return std::max(Int{0}, fewest + count.to_drop - lacking);
}

}  // namespace

Int begin_turn(const ProblemData& data, Searcher& searcher, Int most) {
    SearchCounts& count = *searcher.count;
    const View<Int, 1> absent = searcher.absent;
    ++count.turn;
    count.touched = 0;
    if (count.stay > 0 && count.turn % count.stay == 0) {
        count.focus = any_customer(data, searcher.now, searcher.rng);
    }
    const Int total = count.missing;
    copy_first(searcher.missing, total, absent);
    const Int alone = std::max(Int{0}, total - most);
    for (Int index = total - 1; index >= alone; --index) {
        std::swap(absent[index], absent[below(searcher.rng, index + 1)]);
    }
    count.absent = total;
    return alone;
}

void try_near(const ProblemData& data, Searcher& searcher, Int seed, Int first, Int total) {
    const View<Int, 1> absent = searcher.absent;
    const View<bool, 1> marked = searcher.marked;
    const View<const std::int32_t, 1> near = data.near[seed];
    Int chosen = 0;
    for (Int rank = -1; rank < near.size(); ++rank) {
        Int node = rank < 0 ? seed : near[rank];
        if (node < 0 || chosen == total - first) break;
        node = unit_of(data.pair, node);
        const Int place = served_place(data, searcher.now, node);
        if (searcher.now.where[place].slot == nowhere && !marked[node] && !data.must_serve[node] &&
            (rank < 0 || uniform(searcher.rng) < tried_near_share)) {
            marked[node] = true;
            ++chosen;
        }
    }
    Int last = total;
    for (Int index = total - 1; index >= 0; --index) {
        if (!marked[absent[index]]) continue;
        --last;
        marked[absent[index]] = false;
        std::swap(absent[index], absent[last]);
    }
}

double draw_rise(const Searcher& searcher) {
    return -searcher.value->temperature * std::log(1.0 - uniform(searcher.rng));
}

Int num_lacking(const ProblemData& data, const Searcher& searcher) {
    return num_obliged(data, searcher.missing.first(searcher.count->missing));
}

Int absences_to_spare(const ProblemData& data, const Searcher& searcher, Int lacking, Int first) {
    if (lacking == 0) return Spare{}.absences;
    return lacking + most_more(data, searcher, lacking) -
           num_obliged(data, searcher.absent.first(first));
}

bool rarer_absences(const ProblemData& data, Searcher& searcher) {
    const View<Int, 1> absences = searcher.absences;
    const View<const Int, 1> missing = searcher.missing, absent = searcher.absent;
    const Int num_missing = searcher.count->missing;
    const Int num_absent = searcher.count->absent;
    Int before = 0, after = 0, lacking = 0, more = 0;
    for (Int node : missing.first(num_missing)) {
        if (!data.must_serve[node]) continue;
        before += absences[node];
        ++lacking;
    }
    for (Int node : absent.first(num_absent)) {
        if (!data.must_serve[node]) continue;
        after += absences[node]++;
        ++more;
    }
    more -= lacking;
    if (more < 0 || more > most_more(data, searcher, lacking) || after >= before) return false;
    return more > 0 ||
           left_out_cost(data, absent, num_absent) <= left_out_cost(data, missing, num_missing);
}

bool counts_up(const ProblemData& data, const Searcher& searcher) {
    return data.strategy.give_up_early && (searcher.count->missing == 0 || data.all_optional);
}

double cost_to_insert(const ProblemData& data, const Searcher& searcher, double served, Int first) {
    const Int missing = searcher.count->missing;
    if (missing == 0) return served;
    return served + (left_out_cost(data, searcher.absent, first) -
                     left_out_cost(data, searcher.missing, missing));
}

double turn_cost(const ProblemData& data, const Searcher& searcher, double served) {
    const SearchCounts& count = *searcher.count;
    const double fewer_or_more = double(count.absent - count.missing) * data.unassigned_cost;
    const double others = unassigned_more(data, searcher.absent, count.absent) -
                          unassigned_more(data, searcher.missing, count.missing);
    return served + (fewer_or_more + others);
}

}  // namespace tandem
