// What a search writes down while it looks, and forgets.
#pragma once

#include <memory>

#include "search/route/layout.h"

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

// A row of what is written before it is read.
template <class T>
class Row {
public:
    explicit Row(Int size)
        : room_(std::make_unique_for_overwrite<T[]>(static_cast<std::size_t>(size))),
          view_(room_.get(), {size}) {}

    View<T, 1> view() const { return view_; }
    operator View<T, 1>() const { return view_; }
    operator View<const T, 1>() const { return view_; }
    T& operator[](Int index) const { return view_[index]; }

private:
    std::unique_ptr<T[]> room_;
    View<T, 1> view_;
};

struct Scratch {
    // Makes room for a search, and lends it that.
    Scratch(const ProblemData& data, Searcher& searcher);

    Row<Line> line;         // (node + 3,) places of a trip or two in order
    Row<double> line_cost;  // (node + 3,)
    Row<double> key;        // (node,) order of insertion
    Row<Int> moved;         // slots that a ruin touches, or where stops move to
    Row<Move> offer;        // insertions that may be best
    Row<double> least;      // what each costs at least
    Int offers = 0;         // how many are listed

private:
    Scratch(const ProblemData& data, Searcher& searcher, Int most_offers);
};

}  // namespace tandem
