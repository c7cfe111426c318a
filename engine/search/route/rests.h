// Where those rest on a route whom rules ask to, or who have breaks beside flights and orders: by
// dynamic programming along the route.
#pragma once

#include <utility>

#include "search/route/breaks.h"
#include "search/route/waits.h"

namespace tandem {

// Which rest is taken, on the leg behind which stop, and where, and the one before it.
struct TakenRest {
    std::int32_t stop;
    std::int32_t before;  // among those taken, -1 if there is none
    std::int8_t number, place;
};

// A driver who has come somewhere, with the rests so far.
struct RestLabel {
    Int time;
    Int cum;       // sum of all durations
    Int depart;    // the latest departure that costs nothing
    Int airborne;  // sum of the take-offs of drones that are out
    Driver driver;
    Waited waited;
    std::int32_t next;    // the first break, of those due, that isn't taken
    std::int32_t count;   // of rests
    std::int32_t on_leg;  // of these, on the leg
    std::int32_t last;    // among those taken, -1 if there is none
    std::int32_t timed;   // which timing of the block has the same rests there, -1 if none has
};

// Tell whether a driver may have a rest more on the leg.
inline bool has_room(const RestLabel& label) {
    return label.count < most_rests_on_route && label.on_leg < most_rests;
}

// Tell whether one is no worse than another, whatever comes. Of drones that are out, who left later
// lasts longer, but is back later.
//
// While speeds still change, until `changing`, who is sooner may be on the way for longer, by no
// more than that.
inline bool is_no_worse(const RestLabel& one, const RestLabel& other, Int changing) {
    const Int more = one.time < changing ? other.time - one.time : 0;
    return one.airborne == other.airborne && one.next == other.next && one.time <= other.time &&
           one.waited.excess <= other.waited.excess && one.cum <= other.cum &&
           one.depart >= other.depart && one.driver.driven + more <= other.driver.driven &&
           one.driver.since >= other.driver.since &&
           one.driver.half_rested >= other.driver.half_rested;
}

// Labels of which none is no worse than another.
class RestLabels {
public:
    static constexpr std::size_t all = 48;

    // So many at most, where speeds change until `changing`.
    RestLabels(std::size_t most, Int changing) : most_(most), changing_(changing) {
        label_.reserve(few);
    }

    const RestLabel* begin() const { return label_.data(); }
    const RestLabel* end() const { return label_.data() + label_.size(); }
    void clear() { label_.clear(); }

    // Keep a label unless another is no worse; where there are too many, that goes which is last.
    // Tell whether it is kept.
    bool add(const RestLabel& label) {
        for (const RestLabel& other : label_) {
            if (is_no_worse(other, label, changing_)) return false;
        }
        std::erase_if(label_,
                      [&](const RestLabel& other) { return is_no_worse(label, other, changing_); });
        if (label_.size() < most_) {
            label_.push_back(label);
            return true;
        }
        RestLabel& last = *std::max_element(
            label_.begin(), label_.end(),
            [](const RestLabel& one, const RestLabel& other) { return one.time < other.time; });
        if (label.time >= last.time) return false;
        last = label;
        return true;
    }

private:
    static constexpr std::size_t few = 8;  // are mostly enough

    std::vector<RestLabel> label_;
    std::size_t most_;
    Int changing_;
};

// The rests of all labels, each of which knows its last one.
class TakenRests {
public:
    const TakenRest& operator[](std::int32_t index) const { return taken_[std::size_t(index)]; }
    std::int32_t count() const { return count_; }
    bool is_full() const { return count_ == most; }

    // Note a rest; returns its number.
    std::int32_t add(const TakenRest& rest) {
        taken_[std::size_t(count_)] = rest;
        return count_++;
    }

    // Let a driver have taken a rest more on the leg from stop `p`. In place.
    void note(RestLabel& label, Int p, Int number, RestPlace place) {
        label.last = add({std::int32_t(p), label.last, std::int8_t(number), std::int8_t(place)});
        ++label.count;
        ++label.on_leg;
        label.timed = -1;
    }

    // Call `take` for the rests up to one of them that are behind stop `first` or later, in order.
    template <class Take>
    void for_each_from(Int first, std::int32_t index, const Take& take) const {
        std::array<std::int32_t, most_rests_on_route> found;
        std::size_t count = 0;
        for (; index >= 0 && (*this)[index].stop >= first; index = (*this)[index].before) {
            found[count++] = index;
        }
        while (count > 0) take((*this)[found[--count]]);
    }

