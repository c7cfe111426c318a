// The best way to the end of a route that is known, and the rests on it.
#pragma once

#include <utility>

#include "search/route/rest_route.h"

namespace tandem {

class BestRests {
public:
    bool is_known() const { return is_known_; }
    std::int32_t last() const { return last_; }

    // Tell whether a way that costs so much at least may be better than the one known.
    bool may_be_better(const Ending& bound) const { return !is_known_ || bound < ending_; }

    // Keep a way that has come to the end if none is better. In place.
    void keep(const RestLabel& label, const Ending& ending) {
        // Who is served too long behind another may not be if the route begins later.
        const std::pair value{label.waited.excess, ending};
        if (ending.first >= no_ending.first ||
            (is_known_ && !(value < std::pair{excess_, ending_}))) {
            return;
        }
        excess_ = label.waited.excess;
        ending_ = ending;
        last_ = label.last;
        is_known_ = true;
    }

private:
    bool is_known_ = false;
    Int excess_ = 0;
    Ending ending_ = no_ending;
    std::int32_t last_ = -1;
};

}  // namespace tandem
