// Where a shipment costs least on rows of shipments.
#pragma once

#include <vector>

#include "search/shipments/pair_row.h"

namespace tandem {

// A way that is longer than any.
constexpr Int endless = Int{1} << 60;

// The cheapest place so far, and by how much it is further.
struct CheapestPlace {
    Int slot = nowhere;
    PairPlace place{};
    Int further = endless;
};

// Looks for the cheapest places of one shipment after another.
class PlaceFinder {
public:
    // For rows of so many stops at most.
    PlaceFinder(const ProblemData& data, const PairRows& rows, View<std::uint64_t, 1> rng,
                Int most_stops);

    // Goes on with a shipment, by its pickup.
    void begin(Int pickup) { pair_ = rows_.pair_of(pickup); }

    // Tries all places on a row.
    //
    // What each end alone is further bounds what both are: few pairs of places are tried, unless
    // legs are longer than ways by other places.
    void scan(const PairRow& row, Int slot, CheapestPlace& best);

private:
    // An end of the shipment beside each stop of a row.
    struct End {
        std::vector<Int> out, on;             // how long it takes from there, and back
        std::vector<Int> further_out, on_to;  // how far both are
        std::vector<Int> further;             // how much further it is behind it, `endless` if late
    };

    // Writes all of an end alone.
    void measure(const PairRow& row, const Newcomer& newcomer, End& end) const;

    // Tries the delivery right behind the pickup, behind each stop.
    void scan_together(const PairRow& row, Int slot, CheapestPlace& best);

    // Tries all later deliveries behind a pickup.
    void scan_from(const PairRow& row, Int slot, Int p, CheapestPlace& best);

    void take(Int slot, PairPlace place, Int further, CheapestPlace& best) const;

    const PairRows& rows_;
    const NodeTable places_;
    const double blink_;
    const View<std::uint64_t, 1> rng_;
    const Int most_stops_;
    PairToInsert pair_;
    End pickup_, delivery_;
    std::vector<Int> least_;  // (stop,) how much further a delivery is at least from there on
};

}  // namespace tandem
