// What a plan costs as a whole: its last end, how unequally its vehicles share the work, and how
// many are too few.
#pragma once

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

inline double square(Int value) { return double(value) * double(value); }

// What is known of all vehicles used together: how many, the sum of their shares and that of the
// squares, and when the last ends.
struct Shares {
    double count, sum, squares;
    Int latest;
    double ends = 0.0;  // the sum of the squares of all ends
};

// What vehicles share that are used in any case.
inline Shares shares_before(const Fairness& fairness) {
    return {fairness.used, fairness.sum, fairness.squares, fairness.latest};
}

// What a vehicle of a type has done before of the work.
inline double share_before(const VehicleType& type) {
    return double(std::max(Int{0}, type.share_before));
}

// All with one vehicle more.
inline Shares with(const Shares& shares, double share, Int end) {
    return {shares.count + 1.0, shares.sum + share, shares.squares + share * share,
            std::max(shares.latest, end), shares.ends + square(end)};
}

// When a vehicle ends, before something and after.
struct Ends {
    Int before, after;
};

// All where a vehicle's share grows by so much, and it ends later.
inline Shares with_more(const Shares& shares, double share, double more, Ends end) {
    return {shares.count, shares.sum + more, shares.squares + more * (2.0 * share + more),
            std::max(shares.latest, end.after),
            shares.ends + square(end.after) - square(end.before)};
}

// All with a route of a type, whose vehicle may be used in any case.
inline Shares with_route(const Shares& shares, const VehicleType& type, double share, Int end) {
    return type.share_before < 0 ? with(shares, share, end)
                                 : with_more(shares, share_before(type), share, {0, end});
}

// The sum of the squares of all differences from the mean, by the mean.
inline double imbalance(const Shares& shares) {
    if (shares.sum <= 0.0) return 0.0;
    return std::max(0.0, shares.count * shares.squares / shares.sum - shares.sum);
}

// How many vehicles fewer are used than have to be.
inline double too_few(const Fairness& fairness, const Shares& shares) {
    return std::max(0.0, double(fairness.min_vehicles) - shares.count);
}

// By how much at most what tells plans apart counts that end at the same time, by that.
constexpr double tie_share = 0.02;

// What tells such plans apart: the mean of the squares of all ends, by the last.
inline double tie_of(const Shares& shares) {
    if (shares.latest <= 0) return 0.0;
    const double vehicles = std::max(1.0, shares.count);
    return tie_share * shares.ends / (vehicles * double(shares.latest));
}

// What a plan costs as a whole.
inline double fairness_cost(const Fairness& fairness, const Shares& shares) {
    return fairness.makespan * (double(shares.latest) + tie_of(shares)) +
           fairness.balance * imbalance(shares) + fairness.too_few * too_few(fairness, shares);
}

}  // namespace tandem
