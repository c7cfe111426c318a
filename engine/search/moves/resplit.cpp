#include "search/moves/resplit.h"

#include <algorithm>
#include <cmath>

#include "randomness.h"
#include "rules/load.h"
#include "rules/shift.h"
#include "search/moves/operations.h"
#include "search/moves/split.h"
#include "search/moves/splitter.h"
#include "search/moves/two_opt_star.h"
#include "search/route/edit.h"
#include "search/route/refresh.h"
#include "search/route/routes.h"
#include "search/route/state.h"
#include "search/scratch.h"

namespace tandem {
namespace {

constexpr Int reach = 12;  // how many stops before, and behind, a random one are planned anew

// How often two routes are planned anew together, where both have no more than two `reach`.
constexpr double together_share = 0.2;

constexpr double cut_elsewhere_share = 0.5;  // how often nothing but the depot between them moves

constexpr double same_share = 1e-12;  // costs that differ by a smaller share are the same

// Stops of a route, both included.
struct Part {
    Int first;
    Int last;
};

// Places of one or two routes in a line: how many, 0 if that can't be; what the operations cost if
// that is all that the drones do, whether it is, and whether time saved counts for itself: some
// trucks wait, or some of their work costs more than the rest.
struct Lines {
    Int length = 1;
    double cost = 0.0;
    bool exact = true;
    bool saves_time = false;
};

template <class T>
View<T, 1> behind(View<T, 1> values, Int begin) {
    return {values.data() + begin, {values.size() - begin}};
}

// Tell whether a drone is launched before stop `p` and recovered behind it.
bool flown_over(const Fleet& fleet, Int slot, Int p) {
    const View<const Sortie, 1> sorties = fleet.sortie[slot].first(fleet.route[slot].sorties);
    return std::any_of(sorties.begin(), sorties.end(), [p](const Sortie& sortie) {
        return sortie.launch < p && p < sortie.recovery;
    });
}

// Return the stops around `p` between which all that is launched is recovered.
Part window(const Fleet& fleet, Int slot, Int p) {
    const Trip& trip = fleet.trip(slot, fleet.stop(slot, p).trip);
    Part part{std::max(trip.first, p - reach), std::min(trip.last, p + reach)};
    while (flown_over(fleet, slot, part.first)) --part.first;
    while (flown_over(fleet, slot, part.last)) ++part.last;
    return part;
}

// How many places there are in a line, 0 if a sortie serves several customers or the truck stops at
// a launch site, and whether all that
// the drone does is operations.
struct LinedUp {
    Int length;
    bool exact;
};

// Write the places of stops in the order they are left for, and the operations as they are.
LinedUp line_up(const Fleet& fleet, Int slot, Part part, View<Line, 1> line) {
    const View<const Stop, 1> stops = fleet.stop[slot];
    const View<const Sortie, 1> sorties = fleet.sortie[slot].first(fleet.route[slot].sorties);
    Int length = 0;
    Int begin = 0;
    Int s = 0;
    Int landing = part.first;
    Int flown = no_flight;
    bool exact = true;
    while (s < sorties.size() && sorties[s].launch < part.first) ++s;
    for (Int p = part.first; p <= part.last; ++p) {
        if (stops[p].kind == halt_stop) return {0, false};
        line[length].node = stops[p].node;
        if (p == landing) {
            line[length].before = begin;
            line[length].flight = flown;
            begin = length;
            flown = no_flight;
            landing = p + 1;
        }
        ++length;
        for (; p < part.last && s < sorties.size() && sorties[s].launch == p; ++s) {
            if (sorties[s].count > 1) return {0, false};
            if (sorties[s].recovery > p) {
                exact = exact && length == begin + 1;
                flown = length;
                landing = sorties[s].recovery;
            }
            line[length].node = sorties[s].nodes[0];
            ++length;
        }
    }
    return {length, exact};
}

// Return what a route costs beside its operations, of which the last ends at no customer.
double beside(const Rate& rate) { return rate.fixed - rate.stop; }

// Append the places of a route's stops to a line. In place; false if that can't be.
bool line_up_too(const ProblemData& data, const Fleet& fleet, Int k, Int slot, Part part,
                 View<Line, 1> line, Lines& lines) {
    const Int begin = lines.length - 1;
    const Route& route = fleet.route[slot];
    if (route.length == 0) {
        line[lines.length++].node = line[begin].node;
        return true;
    }
    const View<Line, 1> rest = behind(line, begin);
    const auto [count, exact] = line_up(fleet, slot, part, rest);
    if (count == 0) return false;
    lines.exact = lines.exact && exact;
    lines.saves_time = lines.saves_time || idle_time(route) > 0 ||
                       is_dearer(data.rate[k], work_of(data.type[k], route));
    if (lines.exact) {
        measure(data, k, rest, count);
        lines.cost += present_cost(data, k, rest, count) + beside(data.rate[k]);
    }
    lines.length = begin + count;
    return true;
}

// Write the places of a part of a route, then those of the other, if any.
Lines line_up_all(const ProblemData& data, const Fleet& fleet, Int k, Int slot, Int other,
                  Part part, View<Line, 1> line) {
    Lines lines;
    bool done = line_up_too(data, fleet, k, slot, part, line, lines);
    if (done && other >= 0) {
        const Part all{0, fleet.route[other].length - 1};
        done = line_up_too(data, fleet, k, other, all, line, lines);
    }
    if (!done) lines.length = 0;
    return lines;
}

// Tell whether a drone is launched at the last stop of a route, which no line knows of.
bool ends_in_flight(const Fleet& fleet, Int slot) {
    const Route& route = fleet.route[slot];
    return route.sorties > 0 && fleet.sortie(slot, route.sorties - 1).launch == route.length - 1;
}

// Return a route to plan anew together with a customer's: that of a near neighbour.
//
// An empty slot if that is the same route; `nowhere` if there is none.
Int partner(const ProblemData& data, const Searcher& searcher, Int slot, Int node) {
    const Fleet& now = searcher.now;
    const Route& route = now.route[slot];
    const Int k = route.type;
    const View<const std::int32_t, 1> near = data.near[node];
    const Int neighbour = near[below(searcher.rng, std::min(near_places, near.size()))];
    // The end of the one route is the start of the other in a line.
    if (neighbour < 0 || route.trips > 1 || ends_in_flight(now, slot) ||
        data.type[k].begins_at != data.type[k].ends_at) {
        return nowhere;
    }
    Int other = now.where[neighbour].slot;
    if (other == slot) other = free_slot(data, searcher, k);
    if (other < 0) return nowhere;
    const Route& mate = now.route[other];
    if (mate.length > 0 && (mate.type != k || mate.trips > 1 || ends_in_flight(now, other))) {
        return nowhere;
    }
    return route.length + mate.length <= 2 * reach ? other : nowhere;
}

// Return where in a line of two routes the first ends, or the end of a line of one.
Int depot_between(const ProblemData& data, View<const Line, 1> line, Int length) {
    Int place = 1;
    while (place < length - 1 && line[place].node >= data.num_depots) ++place;
    return place;
}

// Tell whether operations may cost less than `limit` more than before.
//
// Where windows make trucks wait, or count themselves, that says nothing; nor where less work saves
// more than by the hour.
bool is_worth(const ProblemData& data, Int k, const Lines& before, double after, double limit) {
    if (data.evaluation[k].priced || before.saves_time) return true;
    return after < before.cost + limit && std::abs(after - before.cost) > same_share * before.cost;
}

// Tell whether the customers between two places of the line are too much for a truck.
//
// There may be no room for so many stops and sorties then, so that it has to be known before.
bool overloads(const ProblemData& data, Int k, View<const Line, 1> line, Int begin, Int end) {
    Amount load{};
    for (Int place = begin + 1; place < end; ++place) {
        load = plus(load, demand_of(data.place[0][line[place].node]));
    }
    return !holds(data.type[k], load);
}

// Cut a route's places in the line, `begin` to `end`, at least cost; return that. In place; maybe
// infinite.
double split_between(const ProblemData& data, Searcher& searcher, Int k, Int begin, Int end) {
    if (end <= begin + 1) return 0.0;
    if (overloads(data, k, searcher.scratch->line, begin, end)) return infinite_cost;
    const View<Line, 1> line = behind(searcher.scratch->line.view(), begin);
    const Int count = end - begin + 1;
    measure(data, k, line, count);
    return split(data, k, line, count, searcher.scratch->split) + beside(data.rate[k]);
}

// Cut the line, or both routes in it, at least cost; return that. In place; maybe infinite.
//
// `cut` is as `depot_between` says.
double split_all(const ProblemData& data, Searcher& searcher, Int k, Int cut, Int length) {
    const double cost = split_between(data, searcher, k, 0, cut);
    if (cost == infinite_cost) return infinite_cost;
    return cost + split_between(data, searcher, k, cut, length - 1);
}

// Let the places where operations end tell where the next does, not where they began. In place.
void turn_round(View<Line, 1> line, Int length) {
    Int next = nowhere;
    for (Int j = length - 1; j > 0;) {
        const Int before = line[j].before;
        line[j].before = next;
        next = j;
        j = before;
    }
    line[0].before = next;
}

// Append the stops that the operations make, but for the last. In place; turns `before` round.
//
// `kind` is that of the first stop.
void write_operations(Route& route, View<Stop, 1> stops, View<Sortie, 1> sorties,
                      View<Line, 1> line, Int length, Int kind) {
    turn_round(line, length);
    put(stops, route.length, line[0].node, kind);
    for (Int i = 0; i < length - 1;) {
        const Int j = line[i].before;
        const Int p = route.length;
        const Int flown = line[j].flight;
        if (flown != no_flight) {
            add_sortie(route, sorties, p, p + j - i - 1, 0, line[flown].node);
        }
        for (Int place = i + 1; place < j; ++place) {
            if (flown == no_flight) {
                add_sortie(route, sorties, p, p, 0, line[place].node);
            } else if (place != flown) {
                put(stops, ++route.length, line[place].node, customer_stop);
            }
        }
        ++route.length;
        if (j < length - 1) put(stops, route.length, line[j].node, customer_stop);
        i = j;
    }
}

// Write places `begin` to `end` of the line into the part of a route that is kept aside. In place;
// false if that breaks a rule.
bool write_between(const ProblemData& data, Searcher& searcher, Int k, Int slot, Part part,
                   Int begin, Int end) {
    const Fleet& now = searcher.now;
    const Int spare = now.route.size() - 2;
    Route& route = now.route[slot];
    if (route.length > 0) --now.used[k];
    route.length = route.sorties = route.trips = 0;
    now.cost[slot] = 0.0;
    if (end <= begin + 1) return true;
    route.type = k;
    ++now.used[k];
    append(now, spare, 0, part.first, slot);
    write_operations(route, now.stop[slot], now.sortie[slot],
                     behind(searcher.scratch->line.view(), begin), end - begin + 1,
                     now.stop(spare, part.first).kind);
    append(now, spare, part.last, now.route[spare].length, slot);
    const bool done = refresh(data, now, slot);
    locate(now, slot);
    return done;
}

// Write what the line says into a part of a route, and into the other, if any. In place; false if
// that breaks a rule.
bool write_all(const ProblemData& data, Searcher& searcher, Int slot, Int other, Part part, Int cut,
               Int length) {
    Fleet& now = searcher.now;
    const Int k = now.route[slot].type;
    touch(searcher, slot);
    if (other >= 0) touch(searcher, other);
    keep_aside(now, slot, now.route.size() - 2);
    bool done = write_between(data, searcher, k, slot, part, 0, cut);
    if (other >= 0) {
        done = write_between(data, searcher, k, other, part, cut, length - 1) && done;
    }
    return done;
}

}  // namespace

bool resplit(const ProblemData& data, Searcher& searcher, double limit) {
    const Fleet& now = searcher.now;
    const View<std::uint64_t, 1> rng = searcher.rng;
    const Int node = draw_customer(data, now, searcher.count->focus, rng);
    const Int slot = now.where[node].slot;
    if (slot < 0 || data.type[now.route[slot].type].drones != 1) return false;
    const Int k = now.route[slot].type;
    Int other = nowhere;
    if (uniform(rng) < together_share) other = partner(data, searcher, slot, node);
    Part part{0, now.route[slot].length - 1};
    if (other < 0) part = window(now, slot, stop_beside(now, node));
    const Lines lines = line_up_all(data, now, k, slot, other, part, searcher.scratch->line);
    if (lines.length < 4) return false;
    if (other >= 0 && uniform(rng) < cut_elsewhere_share) {
        const Int between = depot_between(data, searcher.scratch->line, lines.length);
        shift(searcher.scratch->line, between, 1 + below(rng, lines.length - 2));
    } else {
        shuffle(data, searcher.scratch->line, lines.length, rng);
    }
    const Int cut = depot_between(data, searcher.scratch->line, lines.length);
    const double after = split_all(data, searcher, k, cut, lines.length);
    if (after == infinite_cost || (lines.exact && !is_worth(data, k, lines, after, limit))) {
        return false;
    }
    return write_all(data, searcher, slot, other, part, cut, lines.length);
}

}  // namespace tandem
