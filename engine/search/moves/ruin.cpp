#include "search/moves/ruin.h"

#include "rules/company.h"
#include "search/route/lags.h"
#include "search/route/rarer.h"
#include "search/route/refresh.h"
#include "search/route/state.h"

namespace tandem {
namespace {

constexpr double average_removed = 10;
constexpr double longest_share = 0.25;     // of a long route, where longer strings are allowed
constexpr double company_share = 0.5;      // how often those who go with a customer go as well
constexpr double flight_only_share = 0.5;  // how often a drone's customer goes alone, as a string
constexpr double make_room_share = 0.5;    // how often strings are removed around one left out
constexpr double split_share = 0.5;        // how often a string spares some within
constexpr double split_more_share = 0.01;  // and each time one more of them
constexpr double whole_trip_share = 0.05;  // how often a trip is removed whole
constexpr Int longest_whole_trip = 25;     // if it has no more stops than this

// Mark a string around a customer, and the customer if a drone serves it. In place.
void mark_around(const Fleet& fleet, View<std::uint64_t, 1> rng, double longest, Int node,
                 Removed& removed) {
    const Int slot = fleet.where[node].slot;
    const Int p = stop_beside(fleet, node);
    if (fleet.where[node].position < 0) removed.mark(node);
    const Trip& trip = fleet.trip(slot, fleet.stop(slot, p).trip);
    const Int stops_there = trip.last - trip.first - 1;
    if (stops_there == 0) return;
    // A drone may have been launched at either of the depot's stops.
    const Int first = trip.first + 1, middle = std::clamp(p, first, trip.last - 1);
    draw_around(rng, longest, stops_there, middle - first, [&](Int place) {
        const Stop& stop = fleet.stop(slot, first + place);
        if (stop.kind == customer_stop) removed.mark(stop.node);
    });
}

// Mark all customers of a route. In place.
void mark_all(const Fleet& fleet, Int slot, Removed& removed) {
    for_each_served(fleet, slot, [&](Int node) { removed.mark(node); });
}

// Tell whether a slot is in a list.
bool listed(View<const Int, 1> slots, Int count, Int slot) {
    const View<const Int, 1> list = slots.first(count);
    return std::find(list.begin(), list.end(), slot) != list.end();
}

}  // namespace

StopString draw_string(View<std::uint64_t, 1> rng, double longest, Int stops) {
    Int size = 1 + Int(uniform(rng) * std::min(longest, double(stops)));
    if (uniform(rng) < whole_trip_share && stops <= longest_whole_trip) size = stops;
    size = std::min(size, stops);
    Int spared = 0;
    if (size > 1 && size < stops && uniform(rng) < split_share) {
        spared = 1;
        while (size + spared < stops && uniform(rng) < split_more_share) ++spared;
    }
    return {size, spared};
}

Int draw_gap(View<std::uint64_t, 1> rng, const StopString& string) {
    return string.spared > 0 ? 1 + below(rng, string.size - 1) : string.size;
}

double longest_string(const Searcher& searcher, Int trips) {
    const SearchCounts& count = *searcher.count;
    const double stops = double(count.customers - count.absent) / double(std::max(Int{1}, trips));
    const double allowed = std::min(searcher.value->longest, longest_share * stops);
    return std::min(stops, std::max(longest_usual_string, allowed));
}

Int draw_strings(double longest, View<std::uint64_t, 1> rng) {
    const double removed = std::max(average_removed, longest);
    return 1 + Int(uniform(rng) * (4 * removed / (1 + longest) - 1));
}

Int draw_seed(const ProblemData& data, const Searcher& searcher, View<const Int, 1> absent) {
    const Int seed = draw_customer(data, searcher.now, searcher.count->focus, searcher.rng);
    if (absent.empty() || uniform(searcher.rng) >= make_room_share) return seed;
    return absent[below(searcher.rng, absent.size())];
}

RuinSize choose(const ProblemData& data, Searcher& searcher, double longest, Removed& removed,
                View<Int, 1> touched) {
    const Fleet& fleet = searcher.now;
    const Int turn = searcher.count->turn;
    const Int before = removed.count;
    Int num_touched = 0;
    Int strings = draw_strings(longest, searcher.rng);
    const Int seed = draw_seed(data, searcher, removed.absent.first(removed.count));
    const View<const std::int32_t, 1> near = data.near[seed];
    Int node = seed;
    for (Int rank = 0; strings > 0 && node >= 0; ++rank) {
        const Int slot = fleet.where[node].slot;
        if (slot >= 0 && !removed.marked[node]) {
            Int& last_turn = searcher.hit(slot, fleet.stop(slot, stop_beside(fleet, node)).trip);
            const Int marked = removed.count;
            if (fleet.where[node].position < 0 && uniform(searcher.rng) < flight_only_share) {
                removed.mark(node);
            } else if (last_turn != turn) {
                last_turn = turn;
                mark_around(fleet, searcher.rng, longest, node, removed);
            }
            if (removed.count > marked) {
                --strings;
                if (!listed(touched, num_touched, slot)) touched.at(num_touched++) = slot;
            }
        }
        node = rank < near.size() ? near[rank] : nowhere;
    }
    if (!orders_cross(data)) return {num_touched, seed};
    for (Int index = before; index < removed.count; ++index) {
        for (const Lag& lag : lags_of(data.across, removed.absent[index])) {
            if (lag.node < 0) break;
            if (lag.node == since_plan_start) continue;
            const Int slot = fleet.where[lag.node].slot;
            if (slot < 0 || removed.marked[lag.node]) continue;
            if (uniform(searcher.rng) >= company_share) continue;
            removed.mark(lag.node);
            if (!listed(touched, num_touched, slot)) touched.at(num_touched++) = slot;
        }
    }
    return {num_touched, seed};
}

void mark_company(const ProblemData& data, const Fleet& fleet, View<std::uint64_t, 1> rng,
                  Removed& removed, Int first) {
    if (!goods_count(data)) return;
    for (Int index = first; index < removed.count; ++index) {
        const Int node = removed.absent[index], kept = kept_by_vehicle(data.goods[node]);
        if (kept == 0 || uniform(rng) >= company_share) continue;
        const Int slot = fleet.where[served_place(data, fleet, node)].slot;
        for_each_served(fleet, slot, [&](Int other) {
            if ((kept_by_vehicle(data.goods[other]) & kept) != 0) removed.mark(other);
        });
    }
}

void remove_marked(const ProblemData& data, Fleet& fleet, Int slot, Removed& removed,
                   View<Int, 1> moved) {
    Route& route = fleet.route[slot];
    const Sequence sequence = sequence_in(fleet, slot);
    keep_sorties(sequence, data.halt_after, removed);
    close_ranks(sequence, removed.marked, moved);
    if (route.length > 0 && !refresh(data, fleet, slot)) {
        mark_all(fleet, slot, removed);
        route.length = 0;
    }
    if (route.length == 0) {
        route.sorties = route.trips = 0;
        fleet.cost[slot] = 0.0;
        --fleet.used[route.type];
    }
}

}  // namespace tandem
