// A flag that is raised at a deadline, or once a caller wants no more, and looked at between turns.
#pragma once

#include "problem/instance.h"

namespace tandem {

// Whether an alarm has rung. Another thread raises the flag, in memory that isn't the engine's.
inline bool rung(View<const Int, 1> flag) {
    return __atomic_load_n(flag.data(), __ATOMIC_RELAXED) != 0;
}

}  // namespace tandem
