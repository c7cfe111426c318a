// Ways in which a driver has come somewhere on a route, of which those are kept that may be best.
#pragma once

#include "search/route/waits.h"

namespace tandem {

// Which rest is taken, on the leg behind which stop, and where, and the one before it.
struct TakenRest {
    std::int32_t stop;
    std::int32_t before;  // among those taken, -1 if there is none
    std::int8_t number;
    std::int8_t place;
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

}  // namespace tandem
