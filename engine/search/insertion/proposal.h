// A trip that goes on otherwise behind one of its stops, until it is as it was.
#pragma once

#include "search/insertion/newcomer.h"
#include "search/route/flown_trips.h"
#include "search/route/routes.h"

namespace tandem {

// A trip of a route as it is.
struct OnTrip {
    OnTrip(const ProblemData& problem, const Fleet& routes, Int of_slot, const Trip& tried)
        : data(problem),
          fleet(routes),
          slot(of_slot),
          trip(tried),
          route(fleet.route[slot]),
          type(data.type[route.type]),
          rate(data.rate[route.type]),
          stops(fleet.stop[slot]),
          evaluation(data.evaluation[route.type]),
          places(data.place.by_truck(type)),
          asks_more(evaluation.priced || bounds_trips(type) || bounds_reach(type) ||
                    limits_legs(type)) {}

    const ProblemData& data;
    const Fleet& fleet;
    const Int slot;
    const Trip& trip;
    const Route& route;
    const VehicleType& type;
    const Rate& rate;
    const View<const Stop, 1> stops;
    const Evaluation& evaluation;
    const NodeTable places;
    const bool asks_more;  // than windows, loads, and how far it is and how long it takes
};

// Tells whether all that matters of a route's times is known at its stops.
inline bool joins_anywhere(const ProblemData& data, const Route& route) {
    const Evaluation& evaluation = data.evaluation[route.type];
    return !evaluation.priced || (!evaluation.held_back && !evaluation.retimed &&
                                  !evaluation.lasting && route.sorties == 0);
}

// Who is inserted by some proposals, of which each goes on where another has come.
using Inserted = std::array<Added, most_pickups + 1>;

// Where a proposal is: behind which stop of the trip, how much further it has come, and when.
struct Whereabouts {
    PaidFront front;
    Int behind;
    Int further = 0;
};

// What rules ask of a proposal that few state: energy, range, travel, time aboard, soft windows,
// loads that cost.
class RarerRules {
public:
    explicit RarerRules(Inserted& inserted) : inserted_(inserted) {}

    // Goes on to somebody by such a leg, whom it comes to at such a time.
    void serve(const OnTrip& on, const Whereabouts& at, const Newcomer& newcomer, const Leg& out);

    // Goes on to the next stop, where it has come to, by such a leg, and to the end of its block.
    void pass(const OnTrip& on, const Whereabouts& at, const Leg& leg);

    // Goes on to the next stop, whenever that is.
    void skip() { here_ = nowhere; }

    // Whether it may go on to the next stop by such a leg, and then as before.
    bool allow(const OnTrip& on, const Whereabouts& at, const Leg& leg) const;

    // What that costs more. In place: when it ends, where that hangs on more than is joined.
    double cost(const OnTrip& on, const Whereabouts& at, const Leg& leg, Whole& whole) const;

private:
    // Where it is: at whom was inserted last, or at the stop.
    Int here(const OnTrip& on, Int behind) const {
        return here_ == nowhere ? on.stops[behind].node : here_;
    }

    void drive(const OnTrip& on, Int behind, Int to, const Leg& leg);

    // Whether nobody's parcel is too long aboard who is served so much later from a stop on.
    static bool arrive_fresh(const OnTrip& on, Int p, Int later);

    Inserted& inserted_;
    bool is_near_ = true;   // to where the trip begins and ends
    bool is_fresh_ = true;  // what is brought to those inserted
    Int count_ = 0;         // of those inserted
    Int here_ = nowhere;    // who was inserted behind that stop last
    Leg legs_{};            // more of them, without setups
    Int aboard_ = 0;        // more than there was
    double carried_ = 0.0;  // more, by the way
    double windows_ = 0.0;  // what lateness and waiting cost more
};

// Where nobody states any.
struct NoRarerRules {
    explicit NoRarerRules(Inserted&) {}
    void serve(const OnTrip&, const Whereabouts&, const Newcomer&, const Leg&) {}
    void pass(const OnTrip&, const Whereabouts&, const Leg&) {}
    bool allow(const OnTrip&, const Whereabouts&, const Leg&) const { return true; }
    double cost(const OnTrip&, const Whereabouts&, const Leg&, Whole&) const { return 0.0; }
};

// Who is inserted into a trip of a route where `joins_anywhere`, one after another, each behind a
// stop past which no drone flies.
//
// Each rule is asked here alone: for what it forbids, and for what it costs.
template <class Rarer>
class Proposal {
public:
    // Leaves stop `p` as it is left.
    Proposal(const OnTrip& on, Int p, Inserted& inserted)
        : on_(on), at_{front_of(on.stops[p]), p}, rarer_(inserted) {}

    // Behind which stop of the trip it is.
    Int behind() const { return at_.behind; }

    // How much further it has come.
    Int further() const { return at_.further; }

    Front front() const { return {at_.front.time}; }

    // Goes on to somebody by such a leg. False if that is too late.
    bool serve(const Newcomer& newcomer, const Leg& out) {
        rarer_.serve(on_, at_, newcomer, out);
        at_.further += out.distance;
        return at_.front.serve(newcomer.place, out.duration);
    }

    // Goes on to the next stop by such a leg, and to the end of its block. False if that can't be.
    bool pass(const Leg& leg) {
        const Stop& next = on_.stops[at_.behind + 1];
        at_.front.drive(leg.duration);
        if (at_.front.time > next.latest || at_.front.time < next.lo) return false;
        rarer_.pass(on_, at_, leg);
        at_.further += leg.distance - on_.stops[at_.behind].leg;
        if (on_.route.sorties > 0) {
            at_.front.pass({next.d, next.c}, next.dep);
        } else {
            at_.front.serve(on_.places[next.node]);
        }
        at_.behind = next.last;
        return true;
    }

    // Goes on to the next stop by such a leg, whenever that is.
    void skip(const Leg& leg) {
        rarer_.skip();
        at_.further += leg.distance - on_.stops[at_.behind++].leg;
    }

    // Returns what it costs more to go on to the next stop by such a leg, and then as before, with
    // what serving those inserted costs; `infeasible` if that breaks a rule.
    double price(const Leg& leg, double serving) const {
        PaidFront front = at_.front;
        front.drive(leg.duration);
        std::optional<Whole> whole = join(front, rear_of(on_.stops[at_.behind + 1]));
        if (!whole || !rarer_.allow(on_, at_, leg)) return infeasible;
        const Int further = at_.further + leg.distance - on_.stops[at_.behind].leg;
        double cost = double(further) * on_.rate.distance + rarer_.cost(on_, at_, leg, *whole);
        cost += serving;
        return on_.evaluation.timed ? cost + longer_cost(on_.type, on_.rate, on_.route, *whole)
                                    : cost;
    }

private:
    const OnTrip& on_;
    Whereabouts at_;
    Rarer rarer_;
};

}  // namespace tandem
