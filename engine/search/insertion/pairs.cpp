#include <tuple>

#include "search/insertion/shipments.h"
#include "search/insertion/trip_scan.h"
#include "search/route/freshness.h"
#include "search/route/goods.h"
#include "search/route/refresh.h"

namespace tandem {
namespace {

constexpr Int ends_of_pair = 2;
constexpr Int most_timed = 16;  // places on a trip that are timed at once
constexpr Int most_tried = 4;   // so many, one after another, until the vehicle can come to one

// Whether a shipment that is aboard on arrival at a stop, or leaving it, is in the way of what the
// stop unloads from a stack, or lies under what comes aboard.
bool disturbs_stack(const Fleet& fleet, Int slot, Int p) {
    const StopLoad& stop_load = fleet.stop_load(slot, 0, p);
    return stop_load.leaves > 0 || stop_load.comes > 0;
}

// A shipment on its way along a trip.
class PairScan : TripScan {
public:
    PairScan(const Insertion& insertion, Int of_slot, const Trip& tried)
        : TripScan(insertion, of_slot, tried),
          pickup_(newcomer(node)),
          delivery_(newcomer(data.pair[node].partner)),
          time_rate_(data.evaluation[route.type].timed ? rate.time : 0.0),
          stops_cost_(double(ends_of_pair) * rate.stop +
                      vehicle_cost_at(data.vehicle_cost, route.type, pickup_.node) +
                      vehicle_cost_at(data.vehicle_cost, route.type, delivery_.node)) {}

    // Tries all places by what is known of the stops' times.
    void walk() { asks_more ? walk_by<RarerRules>() : walk_by<NoRarerRules>(); }

    // Tries the places that look cheapest, timing the route anew for each, and others if the
    // vehicle can come to none of them.
    void time_cheapest() {
        std::optional<PairSpot> last;
        bool possible = false;
        for (Int tried = 0; tried < most_tried && !possible; ++tried) {
            const Spots spots = cheapest_behind(last);
            for (const PairSpot& spot : spots.items()) {
                if (data.deadline.passed()) return;
                last = spot;
                if (is_dear(spot.least)) continue;
                Move move{};
                serve_both(move, spot.p, spot.q);
                const double cost = price_move(data, fleet, move, node, infeasible);
                possible = possible || cost < infeasible;
                best.try_move(cost, move);
            }
            if (!spots.is_full()) return;
        }
    }

private:
    // Where both ends may come; what that costs at least, and about.
    struct PairSpot {
        double about, least;
        Int p, q;

        bool operator<(const PairSpot& other) const {
            return std::tie(about, p, q) < std::tie(other.about, other.p, other.q);
        }
    };

    using Spots = Cheapest<PairSpot, most_timed>;

    // The cheapest of those that come behind `last`.
    Spots cheapest_behind(const std::optional<PairSpot>& last) const {
        Spots spots;
        for (Int p = trip.first; p < trip.last; ++p) {
            const Leg out = leg_from(pickup_.inward, stops[p].node);
            Front front{stops[p].leave};
            if (!front.serve(pickup_.place, out.duration)) continue;
            const Leg apart = more_behind(pickup_, p);
            Int above = 0;
            for (Int q = p; q < trip.last && fits(q); ++q) {
                if (q > p && !goes_past(q, above)) break;
                if (delivery_.place.too_late(std::max(front.time, stops[q].leave))) break;
                if (above > 0) continue;
                const Leg more = q == p ? more_together(out, q) : more_behind(delivery_, q, apart);
                const double least = cost_of(more.distance);
                const PairSpot spot{least + double(more.duration) * time_rate_, least, p, q};
                if (!last || *last < spot) spots.add(spot);
            }
        }
        spots.sort();
        return spots;
    }

    // How much longer and further it is by one end behind a stop, beside another detour.
    Leg more_behind(const Newcomer& end, Int p, Leg beside = {0, 0}) const {
        const auto [out, on, distance] = detour(end, p);
        return {beside.duration + out.duration + on.duration - stops[p].gap,
                beside.distance + distance};
    }

    // How much longer and further it is by both ends behind a stop, from which `out` leads.
    Leg more_together(const Leg& out, Int p) const {
        const Leg on = leg_to(delivery_.onward, stops[p + 1].node);
        return {out.duration + aboard_.duration + on.duration - stops[p].gap,
                out.distance + aboard_.distance + on.distance - stops[p].leg};
    }

    double cost_of(Int detour) const { return double(detour) * rate.distance + stops_cost_; }

    // How much further it is by the delivery behind the pickup, or behind stop `q`.
    Int delivered_behind(Int p, Int q) const {
        const Int on = distance_to(delivery_.onward, stops[q + 1].node) - stops[q].leg;
        if (q == p) return aboard_.distance + on;
        return distance_from(delivery_.inward, stops[q].node) + on;
    }

    // Whether the shipment may be aboard at stop `q`; of a stack, below `above` others behind it.
    bool goes_past(Int q, Int& above) const {
        if (!is_stack(type)) return true;
        above += fleet.stop_load(slot, 0, q).stacks;
        return above >= 0 && !disturbs_stack(fleet, slot, q);
    }

