// Which interface this library has.
#include "guard.h"
#include "include/tandem.h"

extern "C" int tandem_version(int64_t* version) {
    return tandem::guarded([&] { *version = 1; });
}
