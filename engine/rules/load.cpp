#include "rules/load.h"

namespace tandem {

bool weigh_trip(const VehicleType& type, View<Halt, 1> halts, Int first, Int last, Int tier) {
    Amount load = nothing;
    Int given = 0;
    for (Int p = first; p <= last; ++p) {
        load = plus(load, amount_of(halts[p].leaving));
        given += halts[p].leaves;
    }
    Amount most = load;
    Int due = given, picked = 0;
    bool in_order = true;
    for (Int p = first; p <= last; ++p) {
        Halt& halt = halts[p];
        write_amount(most, halt.before);
        in_order = in_order && !out_of_order(type, picked, halt.leaves);
        due -= halt.leaves;
        halt.picked = picked;
        halt.due = due;
        halt.given = given;
        picked += halt.comes;
        load = plus(minus(load, amount_of(halt.leaving)), amount_of(halt.coming));
        halt.load = load[0];
        write_amount(load, halt.behind);
        most = larger(most, load);
    }
    for (Int p = last - 1; p >= first; --p) {
        write_amount(larger(amount_of(halts[p].behind), amount_of(halts[p + 1].behind)),
                     halts[p].behind);
    }
    return in_order && holds_in(type, most, tier) && !comes_first(type, picked, given);
}

}  // namespace tandem
