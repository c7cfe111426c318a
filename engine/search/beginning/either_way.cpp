#include "rules/shift.h"
#include "search/beginning/savings.h"

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

void join_either_way(const ProblemData& data, Int k, Int ranks, View<const Int, 1> keys,
                     const Beside& beside) {
    const ChainCargo joining(data);
    const auto& [chain, cargo] = joining;
    const VehicleType& type = data.type[k];
    for (Int node = data.num_depots; node < data.num_nodes; ++node) {
        Chain& link = chain[node];
        link.before = link.behind = nowhere;
        link.route = node;
        link.length = 1;
        set_up_cargo(data, node, cargo[node]);
    }
    for (const Int key : keys) {
        data.deadline.go_on_late();
        const auto [a, b] = pair(data, ranks, key);
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
    for (Int node = data.num_depots; node < data.num_nodes; ++node) chain[node].last = nowhere;
    for (Int node = data.num_depots; node < data.num_nodes; ++node) {
        if (chain[node].last == nowhere && !is_amid(chain[node])) set_out(chain, node);
    }
    joining.write(beside);
}

}  // namespace tandem

using namespace tandem;

extern "C" int tandem_join_either_way(const tandem_problem_data* data, int64_t k, int64_t ranks,
                                      const tandem_i64_1d* keys, const tandem_i64_2d* beside) {
    return guarded([&] { join_either_way(data_of(*data), k, ranks, *keys, *beside); });
}
