#include <tuple>

#include "search/route/freshness.h"
#include "search/route/pricing.h"
#include "search/route/rests.h"

namespace tandem {

const std::optional<Begun>& BestBegin::of(const AnyBegin& route,
                                          const std::vector<TimedCustomer>& timed) {
    const auto [first, last] = route.begins;
    double missed = 0.0, slope = 0.0, once = 0.0;
    turns_.clear();
    best_.reset();
    for (std::int32_t number = route.last; number >= 0;) {
        const TimedCustomer& customer = timed[std::size_t(number)];
        missed += lateness_cost(data_, customer.node, customer.served.at(first)) +
                  waiting_cost(data_, customer.node, customer.reached.at(first));
        note(customer, first);
        number = customer.before;
    }
    turns_.push_back({std::max(first, route.end.c - route.end.d), 0.0, 0.0});
    std::ranges::sort(turns_,
                      [](const Turn& one, const Turn& other) { return one.begin < other.begin; });
    Int at = first;
    begin_at(route, first, missed);
    for (const Turn& turn : turns_) {
        const Int begin = std::min(turn.begin, last);
        if (begin > at) {
            missed += once + slope * double(begin - at);
            once = 0.0;
            at = begin;
            begin_at(route, begin, missed);
        }
        if (turn.begin > last) break;
        once += turn.once;
        slope += turn.slope;
    }
    return best_;
}

void BestBegin::note(const TimedCustomer& customer, Int first) {
    const Price& price = data_.price[customer.node];
    const Windows place = data_.place[0][customer.node];
    const auto [reached, served, node, before] = customer;
    const auto turn = [&](TimeSegment time) { return std::max(first, time.c - time.d); };
    const Int arrival = reached.at(first), opens = place.opening(arrival);
    if (price.waiting > 0.0 && arrival < opens) {
        const double each = price.waiting / ms_and_mm.duration;
        turns_.push_back({turn(reached), 0.0, -each});
        turns_.push_back({opens - reached.d, 0.0, each});
    }
    const double each = price.lateness / ms_and_mm.duration;
    if (served.at(first) > place.closing()) {
        turns_.push_back({turn(served), 0.0, each});
    } else if (price.lateness > 0.0 || price.late > 0.0) {
        turns_.push_back({place.closing() - served.d, price.late, each});
    }
}

void BestBegin::begin_at(const AnyBegin& route, Int begin, double missed) {
    const Int end = route.end.at(begin);
    const Int working = end - counted_from(type_, begin) - route.unpaid;
    if (!may_work(type_, working)) return;
    const Begun begun{begin, end, working, work_cost(rate_, paid_work(type_, end, working)),
                      missed};
    const auto value = [](const Begun& route) {
        return std::tuple{route.cost(), route.end, route.working};
    };
    if (!best_ || value(begun) < value(*best_)) best_ = begun;
}

namespace {

// What sums of costs differ by that are one, as a share.
constexpr double rounding = 1e-9;

constexpr CostBounds unbounded{0.0, no_bar};

// Ways to take breaks that are timed at most, the most promising first.
constexpr std::size_t most_timed = 8;

// Moves breaks as long as that costs less by `price`, which times a route with breaks where they
// are placed, and tells what it costs.
template <class Price>
class BreakMoves {
public:
    BreakMoves(const VehicleType& type, View<const Stop, 1> stops, const PlacedBreaks& placed,
               double cost, const Price& price)
        : type_(type), stops_(stops), price_(price), best_(placed), cost_(cost) {}

    const PlacedBreaks& best() const { return best_; }
    double cost() const { return cost_; }