    // Forget those from a number on, which no label has.
    void forget(std::int32_t count) { count_ = count; }

private:
    static constexpr std::int32_t most = 8192;

    std::array<TakenRest, most> taken_;
    std::int32_t count_ = 0;
};

// When a route ends that nobody rests on, and how long it works then.
struct LeastWork {
    Int end, working;
};

// Return how long the breaks behind a stop make its gap.
Int resting_in_gap(const VehicleType& type, const Stop& stop);

// Return how long the leg from a stop is, without setup and rests.
Int driving_from(const ProblemData& data, const VehicleType& type, View<const Stop, 1> stops,
                 Int p);

// Let nobody rest behind a stop. In place.
void forget_rests(const VehicleType& type, Stop& stop);

// Let nobody rest on a route. In place.
void clear_rests(const VehicleType& type, View<Stop, 1> stops);

// Write the rests of the route whose work costs least, and of these that which ends first; with
// breaks, that which ends first. In place; false if a rule is broken.
bool place_rests(const ProblemData& data, const Tour& tour, const LeastWork& least);

// What of a route lies ahead: how long its legs are, and all of it, as far as nobody waits or
// rests.
struct Ahead {
    Int driving, lasting;
};

// Return what all of a loaded route is.
Ahead all_of(const ProblemData& data, const VehicleType& type, View<const Stop, 1> stops);

// A leg, driven while drones are out or not, and what lies behind it.
struct LegAhead {
    Int p;  // the stop before it
    Int duration, setup;
    Ahead ahead;
    bool flying, may_rest;
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
    RestRoute(const ProblemData& data, const Tour& tour, const LeastWork& least);

    const Truck truck;
    const VehicleType& type;
    const View<Stop, 1> stops;
    const View<Sortie, 1> sorties;
    const DueBreaks due;

    bool is_last(Int p) const { return p + 1 == stops.size(); }

    // Return a driver who is about to begin.
    RestLabel beginning() const;

    Ahead whole() const { return all_of(truck.data, type, stops); }

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

// All ways along a leg that may be best.
class RestLegs {
public:
    RestLegs(const RestRoute& route, const BestRests& best, TakenRests& taken)
        : route_(route), type_(route.type), best_(best), taken_(taken) {}

    // Let a driver who leaves so drive to the next stop, and note how it may be there.
    void drive(const RestLabel& label, const LegAhead& way, RestLabels& there);

private:
    void ride(const RestLabel& label, const RestedLeg& leg, RestPlace place);
    void rest(const RestLabel& label, const RestedLeg& leg, RestPlace place);
    void take_break(const RestLabel& label, const RestedLeg& leg, RestPlace place);
    void take(RestLabel next, const RestedLeg& leg, Int number, RestPlace place);
    bool come(RestLabel label, const RestedLeg& leg);
    bool is_put_off(const RestedLeg& leg, Int number) const;
    bool may_be_best(const RestLabel& label, const RestedLeg& leg) const;

    const RestRoute& route_;
    const VehicleType& type_;
    const BestRests& best_;
    TakenRests& taken_;
    LegAhead way_{};
    Int left_ = 0;  // when the leg began
    RestLabels* there_ = nullptr;
    Int kept_ = 0;  // labels
};

// Follow ways along a route without flights or orders, as late as allowed, until one is as good as
// any can be. In place: `best`. Tell whether it is.
bool rest_late(const RestRoute& route, BestRests& best, TakenRests& taken);

// Tell whether a rest is taken on a timed route.
bool any_rest(const VehicleType& type, const Route& route);

// Write times as soon as possible, with breaks, and the rests that rules ask for, placed so that
// the route ends as soon as possible. In place; false if a rule is broken.
//
// Gaps between stops then hold rests. They are placed by dynamic programming along the route: of
// two ways to have come somewhere, one is no worse if the truck is there as soon, with no more
// driven or worked since the last rest, and the same drones out since the same instants. Who needs
// none is timed as any other.
bool drive_by_rules(const ProblemData& data, const Tour& tour);

// Tell whether somebody may have to rest on a route who serves a customer more behind stop `p`, or
// has to already.
bool may_have_to_rest(const ProblemData& data, const Fleet& fleet, Int slot, Int p, Int node);

}  // namespace tandem
