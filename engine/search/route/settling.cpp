#include "search/route/freshness.h"
#include "search/route/pricing.h"
#include "search/route/rests.h"

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
    return std::ranges::any_of(
        sorties, [&](const Sortie& sortie) { return sortie.launch <= p && p <= sortie.recovery; });
}

// Return the latest start of a trip that costs nothing, by each stop's last arrival.
//
// Where lags count, stops note by when service may begin.
Int latest_by_stops(const ProblemData& data, const Tour& tour, Int first) {
    const auto& [route, stops, trips, sorties] = tour;
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
                leave = std::min(leave, latest_leave(data, tour, p, service));
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
            leave = follows_driver(type) && !is_steady(type) ? arrival - before.gap
                    : has_breaks(type) ? departure_before(type, Rests(before.rests),
                                                          begin_of(type, stops), arrival, back)
                                       : back(arrival);
        }
    }
    return leave;
}

// Return by when the trip that begins at a stop has to begin for a route to end as soon as it does,
// as far as its truck tells.
Int latest_by_end(const ProblemData& data, const Tour& tour, Int first) {
    const auto& [route, stops, trips, sorties] = tour;
    const VehicleType& type = data.type[route.type];
    const NodeTable places = data.place.by_truck(type), own = data.place[0];
    Int latest = route.end;
    for (Int p = route.length - 1; p > first; --p) {
        const Stop& stop = stops[p];
        if (stop.kind == customer_stop) latest -= places[stop.node].service_duration();
        if (has_window(stop)) latest = std::min(latest, own[stop.node].latest_allowed());
        latest -= stops[p - 1].gap - resting_in_gap(type, stops[p - 1]);
    }
    return latest;
}

// Return the latest start of the trip that begins at stop `first` which costs nothing.
//
// If all is retimed, either by moving the whole trip within the windows that are met, or stop by
// stop, which may reach others but leaves blocks with sorties as they are.
Int latest_hold(const ProblemData& data, const Tour& tour, Int first) {
    const auto& [route, stops, trips, sorties] = tour;
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
        hold = std::max(hold, latest_by_stops(data, tour, first));
    }
    // Where drones fly from is left as it is by that; without a break on the way all may be later.
    const VehicleType& type = data.type[route.type];
    if (has_breaks(type) && route.sorties > 0 && !any_rest(type, route)) {
        hold = std::max(hold, latest_by_end(data, tour, first));
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
    bool is_latest() const { return found_ == failed_; }

    // Try some at most. `late_by` tells by how much too late the route ends if the trip begins at
    // an instant, at most 0 if it may; `far` if it breaks a rule. `is_over` tells when to end.
    template <class LateBy, class IsOver>
    void run(Int most, const LateBy& late_by, const IsOver& is_over) {
        for (Int attempt = 0; attempt <= most && !is_known() && !is_over(); ++attempt) {
            note(late_by(tried_));
        }
    }

private:
    bool is_known() const {
        return is_latest() || (by_end_ && failed_ - std::max(found_, soonest_) <= 1);
    }

    void note(Int late) {
        const bool may = late <= 0;
        (may ? found_ : failed_) = tried_;
        const Int least = std::max(found_, soonest_);
        if (by_end_ && may && is_exact_) {
            tried_ = found_ + 1;
            is_exact_ = false;
        } else if (by_end_ && !may && tried_ - late > least) {
            // Mostly it ends by as much too late as it begins.
            tried_ -= late;
            is_exact_ = true;
        } else {
            tried_ = (least + failed_) >> 1;
            is_exact_ = false;
        }
    }

    Int found_, soonest_, failed_, tried_;
    bool by_end_;
    bool is_exact_ = false;
};

// Lets the trips of a timed route begin as late as costs nothing.
class Settling {
public:
    Settling(const ProblemData& data, const Tour& tour) : data_(data), tour_(tour) {}

