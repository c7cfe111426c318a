#include <utility>

#include "search/insertion/shipments.h"
#include "search/insertion/trip_scan.h"

namespace tandem {
namespace {

constexpr Int most_combined = 256;  // places of all pickups, each alone at its best
constexpr Int most_steps = 20'000;  // pickups tried on one trip

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
        for (Int p = trip.first; p < trip.last; ++p) {
            if (is_walked_ && stops[p].flying > 0) continue;
            take_others({Proposal<RarerRules>(*this, p, inserted_)});
        }
    }

private:
    static constexpr Int none_here = -1;

    // How a vehicle has come behind a stop, and to which pickup there; which it has been at, and at
    // how many; how much more is aboard.
    struct PickupLabel {
        Proposal<RarerRules> on;
        Int here = none_here, taken = 0, rank = 0, aboard = 0;
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

    // The leg to an end from where a vehicle is.
    Leg leg_to_end(const PickupLabel& way, const Newcomer& end) const {
        if (way.here != none_here) return leg_to(pickup(way.here).onward, end.node);
        return leg_from(end.inward, stops[way.on.behind()].node);
    }

    // Whether so much more may be aboard behind a stop, of what is compared first.
    bool holds_more(Int behind, Int aboard) const {
        return fleet.stop_load(slot, 0, behind).aboard[0] + aboard <= capacity_of(type)[0];
    }

    // Whether a pickup is tried right behind a stop.
    bool is_near(const PickupLabel& way, Int number) const {
        if (way.here != none_here) return true;
        return detour(pickup(number), way.on.behind()).distance <= limit_[std::size_t(number)];
    }

    // Takes each pickup that is left.
    void take_others(const PickupLabel& way) {
        for (Int number = 0; number < count_; ++number) {
            if ((way.taken >> number & 1) == 0 && is_near(way, number)) take(way, number);
        }
    }

    // Takes a pickup, and what is left then at all places from here on.
    void take(PickupLabel way, Int number) {
        if (++steps_ > most_steps || data.deadline.passed()) return;
        const Newcomer& newcomer = pickup(number);
        const bool is_served = way.on.serve(newcomer, leg_to_end(way, newcomer));
        way.aboard += picked_of(data.amount, newcomer.node, 0)[0];
        if (is_too_far(way.on.further()) || !holds_more(way.on.behind(), way.aboard)) return;
        if (!is_served && is_walked_) return;
        const Int rank = way.rank++;
        served_[std::size_t(rank)] = {newcomer.node, way.on.behind() + 1 + rank};
        way.taken |= Int{1} << number;
        way.here = number;
        do {
            take_others(way);
            if (way.rank == count_) deliver(way);
        } while (drive_on(way));
    }

    // Drives to the next stop. False if that is the last, or too late, or costs too much.
    bool drive_on(PickupLabel& way) const {
        const Int behind = way.on.behind(), first = behind + 1;
        const Int last = is_walked_ ? stops[first].last : first;
        if (last == trip.last) return false;
        const Leg on = way.here == none_here ? Leg{stops[behind].gap, stops[behind].leg}
                                             : leg_to(pickup(way.here).onward, stops[first].node);
        way.here = none_here;
        for (Int q = first; q <= last; ++q) {
            if (!holds_more(q, way.aboard)) return false;
        }
        if (!is_walked_) {
            way.on.skip(on);
        } else if (!way.on.pass(on)) {
            return false;
        }
        return !is_too_far(way.on.further());
    }

    void deliver(const PickupLabel& way) {
        Proposal<RarerRules> whole = way.on;
        const Int behind = whole.behind();
        const Leg on = leg_to(delivery_.onward, stops[behind + 1].node);
        const bool is_served = whole.serve(delivery_, leg_to_end(way, delivery_));
        if (is_too_far(whole.further() + on.distance - stops[behind].leg)) return;
        if (is_walked_ && (!is_served || whole.price(on, stops_cost_) >= best.cost)) return;
        Move move{};
        move_between(move, served_[0].stop - 1, behind + 1);
        for (Int rank = 0; rank < count_; ++rank) {
            const auto [served, stop] = served_[std::size_t(rank)];
            move.add(How::serve, served, stop);
        }
        move.add(How::serve, delivery_.node, behind + 1 + count_);
        best.try_move(price_move(data, fleet, move, node, best.cost), move);
    }

    const bool is_walked_;
    const Newcomer delivery_;
    const Newcomers pickup_;
    const Int count_;
    const double stops_cost_;
    std::array<Int, most_pickups> limit_{};
    Int steps_ = 0;
    // Which pickups a vehicle has been at, and as which stops of the changed route.
    struct VisitedPickups {
        Int node, stop;
    };
    std::array<VisitedPickups, most_pickups> served_{};
    Inserted inserted_;
};

}  // namespace

void scan_parts(const Insertion& insertion, Int slot, const Trip& trip, bool is_walked) {
    PartsScan(insertion, slot, trip, is_walked).scan();
}

}  // namespace tandem
