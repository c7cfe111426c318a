#include "search/shipments/cheapest_place.h"

#include <algorithm>

#include "randomness.h"
#include "search/trace.h"

namespace tandem {

PlaceFinder::PlaceFinder(const ProblemData& data, const PairRows& rows, View<std::uint64_t, 1> rng,
                         Int most_stops)
    : rows_(rows),
      places_(data.place.by_truck(data.type[0])),
      blink_(data.strategy.blink),
      rng_(rng),
      most_stops_(most_stops),
      pair_(rows.pair_of(data.pair[data.num_depots].unit)),
      least_(std::size_t(most_stops)) {
    for (End* end : {&pickup_, &delivery_}) {
        for (auto* each : {&end->out, &end->on, &end->further_out, &end->on_to, &end->further}) {
            each->resize(std::size_t(most_stops));
        }
    }
}

void PlaceFinder::scan(const PairRow& row, Int slot, CheapestPlace& best) {
    const std::size_t last = row.node.size() - 1;
    if (Int(last) + 3 > most_stops_ || !rows_.takes_more(row)) return;
    measure(row, pair_.pickup, pickup_);
    measure(row, pair_.delivery, delivery_);
    scan_together(row, slot, best);
    least_[last] = endless;
    for (std::size_t q = last; q-- > 0;) {
        least_[q] = std::min(least_[q + 1], delivery_.further[q]);
    }
    for (std::size_t p = 0; p < last; ++p) {
        // Who is late may look cheaper than endless by a delivery that shortens the way.
        if (pickup_.further[p] < endless && pickup_.further[p] + least_[p + 1] < best.further &&
            rows_.fits(row, Int(p), pair_.pickup.node)) {
            scan_from(row, slot, Int(p), best);
        }
    }
}

void PlaceFinder::measure(const PairRow& row, const Newcomer& newcomer, End& end) const {
    const std::size_t stops = row.node.size();
    const bool same = are_same(newcomer.inward, newcomer.onward);
    for (std::size_t p = 0; p < stops; ++p) {
        const Leg out = leg_from(newcomer.inward, row.node[p]);
        const Leg on = same ? out : leg_to(newcomer.onward, row.node[p]);
        end.out[p] = out.duration;
        end.further_out[p] = out.distance;
        end.on[p] = on.duration;
        end.on_to[p] = on.distance;
    }
    const Int opens = newcomer.place.opening(0), closes = newcomer.place.latest_allowed();
    const Int service = newcomer.place.service_duration();
    const Int *const out = end.out.data(), *const on = end.on.data() + 1;
    const Int* const way = row.way.data();
    const Front* const front = row.front.data();
    const Rear* const rear = row.rear.data() + 1;
    const Int *const further_out = end.further_out.data(), *const on_to = end.on_to.data() + 1;
    Int* const further = end.further.data();
    for (std::size_t p = 0; p + 1 < stops; ++p) {
        const Int arrival = front[p].time + out[p];
        const Int next = std::max(arrival, opens) + service + on[p];
        const Int more = further_out[p] + on_to[p] - way[p];
        further[p] = arrival <= closes && next <= rear[p].latest ? more : endless;
    }
}

void PlaceFinder::scan_together(const PairRow& row, Int slot, CheapestPlace& best) {
    const auto& [pickup, delivery, together] = pair_;
    for (std::size_t p = 0; p + 1 < row.node.size(); ++p) {
        const Int further =
            pickup_.further_out[p] + together.distance + delivery_.on_to[p + 1] - row.way[p];
        if (further >= best.further) continue;
        Front front = row.front[p];
        if (front.serve(pickup.place, pickup_.out[p]) && rows_.fits(row, Int(p), pickup.node) &&
            delivery.is_in_time({front.time + together.duration}, row.rear[p + 1],
                                [&] { return delivery_.on[p + 1]; })) {
            take(slot, {Int(p), Int(p)}, further, best);
        }
    }
}

void PlaceFinder::scan_from(const PairRow& row, Int slot, Int p, CheapestPlace& best) {
    const auto& [pickup, delivery, together] = pair_;
    const std::size_t here = std::size_t(p), last = row.node.size() - 1;
    const Int further = pickup_.further[here];
    Front front = row.front[here];
    front.serve(pickup.place, pickup_.out[here]);
    front.drive(pickup_.on[here + 1]);
    for (std::size_t q = here + 1; q < last; ++q) {
        if (further + least_[q] >= best.further || !row.rear[q].allows(front) ||
            !rows_.fits(row, Int(q), pickup.node)) {
            return;
        }
        front.serve(places_[row.node[q]]);
        if (further + delivery_.further[q] < best.further &&
            delivery.is_in_time(
                {front.time + delivery_.out[q]}, row.rear[q + 1],
                [&] { return delivery_.on[q + 1]; })) {
            take(slot, {p, Int(q)}, further + delivery_.further[q], best);
        }
        front.drive(row.gap[q]);
    }
}

void PlaceFinder::take(Int slot, PairPlace place, Int further, CheapestPlace& best) const {
    trace_priced(static_cast<double>(further), nullptr);
    if (uniform(rng_) >= blink_) best = {slot, place, further};
}

}  // namespace tandem
