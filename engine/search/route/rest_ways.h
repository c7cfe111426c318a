// Ways along a route by the breaks and rests taken: on a leg all that may be best, and on the whole
// those on which a driver rests as late as allowed, or while waiting. Mostly one of them is best.
#pragma once

#include "search/route/rest_route.h"

namespace tandem {

// All ways along a leg that may be best.
class RestLegs {
public:
    RestLegs(const RestRoute& route, const BestRests& best, TakenRests& taken)
        : route_(route), type_(route.type), best_(best), taken_(taken) {}

    // Let a driver who leaves so drive to the next stop, and note how it may be there.
    void drive(const RestLabel& label, const LegAhead& way, RestLabels& there);

private:
    void ride(const RestLabel& label, const RestedLeg& leg, RestPlace place);
    void rest(const RestLabel& label, const RestedLeg& leg, RestPlace place);
    void take_break(const RestLabel& label, const RestedLeg& leg, RestPlace place);
    void take(RestLabel next, const RestedLeg& leg, Int number, RestPlace place);
    bool come(RestLabel label, const RestedLeg& leg);
    bool is_put_off(const RestedLeg& leg, Int number) const;
    bool may_be_best(const RestLabel& label, const RestedLeg& leg) const;

    const RestRoute& route_;
    const VehicleType& type_;
    const BestRests& best_;
    TakenRests& taken_;
    LegAhead way_{};
    Int left_ = 0;  // when the leg began
    RestLabels* there_ = nullptr;
    Int kept_ = 0;  // labels
};

// Follow ways along a route without flights or orders, as late as allowed, until one is as good as
// any can be. In place: `best`. Tell whether it is.
bool rest_late(const RestRoute& route, BestRests& best, TakenRests& taken);

}  // namespace tandem
