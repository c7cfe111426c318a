// Removal of strings of adjacent customers from linked stops.
#pragma once

#include "search/linked/layout.h"

namespace tandem {

// How many customers a turn removes at most, to the last string.
constexpr Int most_removed = 512;

// What was saved, and near whom.
struct Ruined {
    double saved;
    Int seed;
};

// Removes strings of customers near each other; they are absent then.
Ruined ruin_linked(const ProblemData& data, Searcher& searcher, Linked& linked);

}  // namespace tandem
