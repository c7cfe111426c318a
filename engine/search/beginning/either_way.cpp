#include "search/beginning/either_way.h"

#include "guard.h"
#include "rules/shift.h"

namespace tandem {

namespace {

// Whether a customer has one beside him on both sides.
bool is_amid(const Chain& link) { return link.before != nowhere && link.behind != nowhere; }

// Puts a customer beside one who has room there.
void link_to(Chain& link, Int node) { (link.before == nowhere ? link.before : link.behind) = node; }

// The customer who stands for a route; shortens the way there.
//
// References: Tarjan and van Leeuwen (1984), worst-case analysis of set union algorithms, Journal
// of the ACM 31:245-281.
Int route_of(View<Chain, 1> chain, Int node) {
    while (chain[node].route != node) {
        chain[node].route = chain[chain[node].route].route;
        node = chain[node].route;
    }
    return node;
}

// Turns all on a route so that it begins with one at its end.
void set_out(View<Chain, 1> chain, Int node) {
    for (Int before = nowhere; node != nowhere;) {
        Chain& link = chain[node];
        const Int behind = link.behind == before ? link.before : link.behind;
        link.before = before;
        link.behind = behind;
        link.last = node;
        before = node;
        node = behind;
    }
}

}  // namespace

void join_either_way(const World& world, Int k, Int ranks, View<const Int, 1> keys,
                     View<Chain, 1> chain, const View<ChainCargo, 2>& cargo) {
    const VehicleType& type = world.type[k];
    for (Int node = world.num_depots; node < world.num_nodes; ++node) {
        Chain& link = chain[node];
        link.before = link.behind = nowhere;
        link.route = node;
        link.length = 1;
        set_up_cargo(world, node, cargo[node]);
    }
    for (const Int key : keys) {
        world.deadline.go_on_late();
        const auto [a, b] = pair(world, ranks, key);
        if (is_amid(chain[a]) || is_amid(chain[b])) continue;
        const Int one = route_of(chain, a);
        const Int other = route_of(chain, b);
        const Int length = chain[one].length + chain[other].length;
        if (one == other || !allows_stops(type, length) ||
            !may_join(type, cargo[one], cargo[other])) {
            continue;
        }
        chain[other].route = one;
        chain[one].length = length;
        add_cargo(cargo[one], cargo[other]);
        link_to(chain[a], b);
        link_to(chain[b], a);
    }
    for (Int node = world.num_depots; node < world.num_nodes; ++node) chain[node].last = nowhere;
    for (Int node = world.num_depots; node < world.num_nodes; ++node) {
        if (chain[node].last == nowhere && !is_amid(chain[node])) set_out(chain, node);
    }
}

}  // namespace tandem

using namespace tandem;

extern "C" int tandem_join_either_way(const tandem_world* world, int64_t k, int64_t ranks,
                                      const tandem_i64_1d* keys, const tandem_chain_1d* chain,
                                      const tandem_chain_cargo_2d* cargo) {
    return guarded([&] { join_either_way(world_of(*world), k, ranks, *keys, *chain, *cargo); });
}
