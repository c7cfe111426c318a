// A part of a trip with one drone, planned at best between two stops.
//
// Dynamic programming over who has been served so far and where truck and drone are, one operation
// after another. What windows and loads allow is left to the exact timing that follows.
//
// References: Bouman, Agatz and Schmidt (2018), dynamic programming approaches for the traveling
// salesman problem with drone, Networks 72:528-542.
#pragma once

#include "search/moves/operations.h"
#include "search/scratch.h"

namespace tandem {

// Plans a part at best.
class BestOperations {
public:
    // For the part that is noted there.
    BestOperations(const ProblemData& data, PartScratch& scratch);

    // Finds the operations that cost least; false if there are none, or time is over.
    bool find();

    Int count() const { return count_; }
    const PlannedOperation& operation(Int number) const { return scratch_.planned[number]; }
    Int node(Spot spot) const { return node_[std::size_t(spot)]; }
    bool is_customer(Spot spot) const { return spot > 0 && spot <= customers_; }
    Spot last() const { return Spot(spots_ - 1); }

    // Calls a function for whom the truck serves on an operation, in order, but at its end.
    template <class Visit>
    void on_the_way(const PlannedOperation& operation, Visit visit) const {
        std::array<Spot, most_planned> order;
        Int number = 0;
        unsigned set = by_truck(operation);
        for (Spot to = operation.to; set != 0;) {
            to = way(operation.from, set, to).last;
            set &= ~bit(to);
            order[std::size_t(number++)] = to;
        }
        while (number > 0) visit(order[std::size_t(--number)]);
    }

private:
    static unsigned bit(Spot customer) { return 1U << unsigned(customer - 1); }
    unsigned bit_of(Spot spot) const { return is_customer(spot) ? bit(spot) : 0U; }
    unsigned by_truck(const PlannedOperation& operation) const {
        const unsigned flown = operation.flown < 0 ? 0U : bit(operation.flown);
        return operation.served & ~flown & ~bit_of(operation.to);
    }

    Int at(Spot from, unsigned set, Spot to) const {
        return (Int(from) * sets_ + Int(set)) * spots_ + to;
    }
    PartScratch::Via& way(Spot from, unsigned set, Spot to) const {
        return scratch_.way[at(from, set, to)];
    }
    Int& flight(Spot from, Spot customer, Spot to) const {
        return scratch_.flight[(from * (customers_ + 1) + customer) * spots_ + to];
    }
    PartScratch::Reached& reached(unsigned set, Spot spot) const {
        return scratch_.reached[Int(set) * spots_ + spot];
    }
    unsigned need(Spot spot) const { return need_[std::size_t(spot)]; }
    bool drives(Spot customer) const { return driven_ & bit(customer); }
    bool flies(Spot customer) const { return data_.can(part_.type, 1, node(customer)); }
    bool launches(Spot spot) const { return is_launch_place(data_.no_launch, node(spot)); }
    bool may_come(unsigned set, Spot spot) const;
    double stop_cost(Spot spot) const;
    double drive_on(Spot from, Spot to) const;

    void find_ways();
    PartScratch::Via beyond(const PartScratch::Via& by, Spot place, Spot to) const;
    PartScratch::Via best_way(Spot from, unsigned set, Spot to) const;
    double way_cost(const PartScratch::Via& by) const;
    void find_flights();
    void find_across();
    PartScratch::Across best_across(Spot from, unsigned set, Spot to) const;
    void reach(unsigned set, Spot spot, const PartScratch::Reached& how);
    void halt_from(unsigned set, Spot from);
    void go_on_from(unsigned set, Spot from);
    void trace();

    const ProblemData& data_;
    const PartToPlan& part_;
    PartScratch& scratch_;
    Rate rate_;
    OperationData by_;
    Spot customers_, spots_;
    Int sets_;
    unsigned all_;
    unsigned driven_ = 0;  // whom trucks may serve
    std::array<Int, most_planned + most_sites + 2> node_{};
    std::array<unsigned, most_planned + most_sites + 2> need_{};
    Int count_ = 0;
};

}  // namespace tandem
