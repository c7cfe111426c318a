// Which breaks a route has, and where they are taken.
#pragma once

#include "rules/driving.h"
#include "rules/hub.h"
#include "search/route/lags.h"

namespace tandem {

// Return when a route begins, as far as breaks hang on it.
inline Int begin_of(const VehicleType& type, View<const Stop, 1> stops) {
    return std::max(type.shift_earliest, std::max(stops[0].release, stops[0].hold));
}

// The breaks that a route has which begins at an instant, unless it ends before them, in order.
class DueBreaks {
public:
    DueBreaks(const VehicleType& type, Int begin) {
        for (Int number = 0; number < num_breaks(type); ++number) {
            if (!over_before(type, number, begin)) {
                number_[std::size_t(count_++)] = number;
            }
        }
    }

    Int count() const { return count_; }
    Int operator[](Int index) const { return number_[std::size_t(index)]; }

private:
    Int count_ = 0;
    std::array<Int, most_breaks> number_;
};

// Return how long the breaks on a route are that don't count in the working duration.
inline Int unpaid_on(const VehicleType& type, View<const Stop, 1> stops) {
    Int unpaid = 0;
    for (const Stop& stop : stops) unpaid += unpaid_of(type, Rests(stop.rests));
    return unpaid;
}

// Tell whether a timed route lacks a break.
inline bool lacks_break(const VehicleType& type, const Route& route, View<const Stop, 1> stops) {
    const Int begin = begin_of(type, stops);
    Int taken = 0;
    for (const Stop& stop : stops.first(route.length)) {
        const Rests rests(stop.rests);
        for (Int index = 0; index < rests.count(); ++index) taken |= Int{1} << rests.number(index);
    }
    for (Int number = 0; number < num_breaks(type); ++number) {
        if (!is_among(taken, number) && break_of(type, number, begin).latest < route.end &&
            !over_before(type, number, begin)) {
            return true;
        }
    }
    return false;
}

// Return the first instant later than `begin` at which a route had better begin, perhaps: once a
// break is over, or the speed changes. `far`: there is none.
inline Int next_begin(const ProblemData& data, Int k, Int begin) {
    const VehicleType& type = data.type[k];
    const Int later = later_begin(type, begin), changes = num_changes(type);
    if (!limits_timed_travel(type) && !follows_driver(type)) return later;
    const View<const Int, 1> times = data.profile_time[k];
    const Int change = changes_until(times, changes, begin);
    return change < changes ? std::min(later, times[change]) : later;
}

// Tell whether a driver pauses for stated breaks alone, and nobody else hangs on when.
inline bool has_breaks_alone(const ProblemData& data, const Route& route) {
    const VehicleType& type = data.type[route.type];
    return has_breaks(type) && !has_driving_rules(type) && !orders_cross(data) &&
           !shares_chargers(type);
}

// Tell whether breaks of a route are chosen so: by `TimeSegment`, or where speeds change for each
// of some instants at which it may begin.
//
// Not where drones fly, drivers rest by rules, or other vehicles are waited for: there breaks are
// placed as rests are.
inline bool joins_breaks(const ProblemData& data, const Route& route) {
    return has_breaks_alone(data, route) && route.sorties == 0;
}

// Where the breaks of a route are, and when it may begin.
class PlacedBreaks {
public:
    PlacedBreaks() = default;
    PlacedBreaks(View<const Stop, 1> stops, Int begin) : begin_(begin) {
        for (Int p = 0; p < stops.size(); ++p) {
            const Rests rests(stops[p].rests);
            for (Int index = 0; index < rests.count(); ++index) {
                insert(count_, {rests.number(index), p, rests.place(index)});
            }
        }
    }

    // Which one, behind which stop, and where.
    struct One {
        Int number, stop;
        RestPlace place;

        bool is_behind(const One& other) const {
            return stop > other.stop || (stop == other.stop && place >= other.place);
        }
    };

    Int begin() const { return begin_; }
    Int count() const { return count_; }
    const One& operator[](Int index) const { return one_[std::size_t(index)]; }

    // These on a route that begins no sooner than then.
    PlacedBreaks from(Int begin) const {
        PlacedBreaks next = *this;
        next.begin_ = begin;
        return next;
    }

    // These with another one at an index, instead of the one there.
    PlacedBreaks with(Int index, const One& one) const {
        PlacedBreaks next = *this;
        next.one_[std::size_t(index)] = one;
        return next;
    }

    // These with one more at an index.
    PlacedBreaks with_more(Int index, const One& one) const {
        PlacedBreaks next = *this;
        next.insert(index, one);
        return next;
    }

    // Tell whether the one at an index lies between those beside it.
    bool is_in_order(Int index) const {
        return (index == 0 || (*this)[index].is_behind((*this)[index - 1])) &&
               (index + 1 == count_ || (*this)[index + 1].is_behind((*this)[index]));
    }

    // Write them. In place.
    void write(View<Stop, 1> stops) const {
        for (Stop& stop : stops) stop.rests = 0;
        for (Int index = 0; index < count_; ++index) {
            Stop& stop = stops[(*this)[index].stop];
            stop.rests =
                Rests(stop.rests).with((*this)[index].number, (*this)[index].place).packed();
        }
    }

private:
    void insert(Int index, const One& one) {
        for (Int next = count_; next > index; --next) {
            one_[std::size_t(next)] = (*this)[next - 1];
        }
        one_[std::size_t(index)] = one;
        ++count_;
    }

    Int begin_ = none;
    Int count_ = 0;
    std::array<One, most_breaks> one_{};
};

}  // namespace tandem
