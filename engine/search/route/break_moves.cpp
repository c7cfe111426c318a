#include "search/route/break_moves.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "rules/breaks.h"
#include "rules/driving.h"
#include "rules/hub.h"
#include "rules/shift.h"
#include "search/route/break_choices.h"
#include "search/route/breaks.h"
#include "search/route/freshness.h"
#include "search/route/lags.h"
#include "search/route/least_cost.h"
#include "search/route/placed_breaks.h"
#include "search/route/pricing.h"
#include "search/route/rest_placing.h"
#include "search/route/routes.h"
#include "search/route/settling.h"

namespace tandem {
namespace {

// What sums of costs differ by that are one, as a share.
constexpr double rounding = 1e-9;

// Ways to take breaks that are timed at most, the most promising first.
constexpr std::size_t most_timed = 8;

// Moves breaks as long as that costs less by `price`, which times a route with breaks where they
// are placed, and tells what it costs if that is below a bar.
template <class Price>
class BreakMoves {
public:
    BreakMoves(const VehicleType& type, View<const Stop, 1> stops, bool flies,
               const PlacedBreaks& placed, double cost, const Price& price)
        : type_(type), stops_(stops), flies_(flies), price_(price), best_(placed), cost_(cost) {}

    const PlacedBreaks& best() const { return best_; }
    double cost() const { return cost_; }

    // Let breaks be there if that costs less; tells. In place, as all that follows; what is timed
    // may be another.
    bool try_these(const PlacedBreaks& placed) {
        const double cost = price_(placed, cost_);
        if (cost >= cost_) return false;
        best_ = placed;
        cost_ = cost;
        return true;
    }

    // Move one after another.
    void run() {
        for (Int pass = 0; pass < most_passes; ++pass) {
            const double before = cost_;
            for (Int index = 0; index < best_.count(); ++index) move(index);
            if (flies_) take_more();
            if (cost_ >= before) break;
        }
    }

private:
    static constexpr Int most_passes = 3;

    // By so many stops a break is moved at most.
    static constexpr Int reach = 3;

    // Call `visit` with each place for a break behind some stops.
    template <class Visit>
    void for_each_place(Int number, Int first, Int last, const Visit& visit) const {
        const RestPlace before =
            may_rest_on_way(type_, number) ? RestPlace::way : RestPlace::departure;
        for (Int p = std::max(Int{0}, first); p <= std::min(last, stops_.size() - 2); ++p) {
            if (stops_[p].kind == end_stop || is_among(stops_[p].heavy, number)) continue;
            visit({number, p, before});
            visit({number, p, RestPlace::arrival});
        }
    }

    void move(Int index) {
        const PlacedBreaks::One from = best_[index];
        for_each_place(from.number, from.stop - reach, from.stop + reach,
                       [&](const PlacedBreaks::One& to) {
                           const PlacedBreaks placed = best_.with(index, to);
                           if (placed.is_in_order(index)) try_these(placed);
                       });
    }

    // Take breaks that aren't due but count in no working duration, while drones are out.
    void take_more() {
        for (Int number = 0, index = 0; number < num_breaks(type_); ++number) {
            if (index < best_.count() && best_[index].number == number) {
                ++index;
            } else if (!is_paid(type_, number)) {
                bool is_taken = false;
                for_each_place(number, 0, stops_.size(), [&](const PlacedBreaks::One& one) {
                    if (stops_[one.stop].flying == 0) return;
                    const PlacedBreaks placed =
                        is_taken ? best_.with(index, one) : best_.with_more(index, one);
                    if (placed.is_in_order(index)) is_taken |= try_these(placed);
                });
                index += is_taken ? 1 : 0;
            }
        }
    }

    const VehicleType& type_;
    View<const Stop, 1> stops_;
    const bool flies_;
    const Price& price_;
    PlacedBreaks best_;
    double cost_;
};

// How long customers are waited for on a timed route where that costs something: so much later it
// might begin.
class CostlyWaits {
public:
    CostlyWaits(const ProblemData& data, const Fleet& fleet, Int slot) : data_(data) {
        const Route& route = fleet.route[slot];
        const NodeTable places = data.place.by_truck(data.type[route.type]);
        for (const Stop& stop : fleet.stop[slot].first(route.length)) {
            if (stop.kind == customer_stop) note(places[stop.node], stop.node, stop.arrival);
        }
        for (const Sortie& sortie : fleet.sortie[slot].first(route.sorties)) {
            for (Int visit = 0; visit < sortie.count; ++visit) {
                const Int node = sortie.nodes[visit];
                note(data.place[0][node], node, sortie.arrivals[visit]);
            }
        }
    }

