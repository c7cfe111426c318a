// All ways along a leg that may be best, by the breaks and rests taken on it.
#pragma once

#include "search/route/best_rests.h"
#include "search/route/rest_labels.h"

namespace tandem {

class RestLegs {
public:
    RestLegs(const RestRoute& route, const BestRests& best, TakenRests& taken)
        : route_(route), type_(route.type), best_(best), taken_(taken) {}

    // Let a driver who leaves so drive to the next stop, and note how it may be there.
    void drive(const RestLabel& label, const Way& way, RestLabels& there);

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
    Way way_{};
    Int left_ = 0;  // when the leg began
    RestLabels* there_ = nullptr;
    Int kept_ = 0;  // labels
};

}  // namespace tandem
