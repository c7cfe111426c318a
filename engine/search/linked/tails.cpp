#include "search/linked/aboard.h"
#include "search/linked/chain.h"
#include "search/linked/turn.h"
#include "search/moves/exchanges.h"
#include "search/route/refresh.h"

namespace tandem {

namespace {

// Whether type `k` may serve a customer and all who come behind.
bool may_serve(const ProblemData& data, const Linked& linked, Int k, Int node) {
    for (; node >= data.num_depots; node = linked.link[node].behind) {
        if (!data.can(k, 0, node)) return false;
    }
    return true;
}

// Whether `other` may come behind a customer, who now does behind `before`: on routes of one type
// `k`, so that all are to be reached as late as now.
bool come_in_time(const ProblemData& data, const Linked& linked, Int k, Int node, Int before,
                  Int other) {
    const VehicleType& type = data.type[k];
    const TravelLegs legs = legs_of(data.leg, type.travel);
    const Int after = linked.link[node].behind;
    const auto goes_on = [&](Int from, Int to) {
        Front front = front_at(data, linked, type, from);
        front.drive(leg(legs, from, to).duration);
        return rear_at(data, linked, type, to).allows(front);
    };
    return goes_on(node, other) &&
           ((before < data.num_depots && after < data.num_depots) || goes_on(before, after));
}

// Whether a vehicle of type `k` may drive from a stop to a customer and all behind; `node` is a
// depot if there are none.
bool drives_in_time(const ProblemData& data, const Linked& linked, Int k, Int before, Int node) {
    const VehicleType& type = data.type[k];
    const TravelLegs legs = legs_of(data.leg, type.travel);
    const NodeTable places = data.place.by_truck(type);
    Front front = front_at(data, linked, type, before);
    for (; node >= data.num_depots; node = linked.link[node].behind) {
        if (!front.serve(places[node], leg(legs, before, node).duration)) return false;
        before = node;
    }
    return may_end(type, front.time + leg(legs, before, type.ends_at).duration);
}

// How much longer a route's last leg is to where routes of type `k` end.
Int longer_home(const ProblemData& data, const Linked& linked, Int slot, Int k) {
    const Int last = linked.run[slot].last;
    const LegRow onward = legs_from(data.leg, data.type[k].travel, last);
    return distance_to(onward, data.type[k].ends_at) - linked.link[last].onward;
}

// How far a route is driven from a customer on, and how many there are from there on.
struct Rest {
    Int distance, customers;
};

Rest tail_from(const ProblemData& data, const Linked& linked, Int node) {
    Rest rest{0, 0};
    for (; node >= data.num_depots; node = linked.link[node].behind) {
        rest.distance += linked.link[node].onward;
        ++rest.customers;
    }
    return rest;
}

// A customer whose tail is swapped, the legs from there, and to who comes behind.
struct Cutting {
    Int node;
    LegRow here, to_after;
};

// What it costs to swap the tails behind a customer and before another.
double cost_of_swap(const ProblemData& data, const Linked& linked, const Cutting& cut, Int other) {
    const View<Link, 1> link = linked.link;
    const Int after = link[cut.node].behind;
    const Int a = link[cut.node].slot;
    const Int b = link[other].slot;
    const Int before = link[other].before;
    const Int k = linked.run[a].type;
    const Int by = linked.run[b].type;
    const Rate& rate = data.rate[k];
    const Rate& rate_by = data.rate[by];
    Int more = distance_to(cut.here, other) - link[cut.node].onward;
    Int more_by = -link[other].inward;
    if (data.type[by].ends_at != data.type[k].ends_at) {
        more += longer_home(data, linked, b, k);
        if (after >= data.num_depots) more_by += longer_home(data, linked, a, by);
    }
    if (after >= data.num_depots) {
        more_by += distance_from(cut.to_after, before);
    } else if (before >= data.num_depots) {
        const LegRow onward = legs_from(data.leg, data.type[by].travel, before);
        more_by += distance_to(onward, data.type[by].ends_at);
    }
    double cost = double(more) * rate.distance + double(more_by) * rate_by.distance;
    if (rate.distance != rate_by.distance || rate.stop != rate_by.stop) {
        const Rest tail = tail_from(data, linked, after);
        const Rest other_tail = tail_from(data, linked, other);
        cost += double(other_tail.distance - tail.distance) * (rate.distance - rate_by.distance) +
                double(other_tail.customers - tail.customers) * (rate.stop - rate_by.stop);
    }
    if (after < data.num_depots && before < data.num_depots) cost -= rate_by.fixed;
    return cost;
}

// Whether vehicles of types `k` and `by` may carry what they do once the tails behind `node` and
// before `other` are swapped, by what is aboard alone.
bool may_carry_swapped(const ProblemData& data, const Linked& linked, Int k, Int node, Int by,
                       Int other) {
    const bool is_new = other < data.num_depots;
    const Int before = is_new ? data.type[by].begins_at : linked.link[other].before;
    return may_carry_both(data, linked, data.type[k], node, other) &&
           may_carry_both(data, linked, data.type[by], before, linked.link[node].behind);
}

// The slot whose tail is best swapped, `nowhere` if none is, who leads that, and what it costs.
struct Tail {
    Int slot, leader;
    double cost;
};

// Finds the tail that is best swapped with that behind a customer, for less than `limit`; an empty
// slot, led by the end of its route, for a new one.
Tail find_tail_linked(const ProblemData& data, const Searcher& searcher, const Linked& linked,
                      Int node, double limit) {
    const View<Link, 1> link = linked.link;
    const Int a = link[node].slot;
    const Int after = link[node].behind;
    const Int k = linked.run[a].type;
    const VehicleType& type = data.type[k];
    const Cutting cut{node, legs_from(data.leg, type.travel, node),
                      legs_to(data.back, type.travel, after)};
    Tail best{nowhere, nowhere, limit};
    const Int ranks = std::min(tail_neighbours, data.near.shape(1));
    for (Int rank = 0; rank < ranks; ++rank) {
        const Int other = data.near(node, rank);
        if (other < 0) break;
        const Int b = link[other].slot;
        if (b < 0 || b == a) continue;
        const Int by = linked.run[b].type;
        if (by != k && !data.splice(k, by)) continue;
        const double cost = cost_of_swap(data, linked, cut, other);
        if (cost >= best.cost) continue;
        if (by != k && !(may_serve(data, linked, k, other) && may_serve(data, linked, by, after))) {
            continue;
        }
        // Where it matters who comes when, few tails fit: look for one that does.
        if (looks_aboard(linked) && !may_carry_swapped(data, linked, k, node, by, other)) continue;
        if (by != k || !linked.timed ||
            come_in_time(data, linked, k, node, link[other].before, other)) {
            best = {b, other, cost};
        }
    }
    if (after >= data.num_depots) {
        const Int detour = distance_to(cut.here, type.ends_at) - link[node].onward +
                           distance_from(cut.to_after, type.begins_at);
        const double cost = data.rate[k].fixed + double(detour) * data.rate[k].distance;
        const Int slot = free_slot(data, searcher, k);
        if (slot >= 0 && cost < best.cost &&
            (!linked.timed || come_in_time(data, linked, k, node, type.begins_at, type.ends_at))) {
            return {slot, type.ends_at, cost};
        }
    }
    return best;
}

// Customers in a row on a route.
struct LinkedRow {
    Amount load;
    Int customers;
    Int distance;  // up to the last of them: of a head from the depot, of a tail from its first
};

// The part of a route up to a customer, none if that is a depot.
LinkedRow head_until(const ProblemData& data, const Linked& linked, Int node) {
    LinkedRow head{nothing, 0, 0};
    for (; node >= data.num_depots; node = linked.link[node].before) {
        head.load = plus(head.load, demand_of(data.place[0][node]));
        ++head.customers;
        head.distance += linked.link[node].inward;
    }
    return head;
}

// The part of a route behind its head, which a customer leads, none if a depot does.
LinkedRow tail_behind(const ProblemData& data, const Linked& linked, const Run& run,
                      const LinkedRow& head, Int first) {
    if (first < data.num_depots) return {nothing, 0, 0};
    const Int around = linked.link[first].inward + linked.link[run.last].onward;
    return {minus(amount_of(run.load), head.load), run.count - head.customers,
            run.distance - head.distance - around};
}

// Lets a customer and all who come behind be served by the route in a slot.
void assign(const ProblemData& data, Linked& linked, Int node, Int slot) {
    for (; node >= data.num_depots; node = linked.link[node].behind) {
        linked.link[node].slot = slot;
    }
}

// Another route's tail, from its first customer to its last.
struct NewTail {
    LinkedRow part;
    Int first, last;
};

// Lets a route go on behind its head, which `before` ends, with another's tail.
void end_with(const ProblemData& data, Linked& linked, Int slot, const LinkedRow& head, Int before,
              const NewTail& tail) {
    Run& run = linked.run[slot];
    const Int end = data.type[run.type].ends_at;
    const bool has_tail = tail.part.customers > 0;
    assign(data, linked, tail.first, slot);
    run.distance = head.distance + tail.part.distance;
    run.distance += connect(data, linked, slot, before, has_tail ? tail.first : end);
    if (has_tail) run.distance += connect(data, linked, slot, tail.last, end);
    run.count = head.customers + tail.part.customers;
    write_amount(plus(head.load, tail.part.load), run.load);
    if (linked.timed) {
        drive_on(data, linked, slot, tail.first, 1);
        look_back(data, linked, slot, run.last, tail.part.customers + 1);
    }
}

// Lets `other`, of the route in slot `b`, come behind a customer, whose tail ends that route. False
// if a vehicle can't hold that, and nothing has changed.
bool swap_tails_linked(const ProblemData& data, Searcher& searcher, Linked& linked, Int node, Int b,
                       Int other) {
    const Int a = linked.link[node].slot;
    const Run& one = linked.run[a];
    const Run& two = linked.run[b];
    const Int after = linked.link[node].behind;
    const bool is_new = other < data.num_depots;
    const Int k = one.type;
    const Int by = is_new ? k : two.type;
    const Int before = is_new ? data.type[k].begins_at : linked.link[other].before;
    const LinkedRow head = head_until(data, linked, node);
    const LinkedRow head_by = head_until(data, linked, before);
    const LinkedRow tail = tail_behind(data, linked, one, head, after);
    const LinkedRow tail_by = tail_behind(data, linked, two, head_by, other);
    if (!holds(data.type[k], plus(head.load, tail_by.load)) ||
        !holds(data.type[by], plus(head_by.load, tail.load)) ||
        !allows_stops(data.type[k], head.customers + tail_by.customers) ||
        !allows_stops(data.type[by], head_by.customers + tail.customers)) {
        return false;
    }
    if (is_new && looks_aboard(linked) && !may_carry_swapped(data, linked, k, node, by, other)) {
        return false;
    }
    // Vehicles of other types may have to be home at other times, and elsewhere.
    if (by != k && linked.timed) {
        if (!drives_in_time(data, linked, k, node, other)) return false;
        const bool is_empty = before < data.num_depots && after < data.num_depots;
        if (!is_empty && !drives_in_time(data, linked, by, before, after)) return false;
    }
    if (is_new) open_run(data, searcher, linked, b, k);
    const NewTail ends_one{tail_by, other, two.last};
    const NewTail ends_two{tail, after, one.last};
    end_with(data, linked, a, head, node, ends_one);
    end_with(data, linked, b, head_by, before, ends_two);
    if (two.count == 0) close_run(searcher, linked, b);
    return true;
}

}  // namespace

SwappedTails two_opt_star_linked(const ProblemData& data, Searcher& searcher, Linked& linked,
                                 double limit) {
    constexpr SwappedTails not_swapped{nowhere, nowhere, 0.0};
    const Int node = draw_customer(data, searcher.now, searcher.count->focus, searcher.rng);
    const Int a = linked.link[node].slot;
    if (a < 0) return not_swapped;
    const auto [b, other, cost] = find_tail_linked(data, searcher, linked, node, limit);
    if (b < 0 || !swap_tails_linked(data, searcher, linked, node, b, other)) return not_swapped;
    return {a, b, cost};
}

}  // namespace tandem
