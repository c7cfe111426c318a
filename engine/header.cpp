// Which header the library was built from.
#include "guard.h"
#include "include/tandem.h"

extern "C" int tandem_header(uint64_t* digest) {
    return tandem::guarded([&] { *digest = TANDEM_HEADER; });
}