    // False if a rule is broken.
    bool run() {
        Int again = may_lose_ ? settled_again : 0;
        for (Int index = 0; index < route_.trips;) {
            Stop& stop = stops_[tour_.trips[index].first];
            const Int before = stop.hold;
            const Int latest = latest_hold(data_, tour_, tour_.trips[index].first);
            if (latest > soonest(stop) && !hold_back(stop, latest)) return false;
            // Without some breaks it may begin even later.
            if (stop.hold == before || again-- <= 0) ++index;
        }
        return true;
    }

private:
    static Int soonest(const Stop& stop) {
        return std::max({stop.arrival, stop.release, stop.hold});
    }

    // Let a trip begin as late as that at most.
    //
    // Later beginnings are tried with the breaks as they are placed, then with others.
    bool hold_back(Stop& stop, Int latest) {
        const Int end = route_.end, before = stop.hold, first = soonest(stop);
        const auto is_over = [&] { return may_lose_ && data_.deadline.passed(); };
        const auto late_by = [&](const auto drive) {
            return [&, drive](Int begin) { return begun_at(stop, begin, drive, end); };
        };
        const auto anew = late_by(drive_forward);
        const bool keeps = keeps_placed();
        const bool restores = keeps && !has_driving_rules(type_);
        const PlacedBreaks placed = restores ? PlacedBreaks(stops_, none) : PlacedBreaks();
        const auto tried = late_by(keeps ? drive_as_placed : drive_forward);
        LatestStart start(before, first, latest, by_end_);
        // Beside drones it mostly may begin either much later or not at all.
        if (!by_end_ || anew(first + 1) <= 0) {
            start.run(most_, tried, is_over);
            // Where it may be later, a break may be due no more if it is much later.
            const Int next = std::max(start.found(), first) + 1;
            const auto may_be_later = [&] {
                if (anew(next) <= 0) return true;
                const Int late = anew(latest);
                return latest - late > next && anew(latest - late) <= 0;
            };
            if (keeps && !start.is_latest() && may_be_later()) {
                start = LatestStart(start.found(), next - 1, latest, by_end_);
                start.run(most_, anew, is_over);
            }
        }
        if (restores && start.found() == before) {
            stop.hold = before;
            placed.write(stops_);
            return drive_as_placed(data_, tour_);
        }
        if (stop.hold == start.found() || anew(start.found()) <= 0) return true;
        // Drones in another order of arrival took longer, or breaks that are due.
        return anew(before) < far;
    }

    // Let a trip begin at an instant. Returns how much later than `end` the route ends, at most 0
    // if it may; `far` if it breaks a rule.
    template <class Drive>
    Int begun_at(Stop& stop, Int begin, const Drive& drive, Int end) {
        stop.hold = begin;
        if (!drive(data_, tour_)) return far;
        const Int late = route_.end - end;
        return late > 0 || !any_too_long(data_, tour_) ? late : far;
    }

    // Tell whether there are breaks that may be kept where the route begins later, if it ends no
    // later.
    bool keeps_placed() const {
        return resting_ && route_.placed == breaks_by_end &&
               (!has_driving_rules(type_) || (follows_driver(type_) && any_rest(type_, route_))) &&
               std::ranges::any_of(stops_, [](const Stop& stop) { return stop.rests != 0; });
    }

    const ProblemData& data_;
    const Tour& tour_;
    const Route& route_ = tour_.route;
    const View<Stop, 1> stops_ = tour_.stops.first(route_.length);
    const VehicleType& type_ = data_.type[route_.type];
    const bool resting_ = rests_in_time(type_);
    const bool may_lose_ = may_pause(type_);
    const bool by_end_ = resting_ && route_.sorties > 0;
    const Int most_ = lags_count(data_) ? halvings_with_lags
                      : resting_        ? halvings_with_breaks
                                        : halvings;
};

}  // namespace

void clear_holds(const Tour& tour) {
    for (const Trip& trip : tour.trips.first(tour.route.trips)) tour.stops[trip.first].hold = none;
}

bool settle(const ProblemData& data, const Tour& tour) { return Settling(data, tour).run(); }

}  // namespace tandem
