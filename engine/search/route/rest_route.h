// A route on which those rest whom rules ask to, and what of it hangs on no rest.
#pragma once

#include <utility>

#include "search/route/breaks.h"
#include "search/route/rest_labels.h"
#include "search/route/rest_placing.h"

namespace tandem {

// What of a route lies ahead: how long its legs are, and all of it, as far as nobody waits or
// rests.
struct Ahead {
    Int driving;
    Int lasting;
};

// A leg, driven while drones are out or not, and what lies behind it.
struct LegAhead {
    Int p;  // the stop before it
    Int duration;
    Int setup;
    Ahead ahead;
    bool flying;
    bool may_rest;
};

// How whoever reaches a stop without flights stays there.
struct Stay {
    Int waits;  // for how long
    Int ends;
};

// What the end of a route costs, and when it is. Of two, that is better which is less.
using Ending = std::pair<double, Int>;

constexpr Ending no_ending{1e300, far};

// The best way to the end of a route that is known, and the rests on it.
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

class RestRoute {
public:
    RestRoute(const ProblemData& data, const Route& route, View<Stop, 1> row,
              View<Sortie, 1> flights, const LeastWork& least);

    const Truck truck;
    const VehicleType& type;
    const View<Stop, 1> stops;
    const View<Sortie, 1> sorties;
    const DueBreaks due;

    bool is_last(Int p) const { return p + 1 == stops.size(); }

    // Return a driver who is about to begin.
    RestLabel beginning() const;

    // Return what all of the route is.
    Ahead whole() const;

    // Write until when each stop may be reached at all, as far as flights and orders don't count.
    void note_latest() const;

    // Return the leg from a stop, from which so much lies ahead.
    LegAhead way_from(Int p, const Ahead& ahead, bool flying) const;

    // Return the leg for a driver who leaves so.
    RestedLeg leg_of(const RestLabel& label, const LegAhead& way) const {
        return {truck.speeds, truck.begin, label.driver, truck.stood_at(stops[way.p]),
                label.time,   way.duration};
    }

    // Whether a driver may have to rest again who has so much ahead.
    bool may_need_rest(const Driver& driver, const Ahead& ahead) const {
        return tandem::may_need_rest(type, driver, truck.speeds.most(ahead.driving, stops.size()));
    }

    // Write a stop without flights that is reached at an instant. In place; false if too late.
    bool reach_alone(Int p, Int time) const;

    // Let a driver leave the block that begins with a stop, which is timed. In place; false if that
    // is too much work.
    bool leave_block(RestLabel& label, Int first) const;

    // Let a driver be where a leg ends that was left at `left`. In place.
    void arrive(RestLabel& label, const LegAhead& way, const RestedLeg& leg, Int left) const;

    // Let a driver pass the end of a trip. In place.
    void reload(RestLabel& label, Int p) const;

    Stay stay_at(Int p, Int time) const;

    // Return what a way that has come to the end costs; `no_ending` if rules are broken.
    Ending ending_of(const RestLabel& label) const;

    // Return what a way costs at least that is somewhere at an instant.
    Ending bound_of(const RestLabel& label, Int time, const Ahead& ahead) const;

    // Let nobody rest between two stops. In place.
    void rest_nowhere(Int first, Int last) const;

    // Take a rest. In place.
    void take(const TakenRest& taken) const;

private:
    Int driving_at(Int p) const;
    Int lasting_at(Int p) const;
    Int least_pause(const RestLabel& label, Int time, const Ahead& ahead) const;
    Ending ending_of(Int end, Int working) const;
    Int working_of(Int end, const RestLabel& label, Int cum) const;

    const LeastWork least_;
};

}  // namespace tandem
