// Annealing by small moves of trips with one drone, thousands a turn.
//
// Where what operations cost tells what routes do, a move is priced by the few that it changes.
//
// References: Agatz, Bouman and Schmidt (2018), optimization approaches for the traveling salesman
// problem with drone, Transportation Science 52:965-981.
#pragma once

#include <initializer_list>
#include <optional>

#include "randomness.h"
#include "search/moves/operations.h"
#include "search/scratch.h"

namespace tandem {

// Anneals trips with one drone by small moves.
class SmallMoves {
public:
    SmallMoves(const ProblemData& data, Searcher& searcher) : data_(data), searcher_(searcher) {}

    // Changes trips near a random customer, move by move, as the temperature allows.
    //
    // In place; tells whether routes were changed and keep all rules; if not, they may be broken.
    bool attempt();

    // Tells whether the last attempt found trips that they can change.
    bool can_do() const { return searcher_.count->movable > 1; }

private:
    // A trip that is changed.
    struct Changing {
        Int slot, first, last;  // its stops in the route
        Int type, customers;
        Amount load;
        OperationRow row;
        OperationRow best;  // as it was when all cost least
        bool is_changed;
        std::optional<OperationData> by;  // what its operations cost
    };

    // Stops of a trip, both included.
    struct TripSpan {
        Int trip, first, last;
    };

    // Some operations as they might be, and what they cost as they are.
    struct Draft {
        TripSpan span;
        OperationRow row;
        double before;
    };

    void gather();
    void add_trip(Int node);
    bool read(Changing& trip);
    void take_on(Changing& trip, Int node);
    void note(Int trip, Int first, Int last);
    void forget();

    void change();
    bool relocate(Int node);
    bool trade(Int node);
    bool reverse(Int node);
    bool move_segment(Int node);
    bool move_joint(Int node);

    bool insert_beside(OperationRow& row, Int other, Int node, bool flies) const;
    bool decide(std::initializer_list<const Draft*> drafts);
    void keep_if_best();
    bool write() const;
    bool write(const Changing& trip, const OperationRow& row) const;

    bool coin() const { return uniform(searcher_.rng) < 0.5; }
    Int random(Int bound) const { return below(searcher_.rng, bound); }
    Changing& trip(Int number) { return trips_[std::size_t(number)]; }
    const Changing& trip(Int number) const { return trips_[std::size_t(number)]; }
    Served& served(Int node) const { return searcher_.scratch->served[node]; }

    Int neighbour(Int node) const;
    TripSpan beyond(Int number, Int first, Int last) const;
    TripSpan around(Int node) const;
    TripSpan widened(TripSpan span) const;
    Draft draft(Int number, TripSpan span) const;
    static Int find(const OperationRow& row, Int node);
    bool remove(OperationRow& row, Int node) const;
    bool may_serve(Int number, Int node, bool flown) const;
    double cost(Int k, const OperationRow& row, Int first, Int last) const;

    const ProblemData& data_;
    Searcher& searcher_;
    std::array<Changing, most_changing> trips_{};
    Int num_trips_ = 0, customers_ = 0;
    double cost_ = 0.0;  // of all routes as they are
    double best_ = 0.0;  // least so far
    bool improved_ = false;
};

}  // namespace tandem
