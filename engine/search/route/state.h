// What one thread of the search holds.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// Copy a route between fleets, from a slot to a slot. In place.
void copy_route(const Fleet& source, Int slot, const Fleet& target, Int to);

// Tell whether a route without sorties is the same in two fleets, each in its slot.
bool is_same(const Fleet& fleet, Int slot, const Fleet& other, Int at);

// Note that a customer is left out; of a shipment, both ends. In place.
void leave_out(const ProblemData& data, const Fleet& fleet, Int node);

// Return the place of a customer that is on a route; the one given if none is.
inline Int served_place(const ProblemData& data, const Fleet& fleet, Int node) {
    return used_place(data.pair, node, [&](Int place) { return fleet.where[place].slot >= 0; });
}

// Call `visit` with each customer of a route.
template <class Visit>
void for_each_served(const Fleet& fleet, Int slot, const Visit& visit) {
    for (const Stop& stop : stops_of(fleet, slot)) {
        if (stop.kind == customer_stop) visit(stop.node);
    }
    for (const Sortie& sortie : sorties_of(fleet, slot)) {
        for (const Int node : sortie.customers()) visit(node);
    }
}

// List the slots in use, and those that are free. In place.
void list_active(const Searcher& searcher);

// List a slot among those in use, or those that are free, if it isn't yet. In place.
void list_anew(const Searcher& searcher, Int slot, bool used);

// List the slots touched this turn where they belong. In place.
void list_touched(const Searcher& searcher);

// Tell whether there is a vehicle of type `k` that nobody drives.
inline bool is_left(const ProblemData& data, const Fleet& fleet, Int k) {
    return fleet.used[k] < data.type[k].count;
}

// Return an empty slot for a route more by type `k`; `nowhere` if there is none.
inline Int free_slot(const ProblemData& data, const Searcher& searcher, Int k) {
    const Int active = searcher.count->active;
    const bool may_open = is_left(data, searcher.now, k) && active < searcher.active.size();
    return may_open ? searcher.active[active] : nowhere;
}

// Keep a route as it is before it changes this turn. In place.
void touch(const Searcher& searcher, Int slot);

// Copy what is chosen of a route to another slot, where it is as long but not timed. In place.
void keep_aside(const Fleet& fleet, Int slot, Int to);

// List a slot as changed since the best. In place.
inline void note_changed(const Searcher& searcher, Int slot) {
    SearchCounts& count = *searcher.count;
    if (count.changed == all_slots || searcher.is_changed[slot]) return;
    searcher.is_changed[slot] = true;
    searcher.changed.at(count.changed++) = slot;
}

// List all slots as changed since the best. In place.
void list_all_changed(const Searcher& searcher);

// Take the routes as they are for the best. In place.
void keep_best(const Searcher& searcher);

// Take what is known of all routes as they are for that of the best. In place.
void keep_totals(const Searcher& searcher);

// Return the cost of the routes as they are, and of the customers left out before this turn.
double served_cost(const Searcher& searcher);

// Return what leaving out the first customers of a list costs above the least for each.
double unassigned_more(const ProblemData& data, View<const Int, 1> nodes, Int count);

// Return what leaving out the first customers of a list costs.
double left_out_cost(const ProblemData& data, View<const Int, 1> nodes, Int count);

// Return what the customers left out cost.
double missing_cost(const ProblemData& data, const Searcher& searcher);

// Go on from this turn's routes. In place.
void accept(const Searcher& searcher, double cost);

// Go on from the best routes. In place.
void go_back(const Searcher& searcher);

}  // namespace tandem