    // Let breaks be there if that costs less; tells. In place, as all that follows; what is timed
    // may be another.
    bool try_these(const PlacedBreaks& placed) {
        const double cost = price_(placed);
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
            take_more();
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
        for (const Stop& stop : stops_of(fleet, slot)) {
            if (stop.kind == customer_stop) note(places[stop.node], stop.node, stop.arrival);
        }
        for (const Sortie& sortie : sorties_of(fleet, slot)) {
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

// Tell whether breaks beside flights may be told apart by cost.
bool tells_breaks_apart(const ProblemData& data, const Route& route) {
    return has_breaks_alone(data, route) && route.sorties > 0 &&
           (!holds_count(data, route.type) || route.trips == 1);
}

// Return when the first trip of a timed route begins.
Int begin_as_timed(View<const Stop, 1> stops) {
    return std::max({stops[0].arrival, stops[0].release, stops[0].hold});
}

// Return when the first trip of a route would begin that has no breaks, as late as costs nothing;
// `none` if it can't be driven. In place: it is timed so.
Int begin_without_breaks(const ProblemData& data, const Fleet& fleet, Int slot) {
    const Tour tour = tour_of(fleet, slot);
    const auto& [route, stops, trips, sorties] = tour;
    stops[0].release = trips[0].release;
    clear_rests(data.type[route.type], stops.first(route.length));
    clear_holds(tour);
    route.placed = breaks_left_out;
    if (!drive_forward(data, tour) || !settle(data, tour)) {
        return none;
    }
    return begin_as_timed(stops);
}

// Return what it costs that customers of a timed route are served too late, or less.
double lateness_on(const ProblemData& data, const Tour& tour) {
    double cost = 0.0;
    if (!data.evaluation[tour.route.type].priced || lags_count(data)) return cost;
    for (const Stop& stop : tour.stops.first(tour.route.length)) {
        if (stop.kind == customer_stop) cost += lateness_cost(data, stop.node, stop.arrival);
    }
    return cost;
}

// Price a route with breaks where they are placed; `no_bar` if it breaks a rule, or is known not to
// be below the bar. In place.
double price_placed(const ProblemData& data, const Fleet& fleet, Int slot,
                    const PlacedBreaks& placed, const CostBounds& bounds, bool& settled) {
    const Tour tour = tour_of(fleet, slot);
    const auto& [route, stops, trips, sorties] = tour;
    placed.write(stops.first(route.length));
    stops[0].release = placed.begin();
    route.placed = breaks_kept;
    clear_holds(tour);
    if (!drive_forward(data, tour) || bounds.in_time + lateness_on(data, tour) >= bounds.bar) {
        return no_bar;
    }
    return price_driven(data, fleet, slot, settled) ? fleet.cost[slot] : no_bar;
}

// Price a route that begins no sooner than then, with breaks where it ends soonest. In place.
bool price_from(const ProblemData& data, const Fleet& fleet, Int slot, Int begin, bool& settled) {
    fleet.stop(slot, 0).release = begin;
    fleet.route[slot].placed = breaks_by_end;
    return price_loaded(data, fleet, slot, settled);
}

}  // namespace

bool price_choices(const ProblemData& data, const Fleet& fleet, Int slot, const CostBounds& bounds,
                   bool& settled) {
    const Tour tour = tour_of(fleet, slot);
    const auto& [route, stops, trips, sorties] = tour;
    const VehicleType& type = data.type[route.type];
    clear_holds(tour);
    clear_rests(type, stops.first(route.length));
    // Whoever takes breaks is later everywhere.
    if (!drive_as_placed(data, tour)) return false;
    const double least_known = bounds.in_time + lateness_on(data, tour);
    if (least_known >= bounds.bar) return false;
    double cost = bounds.bar;
    PlacedBreaks best = PlacedBreaks().from(stops[0].release);
    bool is_found = false, is_timed_last = false;
    if (!lacks_break(type, tour)) {
        route.placed = breaks_left_out;
        is_found = price_driven(data, fleet, slot, settled) && fleet.cost[slot] < cost;
        if (is_found) cost = fleet.cost[slot];
        if (is_found && cost <= least_known * (1.0 + rounding)) return true;
        clear_holds(tour);
    }
    const double besides =
        bounds.in_time - work_cost(data.rate[route.type], paid_work(type, none, bounds.working));
    std::vector<BreakChoice> choices = break_choices(data, tour, cost - bounds.in_time);
    choices.resize(std::min(choices.size(), most_timed));
    for (const auto& [placed, timing] : choices) {
        if (besides + timing.cost() >= cost * (1.0 - rounding)) break;
        const double found =
            price_placed(data, fleet, slot, placed, {besides + timing.work, cost}, settled);
        is_timed_last = found < cost;
        if (!is_timed_last) continue;
        is_found = true;
        best = placed;
        cost = found;
    }
    if (!is_found || is_timed_last) return is_found;
    fleet.cost[slot] = cost;
    return bounds.bar < no_bar ||
           price_placed(data, fleet, slot, best, unbounded, settled) < no_bar;
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
    return tells_breaks_apart(data, route) && fleet.cost[slot] > least * (1.0 + rounding);
}

bool move_breaks(const ProblemData& data, const Fleet& fleet, Int slot, double bar, bool& settled) {
    Route& route = fleet.route[slot];
    const View<Stop, 1> stops = stops_of(fleet, slot);
    const VehicleType& type = data.type[route.type];
    const Int release = stops[0].release;
    const Int begin = begin_as_timed(stops);
    // Who began sooner would lack breaks that are over now.
    const PlacedBreaks soonest(stops, std::max(release, last_over_by(type, begin)));
    const double before = fleet.cost[slot];
    const CostlyWaits waits(data, fleet, slot);
    const auto price = [&](const PlacedBreaks& placed) {
        return price_placed(data, fleet, slot, placed, unbounded, settled);
    };
    BreakMoves moves(type, stops, soonest, before, price);
    for (const Int wait : waits) moves.try_these(soonest.from(begin + wait));
    const Int late = begin_without_breaks(data, fleet, slot);
    if (late > begin && price_from(data, fleet, slot, late, settled)) {
        moves.try_these(PlacedBreaks(stops, late));
    }
    moves.run();
    if (bar < no_bar) {
        fleet.cost[slot] = moves.cost();
        return true;
    }
    if (moves.cost() < before) return price(moves.best()) < no_bar;
    return price_from(data, fleet, slot, release, settled);
}

}  // namespace tandem
