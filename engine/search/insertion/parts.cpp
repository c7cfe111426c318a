#include "search/insertion/parts.h"

#include <algorithm>
#include <array>
#include <utility>

#include "rules/load.h"
#include "rules/pair.h"
#include "search/insertion/cheapest.h"
#include "search/insertion/trip_scan.h"
#include "search/route/refresh.h"
#include "search/route/routes.h"

namespace tandem {
namespace {

constexpr Int most_combined = 256;  // places of all pickups, each alone at its best
constexpr Int most_steps = 20'000;  // pickups tried on one trip

constexpr Int most_orders = 24;  // on a trip of its own: all of four pickups

// How many orders are tried in which a shipment alone is picked up.
Int orders_of(const ProblemData& data, Int pickup) {
    Int orders = 1;
    for (Int count = num_pickups(data.pair, pickup); count > 1; --count) orders *= count;
    return std::min(orders, most_orders);
}

// Writes a route that serves a shipment alone, picked up in one of the orders. In place.
void begin_by_parts(const ProblemData& data, const Sequence& sequence, Int k, Int node, Int order) {
    const Pickups pickups = in_order(pickups_of(data.pair, node), order);
    begin_route(sequence, data.type[k], k, pickups.node[0], by_truck, 0, nowhere);
    for (Int rank = 1; rank < pickups.count; ++rank) {
        insert_stops(sequence, 1 + rank, {{pickups.node[std::size_t(rank)], customer_stop}});
    }
    insert_stops(sequence, 1 + pickups.count, {{data.pair[node].partner, customer_stop}});
}

// How many places are tried for each of so many pickups.
Int places_for_each(Int pickups) {
    Int places = 1, combined = 1;
    while (combined <= most_combined) {
        ++places;
        combined = 1;
        for (Int number = 0; number < pickups; ++number) combined *= places;
    }
    return places - 1;
}

using Newcomers = std::array<Newcomer, most_pickups>;

// What is looked up for each pickup; behind those that there are, for the last.
Newcomers newcomers_for(const ProblemData& data, const VehicleType& type, const Pickups& pickups) {
    const std::size_t last = std::size_t(pickups.count) - 1;
    return [&]<std::size_t... number>(std::index_sequence<number...>) {
        return Newcomers{newcomer_for(data, type, pickups.node[std::min(number, last)])...};
    }(std::make_index_sequence<most_pickups>());
}

// A shipment of several pickups on its way along a trip.
class PartsScan : TripScan {
public:
    PartsScan(const Insertion& insertion, Int of_slot, const Trip& tried, bool is_walked)
        : TripScan(insertion, of_slot, tried),
          is_walked_(is_walked),
          delivery_(newcomer(data.pair[node].partner)),
          pickup_(newcomers_for(data, type, pickups_of(data.pair, node))),
          count_(num_pickups(data.pair, node)),
          stops_cost_(double(count_ + 1) * rate.stop +
                      vehicle_cost_at(data.vehicle_cost, route.type, node)) {}

    void scan() {
        for (Int number = 0; number < count_; ++number) note_limit(number);
        follow({trip.first, none_here, 0, 0, stops[trip.first].leave, 0, 0});
    }

private:
    static constexpr Int none_here = -1;

    // Behind which stop a vehicle is, and at which pickup there; which it has been at, and at how
    // many; when it leaves, how much further it has driven, and how much more is aboard.
    struct Way {
        Int behind, here;
        Int taken, rank;
        Int leave, further, aboard;
    };

    const Newcomer& pickup(Int number) const { return pickup_[std::size_t(number)]; }

    double cost_of(Int further) const { return double(further) * rate.distance + stops_cost_; }

    bool is_too_far(Int further) const { return is_dear(cost_of(further)); }

    // Notes how much further it is at most to a pickup alone where it is tried.
    void note_limit(Int number) {
        Cheapest<Int, most_combined> least(places_for_each(count_));
        for (Int p = trip.first; p < trip.last; ++p) {
            least.add(detour(pickup(number), p).distance);
        }
        limit_[std::size_t(number)] = least.dearest();
    }

    Leg leg_to_pickup(const Way& way, Int number) const {
        if (way.here != none_here) return leg_to(pickup(way.here).onward, pickup(number).node);
        return leg_from(pickup(number).inward, stops[way.behind].node);
    }

    Leg leg_to_delivery(const Way& way) const {
        if (way.here != none_here) return leg_to(pickup(way.here).onward, delivery_.node);
        return leg_from(delivery_.inward, stops[way.behind].node);
    }

    // Whether so much more may be aboard behind a stop, of what is compared first.
    bool holds_more(Int behind, Int aboard) const {
        return fleet.stop_load(slot, 0, behind).load + aboard <= capacity_of(type)[0];
    }

