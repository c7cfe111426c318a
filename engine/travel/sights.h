// Places in cells, and which of them see each other.
#pragma once

#include "problem/instance.h"

namespace tandem {

using Cells = tandem_cells;
using Sights = tandem_sights;

// On which sides of ways to corners areas may lie, as bits.
struct Turns : tandem_turns {
    static constexpr std::int32_t left = 1, right = 2;
};

}  // namespace tandem
