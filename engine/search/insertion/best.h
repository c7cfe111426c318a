// The cheapest place for a customer, as far as places were tried.
#pragma once

#include "randomness.h"
#include "search/insertion/cheapest.h"
#include "search/insertion/evaluate.h"
#include "search/route/edit.h"
#include "search/trace.h"

namespace tandem {

// Which route a customer joins, by which type, what driving costs that, and what all costs but for
// the detour.
struct Joining {
    Int node, slot, type;
    double rate, cost;
};

// The cheapest places of all on a route: of those by truck alone, and with drones.
class PricedPlaces {
public:
    struct Priced {
        double cost;
        Move move;

        bool operator<(const Priced& other) const { return cost < other.cost; }
    };

    static constexpr Int most = 24;  // of either

    void add(double cost, const Move& move) {
        const bool flown = std::ranges::any_of(
            move.placements(), [](const Placement& placed) { return placed.how >= How::fly; });
        if (cost < infeasible) (flown ? flown_ : driven_).add({cost, move});
    }

    // Calls `visit` with each, the cheapest first; then nothing is added any more.
    template <class Visit>
    void for_each(const Visit& visit) {
        for (auto* some : {&driven_, &flown_}) {
            some->sort();
            for (const Priced& priced : some->items()) visit(priced);
        }
    }

private:
    Cheapest<Priced, most> driven_, flown_;
};

struct Best {
    Best(double overlooking, View<std::uint64_t, 1> numbers, double at_most = infeasible)
        : blink(overlooking), rng(numbers), cost(at_most) {
        move.between(0, 0, 0, 0);
    }

    double blink;  // how often a place is overlooked that costs less than the best
    View<std::uint64_t, 1> rng;
    double cost;
    Move move;
    Shares shares{};                 // of all routes, where the plan as a whole costs something
    double weight = 0.0;             // how much what it would cost more counts
    PricedPlaces* listed = nullptr;  // of those overlooked, if they are wanted

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
        if (takes(other, &made)) {
            move.become(made);
        } else if (listed != nullptr) {
            listed->add(other, made);
        }
    }

    // Takes a place for the best likewise, which `make` has a move lead to.
    template <class Make>
    bool try_made(double other, const Make& make) {
        if (takes(other)) {
            make(move);
            return true;
        }
        if (listed != nullptr) {
            Move made{};
            make(made);
            listed->add(other, made);
        }
        return false;
    }

    // Takes the place behind `before` if that is the best and the customer may come there, which is
    // asked last.
    template <class MayCome>
    bool try_behind(const Joining& joins, Int before, Int further, const MayCome& may_come) {
        const double other = double(further) * joins.rate + joins.cost;
        if (other >= cost || !may_come()) return false;
        return try_made(other, [&](Move& made) {
            made.between(joins.slot, joins.type, before, before + 1)
                .add(How::serve, joins.node, before + 1);
        });
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
