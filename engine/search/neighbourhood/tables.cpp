#include "search/neighbourhood/tables.h"

#include <vector>

#include "guard.h"

namespace tandem {
namespace {

// Write all customers in their order; from where all neighbours were met, it begins anew.
void walk(View<const std::int32_t, 2> near, Int num_depots, View<Int, 1> node) {
    std::vector<bool> was_met(std::size_t(near.size()));
    const auto is_new = [&](Int at) { return at >= 0 && !was_met[std::size_t(at)]; };
    Int number = num_depots;
    for (Int start = num_depots; start < near.size(); ++start) {
        for (Int at = start; is_new(at);) {
            was_met[std::size_t(at)] = true;
            node[number++] = at;
            const View<const std::int32_t, 1> others = near[at];
            const auto next = std::find_if(others.begin(), others.end(), is_new);
            at = next == others.end() ? -1 : *next;
        }
    }
}

// Write the legs from nodes, the search's number `first` and behind: (row, column, 2).
template <class Whole>
void write_legs(View<const Whole, 2> duration, View<const Whole, 2> distance,
                View<const Int, 1> node, Int first, View<Whole, 3> legs) {
    for (Int row = 0; row < legs.size(); ++row) {
        const View<const Whole, 1> durations = duration[node[first + row]];
        const View<const Whole, 1> distances = distance[node[first + row]];
        Whole* leg = legs[row].data();
        for (const Int to : node) {
            *leg++ = durations[to];
            *leg++ = distances[to];
        }
    }
}

// When each node opens, how long service takes, and when it closes, in ms.
struct NodeTimes {
    View<const double, 1> earliest, service, latest;

    double detour_behind(Int drive, Int one, Int other) const {
        return detour(drive, earliest[one] + service[one], latest[one] + service[one],
                      earliest[other], latest[other]);
    }
};

// Write how badly neighbours `other` (row, rank) follow or precede customers: `first` and those
// behind, `there` and `back` the drives to and from others.
void write_misfit(View<const Int, 2> there, View<const Int, 2> back, View<const Int, 2> other,
                  Int first, const NodeTimes& times, View<double, 2> weight) {
    for (Int row = 0; row < other.size(); ++row) {
        const Int one = first + row;
        for (Int rank = 0; rank < other.shape(1); ++rank) {
            weight(row, rank) =
                std::min(times.detour_behind(there(row, rank), one, other(row, rank)),
                         times.detour_behind(back(row, rank), other(row, rank), one));
        }
    }
}

}  // namespace
}  // namespace tandem

extern "C" int tandem_walk(const tandem_i32_2d* near, int64_t num_depots,
                           const tandem_i64_1d* node) {
    return tandem::guarded([&] { tandem::walk(*near, num_depots, *node); });
}

extern "C" int tandem_write_legs(const tandem_i64_2d* duration, const tandem_i64_2d* distance,
                                 const tandem_i64_1d* node, int64_t first,
                                 const tandem_i64_3d* legs) {
    return tandem::guarded(
        [&] { tandem::write_legs<std::int64_t>(*duration, *distance, *node, first, *legs); });
}

extern "C" int tandem_write_narrow_legs(const tandem_i32_2d* duration,
                                        const tandem_i32_2d* distance, const tandem_i64_1d* node,
                                        int64_t first, const tandem_i32_3d* legs) {
    return tandem::guarded(
        [&] { tandem::write_legs<std::int32_t>(*duration, *distance, *node, first, *legs); });
}

extern "C" int tandem_write_misfit(const tandem_i64_2d* there, const tandem_i64_2d* back,
                                   const tandem_i64_2d* other, int64_t first,
                                   const tandem_f64_1d* earliest, const tandem_f64_1d* service,
                                   const tandem_f64_1d* latest, const tandem_f64_2d* weight) {
    return tandem::guarded([&] {
        tandem::write_misfit(*there, *back, *other, first, {*earliest, *service, *latest}, *weight);
    });
}
