// Whether linked routes have room for a customer more.
#pragma once

#include "search/linked/layout.h"

namespace tandem {

// What routes may carry at most, by type, so that they may serve a customer more; less than nothing
// if none of the type may.
class RoomByType {
public:
    // `enlarge` tells that a route may be given a larger type.
    RoomByType(const ProblemData& data, Int node, bool enlarge) : data_(data), node_(node) {
        if (enlarge || data.num_types > most_known) {
            same_for_all_ = most_known;
        } else if (data.num_types == 1) {
            same_for_all_ = 0;
        }
        const Int count = std::min(data.num_types, most_known);
        for (Int k = 0; k < count; ++k) most_[std::size_t(k)] = most(k);
        most_[most_known] = {far, far, far};
    }

    // Whether the vehicle of a route may serve the customer more, and holds what that takes.
    bool is_on(const Run& run) const {
        const Amount load = amount_of(run.load);
        return within(load, run.type < most_known ? most_[std::size_t(run.type)] : most(run.type));
    }

    // The same without branches; true as well where another type might.
    bool may_be_on(const Run& run) const {
        // A run's type isn't waited for where there is but one.
        const Amount& most = most_[std::size_t(same_for_all_ < 0 ? run.type : same_for_all_)];
        const Int fits[] = {run.load[0] <= most[0], run.load[1] <= most[1], run.load[2] <= most[2]};
        return fits[0] + fits[1] + fits[2] == 3;
    }

private:
    static constexpr Int most_known = 8;

    Amount most(Int k) const {
        if (!data_.can(k, 0, node_)) return {-1, -1, -1};
        return minus(capacity_of(data_.type[k]), demand_of(data_.place[0][node_]));
    }

    const ProblemData& data_;
    const Int node_;
    Int same_for_all_ = nowhere;  // what is the most for all types, by number
    std::array<Amount, most_known + 1> most_;
};

}  // namespace tandem
