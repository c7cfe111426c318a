#include "search/linked/turn.h"

#include "search/linked/aboard.h"
#include "search/linked/chain.h"
#include "search/moves/ruin.h"
#include "search/route/refresh.h"

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

namespace {

// Where a string of so many customers begins, drawn from all with a customer in it.
Int first_of_string(const ProblemData& data, const Searcher& searcher, const Linked& linked,
                    Int customer, Int span) {
    const View<Link, 1> link = linked.link;
    Int first = customer, before = 0;
    while (before < span - 1 && link[first].before >= data.num_depots) {
        first = link[first].before;
        ++before;
    }
    Int last = customer, behind = 0;
    while (behind < span - 1 && link[last].behind >= data.num_depots) {
        last = link[last].behind;
        ++behind;
    }
    // The first may come `before` places ahead, or as many as leave room for the last.
    const Int latest = std::min(Int{0}, behind - (span - 1));
    for (Int skipped = below(searcher.rng, latest + before + 1); skipped > 0; --skipped) {
        first = link[first].behind;
    }
    return first;
}

// Whether a route is driven in time, by the times of one customer on it.
bool is_in_time(const ProblemData& data, const Linked& linked, Int node) {
    const Link& here = linked.link[node];
    const VehicleType& type = data.type[linked.run[here.slot].type];
    return here.leave - data.place.by_truck(type)[node].service_duration() <= here.latest;
}

// Takes out a string around a customer, or all but some within; returns the saving.
//
// Takes nobody out if a vehicle then came too late, as where the direct leg is the longer one, or
// picked up what it must not before it has delivered something.
double cut_string(const ProblemData& data, Searcher& searcher, Linked& linked, Int customer,
                  double longest) {
    const View<Link, 1> link = linked.link;
    const Int slot = link[customer].slot;
    const Run& run = linked.run[slot];
    const Rate& rate = data.rate[run.type];
    const StopString string = draw_string(searcher.rng, longest, run.count);
    const auto [size, spared] = string;
    const Int first = first_of_string(data, searcher, linked, customer, string.span());
    const Int gap = draw_gap(searcher.rng, string);
    const Int before = link[first].before;
    const NoteCounts noted = linked.noted;
    Int saved = cut_out(data, linked, slot, first, gap);
    const Int first_left = before < data.num_depots ? run.first : link[before].behind;
    Int last_left = before;
    if (spared > 0) {
        last_left = first_left;
        for (Int number = 1; number < spared; ++number) last_left = link[last_left].behind;
        saved += cut_out(data, linked, slot, link[last_left].behind, size - gap);
    }
    bool allowed = run.count == 0 || !looks_aboard(linked) || weigh_run(data, linked, slot);
    if (linked.timed && run.count > 0) {
        drive_on(data, linked, slot, first_left, spared + 1);
        look_back(data, linked, slot, last_left, spared + 1);
        const Int left = first_left < data.num_depots ? last_left : first_left;
        allowed = allowed && is_in_time(data, linked, left);
    }
    if (!allowed) {
        restore(data, searcher, linked, slot, noted);
        return 0.0;
    }
    double cost = double(saved) * rate.distance + double(size) * rate.stop;
    if (run.count == 0) {
        cost += rate.fixed;
        close_run(searcher, linked, slot);
    }
    return cost;
}

}  // namespace

Ruined ruin_linked(const ProblemData& data, Searcher& searcher, Linked& linked) {
    SearchCounts& count = *searcher.count;
    const double longest = longest_string(searcher, count.active);
    Int strings = draw_strings(longest, searcher.rng);
    const Int seed = draw_seed(data, searcher, searcher.absent.first(count.absent));
    double saved = 0.0;
    Int rank = -1, customer = seed;
    while (strings > 0 && customer >= 0 && linked.noted.removed < most_removed) {
        const Int slot = linked.link[customer].slot;
        if (slot >= 0 && linked.hit[slot] != count.turn) {
            linked.hit[slot] = count.turn;
            const Int removed = linked.noted.removed;
            saved += cut_string(data, searcher, linked, customer, longest);
            if (linked.noted.removed > removed) --strings;
        }
        ++rank;
        customer = rank < data.near.shape(1) ? data.near(seed, rank) : nowhere;
    }
    for (const Int node : linked.removed_node.first(linked.noted.removed)) {
        searcher.absent.at(count.absent++) = node;
    }
    return {saved, seed};
}

}  // namespace tandem
