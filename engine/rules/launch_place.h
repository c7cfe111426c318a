// Where drones may take off and be recovered: a place allows both or neither.
#pragma once

#include "problem/instance.h"

namespace tandem {

// Whether a truck may launch and recover its drones at a node.
//
// `forbidden` has a row for each node, and none where they may take off anywhere.
inline bool is_launch_place(View<const bool, 1> forbidden, Int node) {
    return forbidden.empty() || !forbidden[node];
}

// Whether trucks of a type may stop at a launch site for their drones alone.
inline bool may_halt(View<const bool, 2> allowed, Int k, Int node) {
    return !allowed.empty() && allowed(k, node);
}

}  // namespace tandem
