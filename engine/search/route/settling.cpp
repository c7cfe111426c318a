#include "search/route/settling.h"

#include <algorithm>

#include "rules/breaks.h"
#include "rules/clock.h"
#include "rules/driving.h"
#include "rules/hours.h"
#include "rules/shift.h"
#include "rules/start.h"
#include "rules/window.h"
#include "search/route/breaks.h"
#include "search/route/freshness.h"
#include "search/route/lags.h"
#include "search/route/rarer.h"
#include "search/route/resting.h"
#include "search/route/routes.h"

namespace tandem {
namespace {

// Attempts to find out how late a trip may begin whose drones come in another order if it waits.
constexpr Int halvings = 6;

// Attempts likewise where breaks may then be due, or not any more.
constexpr Int halvings_with_breaks = 20;

// Attempts likewise, to the millisecond, where customers may then be served too soon behind others.
constexpr Int halvings_with_lags = 40;

// How often a trip with breaks or rests is held back again since it has lost some.
constexpr Int settled_again = 3;

// Tell whether a drone is launched or recovered at a stop or in the air meanwhile.
bool has_sortie(View<const Sortie, 1> sorties, Int p) {
    return std::any_of(sorties.begin(), sorties.end(), [&](const Sortie& sortie) {
        return sortie.launch <= p && p <= sortie.recovery;
    });
}

// Return the latest start of a trip that costs nothing, by each stop's last arrival.
//
// Where lags count, stops note by when service may begin.
Int latest_by_stops(const ProblemData& data, const Route& route, View<Stop, 1> stops,
                    View<const Sortie, 1> sorties, Int first) {
    const Int k = route.type, last = route.length - 1;
    const VehicleType& type = data.type[k];
    const NodeTable places = data.place.by_truck(type);
    Int leave = far;
    for (Int p = last; p >= first; --p) {
        Stop& stop = stops[p];
        const bool plain = !has_sortie(sorties.first(route.sorties), p);
        Int arrival = stop.arrival;
        if (p == last && plain) leave = stop.leave;
        if (lags_count(data) && stop.kind == customer_stop) {
            stop.free_start = stop.start;
            if (plain) {
                const Int service = places[stop.node].service_duration();
                leave = std::min(leave, latest_leave(data, route, stops, sorties, p, service));
                stop.free_start = leave - service;
            }
        }
        if (plain) {
            arrival = has_window(stop) ? places[stop.node].latest_free_arrival(stop.arrival, leave)
                                       : std::min(leave, leaves_by(type, places, stop.node));
        }
        leave = arrival;
        if (p == first) break;
        const Stop& before = stops[p - 1];
        if (stop.kind == start_stop) {
            leave = arrival - before.gap;
        } else {
            arrival -= setup_beside(type, data.setup, before.node, stop.node);
            const auto back = [&](Int time) {
                return leg_start(type, data.profile_time[k], data.profile_factor[k], before.gap,
                                 time);
            };
            // Who leaves later may rest while it is slow, or needn't.
            leave = follows_driver(type) ? arrival - before.gap
                    : has_breaks(type)   ? departure_before(type, Rests(before.rests),
                                                            begin_of(type, stops), arrival, back)
                                         : back(arrival);
        }
    }
    return leave;
}

// Return the latest start of the trip that begins at stop `first` which costs nothing.
//
// If all is retimed, either by moving the whole trip within the windows that are met, or stop by
// stop, which may reach others but leaves blocks with sorties as they are.
Int latest_hold(const ProblemData& data, const Route& route, View<Stop, 1> stops,
                View<const Sortie, 1> sorties, Int first) {
    Int hold = none;
    if (is_steady(data.type[route.type]) && !has_breaks(data.type[route.type]) &&
        (!lags_count(data) || route.sorties > 0)) {
        const Int base = stops[first].before;
        hold = route.end - (route.cum - base);
        for (Int p = first; p < route.length; p = stops[p].last + 1) {
            hold = std::min(hold, stops[p].dep - (stops[p].before - base));
        }
    }
    if (data.evaluation[route.type].retimed) {
        hold = std::max(hold, latest_by_stops(data, route, stops, sorties, first));
    }
    // Where drones fly from is left as it is by that; without a break on the way all may be later.
    const VehicleType& type = data.type[route.type];
    if (has_breaks(type) && route.sorties > 0 && !any_rest(type, route)) {
        hold = std::max(hold, route.end);
    }
    return hold;
}

// Looks for the latest start of a trip that costs nothing: up to one that is known by bisection, or
// by how much too late a later one ends.
class LatestStart {
public:
    LatestStart(Int before, Int soonest, Int latest, bool by_end)
        : found_(before), soonest_(soonest), failed_(latest), tried_(latest), by_end_(by_end) {}

