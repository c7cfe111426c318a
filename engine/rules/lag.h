// Lags: how long after others service begins at a customer whom the same vehicle serves behind
// them, or any vehicle: who is elsewhere then begins when that vehicle's plan says.
//
// Callers tell by `start_at` when service begins at others; `none` of whoever isn't served there.
// Lags across vehicles may be behind `since_plan_start`, by who was served before there was a plan.
#pragma once

#include "problem/instance.h"

namespace tandem {

// Instead of a customer served before; no customer, since depots come first.
constexpr Int since_plan_start = 0;

// The lags of a customer behind others; nothing where there are none, by the rows of all nodes.
inline View<const Lag, 1> lags_of(const View<const Lag, 2>& lags, Int node) {
    return lags.empty() ? View<const Lag, 1>() : lags[node];
}

// Whether a customer is to be served some time behind others.
inline bool is_behind(const View<const Lag, 2>& lags, Int node) {
    return !lags.empty() && lags(node, 0).node >= 0;
}

// Calls `visit` with a customer's lags and when service began at each other, if it did.
template <class StartAt, class Visit>
void for_each_lag(View<const Lag, 1> lags, const StartAt& start_at, const Visit& visit) {
    for (const Lag& lag : lags) {
        if (lag.node < 0) return;
        const Int start = lag.node == since_plan_start ? 0 : start_at(lag.node);
        if (start != none) visit(lag, start);
    }
}

// When service may begin at the soonest; `none` if nobody is served before.
template <class StartAt>
Int soonest_behind(View<const Lag, 1> lags, const StartAt& start_at) {
    Int soonest = none;
    for_each_lag(lags, start_at, [&](const Lag& lag, Int start) {
        soonest = std::max(soonest, start + lag.least);
    });
    return soonest;
}

// Whether service may begin at an instant.
template <class StartAt>
bool keeps_lags(View<const Lag, 1> lags, Int begun, const StartAt& start_at) {
    bool kept = true;
    for_each_lag(lags, start_at, [&](const Lag& lag, Int start) {
        kept = kept && lag.least <= begun - start && begun - start <= lag.most;
    });
    return kept;
}

// By how much too late service begins at an instant; at most 0 if it doesn't.
template <class StartAt>
Int excess_of_lags(View<const Lag, 1> lags, Int begun, const StartAt& start_at) {
    Int most = none;
    for_each_lag(lags, start_at, [&](const Lag& lag, Int start) {
        most = std::max(most, begun - start - lag.most);
    });
    return most;
}

// How many are left out for good if a customer is served before them, where nobody else serves
// them; `is_served` tells who was.
template <class IsServed>
Int num_forestalled(View<const Lag, 1> lags, const IsServed& is_served) {
    return std::ranges::count_if(
        lags, [&](const Lag& lag) { return lag.node >= 0 && !is_served(lag.node); });
}

// Until when service has to begin at a customer, for that of one behind him to begin at `start`;
// `far` if that is no matter.
inline Int latest_before(View<const Lag, 1> lags, Int node, Int start) {
    Int latest = far;
    for (const Lag& lag : lags) {
        if (lag.node == node) latest = std::min(latest, start - lag.least);
    }
    return latest;
}

// Whether a customer is to be served some time behind or before others, whoever serves them.
inline bool is_bound(const View<const Lag, 2>& across, Int node) { return is_behind(across, node); }

// From when to when service may begin at a customer, by those whom other vehicles serve.
template <class StartAt>
Span span_by(View<const Lag, 1> across, const StartAt& start_at) {
    Span span{none, far};
    for_each_lag(across, start_at, [&](const Lag& lag, Int start) {
        span.soonest = std::max(span.soonest, start + lag.least);
        span.latest = std::min(span.latest, start + lag.most);
    });
    return span;
}

}  // namespace tandem
