// Breaks of those who drive: when they may begin, which are due, and legs that they interrupt.
//
// A break lies between two stops: where the truck leaves, on its way, or where it arrives, before
// it is ready to serve. They are taken in the order stated, each as soon as its window opens.
#pragma once

#include <optional>

#include "rules/clock.h"
#include "rules/load.h"

namespace tandem {

constexpr Int most_breaks = 8;

// What a rest by driving rules may be; numbers of breaks among `Rests` behind those stated.
constexpr Int whole_rest = most_breaks;
constexpr Int first_part = most_breaks + 1;
constexpr Int second_part = most_breaks + 2;

// Breaks and rests between two stops, at most.
constexpr Int most_rests = 9;

inline bool is_stated(Int number) { return number < most_breaks; }

// How long a rest by driving rules is.
inline Int rest_duration(const VehicleType& type, Int number) {
    return type.rest_durations[number - most_breaks];
}

// How long a break is, stated or not.
inline Int length_of(const VehicleType& type, Int number) {
    return is_stated(number) ? type.break_duration[number] : rest_duration(type, number);
}

// Where a break between two stops is taken.
enum class RestPlace : Int { departure, way, arrival };

// The breaks taken between two stops, in order. Packed, 0 is none.
class Rests {
public:
    Rests() = default;
    explicit Rests(Int packed) : packed_(packed) {}

    Int packed() const { return packed_; }
    Int count() const { return packed_ & 15; }
    Int number(Int index) const { return packed_ >> shift(index) & 15; }
    RestPlace place(Int index) const { return RestPlace{packed_ >> (shift(index) + 4) & 3}; }

    // The first break that may come behind these, all of which come behind `next`.
    Int next(Int next) const {
        for (Int index = count() - 1; index >= 0; --index) {
            if (is_stated(number(index))) return number(index) + 1;
        }
        return next;
    }

    // Whether any is a rest by driving rules.
    bool any_unstated() const {
        for (Int index = 0; index < count(); ++index) {
            if (!is_stated(number(index))) return true;
        }
        return false;
    }

    // These, and then another break.
    Rests with(Int number, RestPlace place) const {
        const Int more = number | Int(place) << 4;
        return Rests((packed_ + 1) | more << shift(count()));
    }

private:
    static Int shift(Int index) { return 4 + 6 * index; }

    Int packed_ = 0;
};

// A break of a route that begins at an instant.
struct Break {
    Int earliest, latest, duration;

