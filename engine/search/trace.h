// A digest of what insertions were found to cost, in builds that are compared with others.
#pragma once

#include <atomic>
#include <bit>

#include "search/route/layout.h"

namespace tandem {

#ifdef TANDEM_TRACED
constexpr bool is_traced = true;
#else
constexpr bool is_traced = false;
#endif

// Of all threads: a sum, so that their order doesn't count.
inline std::atomic<std::uint64_t> priced_digest{0};

// Note what a place was found to cost.
inline void trace_priced([[maybe_unused]] double cost, [[maybe_unused]] const Move* move) {
    if constexpr (is_traced) {
        std::uint64_t mixed = std::bit_cast<std::uint64_t>(cost);
        const auto mix = [&](Int part) {
            mixed = (mixed ^ std::uint64_t(part)) * 0x9E3779B97F4A7C15U;
            mixed ^= mixed >> 29;
        };
        mix(0);
        if (move != nullptr) {
            mix(move->slot);
            for (const Placement& placed : move->placements()) mix(placed.from);
        }
        priced_digest.fetch_add(mixed, std::memory_order_relaxed);
    }
}

}  // namespace tandem
