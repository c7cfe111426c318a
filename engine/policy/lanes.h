// Arithmetic of the policy on several floats at once.
//
// Where lanes are summed, it is in one order that is written here. Nothing calls the mathematics of
// a C library, which differs from one to another.
#pragma once

#include "vectors.h"

namespace tandem {

using Quad = Register<float, 16>::Type;

template <int length>
using Floats = Vector<float, length>;

using Lanes = Floats<16>;
using HalfLanes = Floats<8>;

constexpr std::int64_t num_lanes = 16;
constexpr std::int64_t num_half_lanes = 8;

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

// Sum halves, and these likewise, to four.
inline Quad folded(const HalfLanes& x) {
    Quad part[2];
    std::memcpy(part, &x, sizeof x);
    return part[0] + part[1];
}

inline Quad folded(const Lanes& x) {
    Quad part[4];
    std::memcpy(part, &x, sizeof x);
    return (part[0] + part[2]) + (part[1] + part[3]);
}

template <class Lanes>
Quad sums_of(const Lanes (&x)[4]) {
    return sums_of(folded(x[0]), folded(x[1]), folded(x[2]), folded(x[3]));
}

// Replace numbers by their exponentials, to within a few units in the last place.
//
// Cephes' `expf`: a power of two, times a polynomial within half a power of it.
inline void exponentiate(Lanes& lanes) {
    using Piece = Lanes::Piece;
    using Integers = Register<float, Lanes::piece_bytes>::Integers;
    constexpr float least = -87.0F, most = 88.0F;
    constexpr float to_integer = 12582912.0F;  // 1.5 * 2^23, whose last digit is worth one
    constexpr float per_log2 = 1.44269504088896341F;
    constexpr float log2_high = 0.693359375F, log2_low = -2.12194440e-4F;
    for (Piece& x : lanes.piece) {
        x = x < least ? Piece{} + least : x;
        x = x > most ? Piece{} + most : x;
        const Piece power = (x * per_log2 + to_integer) - to_integer;
        const Piece rest = (x - power * log2_high) - power * log2_low;
        Piece value = rest * 1.9875691500e-4F + 1.3981999507e-3F;
        value = value * rest + 8.3334519073e-3F;
        value = value * rest + 4.1665795894e-2F;
        value = value * rest + 1.6666665459e-1F;
        value = value * rest + 5.0000001201e-1F;
        value = value * rest * rest + rest + 1.0F;
        const Integers exponent = (__builtin_convertvector(power, Integers) + 127) << 23;
        Piece scale;
        std::memcpy(&scale, &exponent, sizeof scale);
        x = value * scale;
    }
}

}  // namespace tandem
