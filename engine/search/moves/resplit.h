// Trips with one drone planned anew from an order of their customers.
//
// A part of a trip, or two routes together, the depot between them among what is moved: so a route
// is split in two, or two become one, with the drones' share of each chosen anew at once.
#pragma once

#include "search/moves/split.h"

namespace tandem {

// Plans trips with one drone anew, a part of one or two routes at a time.
class Resplit {
public:
    Resplit(const ProblemData& data, Searcher& searcher) : data_(data), searcher_(searcher) {}

    // Looks at another part next: routes have changed.
    void forget() { tries_ = 0; }

    // Plans a part anew from a changed order of its customers.
    //
    // In place; tells whether routes were changed and keep all rules; if not, they may be broken.
    // Nothing is changed that would cost more than `limit`.
    bool attempt(double limit);

private:
    // Stops of a route, both included.
    struct StopSpan {
        Int first, last;
    };

    // Places of one or two routes in a line: how many, 0 if that can't be; what the operations cost
    // if that is all that the drones do, whether it is, and whether time saved counts for itself:
    // some trucks wait, or some of their work costs more than the rest.
    struct Lines {
        Int length = 1;
        double cost = 0.0;
        bool exact = true, saves_time = false;
    };

    bool draw();
    StopSpan window(Int p) const;
    Int partner(Int node) const;
    bool line_up(Int slot, StopSpan part);

    bool counts() const;
    bool is_worth(double after, double limit) const;
    bool split_first(double limit);
    bool change_again(double limit);
    bool change_once(double limit);
    Places change_order(View<Line, 1> line, Int length) const;

    double split_between(Int begin, Int end) const;
    bool write_between(Int slot, Int begin, Int end) const;
    bool write(Int cut);

    const ProblemData& data_;
    Searcher& searcher_;
    Int tries_ = 0;  // how many more orders of the part are tried
    Int slot_ = nowhere;
    Int other_ = nowhere;  // the route that is planned together with it; `nowhere`: none
    Int type_ = 0;
    StopSpan part_{};
    Lines lines_;
    double least_ = 0.0;   // what the order as it is costs at least
    double beside_ = 0.0;  // what of that isn't operations
};

}  // namespace tandem