    Int found() const { return found_; }
    Int tried() const { return tried_; }
    bool is_known() const { return by_end_ && failed_ - std::max(found_, soonest_) <= 1; }

    // Note whether it may begin as was tried, or ends `late`, if that is known and all it breaks.
    void note(bool may, Int late) {
        (may ? found_ : failed_) = tried_;
        const Int least = std::max(found_, soonest_);
        if (by_end_ && may && is_exact_) {
            tried_ = found_ + 1;
            is_exact_ = false;
        } else if (by_end_ && !may && late > 0 && tried_ - late > least) {
            // Mostly it ends by as much too late as it begins.
            tried_ -= late;
            is_exact_ = true;
        } else {
            tried_ = (least + failed_) >> 1;
            is_exact_ = false;
        }
    }

private:
    Int found_, soonest_, failed_, tried_;
    bool by_end_;
    bool is_exact_ = false;
};

// Let a trip of a timed route whose driver is followed begin as late as `hold` at most, where it
// ends no later. In place; false if a rule is broken.
//
// Later beginnings are tried with the rests that are placed, and that which is chosen with others.
bool settle_followed(const ProblemData& data, Route& route, View<Stop, 1> stops, Stop& stop,
                     View<Sortie, 1> sorties, Int hold) {
    const Int end = route.end, before = stop.hold;
    const Int soonest = std::max({stop.arrival, stop.release, stop.hold});
    Int found = before, failed = hold, tried = hold;
    for (Int attempt = 0; attempt <= halvings_with_breaks && found != hold; ++attempt) {
        stop.hold = tried;
        const bool done = drive_as_placed(data, route, stops, sorties) && route.end <= end;
        (done ? found : failed) = tried;
        tried = (std::max(found, soonest) + failed) >> 1;
    }
    stop.hold = found;
    if (drive_forward(data, route, stops, sorties) && route.end <= end) return true;
    stop.hold = before;
    return drive_forward(data, route, stops, sorties);
}

}  // namespace

void clear_holds(const Route& route, View<Stop, 1> stops, View<const Trip, 1> trips) {
    for (const Trip& trip : trips.first(route.trips)) stops[trip.first].hold = none;
}

bool settle(const ProblemData& data, Route& route, View<Stop, 1> stops, View<const Trip, 1> trips,
            View<Sortie, 1> sorties) {
    const bool resting = rests_in_time(data.type[route.type]);
    const bool may_lose = resting || has_driving_rules(data.type[route.type]);
    Int index = 0, again = may_lose ? settled_again : 0;
    const Int most = lags_count(data) ? halvings_with_lags
                     : resting        ? halvings_with_breaks
                                      : halvings;
    while (index < route.trips) {
        const Trip& trip = trips[index++];
        Stop& stop = stops[trip.first];
        const Int hold = latest_hold(data, route, stops, sorties, trip.first);
        const Int soonest = std::max({stop.arrival, stop.release, stop.hold});
        if (hold <= soonest) continue;
        if (any_rest(data.type[route.type], route) && follows_driver(data.type[route.type])) {
            const Int before = stop.hold;
            if (!settle_followed(data, route, stops, stop, sorties, hold)) return false;
            if (stop.hold > before && again-- > 0) --index;
            continue;
        }
        const Int end = route.end, before = stop.hold;
        Int late = 0;
        const auto may_begin = [&](Int begin) {
            stop.hold = begin;
            late = 0;
            if (!drive_forward(data, route, stops, sorties)) return false;
            late = route.end - end;
            return late <= 0 && !any_too_long(data, route, stops, trips, sorties);
        };
        LatestStart start(before, soonest, hold, resting && route.sorties > 0);
        // Nothing is known of the latest then; mostly it can't be later at all.
        const bool in_vain = hold >= end && resting && !may_begin(soonest + 1);
        for (Int attempt = 0; attempt <= most && start.found() != hold && !in_vain; ++attempt) {
            if (start.is_known() || (may_lose && data.deadline.passed())) break;
            // If not, drones in another order of arrival took longer, or breaks that are due.
            const bool may = may_begin(start.tried());
            start.note(may, late);
        }
        const Int found = start.found();
        if (stop.hold != found) {
            stop.hold = found;
            if (!drive_forward(data, route, stops, sorties)) return false;
        }
        // Without some breaks it may begin even later.
        if (found > before && again-- > 0) --index;
    }
    return true;
}

}  // namespace tandem
