#include "search/route/least_cost.h"

#include <algorithm>

#include "rules/driving.h"
#include "rules/shift.h"
#include "search/route/rest_placing.h"

namespace tandem {
namespace {

// Return how long a driver pauses at least who works at `lasting` things of which `driving` are
// legs, but for breaks that aren't paid.
Int least_pause(const VehicleType& type, Int driving, Int lasting) {
    const Int last_begin = last_end(type) - lasting, first_begin = type.shift_earliest;
    Int paused = 0, saved = 0;
    for (Int number = 0; number < num_breaks(type); ++number) {
        const Break first = break_of(type, number, first_begin);
        const bool is_certain = first.latest < first_begin + lasting &&
                                !over_before(type, number, std::max(first_begin, last_begin));
        if (is_paid(type, number) && !is_certain) continue;
        if (is_paid(type, number)) paused += first.duration;
        saved += most_saved_by(type, first.duration);
    }
    if (!has_driving_rules(type)) return paused;
    const Int begin = counted_begin(type, first_begin);
    const Int rests = least_rest(type, driver_from(type, begin), begin, driving, lasting);
    return paused + std::max(Int{0}, rests - saved);
}

}  // namespace

bool may_rest(const VehicleType& type) { return has_breaks(type) || has_driving_rules(type); }

Int least_working(const ProblemData& data, const Route& route, View<const Stop, 1> stops) {
    const VehicleType& type = data.type[route.type];
    const NodeTable places = data.place.by_truck(type);
    Int driving = 0, lasting = 0;
    for (Int p = 0; p < route.length; ++p) {
        const Stop& stop = stops[p];
        if (stop.kind == customer_stop) lasting += places[stop.node].service_duration();
        if (p + 1 == route.length) break;
        lasting += stop.gap - resting_in_gap(type, stop);
        if (stop.kind != end_stop) driving += driving_from(data, type, stops, p);
    }
    return lasting + least_pause(type, driving, lasting);
}

double least_cost(const ProblemData& data, const Fleet& fleet, Int slot) {
    const Route& route = fleet.route[slot];
    const View<const Stop, 1> stops = fleet.stop[slot];
    const VehicleType& type = data.type[route.type];
    const Rate& rate = data.rate[route.type];
    const Int working = least_working(data, route, stops);
    double cost = rate.fixed + work_cost(rate, paid_work(type, none, working));
    for (const Trip& trip : fleet.trip[slot].first(route.trips)) {
        cost += drive_cost(rate, trip.distance);
    }
    for (const Stop& stop : stops.first(route.length)) {
        if (stop.kind == customer_stop) cost += rate.stop;
    }
    return cost;
}

}  // namespace tandem
