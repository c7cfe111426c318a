// Routes as linked stops.
#pragma once

#include <limits>

#include "search/route/layout.h"

namespace tandem {

using Link = tandem_link;
using Run = tandem_run;
using Piece = tandem_piece;
using Entry = tandem_entry;
using Moment = tandem_moment;
using Noted = tandem_noted;
using Least = tandem_least;

// Beside whom no place is near enough, however long a detour may be.
constexpr Int out_of_reach = -far;

// From which distance on `Linked::near` doesn't tell.
constexpr std::int32_t farthest = std::numeric_limits<std::int32_t>::max();

using Linked = tandem_linked;

}  // namespace tandem
