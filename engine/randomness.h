// Random numbers from a state of one word, the same on every machine and in every thread.
#pragma once

#include "problem/instance.h"

namespace tandem {

// Draw from [0, 1). In place.
//
// Steele, Lea and Flood (2014), fast splittable pseudorandom number generators, OOPSLA: SplitMix.
inline double uniform(View<std::uint64_t, 1> state) {
    std::uint64_t z = state[0] += 0x9E3779B97F4A7C15U;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    z = z ^ (z >> 31);
    return double(z >> 11) * 0x1p-53;
}

// Draw a whole number from 0 to `bound - 1`. In place.
inline Int below(View<std::uint64_t, 1> state, Int bound) {
    return Int(uniform(state) * double(bound));
}

}  // namespace tandem
