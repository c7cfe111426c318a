// What the operations of a row cost.
#pragma once

#include "search/moves/operation_row.h"
#include "search/moves/operations.h"

namespace tandem {

// Tells whether the truck best waits at the stop where an operation begins until the drone is back.
bool waits(const OperationData& by, const OperationRow& row, Int begin, Int end);

// Writes what all operations cost. In place.
void price(const OperationData& by, const OperationRow& row);

// Writes what operations cost that may come in the place of those from stop `first` to `last` of a
// row, which were priced. In place.
//
// Those at either end that are the same as there aren't priced anew.
void price_changed(const OperationData& by, const OperationRow& old, Int first, Int last,
                   const OperationRow& row);

}  // namespace tandem