    // Whether a pickup is tried right behind a stop.
    bool is_near(const Way& way, Int number) const {
        if (way.here != none_here) return true;
        return detour(pickup(number), way.behind).distance <= limit_[std::size_t(number)];
    }

    // Takes what is left to be picked up, at all places from here on.
    void follow(Way way) {
        do {
            for (Int number = 0; number < count_; ++number) {
                if ((way.taken >> number & 1) == 0 && is_near(way, number)) take(way, number);
            }
            if (way.rank == count_) deliver(way);
        } while (drive_on(way));
    }

    void take(Way way, Int number) {
        if (++steps_ > most_steps || data.deadline.passed()) return;
        const Leg out = leg_to_pickup(way, number);
        const Newcomer& newcomer = pickup(number);
        way.further += out.distance;
        way.aboard += picked_of(data.amount, newcomer.node, 0)[0];
        if (is_too_far(way.further) || !holds_more(way.behind, way.aboard)) return;
        if (is_walked_ && newcomer.place.too_late(way.leave + out.duration)) return;
        way.leave = newcomer.place.end_of_service(way.leave + out.duration);
        end_[std::size_t(way.rank++)] = picked_behind(way.behind, number);
        way.taken |= Int{1} << number;
        way.here = number;
        follow(way);
    }

    // Drives to the next stop. False if that is the last, or too late, or costs too much.
    bool drive_on(Way& way) const {
        const Stop &stop = stops[way.behind], &next = stops[way.behind + 1];
        if (way.behind + 1 == trip.last) return false;
        ++way.behind;
        if (way.taken == 0) {
            way.leave = next.leave;
            return true;
        }
        Int gap = stop.gap;
        if (way.here != none_here) {
            const Leg on = leg_to(pickup(way.here).onward, next.node);
            way.further += on.distance - stop.leg;
            gap = on.duration;
        }
        way.here = none_here;
        if (is_too_far(way.further) || !holds_more(way.behind, way.aboard)) return false;
        if (!is_walked_) return true;
        if (next.kind != customer_stop || way.leave + gap > next.latest) return false;
        way.leave = data.place.by_truck(type)[next.node].end_of_service(way.leave + gap);
        return true;
    }

    void deliver(const Way& way) {
        const Leg out = leg_to_delivery(way);
        const Stop &stop = stops[way.behind], &next = stops[way.behind + 1];
        const Int on = distance_to(delivery_.onward, next.node) - stop.leg;
        if (is_too_far(way.further + out.distance + on)) return;
        if (is_walked_ && delivery_.place.too_late(way.leave + out.duration)) return;
        Move move = move_of(all_ends, end_[0] / most_pickups, way.behind);
        std::copy(end_.begin(), end_.end(), move.end);
        best.try_move(price_move(data, fleet, move, node, best.cost), move);
    }

    const bool is_walked_;
    const Newcomer delivery_;
    const Newcomers pickup_;
    const Int count_;
    const double stops_cost_;
    std::array<Int, most_pickups> limit_{};
    Int steps_ = 0;
    std::array<std::int32_t, most_pickups> end_{};
};

}  // namespace

void scan_parts(const Insertion& insertion, Int slot, const Trip& trip, bool is_walked) {
    PartsScan(insertion, slot, trip, is_walked).scan();
}

void try_parts_trip(const Insertion& insertion, Int slot, Int behind) {
    const auto& [data, searcher, node, enlarge, best] = insertion;
    const Fleet& fleet = searcher.now;
    Pickups numbers{{}, num_pickups(data.pair, node)};
    for (Int number = 0; number < numbers.count; ++number)
        numbers.node[std::size_t(number)] = number;
    Move move{};
    move.kind = parts_trip;
    move.slot = slot;
    move.first = behind;
    move.type = fleet.route[slot].type;
    for (Int order = 0; order < orders_of(data, node); ++order) {
        Int rank = 0;
        for (const Int number : in_order(numbers, order)) {
            move.end[rank++] = picked_behind(behind + 1, number);
        }
        best.try_move(price_move(data, fleet, move, node, best.cost), move);
    }
}

bool serve_parts_alone(const ProblemData& data, const Fleet& fleet, Int slot, Int k, Int node) {
    const Sequence sequence = sequence_in(fleet, slot);
    double best = infeasible;
    Int chosen = 0;
    for (Int order = 0; order < orders_of(data, node); ++order) {
        begin_by_parts(data, sequence, k, node, order);
        if (!refresh(data, fleet, slot) || fleet.cost[slot] >= best) continue;
        best = fleet.cost[slot];
        chosen = order;
    }
    begin_by_parts(data, sequence, k, node, chosen);
    return refresh(data, fleet, slot);
}

}  // namespace tandem
