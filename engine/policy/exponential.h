// Exponentially distributed numbers from one of NumPy's bit generators, as NumPy itself draws them.
#pragma once

#include <cstdint>

namespace tandem {

// NumPy's `bitgen_t`, whose address is `BitGenerator.ctypes.bit_generator`. Its lock is Python's
// affair: nobody else may draw from it meanwhile.
struct BitGenerator {
    void* state;
    std::uint64_t (*next_uint64)(void* state);
    std::uint32_t (*next_uint32)(void* state);
    double (*next_double)(void* state);
    std::uint64_t (*next_raw)(void* state);
};

// The same number as `Generator.standard_exponential()`, to the last bit.
double standard_exponential(const BitGenerator& bits);

}  // namespace tandem
