
#include "rules/launch_place.h"
#include "search/insertion/offers.h"
#include "search/route/drone_data.h"
#include "search/route/refresh.h"

namespace tandem {
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
