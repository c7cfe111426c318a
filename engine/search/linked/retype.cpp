#include "search/linked/retype.h"

#include <algorithm>
#include <limits>

#include "randomness.h"
#include "rules/load.h"
#include "search/route/state.h"

namespace tandem {

namespace {

// With how many routes, drawn anew each time, a route may swap vehicles.
constexpr Int most_traded = 64;

// What another vehicle saves at least, so that costs that differ in their last bits don't count.
constexpr double least_saved = 1e-9;

// Whether there is a vehicle of a type that nobody drives.
bool is_left(const ProblemData& data, const Searcher& searcher, Int k) {
    return searcher.now.used[k] < data.type[k].count;
}

// Swaps vehicles with other routes where that is cheaper; returns the saving.
double trade_run(const ProblemData& data, Searcher& searcher, Linked& linked, Int slot) {
    const Run& run = linked.run[slot];
    const Int number = searcher.count->active;
    const Int begin = below(searcher.rng, number);
    double saved = 0.0;
    for (Int index = begin; index < begin + std::min(number, most_traded); ++index) {
        const Int another = searcher.active[index < number ? index : index - number];
        const Run& other = linked.run[another];
        const Int k = run.type;
        const Int by = other.type;
        if (!data.swap(k, by)) continue;
        const double spared = cost_of_run(data, k, run) + cost_of_run(data, by, other) -
                              cost_of_run(data, by, run) - cost_of_run(data, k, other);
        if (spared > least_saved && holds(data.type[by], amount_of(run.load)) &&
            holds(data.type[k], amount_of(other.load))) {
            give_run(searcher, linked, slot, by);
            give_run(searcher, linked, another, k);
            saved += spared;
        }
    }
    return saved;
}

}  // namespace

void give_run(Searcher& searcher, Linked& linked, Int slot, Int k) {
    Run& run = linked.run[slot];
    if (linked.former[slot] == nowhere) {
        linked.former[slot] = run.type;
        linked.retyped[linked.noted->retyped++] = slot;
    }
    --searcher.now.used[run.type];
    ++searcher.now.used[k];
    run.type = k;
}

Int larger_for(const ProblemData& data, const Searcher& searcher, const Run& run, Int node) {
    Int chosen = nowhere;
    double best = std::numeric_limits<double>::infinity();
    for (Int k = 0; k < data.num_types; ++k) {
        if (!data.swap(run.type, k) || !data.can(k, 0, node) || !is_left(data, searcher, k)) {
            continue;
        }
        const double cost = cost_of_run(data, k, run) + data.rate[k].stop;
        if (cost < best && fits(data.type[k], amount_of(run.load), data.place[0][node])) {
            chosen = k;
            best = cost;
        }
    }
    return chosen;
}

double cheapen_run(const ProblemData& data, Searcher& searcher, Linked& linked, Int slot) {
    const Run& run = linked.run[slot];
    if (run.count == 0) return 0.0;
    double saved = 0.0;
    for (Int k = 0; k < data.num_types; ++k) {
        if (!data.swap(run.type, k) || !is_left(data, searcher, k)) continue;
        const double spared = cost_of_run(data, run.type, run) - cost_of_run(data, k, run);
        if (spared > least_saved && holds(data.type[k], amount_of(run.load))) {
            give_run(searcher, linked, slot, k);
            saved += spared;
        }
    }
    return saved + trade_run(data, searcher, linked, slot);
}

double cheapen_runs(const ProblemData& data, Searcher& searcher, Linked& linked) {
    const Noted& noted = *linked.noted;
    double saved = 0.0;
    for (const Piece& piece : linked.piece.first(noted.pieces)) {
        saved += cheapen_run(data, searcher, linked, piece.slot);
    }
    for (const Entry& entry : linked.entry.first(noted.entries)) {
        saved += cheapen_run(data, searcher, linked, linked.link[entry.node].slot);
    }
    return saved;
}

void take_types_back(Searcher& searcher, Linked& linked) {
    for (const Int slot : linked.retyped.first(linked.noted->retyped)) {
        Run& run = linked.run[slot];
        --searcher.now.used[run.type];
        run.type = linked.former[slot];
        ++searcher.now.used[run.type];
        linked.former[slot] = nowhere;
    }
    linked.noted->retyped = 0;
}

}  // namespace tandem
