#include "rules/load.h"

namespace tandem {

bool weigh_trip(const VehicleType& type, View<StopLoad, 1> stop_loads, Int first, Int last,
                Int tier) {
    Amount load = nothing;
    Int given = 0;
    for (Int p = first; p <= last; ++p) {
        load = plus(load, amount_of(stop_loads[p].leaving));
        given += stop_loads[p].leaves;
    }
    Amount most = load;
    Int due = given, picked = 0;
    bool in_order = true;
    for (Int p = first; p <= last; ++p) {
        StopLoad& stop_load = stop_loads[p];
        write_amount(most, stop_load.before);
        in_order = in_order && !out_of_order(type, picked, stop_load.leaves);
        due -= stop_load.leaves;
        stop_load.picked = picked;
        stop_load.due = due;
        stop_load.given = given;
        picked += stop_load.comes;
        load = plus(minus(load, amount_of(stop_load.leaving)), amount_of(stop_load.coming));
        stop_load.load = load[0];
        write_amount(load, stop_load.behind);
        most = larger(most, load);
    }
    for (Int p = last - 1; p >= first; --p) {
        write_amount(larger(amount_of(stop_loads[p].behind), amount_of(stop_loads[p + 1].behind)),
                     stop_loads[p].behind);
    }
    return in_order && holds_in(type, most, tier) && !comes_first(type, picked, given);
}

}  // namespace tandem
