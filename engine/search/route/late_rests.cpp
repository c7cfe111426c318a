#include "search/route/late_rests.h"

#include <optional>

namespace tandem {
namespace {

// How a driver rests who looks no further than the next stop.
enum class Manner {
    late,     // as late as allowed
    waiting,  // or while waiting
    halving,  // the first part where a break that is stated can be the second
};

class LateRests {
public:
    LateRests(const RestRoute& route, TakenRests& taken, Manner manner)
        : route_(route), type_(route.type), taken_(taken), manner_(manner) {}

    // Come from the beginning of a route to its end. In place; false if that doesn't do.
    bool run(RestLabel& label, Ahead ahead) {
        for (Int p = 0;; ++p) {
            const Way way = route_.way_from(p, ahead, false);
            if (!route_.reach_alone(p, label.time) || !route_.leave_block(label, p)) return false;
            if (route_.is_last(p)) return true;
            if (route_.stops[p].kind == end_stop) {
                route_.reload(label, p);
            } else if (!(label.next < route_.due.count() ? drive_with_breaks(label, way)
                                                         : drive(label, way))) {
                return false;
            }
            ahead = way.ahead;
        }
    }

private:
    // Take a break or a rest on a leg. In place; false if it can't be.
    bool take(RestLabel& label, RestedLeg& leg, Int p, Int number, RestPlace place) {
        if (!has_room(label) || taken_.is_full() || leg.take(number, place) == none) return false;
        taken_.note(label, p, number, place);
        return true;
    }

    bool drive(RestLabel& label, const Way& way) {
        const Int left = label.time;
        RestedLeg leg = route_.leg_of(label, way);
        const auto rest_at = [&](RestPlace place) {
            return take(label, leg, way.p, usual_rest(leg.driver()), place);
        };
        while (leg.is_too_long()) {
            if (!rest_at(RestPlace::way)) return false;
        }
        RestedLeg arriving = leg;
        arriving.arrive();
        const Driver& driver = arriving.driver();
        const auto [waits, ends] = route_.stay_at(way.p + 1, arriving.time() + way.setup);
        const bool helps = manner_ == Manner::waiting && driver.driven > 0 &&
                           route_.may_need_rest(driver, way.ahead) &&
                           rest_duration(type_, usual_rest(driver)) <= waits;
        if ((helps || !may_still_work(type_, driver, ends)) && !rest_at(RestPlace::arrival)) {
            return false;
        }
        leg.arrive();
        route_.arrive(label, way, leg, left);
        return true;
    }

    // As `drive`, of who has breaks to come.
    bool drive_with_breaks(RestLabel& label, const Way& way) {
        const Int left = label.time;
        RestedLeg leg = route_.leg_of(label, way);
        const auto stay = [&](Int arrival) {
            return route_.stay_at(way.p + 1, arrival + way.setup);
        };
        const auto opens = [&](Int arrival) { return arrival + stay(arrival).waits; };
        const auto ends = [&](Int arrival) { return stay(arrival).ends; };
        if (manner_ == Manner::halving && !halve(label, leg, way, ends)) return false;
        if (label.next < route_.due.count()) {
            const std::optional<Rests> rests =
                Unforeseeing(type_, leg, opens, ends)
                    .run({route_.due[label.next], route_.stops[way.p].heavy, route_.truck.begin});
            if (!rests) return false;
            for (Int index = 0; index < rests->count(); ++index) {
                const Int number = rests->number(index);
                if (!take(label, leg, way.p, number, rests->place(index))) return false;
                if (is_stated(number)) ++label.next;
            }
        }
        if (!leg.arrive()) return false;
        route_.arrive(label, way, leg, left);
        return true;
    }

    // Take half a rest and behind it a break that is the other half, where that can't be put off.
    // In place; false if they can't be.
    template <class Ends>
    bool halve(RestLabel& label, RestedLeg& leg, const Way& way, const Ends& ends) {
        const Int number = route_.due[label.next], half = rest_duration(type_, first_part);
        if (!completes_rest(leg, number) || is_among(route_.stops[way.p].heavy, number))
            return true;
        const Int latest = break_of(type_, number, route_.truck.begin).latest - half;
        RestedLeg arriving = leg;
        const bool arrives = !leg.is_too_long() && arriving.arrive();
        if (arrives && ends(arriving.time()) <= latest) return true;
        const bool there = arrives && arriving.time() <= latest;
        const RestPlace before = there ? RestPlace::arrival : RestPlace::departure;
        const bool on_way = !there && may_rest_on_way(type_, number);
        if (!take(label, leg, way.p, first_part, before) ||
            !take(label, leg, way.p, number, on_way ? RestPlace::way : before)) {
            return false;
        }
        ++label.next;
        return true;
    }

    // Tell whether a break would be the second part of a rest behind a first one.
    bool completes_rest(const RestedLeg& leg, Int number) const {
        const Int length = length_of(type_, number);
        return may_rest(type_, leg.driver(), first_part) &&
               length >= rest_duration(type_, second_part) &&
               length < rest_duration(type_, whole_rest);
    }

    const RestRoute& route_;
    const VehicleType& type_;
    TakenRests& taken_;
    const Manner manner_;
};

}  // namespace

bool rest_late(const RestRoute& route, BestRests& best, TakenRests& taken) {
    const RestLabel first = route.beginning();
    const Ahead ahead = route.whole();
    const Ending soonest = route.bound_of(first, first.time, ahead);
    for (const Manner manner : {Manner::late, Manner::waiting, Manner::halving}) {
        if (manner == Manner::halving && route.due.count() == 0) break;
        RestLabel label = first;
        if (LateRests(route, taken, manner).run(label, ahead)) {
            best.keep(label, route.ending_of(label));
        }
        if (!best.may_be_better(soonest)) return true;
    }
    return false;
}

}  // namespace tandem
