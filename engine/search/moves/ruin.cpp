#include "search/moves/ruin.h"

#include <algorithm>

#include "randomness.h"
#include "search/route/edit.h"
#include "search/route/refresh.h"
#include "search/route/state.h"

namespace tandem {
namespace {

constexpr double average_removed = 10;
constexpr double longest_share = 0.25;     // of a long route, where longer strings are allowed
constexpr double flight_only_share = 0.5;  // how often a drone's customer goes alone, as a string

// Mark a customer for removal. In place; return how many there are.
Int mark(View<bool, 1> marked, View<Int, 1> absent, Int num_absent, Int node) {
    if (marked[node]) return num_absent;
    marked[node] = true;
    absent[num_absent] = node;
    return num_absent + 1;
}

// Mark `size` adjacent stops of a trip around stop `p`, or all but some within. As `mark`.
Int mark_string(const Fleet& fleet, Int slot, Int index, Int p, Int size, View<bool, 1> marked,
                View<Int, 1> absent, Int num_absent, View<std::uint64_t, 1> rng) {
    const Trip& trip = fleet.trip(slot, index);
    const Int stops_there = trip.last - trip.first - 1;
    Int spared = 0;
    if (size > 1 && size < stops_there && uniform(rng) < split_share) {
        spared = 1;
        while (size + spared < stops_there && uniform(rng) < split_more_share) ++spared;
    }
    const Int span = size + spared;
    const Int lowest = std::max(trip.first + 1, p - span + 1);
    const Int highest = std::min(p, trip.last - span);
    const Int begin = lowest + below(rng, highest - lowest + 1);
    const Int gap = spared > 0 ? 1 + below(rng, size - 1) : size;
    for (Int offset = 0; offset < span; ++offset) {
        if (offset >= gap && offset < gap + spared) continue;
        const Stop& stop = fleet.stop(slot, begin + offset);
        if (stop.kind == customer_stop) num_absent = mark(marked, absent, num_absent, stop.node);
    }
    return num_absent;
}

// Mark a string around a customer, and the customer if a drone serves it. As `mark`.
Int mark_around(const Fleet& fleet, Int node, double longest, View<bool, 1> marked,
                View<Int, 1> absent, Int num_absent, View<std::uint64_t, 1> rng) {
    const Int slot = fleet.where[node].slot;
    const Int p = stop_beside(fleet, node);
    if (fleet.where[node].position < 0) num_absent = mark(marked, absent, num_absent, node);
    const Int index = fleet.stop(slot, p).trip;
    const Trip& trip = fleet.trip(slot, index);
    const Int stops_there = trip.last - trip.first - 1;
    if (stops_there == 0) return num_absent;
    const double most = std::min(longest, static_cast<double>(stops_there));
    Int size = 1 + static_cast<Int>(uniform(rng) * most);
    if (uniform(rng) < whole_trip_share && stops_there <= longest_whole_trip) size = stops_there;
    // A drone may have been launched at either of the depot's stops.
    const Int middle = std::min(std::max(p, trip.first + 1), trip.last - 1);
    return mark_string(fleet, slot, index, middle, std::min(size, stops_there), marked, absent,
                       num_absent, rng);
}

// Mark all customers of a route. As `mark`.
Int mark_all(const Fleet& fleet, Int slot, View<bool, 1> marked, View<Int, 1> absent,
             Int num_absent) {
    const Route& route = fleet.route[slot];
    for (const Stop& stop : fleet.stop[slot].first(route.length)) {
        if (stop.kind == customer_stop) num_absent = mark(marked, absent, num_absent, stop.node);
    }
    for (const Sortie& sortie : fleet.sortie[slot].first(route.sorties)) {
        for (Int visit = 0; visit < sortie.count; ++visit) {
            num_absent = mark(marked, absent, num_absent, sortie.nodes[visit]);
        }
    }
    return num_absent;
}

// Tell whether a slot is in a list.
bool listed(View<const Int, 1> slots, Int count, Int slot) {
    const View<const Int, 1> list = slots.first(count);
    return std::find(list.begin(), list.end(), slot) != list.end();
}

}  // namespace

double longest_string(const Searcher& searcher, Int trips) {
    const SearchCounts& count = *searcher.count;
    const double stops = static_cast<double>(count.customers - count.absent) /
                         static_cast<double>(std::max(Int{1}, trips));
    const double allowed = std::min(searcher.value->longest, longest_share * stops);
    return std::min(stops, std::max(longest_usual_string, allowed));
}

Int draw_strings(double longest, View<std::uint64_t, 1> rng) {
    const double removed = std::max(average_removed, longest);
    return 1 + static_cast<Int>(uniform(rng) * (4 * removed / (1 + longest) - 1));
}

Chosen choose(const ProblemData& data, Searcher& searcher, double longest, View<Int, 1> absent,
              Int num_absent, View<Int, 1> touched) {
    const Fleet& fleet = searcher.now;
    const Int turn = searcher.count->turn;
    Int num_touched = 0;
    Int strings = draw_strings(longest, searcher.rng);
    Int seed = draw_customer(data, fleet, searcher.count->focus, searcher.rng);
    if (num_absent > 0 && uniform(searcher.rng) < make_room_share) {
        seed = absent[below(searcher.rng, num_absent)];
    }
    const View<const std::int32_t, 1> near = data.near[seed];
    Int node = seed;
    for (Int rank = 0; strings > 0 && node >= 0; ++rank) {
        const Int slot = fleet.where[node].slot;
        if (slot >= 0 && !searcher.marked[node]) {
            Int& last_turn = searcher.hit(slot, fleet.stop(slot, stop_beside(fleet, node)).trip);
            const Int before = num_absent;
            if (fleet.where[node].position < 0 && uniform(searcher.rng) < flight_only_share) {
                num_absent = mark(searcher.marked, absent, num_absent, node);
            } else if (last_turn != turn) {
                last_turn = turn;
                num_absent = mark_around(fleet, node, longest, searcher.marked, absent, num_absent,
                                         searcher.rng);
            }
            if (num_absent > before) {
                --strings;
                if (!listed(touched, num_touched, slot)) touched[num_touched++] = slot;
            }
        }
        node = rank < near.size() ? near[rank] : nowhere;
    }
    return {num_absent, num_touched, seed};
}

Int remove_marked(const ProblemData& data, Fleet& fleet, Int slot, View<bool, 1> marked,
                  View<Int, 1> absent, Int num_absent, View<Int, 1> moved) {
    Route& route = fleet.route[slot];
    const Sequence sequence = sequence_in(fleet, slot);
    num_absent = keep_sorties(sequence, data.halt_after, marked, absent, num_absent);
    close_ranks(sequence, marked, moved);
    if (route.length > 0 && !refresh(data, fleet, slot)) {
        num_absent = mark_all(fleet, slot, marked, absent, num_absent);
        route.length = 0;
    }
    if (route.length == 0) {
        route.sorties = route.trips = 0;
        fleet.cost[slot] = 0.0;
        --fleet.used[route.type];
    }
    return num_absent;
}

}  // namespace tandem
