// The cheapest stop on the way from a depot to where a route begins, or back from where it ends.
//
// A route that serves a town far away passes customers to whom nobody on it is near: a stop there
// costs next to nothing, and no neighbour shows it. Who has neighbours alone to go beside is tried
// on some such legs as well, of routes that are drawn.
#pragma once

#include "search/insertion/best.h"

namespace tandem {

constexpr Int each_drawn = 4;   // of how many routes one is drawn
constexpr Int most_drawn = 16;  // and how many are at most

// Tries the customer first and last on routes drawn, where all are lean.
//
// Most routes are full, so they are asked for room before their legs.
void scan_passing(const Insertion& insertion);

}  // namespace tandem
