#include "search/route/fairness.h"

#include "search/route/vehicles.h"

namespace tandem {
namespace {

// Return how much of the first dimension a customer is brought, and gives.
double amount_at(const ProblemData& data, Int node) {
    if (is_paired(data.pair, node)) return 0.0;
    if (tiers_of(data) == 0) return double(demand_of(data.place[0][node])[0]);
    return double(delivered_of(data.amount, node, 0)[0] + picked_of(data.amount, node, 0)[0]);
}

double load_on(const ProblemData& data, const Fleet& fleet, Int slot) {
    double load = 0.0;
    for_each_served(fleet, slot, [&](Int node) { load += amount_at(data, node); });
    return load;
}

// Return a route's share of the work.
double share_of(const ProblemData& data, const Fleet& fleet, Int slot) {
    const Route& route = fleet.route[slot];
    switch (measure_of(data.fairness)) {
        case Measure::duration:
            return double(route.working);
        case Measure::load:
            return load_on(data, fleet, slot);
        default: {
            const bool counts = measure_of(data.fairness) == Measure::stops;
            Int share = 0;
            for (const Trip& trip : trips_of(fleet, slot)) {
                share += counts ? stops_on(trip) : trip.distance;
            }
            return double(share);
        }
    }
}

// A trip that serves a customer alone: how long it takes at least, and its share of the work.
struct Alone {
    Int working;
    double share;
};

Alone alone(const ProblemData& data, Int k, Int node) {
    const VehicleType& type = data.type[k];
    const TravelLegs legs = legs_of(data.leg, type.travel);
    const Leg out = leg(legs, type.begins_at, node), home = leg(legs, node, type.ends_at);
    const Int working = out.duration + data.place[0][node].service_duration() + home.duration;
    switch (measure_of(data.fairness)) {
        case Measure::stops:
            return {working, 1.0};
        case Measure::load:
            return {working, amount_at(data, node)};
        case Measure::distance:
            return {working, double(out.distance + home.distance)};
        default:
            return {working, double(working)};
    }
}

}  // namespace

Shares shares_of(const ProblemData& data, const Searcher& searcher) {
    if (!plan_costs(data)) return {0.0, 0.0, 0.0, 0};
    Shares shares = shares_before(data.fairness);
    const Fleet& now = searcher.now;
    const auto count = [&](Int slot) {
        if (now.route[slot].length == 0) return;
        const Route& route = now.route[slot];
        shares = with_route(shares, data.type[route.type], share_of(data, now, slot), route.end);
    };
    const Int active = searcher.count->active;
    for (const Int slot : searcher.active.first(active)) count(slot);
    // Those that a turn has put on the road may not be listed yet.
    for (const Int slot : searcher.touched.first(searcher.count->touched)) {
        if (searcher.rank[slot] >= active) count(slot);
    }
    return shares;
}

double plan_cost(const ProblemData& data, const Searcher& searcher) {
    return plan_costs(data) ? fairness_cost(data.fairness, shares_of(data, searcher)) : 0.0;
}

double plan_cost_of_joining(const ProblemData& data, const Fleet& fleet, const Shares& shares,
                            Int slot, Int node, double cost) {
    const Route& route = fleet.route[slot];
    const double share = share_of(data, fleet, slot);
    const double service = double(data.place[0][node].service_duration());
    const double longer =
        std::max(service, double(route.working) / double(std::max(Int{1}, route.length - 1)));
    double more = share / double(std::max(Int{1}, route.length - 1));
    if (measure_of(data.fairness) == Measure::stops) more = 1.0;
    if (measure_of(data.fairness) == Measure::load) more = amount_at(data, node);
    if (measure_of(data.fairness) == Measure::duration) more = longer;
    const double before = share_before(data.type[route.type]) + share;
    const double paid = fleet.cost[slot] - data.rate[route.type].fixed;
    const double later =
        paid > 0.0 ? std::max(service, cost * double(route.working) / paid) : longer;
    const Shares grown = with_more(shares, before, more, {route.end, route.end + Int(later)});
    return fairness_cost(data.fairness, grown) - fairness_cost(data.fairness, shares);
}

double plan_cost_of_trip(const ProblemData& data, const Fleet& fleet, const Shares& shares,
                         Int slot, Int node) {
    const Route& route = fleet.route[slot];
    const VehicleType& type = data.type[route.type];
    const Alone trip = alone(data, route.type, node);
    const double before = share_before(type) + share_of(data, fleet, slot);
    const Shares grown = with_more(shares, before, trip.share,
                                   {route.end, route.end + type.reload_duration + trip.working});
    return fairness_cost(data.fairness, grown) - fairness_cost(data.fairness, shares);
}

double plan_cost_of_opening(const ProblemData& data, const Shares& shares, Int k, Int node) {
    const VehicleType& type = data.type[k];
    const Alone trip = alone(data, k, node);
    const Shares grown = with_route(shares, type, trip.share, type.shift_earliest + trip.working);
    return fairness_cost(data.fairness, grown) - fairness_cost(data.fairness, shares);
}

}  // namespace tandem
