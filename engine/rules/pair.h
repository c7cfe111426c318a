// Who belongs together: shipments, parcels fetched at one end, or in parts at several, and brought
// to the other on the same trip, later; and places of one customer, of which one is used.
#pragma once

#include "rules/window.h"

namespace tandem {

// Whether anybody belongs together, by the rows of all nodes.
inline bool some_paired(View<const Pair, 1> pairs) { return !pairs.empty(); }

// Whether a node is an end of a shipment.
inline bool is_paired(View<const Pair, 1> pairs, Int node) {
    return some_paired(pairs) && pairs[node].partner >= 0;
}

// Whether all nodes from one on are ends of shipments.
inline bool all_paired(View<const Pair, 1> pairs, Int first) {
    return some_paired(pairs) && std::all_of(&pairs[first], pairs.end(),
                                             [](const Pair& pair) { return pair.partner >= 0; });
}

// Whether a shipment is picked up at a node.
inline bool is_pickup(View<const Pair, 1> pairs, Int node) {
    return is_paired(pairs, node) && pairs[node].is_delivery == 0;
}

// Whether a shipment is delivered at a node.
inline bool is_delivery(View<const Pair, 1> pairs, Int node) {
    return is_paired(pairs, node) && pairs[node].is_delivery != 0;
}

// Whether a part of what is delivered at a node is picked up at another.
inline bool brings(View<const Pair, 1> pairs, Int node, Int delivery) {
    return pairs[node].partner == delivery;
}

// Whether a truck that picks up at a node gives a drone launched there what that delivers at
// another: it is launched no sooner than service is over.
inline bool hands_over(View<const Pair, 1> pairs, Int node, Int delivery) {
    return is_pickup(pairs, node) && brings(pairs, node, delivery);
}

// Who stands for a node where customers are inserted or left out: of a shipment's ends its first
// pickup, of a customer's places the first.
inline Int unit_of(View<const Pair, 1> pairs, Int node) {
    return some_paired(pairs) ? pairs[node].unit : node;
}

// Whether a node is an end of a shipment for which another stands.
inline bool is_other_end(View<const Pair, 1> pairs, Int node) {
    return is_paired(pairs, node) && pairs[node].unit != node;
}

constexpr Int most_pickups = 8;

// Where a shipment is picked up, in some order.
struct Pickups {
    std::array<Int, most_pickups> node;
    Int count;

    const Int* begin() const { return node.data(); }
    const Int* end() const { return node.data() + count; }
};

// Call `visit` with each place where a shipment is picked up, by one of its ends.
template <class Visit>
void for_each_pickup(View<const Pair, 1> pairs, Int end, const Visit& visit) {
    const Int first = pairs[end].unit;
    Int next = first;
    do {
        visit(next);
        next = pairs[next].next_place;
    } while (next != first);
}

// At how many places a shipment is picked up.
inline Int num_pickups(View<const Pair, 1> pairs, Int end) {
    Int count = 0;
    for_each_pickup(pairs, end, [&](Int) { ++count; });
    return count;
}

// Where a shipment is picked up.
inline Pickups pickups_of(View<const Pair, 1> pairs, Int end) {
    Pickups pickups{};
    for_each_pickup(pairs, end,
                    [&](Int node) { pickups.node[std::size_t(pickups.count++)] = node; });
    return pickups;
}

// Whether a node is the end of a shipment that is picked up in parts.
inline bool is_gathered(View<const Pair, 1> pairs, Int node) {
    return is_paired(pairs, node) && pairs[pairs[node].unit].next_place != pairs[node].unit;
}

// The same pickups in another order, by its number.
inline Pickups in_order(Pickups pickups, Int number) {
    for (Int first = 0; first < pickups.count; ++first) {
        const Int left = pickups.count - first;
        const auto chosen = pickups.node.begin() + first + number % left;
        std::rotate(pickups.node.begin() + first, chosen, chosen + 1);
        number /= left;
    }
    return pickups;
}

// Call `visit` with each place of the customer at a node, that node first; at a shipment's pickup,
// with all of its pickups.
template <class Visit>
void for_each_place(View<const Pair, 1> pairs, Int node, const Visit& visit) {
    visit(node);
    if (!some_paired(pairs)) return;
    for (Int place = pairs[node].next_place; place != node; place = pairs[place].next_place) {
        visit(place);
    }
}

// The place of the customer at a node that is used, by whether each is; the node itself if none is.
template <class IsUsed>
Int used_place(View<const Pair, 1> pairs, Int node, const IsUsed& is_used) {
    Int used = node;
    for_each_place(pairs, node, [&](Int place) {
        if (is_used(place)) used = place;
    });
    return used;
}

// How long shipments may be under way by vehicles of a type, by pickup; none where none is limited.
inline View<const Int, 1> limits_of(const View<const Int, 2>& max_between, Int k) {
    return max_between.empty() ? View<const Int, 1>() : max_between[k];
}

// By how much a shipment is too long under way whose pickup is over at `left`, and whose delivery
// begins at `start`.
inline Int excess_between(View<const Int, 1> max_between, Int pickup, Int left, Int start) {
    return start - left - max_between[pickup];
}

// Shipments on a trip as its ends are served: whether they are whole, all parts of each aboard its
// truck before it is delivered.
//
// A part is aboard from the stop on where its truck picks it up, or recovers the drone that does.
// It leaves at a later one, where its truck delivers it, or there or later with a drone.
class WholePairs {
public:
    explicit WholePairs(View<const Pair, 1> pairs) : pairs_(pairs) {}

