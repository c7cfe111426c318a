// What a plan costs as a whole: its last end, how unequally its vehicles share the work, and how
// many are too few.
#pragma once

#include <algorithm>

#include "problem/instance.h"

namespace tandem {

using Fairness = tandem_fairness;

// Of what a vehicle's share of the work is told.
enum class Measure : Int { duration, stops, load, distance };

inline Measure measure_of(const Fairness& fairness) { return Measure{fairness.measure}; }

// Whether anything of the plan as a whole costs.
inline bool is_fairness_priced(const Fairness& fairness) {
    return fairness.makespan > 0.0 || fairness.balance > 0.0 || fairness.min_vehicles > 0;
}

// What is known of all vehicles used together: how many, the sum of their shares and that of the
// squares, and when the last ends.
struct Shares {
    double count, sum, squares;
    Int latest;
};

// What vehicles share that are used in any case.
inline Shares shares_before(const Fairness& fairness) {
    return {fairness.used, fairness.sum, fairness.squares, fairness.latest};
}

// What a vehicle of a type has done before of the work.
inline double share_before(const VehicleType& type) {
    return static_cast<double>(std::max(Int{0}, type.share_before));
}

// All with one vehicle more.
inline Shares with(const Shares& shares, double share, Int end) {
    return {shares.count + 1.0, shares.sum + share, shares.squares + share * share,
            std::max(shares.latest, end)};
}

// All where a vehicle's share grows by so much, and it ends at `end`.
inline Shares with_more(const Shares& shares, double share, double more, Int end) {
    return {shares.count, shares.sum + more, shares.squares + more * (2.0 * share + more),
            std::max(shares.latest, end)};
}

// All with a route of a type, whose vehicle may be used in any case.
inline Shares with_route(const Shares& shares, const VehicleType& type, double share, Int end) {
    return type.share_before < 0 ? with(shares, share, end)
                                 : with_more(shares, share_before(type), share, end);
}

// The sum of the squares of all differences from the mean, by the mean.
inline double imbalance(const Shares& shares) {
    if (shares.sum <= 0.0) return 0.0;
    return std::max(0.0, shares.count * shares.squares / shares.sum - shares.sum);
}

// How many vehicles fewer are used than have to be.
inline double too_few(const Fairness& fairness, const Shares& shares) {
    return std::max(0.0, static_cast<double>(fairness.min_vehicles) - shares.count);
}

// What a plan costs as a whole.
inline double fairness_cost(const Fairness& fairness, const Shares& shares) {
    return fairness.makespan * static_cast<double>(shares.latest) +
           fairness.balance * imbalance(shares) + fairness.too_few * too_few(fairness, shares);
}

}  // namespace tandem
