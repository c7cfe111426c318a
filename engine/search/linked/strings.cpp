#include "search/linked/aboard.h"
#include "search/linked/chain.h"
#include "search/linked/turn.h"
#include "search/moves/ruin.h"
#include "search/route/refresh.h"

namespace tandem {

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