    const Int* begin() const { return wait_.data(); }
    const Int* end() const { return wait_.data() + count_; }

private:
    static constexpr std::size_t most = 4;

    void note(Windows place, Int node, Int arrival) {
        if (count_ < most && waiting_cost(data_, node, arrival) > 0.0) {
            wait_[count_++] = place.waiting(arrival);
        }
    }

    const ProblemData& data_;
    std::size_t count_ = 0;
    std::array<Int, most> wait_{};
};

// Return when the first trip of a route would begin that has no breaks, as late as costs nothing;
// `none` if it can't be driven. In place: it is timed so.
Int begin_without_breaks(const ProblemData& data, const Fleet& fleet, Int slot) {
    Route& route = fleet.route[slot];
    const View<Stop, 1> stops = fleet.stop[slot];
    const View<Trip, 1> trips = fleet.trip[slot];
    const View<Sortie, 1> sorties = fleet.sortie[slot];
    stops[0].release = trips[0].release;
    clear_rests(data.type[route.type], stops.first(route.length));
    clear_holds(route, stops, trips);
    route.placed = breaks_left_out;
    if (!drive_forward(data, route, stops, sorties) ||
        !settle(data, route, stops, trips, sorties)) {
        return none;
    }
    return std::max({stops[0].arrival, stops[0].release, stops[0].hold});
}

// Price a route with breaks where they are placed; `no_bar` if it breaks a rule. In place.
double price_placed(const ProblemData& data, const Fleet& fleet, Int slot,
                    const PlacedBreaks& placed, bool& settled) {
    Route& route = fleet.route[slot];
    const View<Stop, 1> stops = fleet.stop[slot].first(route.length);
    placed.write(stops);
    stops[0].release = placed.begin();
    route.placed = breaks_kept;
    return price_loaded(data, fleet, slot, settled) ? fleet.cost[slot] : no_bar;
}

// Price a route that begins no sooner than then, with breaks where it ends soonest. In place.
bool price_from(const ProblemData& data, const Fleet& fleet, Int slot, Int begin, bool& settled) {
    fleet.stop(slot, 0).release = begin;
    fleet.route[slot].placed = breaks_by_end;
    return price_loaded(data, fleet, slot, settled);
}

// Tell whether breaks of a route may be told apart by cost.
bool tells_breaks_apart(const ProblemData& data, const Route& route) {
    return has_breaks_alone(data, route.type) &&
           (!holds_count(data, route.type) || route.trips == 1);
}

// Return what it costs that customers are served too late, or waited for, on a priced route.
double missed_windows(const ProblemData& data, const Fleet& fleet, Int slot) {
    double cost = 0.0;
    const Route& route = fleet.route[slot];
    if (!data.evaluation[route.type].priced) return cost;
    for (const Stop& stop : fleet.stop[slot].first(route.length)) {
        if (stop.kind == customer_stop) cost += stop.window_cost;
    }
    for (const Sortie& sortie : fleet.sortie[slot].first(route.sorties)) {
        for (Int visit = 0; visit < sortie.count; ++visit) {
            cost += window_cost(data, sortie.nodes[visit], sortie.arrivals[visit]);
        }
    }
    return cost;
}

// Tell whether customers are served as late as they have to be, by where breaks are, on a route
// that begins as soon as it may.
bool is_soonest_least_late(const ProblemData& data, const Route& route) {
    return data.evaluation[route.type].priced && route.sorties == 0 && !lags_count(data) &&
           tells_breaks_apart(data, route);
}

// Return what it costs that customers of a route are served too late that begins as soon as it
// may; nothing if it can't be driven. In place: it is timed so.
double lateness_as_placed(const ProblemData& data, const Fleet& fleet, Int slot) {
    Route& route = fleet.route[slot];
    const View<Stop, 1> stops = fleet.stop[slot];
    double cost = 0.0;
    clear_holds(route, stops, fleet.trip[slot]);
    if (!drive_as_placed(data, route, stops, fleet.sortie[slot])) return cost;
    for (const Stop& stop : stops.first(route.length)) {
        if (stop.kind == customer_stop) cost += lateness_cost(data, stop.node, stop.arrival);
    }
    return cost;
}

}  // namespace

double least_lateness(const ProblemData& data, const Fleet& fleet, Int slot) {
    const Route& route = fleet.route[slot];
    if (!is_soonest_least_late(data, route)) return 0.0;
    clear_rests(data.type[route.type], fleet.stop[slot].first(route.length));
    return lateness_as_placed(data, fleet, slot);
}

bool price_choices(const ProblemData& data, const Fleet& fleet, Int slot, const CostBounds& bounds,
                   bool& settled) {
    Route& route = fleet.route[slot];
    const View<Stop, 1> stops = fleet.stop[slot];
    const VehicleType& type = data.type[route.type];
    const Rate& rate = data.rate[route.type];
    clear_holds(route, stops, fleet.trip[slot]);
    clear_rests(type, stops.first(route.length));
    // Whoever takes breaks is later everywhere.
    if (!drive_as_placed(data, route, stops, fleet.sortie[slot])) return false;
    if (!lacks_break(type, route, stops)) {
        route.placed = breaks_left_out;
        if (price_driven(data, fleet, slot, settled) &&
            fleet.cost[slot] <= bounds.in_time * (1.0 + rounding)) {
            return true;
        }
        clear_holds(route, stops, fleet.trip[slot]);
    }
    std::vector<BreakChoice> choices = break_choices(data, route, stops);
    const bool is_timed = data.evaluation[route.type].timed;
    const double besides =
        is_timed ? bounds.in_time -
                       work_cost(rate, paid_work(type, none, least_working(data, route, stops)))
                 : bounds.in_time;
    const auto least = [&](const BreakChoice& choice) {
        if (!is_timed) return besides;
        return besides + work_cost(rate, paid_work(type, choice.end, choice.working));
    };
    std::sort(choices.begin(), choices.end(),
              [&](const BreakChoice& one, const BreakChoice& other) {
                  return std::pair{least(one), one.end} < std::pair{least(other), other.end};
              });
    double cost = bounds.bar;
    const PlacedBreaks* best = nullptr;
    const PlacedBreaks* timed = nullptr;
    choices.resize(std::min(choices.size(), most_timed));
    for (const BreakChoice& choice : choices) {
        if (least(choice) >= cost * (1.0 - rounding)) break;
        timed = &choice.placed;
        const double found = price_placed(data, fleet, slot, *timed, settled);
        if (found >= cost) continue;
        best = timed;
        cost = found;
    }
    return best != nullptr &&
           (best == timed || price_placed(data, fleet, slot, *best, settled) < no_bar);
}

bool begin_late(const ProblemData& data, const Fleet& fleet, Int slot, bool& settled) {
    const Route& route = fleet.route[slot];
    if (!tells_breaks_apart(data, route) || !any_follows_departure(data.type[route.type])) {
        return false;
    }
    const Int begin = begin_without_breaks(data, fleet, slot);
    return begin > fleet.trip(slot, 0).release && price_from(data, fleet, slot, begin, settled);
}

bool may_move_breaks(const ProblemData& data, const Fleet& fleet, Int slot, double least) {
    const Route& route = fleet.route[slot];
    return tells_breaks_apart(data, route) && fleet.cost[slot] > least * (1.0 + rounding) &&
           (data.type[route.type].drones > 0 || missed_windows(data, fleet, slot) > 0.0);
}

bool move_breaks(const ProblemData& data, const Fleet& fleet, Int slot, const CostBounds& bounds,
                 bool& settled) {
    Route& route = fleet.route[slot];
    const View<Stop, 1> stops = fleet.stop[slot].first(route.length);
    const VehicleType& type = data.type[route.type];
    const Int release = stops[0].release;
    const Int begin = std::max({stops[0].arrival, release, stops[0].hold});
    // Who began sooner would lack breaks that are over now.
    const PlacedBreaks soonest(stops, std::max(release, last_over_by(type, begin)));
    const double before = fleet.cost[slot];
    const CostlyWaits waits(data, fleet, slot);
    const bool is_bounded = is_soonest_least_late(data, route);
    const auto price = [&](const PlacedBreaks& placed, double bar) {
        if (is_bounded) {
            placed.write(stops);
            stops[0].release = placed.begin();
            route.placed = breaks_kept;
            if (bounds.in_time + lateness_as_placed(data, fleet, slot) >= bar) return no_bar;
        }
        return price_placed(data, fleet, slot, placed, settled);
    };
    BreakMoves moves(type, stops, route.sorties > 0, soonest, before, price);
    for (const Int wait : waits) moves.try_these(soonest.from(begin + wait));
    const Int late = begin_without_breaks(data, fleet, slot);
    if (late > begin && price_from(data, fleet, slot, late, settled)) {
        moves.try_these(PlacedBreaks(stops, late));
    }
    moves.run();
    if (bounds.bar < no_bar) {
        fleet.cost[slot] = moves.cost();
        return true;
    }
    if (moves.cost() < before) return price(moves.best(), no_bar) < no_bar;
    return price_from(data, fleet, slot, release, settled);
}

}  // namespace tandem
