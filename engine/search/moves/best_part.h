// Parts of trips with one drone whose truck may stop for it alone, planned at best.
//
// Whom truck and drone serve from one stop to another is small enough for a dynamic program, so
// that all changes of it are tried at once, stops at launch sites among them.
#pragma once

#include "search/moves/best_operations.h"

namespace tandem {

// Plans parts of trips with one drone at best.
class BestPart {
public:
    BestPart(const ProblemData& data, Searcher& searcher) : data_(data), searcher_(searcher) {}

    // Plans a random part anew. In place; tells whether routes were changed and keep all rules; if
    // not, they may be broken.
    bool attempt();

private:
    // Stops of a route where truck and drone are together, and how many are served between.
    struct TogetherPart {
        Int first, last, customers;
    };

    TogetherPart draw(Int slot, Int p) const;
    bool is_joint(Int slot, Int p) const;
    Int served_between(Int slot, Int first, Int last) const;
    PartToPlan read(Int slot, const TogetherPart& part) const;
    void add_halts(Int slot, const TogetherPart& part, PartToPlan& read) const;
    unsigned needed(Int slot, const TogetherPart& part, const PartToPlan& read, Int halt) const;
    bool write(Int slot, const TogetherPart& part, const BestOperations& best);
    bool write_operation(Int slot, const BestOperations& best, const PlannedOperation& operation);

    const ProblemData& data_;
    Searcher& searcher_;
};

}  // namespace tandem
