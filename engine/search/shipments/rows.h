// Routes of shipments alone as rows, and back.
#pragma once

#include "search/shipments/pair_row.h"

namespace tandem {

// Reads the route in a slot. False if it breaks a rule.
bool read_row(const PairRows& rows, const Fleet& fleet, Int slot, PairRow& row);

// Tells whether the route in a slot has the stops of a row.
bool is_written(const Fleet& fleet, Int slot, const std::vector<Int>& nodes);

// Writes the route in a slot by its nodes, and where those are. False if it breaks a rule.
//
// How many routes there are is for the caller to say.
bool write_row(const ProblemData& data, const Fleet& fleet, Int slot,
               const std::vector<Int>& nodes);

}  // namespace tandem
