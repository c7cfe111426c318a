// What vehicles and drones hold: amounts, in all dimensions at once, goods.
//
// Amounts are looked at three dimensions at a time, a tier. Mostly there is no more than one, and
// what is aboard where a trip begins is the most that ever is: then nothing but `Node` is asked.
// Where somebody has something to be picked up, or there are more dimensions, what each stop asks
// for is a row for each tier (`Instance.amount`), and what is aboard around each stop of a trip a
// `StopLoad`.
#pragma once

#include "rules/window.h"

namespace tandem {

// What is aboard around a stop of a trip, of one tier; sums are over all dimensions.
struct StopLoad {
    Int leaves;     // sum of the parcels that leave the truck there
    Int comes;      // sum of what comes aboard there
    Int stacks;     // shipments that come aboard, less those that leave
    Int picked;     // sum of what was picked up before, and of a stack the shipments on it
    Int due;        // sum of what is delivered behind, and likewise
    Int given;      // sum of what is delivered on the whole trip
    Int driven;     // how far the trip has come
    Int aboard[3];  // on leaving
    Int leaving[3];
    Int coming[3];
    Int before[3];  // the most that is aboard before the stop
    Int behind[3];  // likewise, from leaving it on
};

using Amount = std::array<Int, 3>;  // by dimension of one tier

constexpr Amount nothing = {0, 0, 0};

// What a part of a trip or a sortie delivers and picks up, and the most that is aboard of both, in
// one tier; sums over all dimensions of what it delivers, and of what it picks up.
struct Cargo {
    Amount delivered, picked, most;
    Int total_delivered, total_picked;
};

constexpr Cargo no_cargo = {nothing, nothing, nothing, 0, 0};

// An amount that stands in a row.
inline Amount amount_of(const Int* row) { return {row[0], row[1], row[2]}; }

// Writes an amount into a row.
inline void write_amount(const Amount& amount, Int* row) {
    std::copy(amount.begin(), amount.end(), row);
}

// When a customer's parcel is at the depot.
inline Int release_of(Windows place) { return place.node().release; }

// Whether some goods must not go with others, by the rows of all nodes.
inline bool some_apart(View<const Goods, 1> goods) { return !goods.empty(); }

// Whether a customer's goods may go with all that bars these.
inline bool go_together(const Goods& goods, Int barred_on_trip, Int barred_on_vehicle) {
    return (goods.held & (barred_on_trip | barred_on_vehicle)) == 0;
}

// Which goods must not go on a trip with a customer's.
inline Int barred_on_trip(const Goods& goods) { return goods.barred_on_trip; }

// Which goods must not go by the vehicle that brings a customer's.
inline Int barred_on_vehicle(const Goods& goods) { return goods.barred_on_vehicle; }

// Whether some parcels may be aboard for so long and no longer, by the limits of all.
inline bool some_limited(View<const Int, 1> max_time_aboard) { return !max_time_aboard.empty(); }

// By how much a parcel is too long aboard whose service starts at `start`, and whose trip has left
// the depot at `departure`.
inline Int excess_aboard(View<const Int, 1> max_time_aboard, Int node, Int departure, Int start) {
    return start - departure - max_time_aboard[node];
}

// What a customer's parcel takes, in the first tier.
inline Amount demand_of(Windows place) { return amount_of(place.node().demand); }

// How many tiers loads have to be looked at in at each stop; 0 if that isn't needed.
inline Int num_tiers(const View<const Int, 3>& amounts) { return amounts.shape(1); }

// What is delivered at a node.
inline Amount delivered_of(const View<const Int, 3>& amounts, Int node, Int tier) {
    return amount_of(&amounts(node, tier, 0));
}

// What is picked up at a node.
inline Amount picked_of(const View<const Int, 3>& amounts, Int node, Int tier) {
    return amount_of(&amounts(node, tier, 3));
}

// The sum over all dimensions of what is delivered at a node.
inline Int total_delivered(const View<const Int, 3>& amounts, Int node) {
    return amounts(node, 0, 6);
}

// The sum over all dimensions of what is picked up at a node.
inline Int total_picked(const View<const Int, 3>& amounts, Int node) { return amounts(node, 0, 7); }

// What a customer's parcel weighs, by the drones' table of nodes.
inline Int weight_brought(Windows place) { return place.node().demand[0]; }

// What weighs of that which is picked up at a customer, likewise.
inline Int weight_taken(Windows place) { return place.node().demand[1]; }

// What a truck's drone brings to a customer weighs, and what it takes back. A shipment that it
// delivers comes from the truck.
inline Int weight_flown_out(Windows place) {
    return weight_brought(place) - std::min(weight_taken(place), Int{0});
}
inline Int weight_flown_back(Windows place) { return std::max(weight_taken(place), Int{0}); }

// What a vehicle of a type holds, in the first tier.
inline Amount capacity_of(const VehicleType& type) { return amount_of(type.capacity); }

// What a vehicle of a type holds.
inline Amount capacity_in(const VehicleType& type, Int tier) {
    return amount_of(type.capacity + dimensions_per_tier * tier);
}

// What a type's drone lifts.
inline Amount payload_in(const VehicleType& type, Int tier) {
    return amount_of(type.payload + dimensions_per_tier * tier);
}

// The sum of two amounts.
inline Amount plus(const Amount& one, const Amount& other) {
    return {one[0] + other[0], one[1] + other[1], one[2] + other[2]};
}

// What is left of an amount.
inline Amount minus(const Amount& one, const Amount& other) {
    return {one[0] - other[0], one[1] - other[1], one[2] - other[2]};
}

// The larger of two amounts in each dimension.
inline Amount larger(const Amount& one, const Amount& other) {
    return {std::max(one[0], other[0]), std::max(one[1], other[1]), std::max(one[2], other[2])};
}

// The smaller of two amounts in each dimension.
inline Amount smaller(const Amount& one, const Amount& other) {
    return {std::min(one[0], other[0]), std::min(one[1], other[1]), std::min(one[2], other[2])};
}

// The sum over dimensions, for comparisons.
inline Int total(const Amount& amount) { return amount[0] + amount[1] + amount[2]; }

// Whether an amount is no more than another in any dimension.
inline bool within(const Amount& one, const Amount& limit) {
    return one[0] <= limit[0] && one[1] <= limit[1] && one[2] <= limit[2];
}

// Whether a vehicle of a type holds a load, in the first tier.
inline bool holds(const VehicleType& type, const Amount& load) {
    return within(load, capacity_of(type));
}

// Whether a vehicle of a type holds a load.
inline bool holds_in(const VehicleType& type, const Amount& load, Int tier) {
    return within(load, capacity_in(type, tier));
}

// Whether a vehicle of a type holds a customer's parcel on top of a load.
inline bool fits(const VehicleType& type, const Amount& load, Windows place) {
    return holds(type, plus(load, demand_of(place)));
}

// Whether a type's drone lifts what a sortie carries.
inline bool lifts(const VehicleType& type, const Amount& payload, Int tier) {
    return within(payload, payload_in(type, tier));
}

// The cargo of serving a customer, where all is delivered before anything is taken.
inline Cargo cargo_for(const View<const Int, 3>& amounts, Int node, Int tier) {
    const Amount delivered = delivered_of(amounts, node, tier);
    const Amount picked = picked_of(amounts, node, tier);
    return {delivered, picked, larger(delivered, picked), total_delivered(amounts, node),
            total_picked(amounts, node)};
}

// The cargo of a stop.
inline Cargo cargo_at(const StopLoad& stop_load) {
    const Amount leaving = amount_of(stop_load.leaving), coming = amount_of(stop_load.coming);
    return {leaving, coming, larger(leaving, coming), stop_load.leaves, stop_load.comes};
}

// The cargo of a part that is followed by another.
inline Cargo followed(const Cargo& one, const Cargo& other) {
    return {plus(one.delivered, other.delivered), plus(one.picked, other.picked),
            larger(plus(one.most, other.delivered), plus(one.picked, other.most)),
            one.total_delivered + other.total_delivered, one.total_picked + other.total_picked};
}

// Whether a vehicle of a type may not deliver an amount once it has picked up another.
inline bool out_of_order(const VehicleType& type, Int picked, Int delivered) {
    return type.pickup_order >= pickups_last && picked > 0 && delivered > 0;
}

// Whether a trip may not pick up an amount since it delivers nothing but what is given.
inline bool comes_first(const VehicleType& type, Int picked, Int given) {
    return type.pickup_order == pickups_last && picked > 0 && given == 0;
}

// Whether a part of a trip may follow another, by what they deliver and pick up.
inline bool may_follow(const VehicleType& type, const Cargo& one, const Cargo& other) {
    return !out_of_order(type, one.total_picked, other.total_delivered);
}

// Whether a vehicle of a type may carry no more than this on a trip.
inline bool may_be_all(const VehicleType& type, const Cargo& cargo, Int tier) {
    return holds_in(type, cargo.most, tier) &&
           !comes_first(type, cargo.total_picked, cargo.total_delivered);
}

// Whether a vehicle of a type may carry on one trip what two parts of it do, one behind the other.
inline bool may_be_joined(const VehicleType& type, const Cargo& one, const Cargo& other, Int tier) {
    return may_follow(type, one, other) && may_be_all(type, followed(one, other), tier);
}

// The cargo of stops in a row, `behind` not among them.
inline Cargo cargo_between(View<const StopLoad, 1> stop_loads, Int first, Int behind) {
    Cargo cargo = no_cargo;
    for (Int p = first; p < behind; ++p) cargo = followed(cargo, cargo_at(stop_loads[p]));
    return cargo;
}

// Lets parcels leave the truck at a stop.
inline void add_left(StopLoad& stop_load, const Amount& amount, Int sum_of_all) {
    write_amount(plus(amount_of(stop_load.leaving), amount), stop_load.leaving);
    stop_load.leaves += sum_of_all;
}

// Lets what was picked up come aboard at a stop.
inline void add_come(StopLoad& stop_load, const Amount& amount, Int sum_of_all) {
    write_amount(plus(amount_of(stop_load.coming), amount), stop_load.coming);
    stop_load.comes += sum_of_all;
}

// Whether only what was loaded last can be unloaded. Then what comes from the depot lies under all
// shipments, and what is brought there must not lie on any, nor on what leaves later.
inline bool is_stack(const VehicleType& type) { return type.lifo != 0; }

// Writes what is aboard at the stops of a trip, `behind` not among them, by what leaves and comes
// aboard at each; both are pointers, or go from stop to stop as those do. False if it is too much,
// picked up too early, or below what a stack has on it.
template <class Stops>
bool weigh_trip(const VehicleType& type, Stops first, Stops behind, Int tier) {
    Amount load = nothing;
    Int given = 0;
    for (Stops at = first; at != behind; ++at) {
        load = plus(load, amount_of(at->leaving));
        given += at->leaves;
    }
    Amount most = load;
    Int due = given, picked = 0, stacked = 0;
    bool in_order = true;
    for (Stops at = first; at != behind; ++at) {
        StopLoad& stop_load = *at;
        write_amount(most, stop_load.before);
        due -= stop_load.leaves;
        stop_load.picked = picked + stacked;
        if (is_stack(type)) stacked += stop_load.stacks;
        stop_load.due = due + stacked;
        in_order = in_order && !out_of_order(type, stop_load.picked, stop_load.leaves) &&
                   !out_of_order(type, stop_load.comes, stacked);
        stop_load.given = given;
        picked += stop_load.comes;
        load = plus(minus(load, amount_of(stop_load.leaving)), amount_of(stop_load.coming));
        write_amount(load, stop_load.aboard);
        write_amount(load, stop_load.behind);
        most = larger(most, load);
    }
    Amount later = load;
    for (Stops at = behind; at != first;) {
        StopLoad& stop_load = *--at;
        later = larger(later, amount_of(stop_load.behind));
        write_amount(later, stop_load.behind);
    }
    return in_order && holds_in(type, most, tier) && !comes_first(type, picked, given);
}

// Whether a customer may be served on a trip on top of all others. The parcel leaves the truck at
// stop `left`, or just before it, and what is picked up comes aboard at stop `came`, or just behind
// it, by `stop_loads` (tier, stop) as they are.
inline bool has_room(const VehicleType& type, const View<const StopLoad, 2>& stop_loads, Int left,
                     Int came, const View<const Int, 3>& amounts, Int node) {
    for (Int tier = 0; tier < stop_loads.size(); ++tier) {
        const Amount before = amount_of(stop_loads(tier, left).before);
        const Amount behind = amount_of(stop_loads(tier, came).behind);
        if (!holds_in(type, plus(before, delivered_of(amounts, node, tier)), tier) ||
            !holds_in(type, plus(behind, picked_of(amounts, node, tier)), tier)) {
            return false;
        }
    }
    if (type.pickup_order == pickups_any) return true;
    const Int delivered = total_delivered(amounts, node), picked = total_picked(amounts, node);
    return !out_of_order(type, stop_loads(0, left).picked, delivered) &&
           !out_of_order(type, picked, stop_loads(0, came).due) &&
           !comes_first(type, picked, stop_loads(0, left).given + delivered);
}

// The most that is aboard at any point of a trip, by its first stop.
inline Amount most_of(const StopLoad& first) {
    return larger(amount_of(first.before), amount_of(first.behind));
}

}  // namespace tandem
