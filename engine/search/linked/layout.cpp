#include <utility>

#include "search/linked/aboard.h"
#include "search/linked/store.h"
#include "search/linked/turn.h"
#include "search/search.h"

namespace tandem {
namespace {

// The row of where the route of a slot begins; that of where it ends is the next.
Int first_row(const ProblemData& data, Int slot) { return data.num_nodes + 2 * slot; }

// The rows of a route in one tier, from where it begins to where it ends.
class TierRows {
public:
    TierRows(const ProblemData& data, const Linked& linked, Int slot, Int tier, Int row)
        : data_(data), linked_(linked), slot_(slot), tier_(tier), row_(row) {}

    StopLoad& operator*() const { return linked_.aboard(tier_, row_); }
    StopLoad* operator->() const { return &**this; }
    bool operator==(const TierRows& other) const { return row_ == other.row_; }

    TierRows& operator++() {
        const Int begin = first_row(data_, slot_);
        if (row_ > begin) {
            row_ = begin + 2;
        } else {
            row_ = row_or(begin + 1,
                          row_ == begin ? linked_.run[slot_].first : linked_.link[row_].behind);
        }
        return *this;
    }

    TierRows& operator--() {
        const Int begin = first_row(data_, slot_);
        if (row_ > begin + 1) {
            row_ = begin + 1;
        } else {
            row_ =
                row_or(begin, row_ > begin ? linked_.run[slot_].last : linked_.link[row_].before);
        }
        return *this;
    }

private:
    // The row of a customer, or that given for a depot.
    Int row_or(Int depot, Int node) const { return node < data_.num_depots ? depot : node; }

    const ProblemData& data_;
    const Linked& linked_;
    const Int slot_, tier_;
    Int row_;
};

// Writes the rows of a route if it has changed since they were.
void weigh_if_stale(const ProblemData& data, const Linked& linked, Int slot) {
    if (linked.stale[slot]) weigh_run(data, linked, slot);
}

}  // namespace

void note_amounts(const ProblemData& data, Linked& linked) {
    for (Int tier = 0; tier < linked.aboard.size(); ++tier) {
        for (Int node = data.num_depots; node < data.num_nodes; ++node) {
            StopLoad& row = linked.aboard(tier, node);
            row = {};
            add_left(row, delivered_of(data.amount, node, tier),
                     total_delivered(data.amount, node));
            add_come(row, picked_of(data.amount, node, tier), total_picked(data.amount, node));
        }
    }
}

bool weigh_run(const ProblemData& data, const Linked& linked, Int slot) {
    const VehicleType& type = data.type[linked.run[slot].type];
    const Int begin = first_row(data, slot);
    bool allowed = true;
    for (Int tier = 0; tier < linked.aboard.size(); ++tier) {
        allowed = weigh_trip(type, TierRows(data, linked, slot, tier, begin),
                             TierRows(data, linked, slot, tier, begin + 2), tier) &&
                  allowed;
    }
    linked.stale[slot] = false;
    return allowed;
}

bool has_room_between(const ProblemData& data, const Linked& linked, const Joining& joins,
                      Int before, Int behind) {
    weigh_if_stale(data, linked, joins.slot);
    const Int begin = first_row(data, joins.slot);
    return has_room(data.type[joins.type], linked.aboard,
                    behind < data.num_depots ? begin + 1 : behind,
                    before < data.num_depots ? begin : before, data.amount, joins.node);
}

bool may_hold_more(const ProblemData& data, const Linked& linked, Int slot, const VehicleType& type,
                   Int node) {
    weigh_if_stale(data, linked, slot);
    const Int begin = first_row(data, slot);
    for (Int tier = 0; tier < linked.aboard.size(); ++tier) {
        const Amount taken = plus(amount_of(linked.aboard(tier, begin + 1).behind),
                                  picked_of(data.amount, node, tier));
        if (!holds_in(type, taken, tier) ||
            !holds_in(type, most_of(linked.aboard(tier, begin)), tier)) {
            return false;
        }
    }
    return true;
}

bool can_take(const ProblemData& data, const Linked& linked, Int slot, const VehicleType& type) {
    const Run& run = linked.run[slot];
    if (!holds(type, amount_of(run.load)) || !allows_stops(type, run.count)) return false;
    if (!looks_aboard(linked)) return true;
    weigh_if_stale(data, linked, slot);
    for (Int tier = 0; tier < linked.aboard.size(); ++tier) {
        if (!holds_in(type, most_of(linked.aboard(tier, first_row(data, slot))), tier)) {
            return false;
        }
    }
    return true;
}

bool may_carry_both(const ProblemData& data, const Linked& linked, const VehicleType& type,
                    Int head, Int tail) {
    for (Int tier = 0; tier < linked.aboard.size(); ++tier) {
        Cargo front = no_cargo;
        for (Int node = head; node >= data.num_depots; node = linked.link[node].before) {
            front = followed(cargo_for(data.amount, node, tier), front);
        }
        Cargo rest = no_cargo;
        for (Int node = tail; node >= data.num_depots; node = linked.link[node].behind) {
            rest = followed(rest, cargo_for(data.amount, node, tier));
        }
        if (!may_be_joined(type, front, rest, tier)) return false;
    }
    return true;
}

namespace {

// Customers that are noted in a turn: it removes the most, to the last string.
Int most_noted(const ProblemData& data) { return std::min(data.num_nodes, 2 * most_removed); }

CheapestVehicle cheapest_of(const ProblemData& data) {
    CheapestVehicle least{data.rate[0].distance, data.rate[0].stop};
    for (const Rate& rate : data.rate.first(data.num_types)) {
        least = {std::min(least.distance, rate.distance), std::min(least.stop, rate.stop)};
    }
    return least;
}

}  // namespace

bool is_one_travel(const ProblemData& data) {
    const auto types = data.type.first(data.num_types);
    return std::ranges::all_of(
        types, [&](const VehicleType& type) { return type.travel == types[0].travel; });
}

Linked::Linked(const ProblemData& data, const Searcher& searcher, Int moments,
               std::shared_ptr<const Nearness> nearness)
    : link({data.num_nodes}),
      run({searcher.active.size()}),
      piece({most_noted(data)}),
      removed({most_noted(data)}),
      removed_node({most_noted(data)}),
      entry({data.num_nodes}),
      moment({moments}),
      retyped({searcher.active.size()}),
      former({searcher.active.size()}),
      hit({searcher.active.size()}),
      measured(std::move(nearness)),
      near(*measured),
      best_first({searcher.active.size()}),
      best_type({searcher.active.size()}),
      best_behind({data.num_nodes}),
      cheapest(cheapest_of(data)),
      timed(moments > 0),
      reach({data.num_nodes}),
      aboard({data.amount.shape(1), data.num_nodes + 2 * searcher.active.size()}),
      stale({searcher.active.size()}),
      one_travel(is_one_travel(data)) {
    std::ranges::fill(former, nowhere);
    std::ranges::fill(best_first, nowhere);
    std::ranges::fill(stale, true);
}

}  // namespace tandem

using namespace tandem;

int tandem_open_linked(const tandem_problem_data* data, tandem_search* search, int64_t moments,
                       const tandem_linked* like, tandem_linked** linked) {
    return guarded([&] {
        const ProblemData problem = data_of(*data);
        auto measured = like == nullptr ? measured_near(problem) : like->measured;
        *linked = std::make_unique<tandem_linked>(problem, *search, moments, std::move(measured))
                      .release();
    });
}

int tandem_close_linked(tandem_linked* linked) {
    return guarded([&] { const std::unique_ptr<tandem_linked> owned(linked); });
}
