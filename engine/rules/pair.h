// Who belongs together: shipments, parcels fetched at one end and brought to the other on the same
// trip, later; and places of one customer, of which one is used.
#pragma once

#include "rules/window.h"

namespace tandem {

// Whether anybody belongs together, by the rows of all nodes.
inline bool some_paired(View<const Pair, 1> pairs) { return !pairs.empty(); }

// Whether a node is an end of a shipment.
inline bool is_paired(View<const Pair, 1> pairs, Int node) {
    return some_paired(pairs) && pairs[node].partner >= 0;
}

// Whether a shipment is picked up at a node.
inline bool is_pickup(View<const Pair, 1> pairs, Int node) {
    return is_paired(pairs, node) && pairs[node].is_delivery == 0;
}

// Whether a shipment is delivered at a node.
inline bool is_delivery(View<const Pair, 1> pairs, Int node) {
    return is_paired(pairs, node) && pairs[node].is_delivery != 0;
}

// Who stands for a node where customers are inserted or left out: of both ends of a shipment its
// pickup, of a customer's places the first.
inline Int unit_of(View<const Pair, 1> pairs, Int node) {
    return some_paired(pairs) ? pairs[node].unit : node;
}

// Call `visit` with each place of the customer at a node, that node first.
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

// Shipments on a trip as its ends are served: whether they are whole, each aboard its truck before
// it is delivered.
//
// A shipment is aboard from the stop on where its truck picks it up, or recovers the drone that
// does. It leaves at a later one, where its truck delivers it, or launches the drone that does.
class WholePairs {
public:
    explicit WholePairs(View<const Pair, 1> pairs) : pairs_(pairs) {}

    // Count whoever is served at a stop, or by a drone that is launched at one; `comes_before`
    // tells whether a pickup counts at a stop before.
    template <class ComesBefore>
    void serve(Int node, const ComesBefore& comes_before) {
        if (!is_paired(pairs_, node)) return;
        const bool delivered = pairs_[node].is_delivery != 0;
        whole_ = whole_ && (!delivered || comes_before(pairs_[node].partner));
        aboard_ += delivered ? -1 : 1;
    }

    bool are_kept() const { return whole_ && aboard_ == 0; }

private:
    View<const Pair, 1> pairs_;
    Int aboard_ = 0;
    bool whole_ = true;
};

// Whether each shipment is delivered before all that are picked up before it and not yet delivered:
// those from `first` on, `behind` not among them, of which `keeps_pairs` holds.
template <class NodeAt>
bool keeps_stack(View<const Pair, 1> pairs, Int first, Int behind, const NodeAt& node_at) {
    for (Int p = first; p < behind; ++p) {
        if (node_at(p) < 0 || !is_delivery(pairs, node_at(p))) continue;
        Int beneath = 0;
        for (Int q = p - 1; node_at(q) != pairs[node_at(p)].partner; --q) {
            if (node_at(q) < 0 || !is_paired(pairs, node_at(q))) continue;
            beneath += pairs[node_at(q)].is_delivery != 0 ? 1 : -1;
            if (beneath < 0) return false;
        }
    }
    return true;
}

// By how many shipments more are aboard behind a node.
inline Int stacked_at(View<const Pair, 1> pairs, Int node) {
    if (!is_paired(pairs, node)) return 0;
    return pairs[node].is_delivery != 0 ? -1 : 1;
}

}  // namespace tandem