    Int start(Int time) const { return std::max(time, earliest); }
    bool may_begin(Int time) const { return start(time) <= latest; }
    Int end(Int time) const { return start(time) + duration; }
};

// How many breaks a driver has.
inline Int num_breaks(const VehicleType& type) { return type.breaks; }

// Whether a driver has breaks, so that times hang on where they are taken.
inline bool has_breaks(const VehicleType& type) { return type.breaks > 0; }

// What may be aboard at most while a break is taken.
inline Amount most_during(const VehicleType& type, Int number, Int tier) {
    const Int row = number * max_tiers + tier;
    return amount_of(type.break_max_load + row * dimensions_per_tier);
}

// The breaks, as bits, that can't be taken with so much aboard.
inline Int too_heavy_for(const VehicleType& type, const Amount& load, Int tier) {
    Int heavy = 0;
    for (Int number = 0; number < type.breaks; ++number) {
        if (!within(load, most_during(type, number, tier))) heavy |= Int{1} << number;
    }
    return heavy;
}

// Whether a break is among some, as bits.
inline bool is_among(Int breaks, Int number) { return (breaks >> number & 1) != 0; }

// When a route began, as far as breaks hang on it, that begins here at `begin`.
inline Int counted_begin(const VehicleType& type, Int begin) {
    return type.breaks_since == none ? begin : type.breaks_since;
}

// A break of a route that begins at `begin`.
inline Break break_of(const VehicleType& type, Int number, Int begin) {
    const bool follows = type.break_after_departure[number] == 1;
    const Int since = follows ? counted_begin(type, begin) : 0;
    return {since + type.break_earliest[number], since + type.break_latest[number],
            type.break_duration[number]};
}

// Whether a break may be taken on the way, by who drives as fast all day.
inline bool may_rest_on_way(const VehicleType& type, Int number) {
    return type.break_anywhere[number] == 1 && is_steady(type);
}

// Whether a break can be over before a route begins, which then hasn't it.
inline bool over_before(const VehicleType& type, Int number, Int begin) {
    return break_of(type, number, begin).end(none) <= counted_begin(type, begin);
}

// The first instant later than `begin` by which one more break is over; `far`: none is, or a route
// can't begin then.
inline Int later_begin(const VehicleType& type, Int begin) {
    Int later = far;
    for (Int number = 0; number < type.breaks; ++number) {
        const Int end = break_of(type, number, 0).end(none);
        if (type.break_after_departure[number] == 0 && end > begin) later = std::min(later, end);
    }
    return type.breaks_since == none ? later : far;
}

// The last instant by `begin` by which one more break is over; `none`: none is.
inline Int last_over_by(const VehicleType& type, Int begin) {
    Int last = none;
    for (Int number = 0; number < type.breaks; ++number) {
        const Int end = break_of(type, number, 0).end(none);
        if (type.break_after_departure[number] == 0 && end <= begin) last = std::max(last, end);
    }
    return type.breaks_since == none ? last : none;
}

// Whether a route that begins and ends then has to have none of the breaks from `number` on.
inline bool none_due(const VehicleType& type, Int number, Int begin, Int end) {
    for (; number < type.breaks; ++number) {
        if (break_of(type, number, begin).latest < end && !over_before(type, number, begin)) {
            return false;
        }
    }
    return true;
}

// Until when the next break from `number` on has to begin, of a route that begins at `begin`; `far`
// if none is left.
inline Int latest_rest(const VehicleType& type, Int number, Int begin) {
    while (number < type.breaks && over_before(type, number, begin)) ++number;
    return number < type.breaks ? break_of(type, number, begin).latest : far;
}

// Whether breaks between two stops are taken later if the route begins later.
inline bool follow_departure(const VehicleType& type, Rests rests) {
    if (!has_breaks(type) || type.breaks_since != none) return false;
    for (Int index = 0; index < rests.count(); ++index) {
        const Int number = rests.number(index);
        if (is_stated(number) && type.break_after_departure[number] == 1) return true;
    }
    return false;
}

// Whether any break is taken later if the route begins later.
inline bool any_follows_departure(const VehicleType& type) {
    const Int* follows = type.break_after_departure;
    return type.breaks_since == none && std::count(follows, follows + type.breaks, 1) > 0;
}

// Whether a break counts in the working duration.
inline bool is_paid(const VehicleType& type, Int number) { return type.break_unpaid[number] == 0; }

// How long the breaks between two stops are that don't count in the working duration.
inline Int unpaid_of(const VehicleType& type, Rests rests) {
    Int unpaid = 0;
    for (Int index = 0; index < rests.count(); ++index) {
        const Int number = rests.number(index);
        if (is_stated(number) && !is_paid(type, number)) unpaid += type.break_duration[number];
    }
    return unpaid;
}

// A break by when its route begins, as `TimeSegment` says: of a route that is timed for many
// beginnings at once.
class JoinedBreak {
public:
    JoinedBreak(const VehicleType& type, Int number)
        : follows_(type.break_after_departure[number] == 1 && type.breaks_since == none) {
        const Break stated = break_of(type, number, 0);
        opens_ = follows_ ? TimeSegment{stated.earliest, none} : TimeSegment{none, stated.earliest};
        latest_ = stated.latest;
        duration_ = stated.duration;
    }

    // Narrow when a route begins at which something is at `time`, by the last begin of the break.
    // In place; false if it is too late.
    bool lets(Interval& begins, TimeSegment time) const {
        if ((follows_ ? time.d : time.c) > latest_) return false;
        return narrow(
            begins, follows_ ? Interval{time.c - latest_, far} : Interval{none, latest_ - time.d});
    }

    // When it is over for who may take it from then on.
    TimeSegment end(TimeSegment time) const { return behind(later(time, opens_), duration_); }

private:
    bool follows_;
    TimeSegment opens_;
    Int latest_, duration_;
};

// The latest departure of a leg with breaks that ends by `arrival`, as far as breaks delay it.
//
// `back` tells it without them.
template <class Back>
Int departure_before(const VehicleType& type, Rests rests, Int begin, Int arrival,
                     const Back& back) {
    Int time = arrival;
    bool driven = false;
    for (Int index = rests.count() - 1; index >= 0; --index) {
        const Int number = rests.number(index);
        if (rests.place(index) != RestPlace::arrival && !driven) {
            time = back(time);
            driven = true;
        }
        time -= length_of(type, number);
        if (is_stated(number) && type.break_after_departure[number] == 0) {
            time = std::min(time, break_of(type, number, begin).latest);
        }
    }
    return driven ? time : back(time);
}

// The breaks that may come next, on a route that begins at `begin`: from a number on, but for those
// that are too heavy for what is aboard, as bits.
struct BreaksAhead {
    Int next, heavy, begin;
};

}  // namespace tandem
