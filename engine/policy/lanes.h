// Arithmetic on several floats at once, the same to the last bit on every processor.
//
// Each lane is computed alone; where lanes are summed, it is in one order that is written here.
// Nothing calls the mathematics of a C library, which differs from one to another.
#pragma once

#include <cstdint>
#include <cstring>

// Before a function whose loops are compiled for several families of processors, the best of which
// is taken as the library is loaded. Results are the same: nothing is fused.
#ifdef TANDEM_CLONES
#define TANDEM_FOR_PROCESSORS [[gnu::flatten, gnu::target_clones("avx512f", "avx2", "default")]]
#else
#define TANDEM_FOR_PROCESSORS
#endif

namespace tandem {

using Lanes = float __attribute__((vector_size(64)));
using HalfLanes = float __attribute__((vector_size(32)));
using Quad = float __attribute__((vector_size(16)));

constexpr std::int64_t num_lanes = 16;
constexpr std::int64_t num_half_lanes = 8;

// Read lanes from where floats lie in a row.
template <class Vector>
void load(const float* from, Vector& lanes) {
    std::memcpy(&lanes, from, sizeof lanes);
}

// Write lanes to where floats lie in a row.
template <class Vector>
void store(const Vector& lanes, float* to) {
    std::memcpy(to, &lanes, sizeof lanes);
}

// Sum the lanes of each of four.
inline Quad sums_of(const Quad& a, const Quad& b, const Quad& c, const Quad& d) {
    const Quad even = __builtin_shufflevector(a, b, 0, 4, 1, 5);
    const Quad odd = __builtin_shufflevector(a, b, 2, 6, 3, 7);
    const Quad also_even = __builtin_shufflevector(c, d, 0, 4, 1, 5);
    const Quad also_odd = __builtin_shufflevector(c, d, 2, 6, 3, 7);
    const Quad left = even + odd, right = also_even + also_odd;
    return __builtin_shufflevector(left, right, 0, 1, 4, 5) +
           __builtin_shufflevector(left, right, 2, 3, 6, 7);
}

inline Quad folded(const HalfLanes& x) {
    return __builtin_shufflevector(x, x, 0, 1, 2, 3) + __builtin_shufflevector(x, x, 4, 5, 6, 7);
}

inline Quad folded(const Lanes& x) {
    const HalfLanes half = __builtin_shufflevector(x, x, 0, 1, 2, 3, 4, 5, 6, 7) +
                           __builtin_shufflevector(x, x, 8, 9, 10, 11, 12, 13, 14, 15);
    return folded(half);
}

template <class Vector>
Quad sums_of(const Vector (&x)[4]) {
    return sums_of(folded(x[0]), folded(x[1]), folded(x[2]), folded(x[3]));
}

// Replace numbers by their exponentials, to within a few units in the last place.
//
// Cephes' `expf`: a power of two, times a polynomial within half a power of it.
inline void exponentiate(Lanes& x) {
    using Integers = std::int32_t __attribute__((vector_size(64)));
    constexpr float least = -87.0F, most = 88.0F;
    constexpr float to_integer = 12582912.0F;  // 1.5 * 2^23, whose last digit is worth one
    constexpr float per_log2 = 1.44269504088896341F;
    constexpr float log2_high = 0.693359375F, log2_low = -2.12194440e-4F;
    x = x < least ? Lanes{} + least : x;
    x = x > most ? Lanes{} + most : x;
    const Lanes power = (x * per_log2 + to_integer) - to_integer;
    const Lanes rest = (x - power * log2_high) - power * log2_low;
    Lanes value = rest * 1.9875691500e-4F + 1.3981999507e-3F;
    value = value * rest + 8.3334519073e-3F;
    value = value * rest + 4.1665795894e-2F;
    value = value * rest + 1.6666665459e-1F;
    value = value * rest + 5.0000001201e-1F;
    value = value * rest * rest + rest + 1.0F;
    const Integers exponent = (__builtin_convertvector(power, Integers) + 127) << 23;
    Lanes scale;
    std::memcpy(&scale, &exponent, sizeof scale);
    x = value * scale;
}

}  // namespace tandem
