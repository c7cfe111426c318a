#include "search/trace.h"

extern "C" int tandem_take_trace(int64_t* digest) {
    return tandem::guarded(
        [&] { *digest = std::bit_cast<std::int64_t>(tandem::priced_digest.exchange(0)); });
}
