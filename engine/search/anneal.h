// Simulated annealing by ruin and recreate, over whatever holds the routes.
//
// References: Christiaens and Vanden Berghe (2020), slack induction by string removals for vehicle
// routing problems, Transportation Science 54:417-433.
#pragma once

#include <concepts>

#include "randomness.h"
#include "search/moves/recreate.h"

namespace tandem {

constexpr double retyped_share = 0.1;  // how often changed routes get the vehicles that cost least

// From how many places on all who are inserted at the beginning come beside neighbours or on a new
// route, too: looking at all routes for each takes time that grows with the square.
constexpr Int built_beside_from = 2000;

// What holds the routes, and notes what a turn, or one part of it, has changed of them.
template <typename T>
concept Store = requires(T store, const T now, Int number, double cost, Spare spare) {
    // Removes customers near each other, who are absent then; those before them, from a number on,
    // are tried near the ruin.
    { store.ruin(number) };
    // Inserts who is absent, from a number on; false, with only some of them inserted, once that
    // costs more than is to spare, or leaves out more.
    { store.recreate(number, spare) } -> std::same_as<bool>;
    // Gives changed routes the vehicles that cost least.
    { store.retype() };
    // How often a turn tries something else.
    { now.parts() } -> std::same_as<Int>;
    // Does that, with vehicles traded now and then where they may be; true if it costs less than so
    // much more.
    { store.move_part(number, cost) } -> std::same_as<bool>;
    // Inserts who is absent, from a number on, whatever that costs.
    { store.insert_all(number) };
    // What the routes, and those left out before, cost.
    { now.served_cost() } -> std::same_as<double>;
    // Goes on from the routes as they are.
    { store.accept(cost) };
    { store.keep_best() };
    { store.take_back() };
};

// Goes on from this turn's routes, and keeps them if they are the best.
template <Store Routes>
void go_on(Searcher& searcher, Routes& routes, double cost) {
    routes.accept(cost);
    if (cost < searcher.value->best) routes.keep_best();
}

// Swaps tails of routes, or does what else a store can, if that is accepted.
template <Store Routes>
void move_part(Searcher& searcher, Routes& routes, Int part) {
    if (routes.move_part(part, draw_rise(searcher))) {
        go_on(searcher, routes, routes.served_cost());
    } else {
        routes.take_back();
    }
}

// Ruins and recreates once. False, with nothing changed, once the search must end.
template <Store Routes>
bool ruin_and_recreate(const ProblemData& data, Searcher& searcher, Routes& routes) {
    SearchCounts& count = *searcher.count;
    const Int first = begin_turn(data, searcher, most_missing);
    routes.ruin(first);
    const Int lacking = count.to_drop > 0 ? num_lacking(data, searcher) : 0;
    sort_absent(data, searcher, first, draw_order(data, searcher.rng, lacking > 0));
    const double limit = searcher.value->cost + draw_rise(searcher);
    const bool retyped = (data.strategy.swap_vehicles || data.strategy.change_vehicles) &&
                         uniform(searcher.rng) < retyped_share;
    Spare spare{.absences = absences_to_spare(data, searcher, lacking, first)};
    if (!retyped && counts_up(data, searcher)) {
        spare.cost = limit - cost_to_insert(data, searcher, routes.served_cost(), first);
    }
    const bool done = routes.recreate(first, spare);
    if (data.deadline.passed()) {
        routes.take_back();
        --count.turn;
        return false;
    }
    if (done && retyped) routes.retype();
    const double cost = turn_cost(data, searcher, routes.served_cost());
    const bool scarce = !data.all_optional && count.absent > 0;
    const bool counts = scarce && (done || lacking > 0);
    const bool rarer = counts && rarer_absences(data, searcher);
    if (done && (cost < limit || rarer)) {
        go_on(searcher, routes, cost);
    } else {
        routes.take_back();
    }
    return true;
}

// Ruins and recreates `turns` times.
//
// Where no insertion saves anything, a turn is given up once those made cost more than would be
// accepted, or leave out more who have to be served; once the search must end, as if it had not
// begun.
template <Store Routes>
void anneal(const ProblemData& data, Searcher& searcher, Routes& routes, Int turns) {
    for (Int turn = 0; turn < turns; ++turn) {
        if (!ruin_and_recreate(data, searcher, routes)) return;
        for (Int part = 0; part < routes.parts(); ++part) {
            if ((part > 0 || data.strategy.two_opt_star) && !data.deadline.passed()) {
                move_part(searcher, routes, part);
            }
        }
        searcher.value->temperature *= searcher.value->cooling;
    }
}

// Inserts all who are left out in an order, whatever that costs, and goes on from that.
//
// Once the search must end, it leaves out whoever is not inserted yet.
template <Store Routes>
void insert_all(const ProblemData& data, Searcher& searcher, Routes& routes, Int order) {
    const Int first = begin_turn(data, searcher, searcher.count->missing);
    sort_absent(data, searcher, first, order);
    uniform(searcher.rng);  // As a turn draws that may be taken back.
    routes.insert_all(first);
    go_on(searcher, routes, turn_cost(data, searcher, routes.served_cost()));
    searcher.value->temperature *= searcher.value->cooling;
}

}  // namespace tandem