    // Count whoever is served at a stop, or by a drone that is launched at one; `comes_before`
    // tells whether a pickup counts at a stop before.
    template <class ComesBefore>
    void serve(Int node, const ComesBefore& comes_before) {
        if (!is_paired(pairs_, node)) return;
        if (pairs_[node].is_delivery == 0) {
            ++aboard_;
            return;
        }
        for_each_pickup(pairs_, node, [&](Int pickup) {
            whole_ = whole_ && comes_before(pickup);
            --aboard_;
        });
    }

    bool are_kept() const { return whole_ && aboard_ == 0; }

private:
    View<const Pair, 1> pairs_;
    Int aboard_ = 0;
    bool whole_ = true;
};

// By how many parts of shipments more are aboard behind a node.
inline Int stacked_at(View<const Pair, 1> pairs, Int node) {
    if (!is_paired(pairs, node)) return 0;
    return pairs[node].is_delivery != 0 ? -num_pickups(pairs, node) : 1;
}

// Whether each shipment is delivered before all that are picked up before it and not yet delivered:
// those from `first` on, `behind` not among them, of which `keeps_pairs` holds.
template <class NodeAt>
bool keeps_stack(View<const Pair, 1> pairs, Int first, Int behind, const NodeAt& node_at) {
    for (Int p = first; p < behind; ++p) {
        if (node_at(p) < 0 || !is_delivery(pairs, node_at(p))) continue;
        Int beneath = 0, lacking = num_pickups(pairs, node_at(p));
        for (Int q = p - 1; lacking > 0; --q) {
            if (node_at(q) < 0 || !is_paired(pairs, node_at(q))) continue;
            if (brings(pairs, node_at(q), node_at(p))) {
                --lacking;
                continue;
            }
            beneath -= stacked_at(pairs, node_at(q));
            if (beneath < 0) return false;
        }
    }
    return true;
}

// Whether a sortie delivers as its visit number `index`, by whom it serves, what it fetched before:
// nothing of several parts, all of which come aboard the truck.
inline bool is_brought_within(View<const Pair, 1> pairs, const Int* nodes, Int index) {
    return is_delivery(pairs, nodes[index]) && !is_gathered(pairs, nodes[index]) &&
           std::find(nodes, nodes + index, pairs[nodes[index]].partner) != nodes + index;
}

// Whether a sortie delivers later what it fetches as its visit number `index`.
inline bool is_fetched_within(View<const Pair, 1> pairs, const Int* nodes, Int count, Int index) {
    return is_pickup(pairs, nodes[index]) && !is_gathered(pairs, nodes[index]) &&
           std::find(nodes + index, nodes + count, pairs[nodes[index]].partner) != nodes + count;
}

}  // namespace tandem
