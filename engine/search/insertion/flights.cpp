
#include "rules/launch_place.h"
#include "search/insertion/offers.h"
#include "search/route/drone_data.h"
#include "search/route/refresh.h"
#include "search/route/stop_loads.h"

namespace tandem {
namespace {

// Returns until which stop some drone of a row is free that is aboard at stop `launch`: that stop
// alone if all are launched there, the one before if none is aboard.
Int free_until(const ProblemData& data, const Fleet& fleet, Int slot, Int launch, Int row) {
    const Route& route = fleet.route[slot];
    const View<const Sortie, 1> sorties = sorties_of(fleet, slot);
    const Int number = first_drone(data.type, route.type, row);
    Int until = launch - 1;
    for (Int drone = number; drone < number + data.type[row].drones; ++drone) {
        Int free = route.length;
        for (const Sortie& sortie : sorties) {
            if (sortie.drone != drone || sortie.recovery <= launch) continue;
            free = sortie.launch < launch ? launch - 1 : sortie.launch;
            break;
        }
        until = std::max(until, free);
    }
    return until;
}

// Sorties to a customer by drones of a row on a route.
class Flights {
public:
    Flights(const Insertion& insertion, Int slot, Int row)
        : insertion_(insertion), slot_(slot), row_(row) {}

    // Lists those from stop `launch`.
    void offer_from(Int launch) const {
        const Stop& from = stops_[launch];
        if (!is_launch_place(data_.no_launch, from.node)) return;
        const Leg out = leg_from(inward_, from.node);
        // Most stops are so far away that nothing else needs to be looked at.
        if (flown_cost(rate_, out.distance) - saved_ >= best_) return;
        if (!in_range(data_, type_, from.node, node_)) return;
        const Int ready = launch > 0 ? take_off(type_, from.arrival, 0) : from.arrival;
        const double late = priced_ ? lateness_cost(data_, node_, ready + out.duration) : 0.0;
        if (flown_cost(rate_, out.distance) + late - saved_ >= best_) return;
        Front front{from.arrival + out.duration};
        if (!front.serve(place_)) return;
        const Int left = gone_by(type_, from.leave);
        const Int begun = recovery_end(type_, ready) - idle_;
        Int last = free_until(data_, searcher_.now, slot_, launch, row_);
        const Int furthest = searcher_.now.trip(slot_, from.trip).last;
        last = std::min({last, furthest, crosses_ ? launch + max_span : launch});
        for (Int recovery = data_.strategy.loops ? launch : launch + 1; recovery <= last;
             ++recovery) {
            const Stop& to = stops_[recovery];
            const Leg home = leg_to(onward_, to.node);
            const double flown = flown_cost(rate_, out.distance + home.distance);
            if (flown + late - saved_ >= best_ || !in_range(data_, type_, to.node, node_)) continue;
            if (!is_launch_place(data_.no_launch, to.node)) continue;
            if (recovery < route_.length - 1 &&
                recovery_end(type_, front.time + home.duration) + to.gap >
                    stops_[recovery + 1].latest) {
                continue;
            }
            const Flight flight{type_, place_, out.duration, home.duration};
            if (!within_endurance(type_, left, left, to.arrival)) {
                // Held back for the window, the truck leaves later and may wait less on its way.
                if (earliest_back(place_, left + out.duration, 0) <= left) break;
                if (to.arrival > earliest_back(place_, left + out.duration, home.duration)) {
                    continue;
                }
            }
            // The truck leaves no sooner than the drone is aboard, whatever else it has time for.
            const Int longer = std::max(Int{0}, begun + flight.duration() - to.leave);
            double cost = flown + usual_work_cost(rate_, longer) + late - saved_;
            if (loaded_) {
                cost += load_more(data_, searcher_.now, slot_, launch, recovery, node_);
            }
            if (cost < best_ && flight.can_serve() && room_between(room_, launch, recovery)) {
                add_offer(searcher_, cost, slot_, launch, recovery)
                    .add(How::fly, node_, launch, recovery, drone_);
            }
        }
    }

private:
    const Insertion& insertion_;
    const Int slot_, row_;
    const ProblemData& data_ = insertion_.data;
    const Searcher& searcher_ = insertion_.searcher;
    const Int node_ = insertion_.node;
    const View<const Stop, 1> stops_ = searcher_.now.stop[slot_];
    const Route& route_ = searcher_.now.route[slot_];
    const Int drone_ = first_drone(data_.type, route_.type, row_);  // stands for the row's
    const VehicleType& type_ = data_.type[row_];
    const Rate rate_ = data_.rate[row_];
    const Windows place_ = data_.place.by_air(type_)[node_];
    const LegRow inward_ = legs_to(data_.back, type_.drone_travel, node_);
    const LegRow onward_ = legs_from(data_.leg, type_.home_travel, node_);
    const Room room_ = room_on(data_, searcher_.now, slot_, route_.type, node_);
    const bool crosses_ = data_.strategy.crossings && !waits_for_drones(data_.type[route_.type]);
    const double best_ = insertion_.best.cost;
    // At most, beside what is flown and worked.
    const double saved_ = most_saved(data_, searcher_.now, slot_, node_);
    const Int idle_ = idle_time(route_);  // how long the route could work longer at no cost
    const bool priced_ = data_.evaluation[route_.type].priced;
    const bool loaded_ = loads_cost(data_, route_.type);
};

}  // namespace

void offer_sorties(const Insertion& insertion, Int slot, Int first, Int last) {
    const auto [data, searcher, node, enlarge, best] = insertion;
    const Fleet& now = searcher.now;
    const Route& route = now.route[slot];
    const Trip& trip = now.trip(slot, now.stop(slot, first).trip);
    const auto may_fly = [&, &data = data, node = node](Int row) {
        return data.can(row, 1, node) && has_battery(data.type, route, now.sortie[slot], trip, row);
    };
    const Int first_row = first_drone_row(data.type, route.type);
    if (next_drone_row(data.type, first_row) == no_row) {
        if (!may_fly(first_row)) return;
        const Flights flights(insertion, slot, first_row);
        for (Int launch = first; launch <= last; ++launch) flights.offer_from(launch);
        return;
    }
    for (Int launch = first; launch <= last; ++launch) {
        for (Int row = first_row; row >= 0; row = next_drone_row(data.type, row)) {
            if (may_fly(row)) Flights(insertion, slot, row).offer_from(launch);
        }
    }
}

}  // namespace tandem
