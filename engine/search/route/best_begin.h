// When a route had better begin of which all else is given.
#pragma once

#include <optional>
#include <vector>

#include "search/route/layout.h"

namespace tandem {

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

}  // namespace tandem
