// A flag that is raised at a deadline, or once a caller wants no more, and looked at between turns.
#pragma once

#include "problem/instance.h"

namespace tandem {

// Whether an alarm has rung. Another thread raises the flag, in memory that isn't the engine's.
inline bool rung(View<const Int, 1> flag) {
    return *static_cast<const volatile Int*>(flag.data()) != 0;
}

}  // namespace tandem
