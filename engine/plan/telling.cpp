#include "plan/telling.h"

#include "guard.h"

namespace tandem {

RouteTeller::RouteTeller(Plan& plan, const Speeds& speeds, Int type, Int vehicle, Int begin)
    : numbers_(plan.numbers),
      speeds_(speeds),
      begin_(begin),
      driver_(driver_from(speeds.type, begin)),
      route_(add({type, vehicle, 0})) {}

std::size_t RouteTeller::add(std::initializer_list<Int> numbers) {
    numbers_.insert(numbers_.end(), numbers);
    return numbers_.size() - numbers.size();
}

void RouteTeller::trip(Int charged_from, Int charged_until) {
    ++numbers_[route_ + 2];
    trip_ = add({charged_from, charged_until, 0, 0, 0});
}

void RouteTeller::stop(const ToldStop& stop) {
    ++numbers_[trip_ + 2];
    visit(stop);
}

void RouteTeller::sortie(const ToldSortie& sortie) {
    ++numbers_[trip_ + 3];
    const auto& [drone, launch, recovery, takeoff, begin, end, visits] = sortie;
    add({drone, launch, recovery, takeoff, begin, end, visits});
}

void RouteTeller::visit(const ToldStop& visit) {
    const auto& [node, arrival, start, departure, setup, is_launch_site] = visit;
    add({node, arrival, start, departure, setup, is_launch_site});
}

void RouteTeller::leg(Int stop, const ToldLeg& leg) {
    const PausedLeg whole{speeds_,      leg.rests, begin_,   leg.leave,
                          leg.duration, leg.stood, leg.setup};
    RestedLeg rested = whole.by(driver_);
    for (Int index = 0; index < leg.rests.count(); ++index) {
        const Int start = rested.take(leg.rests.number(index), leg.rests.place(index));
        rest(stop, leg.rests, index, {rested.stood(), start, rested.time()});
    }
    rested.arrive();
    driver_ = whole.having_arrived(rested);
}

void RouteTeller::rest(Int stop, Rests rests, Int index, const RestTimes& times) {
    ++numbers_[trip_ + 4];
    const Int number = rests.number(index), place = Int(rests.place(index));
    add({is_stated(number) ? number : unstated, stop, place, times.stood, times.start, times.end});
}

}  // namespace tandem

using namespace tandem;

int tandem_open_plan(tandem_plan** plan) {
    return guarded([&] { *plan = std::make_unique<tandem_plan>().release(); });
}

int tandem_close_plan(tandem_plan* plan) {
    return guarded([&] { const std::unique_ptr<tandem_plan> owned(plan); });
}

int tandem_numbers_of(tandem_plan* plan, tandem_i64_1d* numbers) {
    return guarded([&] { *numbers = {plan->numbers.data(), {Int(plan->numbers.size())}}; });
}
