// What a search writes down while it looks, and forgets.
#pragma once

#include "search/moves/operation_row.h"

namespace tandem {

// A place in an order of customers that truck and drone serve.
struct Line {
    Int node;
    Int drive;            // driving and serving up to the arrival there
    Int distance;         // likewise
    Int grounded;         // how many so far no truck may serve
    Int before;           // where the operation begins that ends here
    Int flight;           // the place flown to meanwhile; 0: none
    Int spared_drive;     // by a truck that passes by
    Int spared_distance;  // likewise
};

constexpr Int longest_operation = 12;  // stops from where truck and drone part, at most

// How many operations are compared at once that begin one after another.
constexpr int at_once = 8;

// What a line is split by. Durations and distances are whole numbers, held so that processors
// reckon with several at once.
struct SplitScratch {
    // For lines of so many places at most.
    explicit SplitScratch(Int longest);

    Row<double> cost;  // (place,) of the operations up to there

    // (place,) what the flights from there cost for which the truck waits, up to a place.
    Row<double> loops;
    Row<Int> looped_until;

    // (place,) how long and how far a truck has driven which launches its drone there.
    Row<double> drive, distance;

    // Legs of the drone to a place from those before, the last from that right before it; behind
    // it, none takes a finite time.
    struct WaysOut {
        std::array<double, longest_operation + at_once> duration, distance;
    };
    Row<WaysOut> out;  // (place,)
};

constexpr Int most_planned = 10;              // customers of a part planned at best
constexpr Int usually_planned = 8;            // where there are more customers than those
constexpr Int most_sites = most_planned + 6;  // launch sites looked at for it

// Who is served between two stops, and where the truck may stop for its drone alone.
struct PartToPlan {
    Int type;
    Int from, to;  // nodes of the stops
    Int customers, halts;
    std::array<Int, most_planned> customer;
    std::array<Int, most_sites> halt;
    std::array<unsigned, most_sites> need;  // the customer, as a bit, served before a stop there
};

// A place of a part where truck and drone are together: the first stop, a customer, a launch site,
// or the last stop.
using Spot = std::int16_t;

constexpr Spot no_spot = -1;

// What truck and drone do between two places: the drone serves somebody, or nobody, meanwhile.
struct PlannedOperation {
    Spot from, to;
    Spot flown;       // a customer, or `no_spot`
    unsigned served;  // by both, as bits
};

// What a part is planned in at best.
struct PartScratch {
    // For so many customers and launch sites at most.
    PartScratch(Int most_customers, Int most_halts);

    // How a truck drives from one place to another by way of some customers.
    struct Via {
        Int duration, distance;
        Spot last;  // whom it serves last, or `no_spot`
    };

    // The cheapest operation from one place to another that serves some customers.
    struct Across {
        double cost;
        Spot flown;
    };

    // How truck and drone come to a place, some having been served, and what all up to there costs.
    struct Reached {
        double cost;
        unsigned before;  // who had been served where the operation began
        Spot from, flown;
    };

    // How many places there are at most.
    Int places() const { return customers + halts + 2; }

    Int customers, halts;  // at most
    PartToPlan part{};
    Row<Int> flight;                // (from, customer, to) how long that takes
    Row<Via> way;                   // (from, set, to)
    Row<Across> across;             // (from, set, to)
    Row<Reached> reached;           // (set, place)
    Row<PlannedOperation> planned;  // in order
};

constexpr double same_share = 1e-12;  // costs that differ by a smaller share are the same

constexpr Int most_changing = 6;  // trips changed at a time by small moves
constexpr Int more_places = 4;    // in a trip, or while it is changed, than customers

// Where a customer is on the trips that small moves change.
struct Served {
    std::int32_t trip;   // `nobody`: on none
    std::int32_t place;  // of the stop, or of that where the operation begins
    bool flown;
};

struct Scratch {
    // Makes room for calls of a search.
    Scratch(const ProblemData& data, const Searcher& searcher);

    // Whether it is large enough for calls of a search.
    bool is_enough_for(const ProblemData& data, const Searcher& searcher) const;

    Row<Line> line;   // (place,) those of a trip or two in order
    Row<Line> aside;  // (place,) some of them before a change
    SplitScratch split;
    SplitScratch changed;  // of a line of which some places were changed
    PartScratch part;
    Row<OperationStop> operations;  // (2, trip, node + more) of trips
    Row<OperationStop> drafts;      // (2, node + more)
    Row<Served> served;             // (node,)
    Row<Int> moved_customers;       // (node,) of those trips
    Row<double> key;                // (node,) order of insertion
    Row<Int> moved;                 // slots that a ruin touches, or where stops move to
    Row<Offer> offer;               // insertions that may be best
    Row<double> least;              // what each costs at least
    Int offers = 0;                 // how many are listed

private:
    Scratch(Int longest, PartScratch part, Int num_nodes, Int most_moved, Int most_offers);
};

}  // namespace tandem
