#include "policy/exponential.h"

#include <cmath>

#include "policy/exponential_layers.h"

namespace tandem {

double standard_exponential(const BitGenerator& bits) {
    for (;;) {
        const std::uint64_t drawn = bits.next_uint64(bits.state) >> 3;
        const std::size_t number = drawn & 0xff;
        const std::uint64_t place = drawn >> 8;
        const Layer& layer = layers[number];
        const double x = static_cast<double>(place) * layer.width;
        if (place < layer.inner) return x;
        const double uniform = bits.next_double(bits.state);
        if (number == 0) return last_edge - std::log1p(-uniform);
        const double above = layers[number - 1].height - layer.height;
        if (above * uniform + layer.height < std::exp(-x)) return x;
    }
}

}  // namespace tandem
