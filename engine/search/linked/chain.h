// Stops that come into routes and go out of them, and back again.
#pragma once

#include "rules/segment.h"
#include "rules/shift.h"
#include "rules/start.h"
#include "search/linked/layout.h"

namespace tandem {

// Lets a vehicle of a type drive from a free slot, to nobody as yet.
void open_run(const ProblemData& data, Searcher& searcher, Linked& linked, Int slot, Int k);

// Lets a vehicle that serves nobody stay where it is.
void close_run(Searcher& searcher, Linked& linked, Int slot);

// Inserts a customer behind another, or first if `before` is a depot, and notes it. Times stay as
// they are.
void tie_in(const ProblemData& data, Linked& linked, Int slot, Int before, Int node);

// Lets one customer, or the depot, come right behind another on a route; returns how far that is.
Int connect(const ProblemData& data, Linked& linked, Int slot, Int before, Int behind);

// Takes customers in a row out of a route, and notes them; returns what that saves. Times stay as
// they are.
Int cut_out(const ProblemData& data, Linked& linked, Int slot, Int first, Int count);

// The route of a vehicle of a type up to where it leaves a customer, or begins if that is a depot.
inline Front front_at(const ProblemData& data, const Linked& linked, const VehicleType& type,
                      Int node) {
    if (node >= data.num_depots) return {linked.link[node].leave};
    return {leaves_first(type, type.shift_earliest)};
}

// That from where it comes to a customer, or home, on.
inline Rear rear_at(const ProblemData& data, const Linked& linked, const VehicleType& type,
                    Int node) {
    return {node >= data.num_depots ? linked.link[node].latest : last_end(type)};
}

// The same of vehicles of any type, so that depots limit nothing. Links are read before it is known
// whether they are customers', which takes no branch.
inline Front front_at(const ProblemData& data, const Linked& linked, Int node) {
    const Int leave = linked.link[node].leave;
    return {node < data.num_depots ? -far : leave};
}

inline Rear rear_at(const ProblemData& data, const Linked& linked, Int node) {
    const Int latest = linked.link[node].latest;
    return {node < data.num_depots ? far : latest};
}

// Brings departures from a customer on up to date, of so many even if none changes.
void drive_on(const ProblemData& data, Linked& linked, Int slot, Int node, Int number);

// Brings latest arrivals from a customer back up to date. As `drive_on`.
void look_back(const ProblemData& data, Linked& linked, Int slot, Int node, Int number);

// Writes all times of a route.
void retime(const ProblemData& data, Linked& linked, Int slot);

// Lets a route, of which customers alone were taken out since, be as it was when so much was noted.
void restore(const ProblemData& data, Searcher& searcher, Linked& linked, Int slot,
             const NoteCounts& before);

// Lets all be as it was before this turn.
void take_back(const ProblemData& data, Searcher& searcher, Linked& linked);

// Lets nothing be noted.
void forget(Linked& linked);

}  // namespace tandem
