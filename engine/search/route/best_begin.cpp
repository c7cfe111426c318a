#include <tuple>

#include "search/route/breaks.h"
#include "search/route/routes.h"

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

}  // namespace tandem
