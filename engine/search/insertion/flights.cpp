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

namespace {

// From where to where a drone flies, and at which of these the truck stops at a launch site by
// more, behind that stop; `nowhere` at others.
struct FlownBetween {
    Int launch, recovery, launch_halt, recovery_halt;
};

// Sorties to a customer by drones of a row that begin or end at stops at launch sites to come.
class Halting {
public:
    Halting(const Insertion& insertion, Int slot, Int row)
        : data_(insertion.data),
          searcher_(insertion.searcher),
          slot_(slot),
          drone_(first_drone(data_.type, searcher_.now.route[slot].type, row)),
          node_(insertion.node),
          k_(searcher_.now.route[slot].type),
          stops_(searcher_.now.stop[slot]),
          type_(data_.type[row]),
          rate_(data_.rate[row]),
          place_(data_.place.by_air(type_)[node_]),
          inward_(legs_to(data_.back, type_.drone_travel, node_)),
          onward_(legs_from(data_.leg, type_.home_travel, node_)),
          crossing_(data_.strategy.crossings && !waits_for_drones(data_.type[k_])),
          best_(insertion.best.cost),
          saved_(most_saved(data_, searcher_.now, slot, node_)),
          idle_(idle_time(searcher_.now.route[slot])) {}

    // Lists those for which the truck stops at a launch site behind stop `p`.
    void offer_behind(Int p, Int halt) const {
        if (!may_halt(data_.halts, k_, halt) || !in_range(data_, type_, halt, node_) ||
            !is_served_by(p, data_.halt_after[halt])) {
            return;
        }
        const TravelLegs legs = legs_of(data_.leg, data_.type[k_].travel);
        const Stop &here = stops_[p], &behind = stops_[p + 1];
        const Leg there = leg(legs, here.node, halt), on = leg(legs, halt, behind.node);
        const Leg out = leg_from(inward_, halt), home = leg_to(onward_, halt);
        const Trip& trip = searcher_.now.trip(slot_, here.trip);
        const Int distance = there.distance + on.distance - here.leg;
        if (distance > longest_trip(data_.type[k_]) - trip.distance) return;
        const double driven = drive_cost(data_.rate[k_], distance) + data_.halt_cost[halt] - saved_;
        if (driven + flown_cost(rate_, std::min(out.distance, home.distance)) >= best_) return;
        // While drones fly, the truck may have time before they are back.
        const Int detour = there.duration + on.duration - here.gap;
        const Int longer = detour - idle_ - here.idle;
        const Int handled = handling_duration(type_);
        const Int least_longer = std::max(Int{0}, longer - handled);
        if (driven + usual_work_cost(data_.rate[k_], least_longer) >= best_) return;
        if (data_.strategy.loops) {
            const Flight loop{type_, place_, out.duration, home.duration};
            offer({p, p, halt, halt}, loop, driven, out.distance + home.distance,
                  recovery_end(type_, longer + loop.duration()));
        }
        if (!crossing_) return;
        offer_landings(p, halt, out, driven, longer);
        const Int last = std::min(trip.last, p + max_span);
        for (Int recovery = p + 1; recovery <= last; ++recovery) {
            const Stop& to = stops_[recovery];
            const Leg back = leg_to(onward_, to.node);
            if (!may_end_at(to)) continue;
            const Flight flight{type_, place_, out.duration, back.duration};
            const Int begun = recovery_end(type_, here.leave + there.duration);
            offer({p, recovery, halt, nowhere}, flight, driven, out.distance + back.distance,
                  std::max(longer, begun + flight.duration() - to.leave - idle_));
        }
        for (Int launch = std::max(trip.first, p - max_span + 1); launch <= p; ++launch) {
            const Stop& from = stops_[launch];
            if (!may_end_at(from)) continue;
            const Leg way = leg_from(inward_, from.node);
            const Flight flight{type_, place_, way.duration, home.duration};
            const Int begun = recovery_end(type_, from.arrival + on.duration);
            offer({launch, p, nowhere, halt}, flight, driven, way.distance + home.distance,
                  std::max(longer - handled, begun + flight.duration() - behind.leave - idle_));
        }
    }

private:
    // Lists those from a launch site behind stop `p` to one more behind a later stop.
    //
    // `driven` and `longer` are what the first stop costs, and how much longer it takes.
    void offer_landings(Int p, Int halt, const Leg& out, double driven, Int longer) const {
        const TravelLegs legs = legs_of(data_.leg, data_.type[k_].travel);
        const View<const std::int32_t, 1> near = nearest_halts(data_, node_);
        const Int last = std::min(searcher_.now.trip(slot_, stops_[p].trip).last - 1, p + max_span);
        for (Int rank = 0; rank < std::min(max_landings, near.size()); ++rank) {
            const Int landing = near[rank];
            if (landing < 0) break;
            if (!may_halt(data_.halts, k_, landing) || !in_range(data_, type_, landing, node_)) {
                continue;
            }
            const Leg home = leg_to(onward_, landing);
            const Flight flight{type_, place_, out.duration, home.duration};
            for (Int q = p + 1; q <= last; ++q) {
                const Stop &here = stops_[q], &behind = stops_[q + 1];
                const Leg there = leg(legs, here.node, landing),
                          on = leg(legs, landing, behind.node);
                const Int detour = there.duration + on.duration - here.gap - here.idle;
                const double cost =
                    driven + data_.halt_cost[landing] +
                    drive_cost(data_.rate[k_], there.distance + on.distance - here.leg);
                if (cost >= best_ || !is_served_by(q, data_.halt_after[landing])) continue;
                offer({p, q, halt, landing}, flight, cost, out.distance + home.distance,
                      longer + std::max(Int{0}, detour));
            }
        }
    }

