#include "search/insertion/proposal.h"

#include "rules/hours.h"
#include "search/route/freshness.h"
#include "search/route/stop_loads.h"

namespace tandem {
namespace {

// Follows a route on which no drone flies from stop `p` to its end; returns what lateness costs
// more. In place.
double follow(const ProblemData& data, const Route& route, View<const Stop, 1> stops, Int p,
              PaidFront& front) {
    const Int last = route.length - 1;
    const VehicleType& type = data.type[route.type];
    const NodeTable places = data.place.by_truck(type);
    double cost = 0.0;
    for (Int q = p; q <= last; ++q) {
        const Stop& stop = stops[q];
        if (has_window(stop)) {
            cost += window_cost(data, stop.node, front.time) - stop.window_cost;
            front.serve(places[stop.node]);
        } else if (stop.kind == start_stop) {
            front.time = std::max(front.time, stop.release);
        } else {
            front.time = let_in(type, places, stop.node, front.time);
        }
        if (q < last) front.drive(stop.gap);
    }
    return cost;
}

}  // namespace

void RarerRules::drive(const OnTrip& on, Int behind, Int to, const Leg& leg) {
    if (limits_legs(on.type)) {
        legs_ = legs_ + leg_between(on.data, on.type, here(on, behind), to);
    }
    if (loads_cost(on.data, on.route.type)) {
        const Int load = on.fleet.stop_load(on.slot, 0, behind).aboard[0] + on.type.carried;
        carried_ += double(load + aboard_) * double(leg.distance);
    }
}

void RarerRules::serve(const OnTrip& on, const Whereabouts& at, const Newcomer& newcomer,
                       const Leg& out) {
    const Int node = newcomer.node;
    drive(on, at.behind, node, out);
    if (loads_cost(on.data, on.route.type)) {
        const Int driven = on.fleet.stop_load(on.slot, 0, at.behind).driven + at.further;
        carried_ +=
            double(delivered_of(on.data.amount, node, 0)[0]) * double(driven + out.distance);
        aboard_ += picked_of(on.data.amount, node, 0)[0];
    }
    if (bounds_trips(on.type)) {
        inserted_[std::size_t(count_++)] = {at.behind, node, out.duration, 0};
    }
    if (on.evaluation.priced) {
        windows_ += window_cost(on.data, node, at.front.time + out.duration);
    }
    if (time_aboard_counts(on.data)) {
        const Int departure = departure_of(on.data, tour_of(on.fleet, on.slot), on.trip.first);
        const Int start = newcomer.place.start_of_service(at.front.time + out.duration);
        is_fresh_ =
            is_fresh_ && excess_aboard(on.data.max_time_aboard, node, departure, start) <= 0;
    }
    is_near_ = is_near_ && reaches(on.data, on.route.type, on.stops, on.trip, node);
    here_ = node;
}

void RarerRules::pass(const OnTrip& on, const Whereabouts& at, const Leg& leg) {
    const Stop &stop = on.stops[at.behind], &next = on.stops[at.behind + 1];
    drive(on, at.behind, next.node, leg);
    if (limits_legs(on.type)) {
        legs_ = legs_ - leg_between(on.data, on.type, stop.node, next.node);
    }
    if (loads_cost(on.data, on.route.type)) {
        const View<const StopLoad, 1> stop_loads = on.fleet.stop_load[on.slot][0];
        carried_ -= double(stop_loads[at.behind].aboard[0] + on.type.carried) * double(stop.leg);
        const Int within = stop_loads[next.last].driven - stop_loads[at.behind + 1].driven;
        carried_ += double(aboard_) * double(within);
    }
    if (here_ != nowhere && bounds_trips(on.type)) {
        inserted_[std::size_t(count_ - 1)].on = leg.duration;
    }
    if (on.evaluation.priced && has_window(next)) {
        windows_ += window_cost(on.data, next.node, at.front.time) - next.window_cost;
    }
    here_ = nowhere;
}

bool RarerRules::allow(const OnTrip& on, const Whereabouts& at, const Leg& leg) const {
    if (limits_legs(on.type)) {
        const Int next = on.stops[at.behind + 1].node;
        const Leg more = leg_between(on.data, on.type, here(on, at.behind), next) -
                         leg_between(on.data, on.type, on.stops[at.behind].node, next);
        if (!may_drive_all(on.type, on.route.legs + legs_ + more)) return false;
    }
    if (bounds_trips(on.type)) {
        if (here_ != nowhere) inserted_[std::size_t(count_ - 1)].on = leg.duration;
        const View<const Added, 1> added{inserted_.data(), {count_}};
        if (!lasts_in_air(on.data, on.route.type, on.stops, on.trip.first, on.trip.last, added)) {
            return false;
        }
    }
    if (time_aboard_counts(on.data)) {
        const Int next = at.behind + 1, comes = at.front.time + leg.duration;
        if (!is_fresh_ || !arrive_fresh(on, next, comes - on.stops[next].arrival)) return false;
    }
    return is_near_;
}

// As nobody waits on the trip, all come as much later.
bool RarerRules::arrive_fresh(const OnTrip& on, Int p, Int later) {
    if (later <= 0) return true;
    const Int departure = departure_of(on.data, tour_of(on.fleet, on.slot), on.trip.first);
    for (Int q = p; q < on.trip.last; ++q) {
        const Stop& stop = on.stops[q];
        if (stop.kind == customer_stop && excess_aboard(on.data.max_time_aboard, stop.node,
                                                        departure, stop.arrival + later) > 0) {
            return false;
        }
    }
    return true;
}

double RarerRules::cost(const OnTrip& on, const Whereabouts& at, const Leg& leg,
                        Whole& whole) const {
    double cost = 0.0;
    if (loads_cost(on.data, on.route.type)) {
        const View<const StopLoad, 1> stop_loads = on.fleet.stop_load[on.slot][0];
        const Int load = stop_loads[at.behind].aboard[0] + on.type.carried;
        const double carried =
            carried_ + double(load + aboard_) * double(leg.distance) -
            double(load) * double(on.stops[at.behind].leg) +
            double(aboard_) * double(on.trip.distance - stop_loads[at.behind + 1].driven);
        cost += load_cost(on.rate, carried);
    }
    if (on.evaluation.priced) {
        PaidFront front = at.front;
        front.drive(leg.duration);
        cost += windows_ + follow(on.data, on.route, on.stops, at.behind + 1, front);
        whole = whole_of(front);
    }
    return cost;
}

}  // namespace tandem
