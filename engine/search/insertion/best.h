// The cheapest place for a customer, as far as places were tried.
#pragma once

#include "randomness.h"
#include "search/insertion/evaluate.h"
#include "search/route/edit.h"
#include "search/trace.h"

namespace tandem {

// Which route a customer joins, by which type, what driving costs that, and what all costs but for
// the detour.
struct Joining {
    Int node;
    Int slot;
    Int type;
    double rate;
    double cost;
};

struct Best {
    double blink;  // how often a place is overlooked that costs less than the best
    View<std::uint64_t, 1> rng;
    double cost = infeasible;
    Move move{};
    Shares shares{};      // of all routes, where the plan as a whole costs something
    double weight = 0.0;  // how much what it would cost more counts

    // Takes a place for the best, for the caller to say which, if it costs less and isn't
    // overlooked. Of those that cost the same, the first is the best.
    bool takes(double other, const Move* made = nullptr) {
        trace_priced(other, made);
        if (other >= cost || uniform(rng) < blink) return false;
        cost = other;
        return true;
    }

    // Takes a move for the best likewise.
    void try_move(double other, const Move& made) {
        if (takes(other, &made)) move.become(made);
    }

    // Takes the place behind `before` if that is the best and the customer may come there, which is
    // asked last.
    template <class MayCome>
    bool try_behind(const Joining& joins, Int before, Int further, const MayCome& may_come) {
        const double other = double(further) * joins.rate + joins.cost;
        if (other >= cost || !may_come() || !takes(other)) return false;
        move.between(joins.slot, joins.type, before, before + 1)
            .add(How::serve, joins.node, before + 1);
        return true;
    }
};

// Lets places cost so much more while it lasts.
class Surcharge {
public:
    Surcharge(Best& best, double more) : best_(best), more_(more) { best_.cost -= more_; }
    ~Surcharge() { best_.cost += more_; }
    Surcharge(const Surcharge&) = delete;
    Surcharge& operator=(const Surcharge&) = delete;

private:
    Best& best_;
    double more_;
};

// Who is to be inserted into routes, and the best place so far.
struct Insertion {
    const ProblemData& data;
    const Searcher& searcher;
    Int node;
    bool enlarge;  // a route may be given a larger type
    Best& best;
};

}  // namespace tandem
