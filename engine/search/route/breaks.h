// Which breaks a route has, and where they are taken.
#pragma once

#include <vector>

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
inline bool lacks_break(const VehicleType& type, const Tour& tour) {
    const auto& [route, stops, trips, sorties] = tour;
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

    Int begin_ = none, count_ = 0;
    std::array<One, most_breaks> one_{};
};

// When a customer is reached and served who costs by when, by when the route begins.
struct TimedCustomer {
    TimeSegment reached, served;
    Int node;
    std::int32_t before;  // number of the one before on the route, -1 if there is none
};

// A route by when it begins: its end, how much of it isn't paid, and the number of the last of
// those `timed`.
struct AnyBegin {
    Interval begins;
    TimeSegment end;
    Int unpaid;
    std::int32_t last;
};

// A route that begins at an instant, what its work costs, and that customers are served too late or
// waited for.
struct Begun {
    Int begin, end, working;
    double work, missed;

    double cost() const { return work + missed; }
};

// Looks for when routes of one type had better begin. Keeps what it needs for the next.
class BestBegin {
public:
    BestBegin(const ProblemData& data, Int k)
        : data_(data), type_(data.type[k]), rate_(data.rate[k]) {}

    // Return how a route goes that begins when that costs least; of several the one that ends first
    // and works least. Nothing if it works too long anyway.
    const std::optional<Begun>& of(const AnyBegin& route, const std::vector<TimedCustomer>& timed);

private:
    // From when on it costs so much more, once and per ms, that the route begins later.
    struct Turn {
        Int begin;
        double once, slope;
    };

    void note(const TimedCustomer& customer, Int first);
    void begin_at(const AnyBegin& route, Int begin, double missed);

    const ProblemData& data_;
    const VehicleType& type_;
    const Rate& rate_;
    std::vector<Turn> turns_;
    std::optional<Begun> best_;
};

// Instants at which a route may begin by which ways are compared where customers cost by when.
constexpr std::size_t most_compared = 3;

// A break that is taken.
struct Taken {
    PlacedBreaks::One one;
    std::int32_t before;
};

// A break that may be taken, or is over before the route begins.
struct Chosen {
    Int number;
    bool is_over;
};

// What customers cost on a way by when they are served.
struct Times {
    std::int32_t timed = -1;  // the last of them
    double late = 0.0;        // what these cost who are served too late, at the soonest begin
    std::array<double, most_compared> missed{};  // all that these cost, by begins compared
};

struct NoTimes {};

// A way to have come somewhere; lean where customers cost the same at any time.
template <bool is_lean>
struct Way : std::conditional_t<is_lean, NoTimes, Times> {
    TimeSegment now;            // when the truck is there, by when the route begins
    Interval begins;            // for which that holds
    std::int32_t next = 0;      // the first break, of those due, that may still be taken
    std::int32_t left_out = 0;  // bits of those before that aren't
    std::int32_t last = -1;     // break taken
    std::int32_t noted = -1;    // the last one, likewise
};

// A way on a leg: when the truck stands where it last had a break, and when it is at its end.
template <bool is_lean>
struct OnLeg {
    Way<is_lean> way;
    TimeSegment here, there;
    RestPlace place;
};

// Where breaks are taken, and what that makes of a route that begins when that costs least.
struct BreakChoice {
    PlacedBreaks placed;
    Begun timing;
};

// Return all ways to take breaks on a loaded route that may be the cheapest, none that breaks a
// rule by itself, or costs `most_late` as customers are served too late; the cheapest first.
//
// By dynamic programming along the route: of two ways to have taken as many breaks, one is no worse
// that is nowhere later, may begin in the same interval, costs no more by when customers are
// served, and was at those later whom others look back to.
std::vector<BreakChoice> break_choices(const ProblemData& data, const Tour& tour, double most_late);

// Write when each stop of a loaded route may be left at the soonest, whichever breaks are taken
// before. In place.
void note_soonest(const ProblemData& data, const Tour& tour);

// What is known of a route's cost: what it would be at least were nobody served too late, with how
// much work, and what it has to be below.
struct CostBounds {
    double in_time, bar;
    Int working = 0;
};

// Price a loaded route by the cheapest way to take its breaks, of those that `break_choices` knows.
// In place; false if none does, or is below the bar.
bool price_choices(const ProblemData& data, const Fleet& fleet, Int slot, const CostBounds& bounds,
                   bool& settled);

// Price a route that can't begin sooner, as breaks that follow its departure would come too soon:
// as late as it could without them. In place; false if that doesn't do.
bool begin_late(const ProblemData& data, const Fleet& fleet, Int slot, bool& settled);

// Tell whether a priced route might cost less, at least so much, were its breaks elsewhere.
bool may_move_breaks(const ProblemData& data, const Fleet& fleet, Int slot, double least);

// Let the breaks of a priced route be elsewhere, or the route begin later, if that costs less. In
// place; false if it can't be driven any more. Where there is a bar, its cost alone is written.
bool move_breaks(const ProblemData& data, const Fleet& fleet, Int slot, double bar, bool& settled);

}  // namespace tandem
