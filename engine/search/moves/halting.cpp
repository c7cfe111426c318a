#include "search/moves/halting.h"

#include "randomness.h"
#include "search/route/edit.h"
#include "search/route/rarer.h"
#include "search/route/refresh.h"
#include "search/route/state.h"

namespace tandem {

namespace {

constexpr double near_stop_share =
    0.5;  // how often a site is near the stop before, not the customer

constexpr double dropping_share = 0.5;  // how often a line loses a stop, not one more is put there

constexpr Int nearby = 2;  // at how many places before or behind a customer one is put

// Let all from a place on come `more` places later. In place; what they are is all that is kept.
void move_rest(View<Line, 1> line, Int from, Int length, Int more) {
    const auto move = [&](Int place) { line.at(place + more).node = line[place].node; };
    if (more > 0) {
        for (Int place = length - 1; place >= from; --place) move(place);
    } else {
        for (Int place = from; place < length; ++place) move(place);
    }
}

}  // namespace

void halt_for(const ProblemData& data, const Searcher& searcher, Int node) {
    const Fleet& now = searcher.now;
    const Int touched = searcher.count->touched;
    if (touched == 0) return;
    const Int slot = searcher.touched[below(searcher.rng, touched)];
    const Int length = now.route[slot].length;
    if (length == 0) return;
    const Int p = below(searcher.rng, length - 1);
    const Stop& stop = now.stop(slot, p);
    if (stop.kind == end_stop) return;
    const bool near_stop = stop.kind == customer_stop && uniform(searcher.rng) < near_stop_share;
    const View<const std::int32_t, 1> near = nearest_halts(data, near_stop ? stop.node : node);
    const Int halt = near[below(searcher.rng, near.size())];
    if (halt < 0) return;
    const Int spare = now.route.size() - 2;
    set_aside(data, now, slot, spare);
    if (!insert_stop(sequence_in(now, slot), p + 1, halt, halt_stop)) return;
    if (!refresh(data, now, slot)) put_back(data, now, slot, spare);
    locate(now, slot);
}

void drop_idle_halts(const ProblemData& data, const Searcher& searcher) {
    const Fleet& now = searcher.now;
    const Int spare = now.route.size() - 2;
    for (const Int slot : searcher.touched.first(searcher.count->touched)) {
        const Int length = now.route[slot].length;
        if (length == 0) continue;
        set_aside(data, now, slot, spare);
        close_ranks(sequence_in(now, slot), searcher.marked, searcher.scratch->moved);
        if (now.route[slot].length == length) continue;
        if (!refresh(data, now, slot)) put_back(data, now, slot, spare);
        locate(now, slot);
    }
}

Places change_halts(const ProblemData& data, Int k, View<Line, 1> line, Int length,
                    View<std::uint64_t, 1> rng) {
    const Int count = length - 2;
    Int halts = 0;
    for (Int place = 1; place <= count; ++place) halts += is_halt(data, k, line[place].node);
    if (halts > 0 && uniform(rng) < dropping_share) {
        Int number = below(rng, halts);
        Int place = 1;
        while (!is_halt(data, k, line[place].node) || number-- > 0) ++place;
        move_rest(line, place + 1, length, -1);
        return {place, place, -1};
    }
    if (2 * halts > count || length >= line.size()) return {1, 0};
    const Int beside = 1 + below(rng, count);
    const View<const std::int32_t, 1> near = nearest_halts(data, line[beside].node);
    const Int halt = near[below(rng, near.size())];
    const Int from = beside + 1 - nearby + below(rng, 2 * nearby);
    const Int place = std::clamp(from, Int{1}, count + 1);
    if (halt < 0 || !may_halt(data.halts, k, halt)) return {1, 0};
    move_rest(line, place, length, 1);
    line[place].node = halt;
    return {place, place, 1};
}

bool are_halts_in_order(const ProblemData& data, View<const Line, 1> line, Int length) {
    if (!has_halts(data)) return true;
    for (Int place = 1; place < length - 1; ++place) {
        const Int node = line[place].node;
        if (node >= data.num_depots || data.halt_after[node] < 0) continue;
        for (Int other = place + 1; other < length - 1; ++other) {
            if (line[other].node == data.halt_after[node]) return false;
        }
    }
    return true;
}

}  // namespace tandem
