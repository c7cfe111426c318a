// When those of a route were served before somewhere, on each of several ways to have come there.
#pragma once

#include <vector>

#include "search/route/block.h"

namespace tandem {

// What orders look back to, on one way.
struct Waited {
    Int excess = 0;    // by how much somebody is served too long behind another
    Int noted = none;  // number of the last who was noted
};

// Notes when trucks on several ways along a route serve whom orders bind.
class Waits {
public:
    Waits(const Truck& truck, View<Stop, 1> stops, View<Sortie, 1> sorties)
        : truck_(truck), stops_(stops), sorties_(sorties) {}

    // Whether anybody waits for others.
    bool count() const { return lags_count(truck_.data); }

    // Have the truck wait at a stop without sorties that it reaches at `time`.
    //
    // Returns when it leaves at the soonest, `none` if nobody waits there, `far` if that is too
    // late. In place.
    Int leave_alone(Int p, Int time, Waited& waited) {
        if (stops_[p].kind != customer_stop) return none;
        if (is_behind(truck_.data.lag, stops_[p].node)) recall(waited);
        const Int leave = await_others(truck_, stops_, sorties_, p, time);
        if (leave != far) pass({p, p + 1}, {0, 0}, waited);
        return leave;
    }

    // Write when those were served who are before, on a way. In place.
    void recall(const Waited& waited) const {
        for (Int number = waited.noted; number != none;) {
            const NotedStart& noted = noted_[std::size_t(number)];
            *noted.at = noted.time;
            number = noted.before;
        }
    }

    // Note when those of a part were served, and of its sorties. In place.
    void pass(Part part, Part flown, Waited& waited) {
        waited.excess = std::max(waited.excess, excess_within(truck_.data, stops_, sorties_, part));
        for (Int p = part.first; p < part.behind; ++p) {
            if (stops_[p].kind == customer_stop) note(stops_[p].start, waited);
        }
        for (Int s = flown.first; s < flown.behind; ++s) {
            for (Int visit = 0; visit < sorties_[s].count; ++visit) {
                note(sorties_[s].arrivals[visit], waited);
            }
        }
    }

private:
    // When service began at a stop, or a drone arrived at a customer.
    struct NotedStart {
        Int* at;
        Int time;
        Int before;  // number of who was noted before
    };

    void note(Int& at, Waited& waited) {
        noted_.push_back({&at, at, waited.noted});
        waited.noted = Int(noted_.size()) - 1;
    }

    const Truck& truck_;
    View<Stop, 1> stops_;
    View<Sortie, 1> sorties_;
    std::vector<NotedStart> noted_;  // nothing without orders
};

}  // namespace tandem