    template <class Rarer>
    void walk_by() {
        for (Int p = trip.first; p < trip.last; ++p) {
            if (pickup_.place.too_late(stops[p].leave)) return;
            if (stops[p].flying == 0) walk_from<Rarer>(p);
        }
    }

    template <class Rarer>
    void walk_from(Int p) {
        const Leg out = leg_from(pickup_.inward, stops[p].node);
        const Leg on = leg_to(pickup_.onward, stops[p + 1].node);
        const Int together = out.distance + delivered_behind(p, p);
        // By the triangle inequality it is no less further to deliver later.
        const Int later = out.distance + on.distance - stops[p].leg;
        if (cost_of(std::min(together, later)) >= best.cost || !fits(p)) return;
        Proposal<Rarer> way(*this, p, inserted_);
        if (!way.serve(pickup_, out)) return;
        Int above = 0;
        for (Int q = p;; q = way.behind()) {
            if (delivery_.place.too_late(way.front().time)) return;
            if (above == 0) try_delivery(way, p, q);
            if (cost_of(later) >= best.cost || !may_pass(q + 1, above)) return;
            if (!way.pass(q == p ? on : Leg{stops[q].gap, stops[q].leg})) return;
        }
    }

    // Whether the shipment may be aboard on a block of stops, and one more comes behind it.
    bool may_pass(Int first, Int& above) const {
        const Int last = first < trip.last ? stops[first].last : trip.last;
        for (Int q = first; q <= last; ++q) {
            if (q == trip.last || !fits(q) || !goes_past(q, above)) return false;
        }
        return true;
    }

    template <class Rarer>
    void try_delivery(const Proposal<Rarer>& without, Int p, Int q) {
        if (cost_of(without.further() + delivered_behind(p, q)) >= best.cost) return;
        Proposal<Rarer> way = without;
        const Leg out = q == p ? aboard_ : leg_from(delivery_.inward, stops[q].node);
        if (!way.serve(delivery_, out)) return;
        const double cost = way.price(leg_to(delivery_.onward, stops[q + 1].node), stops_cost_);
        if (cost < infeasible) best.try_made(cost, [&](Move& move) { serve_both(move, p, q); });
    }

    // Lets a move serve the pickup behind a stop, and the delivery behind it or a later one.
    void serve_both(Move& move, Int p, Int q) const {
        move_between(move, p, q + 1);
        move.add(How::serve, pickup_.node, p + 1);
        move.add(How::serve, delivery_.node, q + 2);
    }

    const Newcomer pickup_;
    const Newcomer delivery_;
    const Leg aboard_ = leg_to(pickup_.onward, delivery_.node);
    const double time_rate_, stops_cost_;
    Inserted inserted_;
};

// Whether a part of a shipment comes from the depot, or its trip has to wait for it there.
bool comes_in_part(const ProblemData& data, Int delivery) {
    return release_of(data.place[0][delivery]) > 0 || total_delivered(data.amount, delivery) > 0;
}

}  // namespace

void scan_pair(const Insertion& insertion, Int slot) {
    const auto& [data, searcher, node, enlarge, best] = insertion;
    const Fleet& fleet = searcher.now;
    const Int k = fleet.route[slot].type;
    if (!data.can(k, 0, node)) return;
    const bool walked = joins_anywhere(data, fleet.route[slot]) &&
                        !(data.evaluation[k].priced && holds_count(data, k)) &&
                        !has_driving_rules(data.type[k]) &&
                        !comes_in_part(data, data.pair[node].partner);
    for (Int index = 0; index < fleet.route[slot].trips; ++index) {
        const Trip& trip = fleet.trip(slot, index);
        if (!goods_may_join(data, fleet, slot, index, node)) continue;
        if (is_gathered(data.pair, node)) {
            const Int ends = num_pickups(data.pair, node) + 1;
            if (allows_stops(data.type[k], stops_on(trip) + ends)) {
                scan_parts(insertion, slot, trip, walked);
            }
        } else if (allows_stops(data.type[k], stops_on(trip) + ends_of_pair)) {
            PairScan scan(insertion, slot, trip);
            walked ? scan.walk() : scan.time_cheapest();
        }
        scan_flown(insertion, slot, trip);
    }
}

void scan_pair_beside(const Insertion& insertion) {
    const auto& [data, searcher, node, enlarge, best] = insertion;
    const Fleet& fleet = searcher.now;
    const View<Int, 1> seen = searcher.scratch->moved;
    Int found = 0;
    const auto look_beside = [&](Int end) {
        for (const Int other : data.granular[end]) {
            if (other < 0) break;
            const Int slot = fleet.where[other].slot;
            if (slot < 0 || std::find(&seen[0], &seen[0] + found, slot) != &seen[0] + found) {
                continue;
            }
            seen[found++] = slot;
            scan_pair(insertion, slot);
        }
    };
    for_each_pickup(data.pair, node, look_beside);
    look_beside(data.pair[node].partner);
}

}  // namespace tandem