    // Tells whether a drone may leave, or come to, a stop as it flies to the customer.
    bool may_end_at(const Stop& stop) const {
        return is_launch_place(data_.no_launch, stop.node) &&
               in_range(data_, type_, stop.node, node_);
    }

    // Tells whether somebody, if anybody, is served up to stop `p`, drones being recovered by then.
    bool is_served_by(Int p, Int customer) const {
        if (customer < 0) return true;
        const Place& place = searcher_.now.where[customer];
        if (place.slot != slot_) return false;
        if (place.position >= 0) return place.position <= p;
        return searcher_.now.sortie(slot_, place.sortie).recovery <= p;
    }

    // Lists an insertion, if that may be cheapest, by how much longer the vehicle works at least.
    void offer(const FlownBetween& way, const Flight& flight, double driven, Int flown,
               Int longer) const {
        const double cost = driven + flown_cost(rate_, flown) +
                            usual_work_cost(data_.rate[k_], std::max(Int{0}, longer));
        if (cost >= best_ || unreachable(std::max(flight.out, flight.home)) ||
            !flight.can_serve()) {
            return;
        }
        const auto& [launch, recovery, from, to] = way;
        const bool comes_back = from >= 0 && launch == recovery;
        const Int last = std::max(launch + 1, to < 0 ? recovery : recovery + 1);
        Offer& move = add_offer(searcher_, cost, slot_, launch, last);
        Int begin = launch, end = recovery;
        if (from >= 0) {
            move.add(How::halt, from, ++begin);
            ++end;
        }
        if (to >= 0 && !comes_back) move.add(How::halt, to, ++end);
        move.add(How::fly, node_, begin, end, drone_);
    }

    const ProblemData& data_;
    const Searcher& searcher_;
    Int slot_;
    Int drone_;  // stands for the row's
    Int node_, k_;
    View<const Stop, 1> stops_;
    const VehicleType& type_;
    Rate rate_;
    Windows place_;
    LegRow inward_, onward_;
    bool crossing_;  // drones may be recovered elsewhere than they are launched
    double best_;
    double saved_;  // at most, beside what is driven, flown and worked
    Int idle_;      // how long the route could work longer at no cost
};

}  // namespace

void offer_halts(const Insertion& insertion, Int slot, Int first, Int last) {
    const auto [data, searcher, node, enlarge, best] = insertion;
    const Fleet& now = searcher.now;
    const Route& route = now.route[slot];
    const Trip& trip = now.trip(slot, now.stop(slot, first).trip);
    for (Int row = first_drone_row(data.type, route.type); row >= 0;
         row = next_drone_row(data.type, row)) {
        if (!data.can(row, 1, node) ||
            !has_battery(data.type, route, now.sortie[slot], trip, row)) {
            continue;
        }
        const Halting halting(insertion, slot, row);
        for (const Int halt : nearest_halts(data, node)) {
            if (halt < 0) break;
            for (Int p = first; p <= last; ++p) halting.offer_behind(p, halt);
        }
    }
}

void offer_halt_trips(const Insertion& insertion, Int slot) {
    const auto [data, searcher, node, enlarge, best] = insertion;
    if (!data.strategy.loops) return;
    const Fleet& now = searcher.now;
    const Route& route = now.route[slot];
    const Int k = route.type, depot = data.type[k].depot;
    if (!may_begin(data, k, node)) return;
    const TravelLegs legs = legs_of(data.leg, data.type[k].travel);
    for (Int row = first_drone_row(data.type, k); row >= 0; row = next_drone_row(data.type, row)) {
        const VehicleType& type = data.type[row];
        if (!data.can(row, 1, node)) continue;
        for (const Int halt : nearest_halts(data, node)) {
            if (halt < 0) break;
            if (!may_halt(data.halts, k, halt) || !in_range(data, type, halt, node)) continue;
            const Leg out = leg(legs_of(data.leg, type.drone_travel), halt, node);
            const Leg home = leg(legs_of(data.leg, type.home_travel), node, halt);
            const Flight flight{type, data.place.by_air(type)[node], out.duration, home.duration};
            const Int driven = leg(legs, depot, halt).distance + leg(legs, halt, depot).distance;
            const double cost = drive_cost(data.rate[k], driven) + data.halt_cost[halt] +
                                flown_cost(data.rate[row], out.distance + home.distance) -
                                most_saved(data, now, slot, node);
            if (cost >= best.cost || !flight.can_serve()) continue;
            for (Int p = -1; p < route.length; ++p) {
                if (p >= 0 && now.stop(slot, p).kind != end_stop) continue;
                Offer& move = add_offer(searcher, cost, slot, p, p + 1);
                move.add(How::begin, depot, p + 1);
                move.add(How::halt, halt, p + 2);
                move.add(How::end, depot, p + 3);
                move.add(How::fly, node, p + 2, p + 2, first_drone(data.type, k, row));
            }
        }
    }
}

}  // namespace tandem
