// Plans as numbers, in the order that `tandem.h` states.
#pragma once

#include <initializer_list>
#include <memory>
#include <vector>

#include "rules/driving.h"
#include "rules/flown_trip.h"

// As C knows it.
struct tandem_plan final {
    std::vector<std::int64_t> numbers;
};

namespace tandem {

using Plan = tandem_plan;

constexpr Int unstated = -1;  // in place of the number of a break: a rest that rules ask for

// A stop, or a visit of a drone.
struct ToldStop {
    Int node, arrival, start, departure, setup;
    bool is_launch_site = false;
};

struct ToldSortie {
    Int drone, launch, recovery;  // stops of its trip
    Int takeoff, begin, end;      // and recovery
    Int visits;                   // told behind it
};

// What is between two stops.
struct ToldLeg {
    Rests rests;
    Int leave, duration;  // at full speed, without setup and what is rested meanwhile
    Int stood;            // how long the driver was at other work before
    Int setup;            // at its end
};

// A stop of a trip, which may be its first or last, with what who flies by itself does there.
inline ToldStop with_handling(const VehicleType& type, ToldStop stop, bool is_first, bool is_last) {
    if (!flies(type)) return stop;
    if (is_first) stop.departure = take_off(type, stop.departure, 0);
    if (is_last) {
        stop.arrival = recovery_begin(type, stop.arrival);
        stop.start = recovery_begin(type, stop.start);
    }
    return stop;
}

// Tells a route: its trips, of each its stops, then its sorties with the visits of each, then its
// legs.
class RouteTeller {
public:
    // Of one vehicle, whose first trip begins at `begin`.
    RouteTeller(Plan& plan, const Speeds& speeds, Int type, Int vehicle, Int begin);

    // The vehicle is charged before it from one instant to another, unless that is the same.
    void trip(Int charged_from, Int charged_until);

    void stop(const ToldStop& stop);
    void sortie(const ToldSortie& sortie);
    void visit(const ToldStop& visit);

    // Between a stop of the trip and the next.
    void leg(Int stop, const ToldLeg& leg);

private:
    // When the truck stands for a break, and when that begins and ends.
    struct RestTimes {
        Int stood, start, end;
    };

    // Tell numbers more. Returns where they stand.
    std::size_t add(std::initializer_list<Int> numbers);

    void rest(Int stop, Rests rests, Int index, const RestTimes& times);

    std::vector<Int>& numbers_;
    Speeds speeds_;
    Int begin_;
    Driver driver_;
    std::size_t route_, trip_ = 0;  // where they are told
};

}  // namespace tandem
