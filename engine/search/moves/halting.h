// Stops at launch sites that are there before anybody is flown to from them.
//
// One customer alone may not be worth a stop that two are worth together. So a stop is put on a
// route now and then while customers are missing, and goes again if no drone has used it.
#pragma once

#include "search/route/layout.h"

namespace tandem {

constexpr double halting_share = 0.5;  // how often that is done

// Put a stop at a launch site near a customer, or near where it is put, on a route that was
// touched. In place; maybe nothing.
void halt_for(const ProblemData& data, const Searcher& searcher, Int node);

// Take the stops at launch sites that no drone uses off the routes that were touched, if that
// breaks no rule. In place.
void drop_idle_halts(const ProblemData& data, const Searcher& searcher);

}  // namespace tandem
