#include "search/beginning/savings.h"

#include "rules/flown_trip.h"
#include "search/neighbourhood/tables.h"
#include "search/route/routes.h"

namespace tandem {

namespace {

// How fast a type drives from where its routes begin, in mm per ms.
double speed_of(const ProblemData& data, const VehicleType& type) {
    const TravelLegs legs = legs_of(data.leg, type.travel);
    double distance = 0.0, duration = 0.0;
    for (Int node = data.num_depots; node < data.num_nodes; ++node) {
        const Leg way = leg(legs, type.begins_at, node);
        distance += double(way.distance);
        duration += double(way.duration);
    }
    return duration > 0.0 ? distance / duration : 0.0;
}

// Chains that are joined to routes of one type.
struct Chains {
    const VehicleType& type;
    TravelLegs legs;
    NodeTable places;
    View<Chain, 1> chain;
};

// Two routes that may become one: it would go on from `a`, the last of that which begins with
// `head`, to `b`, the first of that which ends with `tail`; the drive from one to the other takes
// `way`.
struct Joint {
    Int a, b, head, tail, way;
};

// Lets a chain be one customer.
void set_up_chain(const Chains& chains, Int node) {
    const auto& [type, legs, places, chain] = chains;
    const Windows place = places[node];
    Front front{std::max(leaves_first(type, type.shift_earliest), release_of(place))};
    front.serve(place, leg(legs, type.begins_at, node).duration);
    Rear rear{last_end(type)};
    rear.serve(place, leg(legs, node, type.ends_at).duration);
    chain[node] = {
        .before = nowhere,
        .behind = nowhere,
        .route = node,
        .leave = front.time,
        .latest = rear.latest,
        .last = node,
        .length = 1,
        .busy = place.service_duration(),
        .legs = {},
    };
}

// How long a vehicle works at least that drives two routes as one.
Int working(const Chains& chains, const Joint& joint) {
    const auto& [type, legs, places, chain] = chains;
    const auto& [a, b, head, tail, way] = joint;
    const Int latest = std::min(chain[head].latest, chain[b].latest - way - chain[head].busy);
    const Int leaves = std::max(chain[tail].leave, chain[a].leave + way + chain[b].busy);
    const Int busy = std::max(chain[head].busy + way + chain[b].busy, leaves - latest);
    return leg(legs, type.begins_at, head).duration + busy + leg(legs, tail, type.ends_at).duration;
}

// Tells whether a vehicle may drive all legs of two routes as one.
bool may_drive_as_one(const ProblemData& data, const Chains& chains, const Joint& joint) {
    const VehicleType& type = chains.type;
    return !limits_legs(type) ||
           may_drive_all(type, leg_between(data, type, type.begins_at, joint.head) +
                                   chains.chain[joint.head].legs +
                                   leg_between(data, type, joint.a, joint.b) +
                                   chains.chain[joint.b].legs +
                                   leg_between(data, type, joint.tail, type.ends_at));
}

// Returns how much later who flies by itself has to begin two routes as one trip than at `start`,
// for calm; `far` if that doesn't help. `weight` is aboard at first.
Int delay_as_one(const ProblemData& data, const Chains& chains, const Joint& joint, Int weight,
                 Int start) {
    const auto& [type, legs, places, chain] = chains;
    const NodeTable weighed = data.place.by_air(type);
    const auto behind = [&](Int node) { return node == joint.a ? joint.b : chain[node].behind; };
    FlownTrip trip(type, weight);
    Front front{start};
    Int here = type.begins_at;
    Int zones = zones_at(data.zones, type.begins_at) | zones_at(data.zones, type.ends_at);
    for (Int node = joint.head; node != nowhere; node = behind(node)) {
        const Int way = leg(legs, here, node).duration;
        front.drive(way);
        trip.fly_to(weighed[node], way, node == joint.head, weighed[node].waiting(front.time));
        if (!front.serve(places[node])) return far;
        zones |= zones_at(data.zones, node);
        here = node;
    }
    const Int home = leg(legs, here, type.ends_at).duration;
    trip.fly_home(home, false);
    front.drive(home);
    const bool done = may_end(type, front.time) && front.time - start <= longest_in_air(type) &&
                      (!is_limited(type) || trip.left() >= 0);
    return done ? wait_for_calm(type, start, front.time, zones) : far;
}

// Tells whether who flies by itself may fly two routes as one trip, as soon as all parcels are
// there and it is calm.
bool flies_as_one(const ProblemData& data, const Chains& chains, const Joint& joint) {
    Int weight = 0, start = chains.type.shift_earliest;
    const NodeTable weighed = data.place.by_air(chains.type);
    for (Int node = joint.head; node != nowhere;
         node = node == joint.a ? joint.b : chains.chain[node].behind) {
        weight += weight_brought(weighed[node]);
        start = std::max(start, release_of(chains.places[node]));
    }
    while (true) {
        const Int delay = delay_as_one(data, chains, joint, weight, start);
        if (delay == 0 || delay == far) return delay == 0;
        start += delay;
    }
}

// Puts the route that begins with `b` behind that which ends with `a`.
void link_up(const Chains& chains, const Joint& joint) {
    const auto& [type, legs, places, chain] = chains;
    const auto& [a, b, head, tail, way] = joint;
    chain[a].behind = b;
    chain[b].before = a;
    chain[head].last = tail;
    chain[tail].route = head;
    Front front{chain[a].leave + way};
    for (Int node = b; node != nowhere;) {
        const Int behind = chain[node].behind;
        front.serve(places[node]);
        chain[node].leave = front.time;
        if (behind != nowhere) front.drive(leg(legs, node, behind).duration);
        node = behind;
    }
    Rear rear{chain[b].latest - way};
    for (Int node = a; node != nowhere;) {
        const Int before = chain[node].before;
        rear.serve(places[node]);
        chain[node].latest = rear.latest;
        if (before != nowhere) rear.drive(leg(legs, before, node).duration);
        node = before;
    }
}

}  // namespace

ChainCargo::ChainCargo(const ProblemData& data)
    : chain({data.num_nodes}), cargo({data.num_nodes, std::max(Int{1}, tiers_of(data))}) {}

void ChainCargo::write(const Beside& beside) const {
    for (Int node = 0; node < chain.size(); ++node) {
        beside(0, node) = chain[node].before;
        beside(1, node) = chain[node].behind;
    }
}

Int length_of(const ProblemData& data, Int k, const Beside& beside) {
    const VehicleType& type = data.type[k];
    const TravelLegs legs = legs_of(data.leg, type.travel);
    Int length = 0;
    for (Int node = data.num_depots; node < data.num_nodes; ++node) {
        if (!data.can(k, 0, node)) continue;
        const Int behind = beside(1, node);
        if (beside(0, node) == nowhere) length += leg(legs, type.begins_at, node).distance;
        length += leg(legs, node, behind == nowhere ? type.ends_at : behind).distance;
    }
    return length;
}

void write_nearest_types(const ProblemData& data, View<Int, 1> nearest) {
    for (Int node = data.num_depots; node < data.num_nodes; ++node) {
        Int least = -1;
        for (Int k = 0; k < data.num_types; ++k) {
            if (!data.can(k, 0, node)) continue;
            const VehicleType& type = data.type[k];
            const TravelLegs legs = legs_of(data.leg, type.travel);
            const Int way =
                leg(legs, type.begins_at, node).distance + leg(legs, node, type.ends_at).distance;
            if (least < 0 || way < least) {
                least = way;
                nearest[node] = k;
            }
        }
    }
}

void write_excess(const ProblemData& data, Int k, Int ranks, View<Int, 1> excess) {
    const VehicleType& type = data.type[k];
    const TravelLegs legs = legs_of(data.leg, type.travel);
    const NodeTable places = data.place.by_truck(type);
    const double speed = speed_of(data, type);
    std::ranges::fill(excess, 0);
    for (Int a = data.num_depots; a < data.num_nodes; ++a) {
        data.deadline.go_on_late();
        if (!data.can(k, 0, a)) continue;
        const Int to_end = leg(legs, a, type.ends_at).distance;
        const Int leaves = places[a].end_of_service(0);
        const Int leaves_last = places[a].end_of_service(places[a].closing());
        const Int first = (a - data.num_depots) * ranks;
        for (Int rank = 0; rank < ranks; ++rank) {
            const Int b = data.near(a, rank);
            if (b < 0 || !data.can(k, 0, b)) continue;
            const Leg way = leg(legs, a, b);
            const double more = detour(way.duration, double(leaves), double(leaves_last),
                                       double(places[b].opening(0)), double(places[b].closing())) -
                                double(way.duration);
            excess[first + rank] =
                way.distance + Int(more * speed) - to_end - leg(legs, type.begins_at, b).distance;
        }
    }
}

void number_pairs(View<Int, 1> excess) {
    constexpr Int most_bits = 62;  // of a key
    std::uint64_t largest = 0, size = std::uint64_t(excess.size());
    for (const Int each : excess) largest = std::max(largest, std::uint64_t(std::abs(each)));
    const Int bits = Int(std::bit_width(largest)) + Int(std::bit_width(size));
    const Int coarse = std::max(Int{0}, bits - most_bits);
    for (Int index = 0; index < excess.size(); ++index) {
        excess[index] = (excess[index] >> coarse) * excess.size() + index;
    }
}

Neighbours pair(const ProblemData& data, Int ranks, Int key) {
    const Int pairs = (data.num_nodes - data.num_depots) * ranks;
    // The number of the pair, whether the key is below zero or not.
    const Int index = (key % pairs + pairs) % pairs;
    const Int customer = data.num_depots + index / ranks;
    return {customer, data.near(customer, index % ranks)};
}

void set_up_cargo(const ProblemData& data, Int node, View<Cargo, 1> cargo) {
    if (tiers_of(data) == 0) {
        const Amount demand = demand_of(data.place[0][node]);
        cargo[0] = {demand, nothing, demand, total(demand), 0};
    }
    for (Int tier = 0; tier < tiers_of(data); ++tier) {
        cargo[tier] = cargo_for(data.amount, node, tier);
    }
}

bool may_join(const VehicleType& type, View<const Cargo, 1> front, View<const Cargo, 1> rear) {
    for (Int tier = 0; tier < front.size(); ++tier) {
        const Cargo& one = front[tier];
        const Cargo& other = rear[tier];
        if (!may_follow(type, one, other) || !holds_in(type, followed(one, other).most, tier)) {
            return false;
        }
    }
    return true;
}

void add_cargo(View<Cargo, 1> front, View<const Cargo, 1> rear) {
    for (Int tier = 0; tier < front.size(); ++tier) {
        front[tier] = followed(front[tier], rear[tier]);
    }
}

void join(const ProblemData& data, Int k, Int ranks, View<const Int, 1> keys,
          const Beside& beside) {
    const ChainCargo joining(data);
    const auto& [chain, cargo] = joining;
    const VehicleType& type = data.type[k];
    const Chains chains{type, legs_of(data.leg, type.travel), data.place.by_truck(type), chain};
    for (Int node = data.num_depots; node < data.num_nodes; ++node) {
        set_up_chain(chains, node);
        set_up_cargo(data, node, cargo[node]);
    }
    for (const Int key : keys) {
        data.deadline.go_on_late();
        const auto [a, b] = pair(data, ranks, key);
        const Int way = leg(chains.legs, a, b).duration;
        if (chain[a].behind != nowhere || chain[b].before != nowhere ||
            chain[a].leave + way > chain[b].latest) {
            continue;
        }
        const Joint joint{a, b, chain[a].route, chain[b].last, way};
        Chain& head = chain[joint.head];
        const Int length = head.length + chain[b].length;
        if (joint.head == b || !allows_stops(type, length) ||
            !may_join(type, cargo[joint.head], cargo[b]) ||
            !may_work(type, working(chains, joint)) || !may_drive_as_one(data, chains, joint) ||
            (flies(type) && !flies_as_one(data, chains, joint))) {
            continue;
        }
        head.busy += way + chain[b].busy;
        head.legs = head.legs + leg_between(data, type, a, b) + chain[b].legs;
        link_up(chains, joint);
        head.length = length;
        add_cargo(cargo[joint.head], cargo[b]);
    }
    joining.write(beside);
}

}  // namespace tandem

using namespace tandem;

extern "C" int tandem_write_nearest_types(const tandem_problem_data* data,
                                          const tandem_i64_1d* nearest) {
    return guarded([&] { write_nearest_types(data_of(*data), *nearest); });
}

extern "C" int tandem_write_pairs(const tandem_problem_data* data, int64_t k, int64_t ranks,
                                  const tandem_i64_1d* keys) {
    return guarded([&] {
        write_excess(data_of(*data), k, ranks, *keys);
        number_pairs(*keys);
    });
}

extern "C" int tandem_join(const tandem_problem_data* data, int64_t k, int64_t ranks,
                           const tandem_i64_1d* keys, bool either_way, const tandem_i64_2d* beside,
                           int64_t* length) {
    return guarded([&] {
        const ProblemData problem = data_of(*data);
        if (either_way) {
            join_either_way(problem, k, ranks, *keys, *beside);
        } else {
            join(problem, k, ranks, *keys, *beside);
        }
        *length = length_of(problem, k, *beside);
    });
}
