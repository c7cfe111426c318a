#include "search/linked/aboard.h"
#include "search/linked/turn.h"

namespace tandem {

namespace {

// With how many routes, drawn anew each time, a route may swap vehicles.
constexpr Int most_traded = 64;

// What another vehicle saves at least, so that costs that differ in their last bits don't count.
constexpr double least_saved = 1e-9;

// Swaps vehicles with other routes where that is cheaper; returns the saving.
double trade_run(const ProblemData& data, Searcher& searcher, Linked& linked, Int slot) {
    const Run& run = linked.run[slot];
    const Haul haul = haul_of(run);
    const Int number = searcher.count->active;
    const Int begin = below(searcher.rng, number);
    double saved = 0.0;
    for (Int index = begin; index < begin + std::min(number, most_traded); ++index) {
        const Int another = searcher.active[index < number ? index : index - number];
        const Run& other = linked.run[another];
        const Haul other_haul = haul_of(other);
        const Int k = run.type, by = other.type;
        if (!data.swap(k, by)) continue;
        const double spared = route_cost(data, k, haul) + route_cost(data, by, other_haul) -
                              route_cost(data, by, haul) - route_cost(data, k, other_haul);
        if (spared > least_saved && can_take(data, linked, slot, data.type[by]) &&
            can_take(data, linked, another, data.type[k])) {
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
        linked.retyped.at(linked.noted.retyped++) = slot;
    }
    --searcher.now.used[run.type];
    ++searcher.now.used[k];
    run.type = k;
}

double cheapen_run(const ProblemData& data, Searcher& searcher, Linked& linked, Int slot) {
    const Run& run = linked.run[slot];
    if (run.count == 0) return 0.0;
    const Haul haul = haul_of(run);
    double saved = 0.0;
    for (Int k = 0; k < data.num_types; ++k) {
        if (!data.swap(run.type, k) || !is_left(data, searcher.now, k)) continue;
        const double spared = route_cost(data, run.type, haul) - route_cost(data, k, haul);
        if (spared > least_saved && can_take(data, linked, slot, data.type[k])) {
            give_run(searcher, linked, slot, k);
            saved += spared;
        }
    }
    return saved + trade_run(data, searcher, linked, slot);
}

double cheapen_runs(const ProblemData& data, Searcher& searcher, Linked& linked) {
    const NoteCounts& noted = linked.noted;
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
    for (const Int slot : linked.retyped.first(linked.noted.retyped)) {
        Run& run = linked.run[slot];
        --searcher.now.used[run.type];
        run.type = linked.former[slot];
        ++searcher.now.used[run.type];
        linked.former[slot] = nowhere;
    }
    linked.noted.retyped = 0;
}

}  // namespace tandem
