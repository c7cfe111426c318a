#include "search/moves/resplit.h"

#include <cmath>

#include "randomness.h"
#include "search/moves/halting.h"
#include "search/moves/operations.h"
#include "search/moves/rewrite.h"

namespace tandem {
namespace {

constexpr Int reach = 12;  // how many stops before, and behind, a random one are planned anew

// How often two routes are planned anew together, where both have no more than two `reach`.
constexpr double together_share = 0.2;

constexpr double cut_elsewhere_share = 0.5;  // how often nothing but the depot between them moves

constexpr Int orders_tried = 9;  // of a part, one after another

template <class T>
View<T, 1> behind(View<T, 1> values, Int begin) {
    return values.part(begin, values.size() - begin);
}

// Tell whether a drone is launched before stop `p` and recovered behind it.
bool flown_over(const Fleet& fleet, Int slot, Int p) {
    const View<const Sortie, 1> sorties = sorties_of(fleet, slot);
    return std::ranges::any_of(
        sorties, [p](const Sortie& sortie) { return sortie.launch < p && p < sortie.recovery; });
}

// How many places there are in a line, 0 if a sortie serves several customers, and whether all that
// the drone does is operations.
struct LinedUp {
    Int length;
    bool exact;
};

// Write the places of stops in the order they are left for, and the operations as they are.
LinedUp line_up(const Fleet& fleet, Int slot, Int first, Int last, View<Line, 1> line) {
    const View<const Stop, 1> stops = fleet.stop[slot];
    const View<const Sortie, 1> sorties = sorties_of(fleet, slot);
    Int length = 0, begin = 0, s = 0, landing = first, flown = no_flight;
    bool exact = true;
    while (s < sorties.size() && sorties[s].launch < first) ++s;
    for (Int p = first; p <= last; ++p) {
        Line& place = line.at(length);
        place.node = stops[p].node;
        if (p == landing) {
            place.before = begin;
            place.flight = flown;
            begin = length;
            flown = no_flight;
            landing = p + 1;
        }
        ++length;
        for (; p < last && s < sorties.size() && sorties[s].launch == p; ++s) {
            if (sorties[s].count > 1) return {0, false};
            if (sorties[s].recovery > p) {
                exact = exact && length == begin + 1;
                flown = length;
                landing = sorties[s].recovery;
            }
            line.at(length++).node = sorties[s].nodes[0];
        }
    }
    return {length, exact};
}

// Return what a route costs beside its operations, of which the last ends at no customer, and those
// between at a customer each but where the truck stops at a launch site.
double beside(const ProblemData& data, Int k, View<const Line, 1> line, Int length) {
    const Rate& rate = data.rate[k];
    double cost = rate.fixed - rate.stop;
    if (!has_halts(data)) return cost;
    for (Int place = 1; place < length - 1; ++place) {
        const Int node = line[place].node;
        if (node < data.num_depots) cost += data.halt_cost[node] - rate.stop;
    }
    return cost;
}

// Tell whether a drone is launched at the last stop of a route, which no line knows of.
bool ends_in_flight(const Fleet& fleet, Int slot) {
    const Route& route = fleet.route[slot];
    return route.sorties > 0 && fleet.sortie(slot, route.sorties - 1).launch == route.length - 1;
}

// Return where in a line of two routes the first ends, or the end of a line of one.
Int depot_between(const ProblemData& data, Int k, View<const Line, 1> line, Int length) {
    Int place = 1;
    while (place < length - 1 &&
           (line[place].node >= data.num_depots || is_halt(data, k, line[place].node))) {
        ++place;
    }
    return place;
}

// Tell whether nobody is between two places of the line, but maybe launch sites.
bool are_idle(const ProblemData& data, View<const Line, 1> line, Int begin, Int end) {
    ++begin;
    while (begin < end && line[begin].node < data.num_depots) ++begin;
    return begin >= end;
}

// Tell whether the customers between two places of the line are too much for a truck.
bool overloads(const ProblemData& data, Int k, View<const Line, 1> line, Int begin, Int end) {
    Amount load{};
    for (Int place = begin + 1; place < end; ++place) {
        load = plus(load, demand_of(data.place[0][line[place].node]));
    }
    return !holds(data.type[k], load);
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

// Append the stops that the operations make, but for the last. In place; turns `before` round;
// false if there is no room.
//
// `kind` is that of the first stop.
bool write_operations(const ProblemData& data, const Sequence& sequence, View<Line, 1> line,
                      Int length, Int kind) {
    const auto add = [&](Int place) {
        const Int node = line[place].node;
        return add_stop(sequence, node, node < data.num_depots ? halt_stop : customer_stop);
    };
    turn_round(line, length);
    if (!add_stop(sequence, line[0].node, kind)) return false;
    for (Int i = 0; i < length - 1;) {
        const Int j = line[i].before;
        const Int p = sequence.route.length - 1;
        const Int flown = line[j].flight;
        bool fits =
            flown == no_flight || add_sortie(sequence, p, p + j - i - 1, 0, line[flown].node);
        for (Int place = i + 1; place < j && fits; ++place) {
            if (flown == no_flight) {
                fits = add_sortie(sequence, p, p, 0, line[place].node);
            } else if (place != flown) {
                fits = add(place);
            }
        }
        if (!fits || (j < length - 1 && !add(j))) return false;
        i = j;
    }
    return true;
}

}  // namespace

bool Resplit::attempt(double limit) {
    if (tries_ > 0) return change_again(limit);
    if (!draw()) return false;
    return counts() ? split_first(limit) : change_once(limit);
}

// Draw a part, and write its places into the line; false if there is nothing to plan anew.
bool Resplit::draw() {
    const Fleet& now = searcher_.now;
    const View<std::uint64_t, 1> rng = searcher_.rng;
    const Int node = draw_customer(data_, now, searcher_.count->focus, rng);
    slot_ = now.where[node].slot;
    if (slot_ < 0 || data_.type[now.route[slot_].type].drones != 1) return false;
    type_ = now.route[slot_].type;
    other_ = uniform(rng) < together_share ? partner(node) : nowhere;
    part_ = {0, now.route[slot_].length - 1};
    if (other_ < 0) part_ = window(stop_beside(now, node));
    lines_ = {};
    const bool done =
        line_up(slot_, part_) && (other_ < 0 || line_up(other_, {0, now.route[other_].length - 1}));
    return done && lines_.length >= 4;
}

// Return the stops around `p` between which all that is launched is recovered.
Resplit::StopSpan Resplit::window(Int p) const {
    const Fleet& fleet = searcher_.now;
    const Trip& trip = fleet.trip(slot_, fleet.stop(slot_, p).trip);
    StopSpan part{std::max(trip.first, p - reach), std::min(trip.last, p + reach)};
    while (flown_over(fleet, slot_, part.first)) --part.first;
    while (flown_over(fleet, slot_, part.last)) ++part.last;
    return part;
}

// Return a route to plan anew together with a customer's: that of a near neighbour.
//
// An empty slot if that is the same route; `nowhere` if there is none.
Int Resplit::partner(Int node) const {
    const Fleet& now = searcher_.now;
    const Route& route = now.route[slot_];
    const View<const std::int32_t, 1> near = data_.near[node];
    const Int neighbour = near[below(searcher_.rng, std::min(near_places, near.size()))];
    // The end of the one route is the start of the other in a line.
    if (neighbour < 0 || route.trips > 1 || ends_in_flight(now, slot_) ||
        data_.type[type_].begins_at != data_.type[type_].ends_at) {
        return nowhere;
    }
    Int other = now.where[neighbour].slot;
    if (other == slot_) other = free_slot(data_, searcher_, type_);
    if (other < 0) return nowhere;
    const Route& mate = now.route[other];
    if (mate.length > 0 && (mate.type != type_ || mate.trips > 1 || ends_in_flight(now, other))) {
        return nowhere;
    }
    return route.length + mate.length <= 2 * reach ? other : nowhere;
}

// Append the places of a route's stops to the line. In place; false if that can't be.
bool Resplit::line_up(Int slot, StopSpan part) {
    const Fleet& fleet = searcher_.now;
    const View<Line, 1> line = searcher_.scratch->line;
    const Int begin = lines_.length - 1;
    const Route& route = fleet.route[slot];
    if (route.length == 0) {
        line.at(lines_.length++).node = line[begin].node;
        return true;
    }
    const View<Line, 1> rest = behind(line, begin);
    const auto [count, exact] = tandem::line_up(fleet, slot, part.first, part.last, rest);
    if (count == 0) return false;
    lines_.exact = lines_.exact && exact;
    lines_.saves_time = lines_.saves_time || may_save_more(data_, route);
    if (lines_.exact) {
        measure(data_, type_, rest, count);
        lines_.cost += present_cost(data_, type_, rest, count) + beside(data_, type_, rest, count);
    }
    lines_.length = begin + count;
    return true;
}

// Tell whether what operations cost tells what the routes do.
//
// Where windows make trucks wait, or count themselves, it doesn't; nor where less work saves more
// than by the hour.
bool Resplit::counts() const {
    return lines_.exact && !data_.evaluation[type_].priced && !lines_.saves_time;
}

// Tell whether operations may cost less than `limit` more than before.
bool Resplit::is_worth(double after, double limit) const {
    if (after == infinite_cost) return false;
    if (!counts()) return true;
    return after < lines_.cost + limit && std::abs(after - lines_.cost) > same_share * lines_.cost;
}

// Cut the order as it is at least cost, if that is worth it; else change it later.
bool Resplit::split_first(double limit) {
    if (other_ >= 0) return change_once(limit);
    const Scratch& scratch = *searcher_.scratch;
    beside_ = beside(data_, type_, scratch.line, lines_.length);
    least_ = split_between(0, lines_.length - 1);
    if (is_worth(least_, limit)) return write(lines_.length - 1);
    std::copy_n(scratch.line.view().begin(), lines_.length, scratch.aside.view().begin());
    tries_ = orders_tried;
    return false;
}

// Change the order that was cut before, and cut it where that changes anything.
bool Resplit::change_again(double limit) {
    --tries_;
    Scratch& scratch = *searcher_.scratch;
    const Int length = lines_.length;
    const View<Line, 1> line = scratch.line;
    std::copy_n(scratch.aside.view().begin(), length, line.begin());
    const Places changed = change_order(line, length);
    const Int count = length + changed.more;
    if (!changed.any() || !are_halts_in_order(data_, line, count)) return false;
    measure(data_, type_, line, count);
    const double apart = beside(data_, type_, line, count);
    const double most = lines_.cost + limit - least_ + (beside_ - apart);
    const double after =
        split_changed(data_, type_, line, count, {changed, scratch.split, most}, scratch.changed) +
        apart;
    if (!is_worth(after, limit)) return false;
    tries_ = 0;
    return write(count - 1);
}

// Change the order, and cut all of it at least cost.
bool Resplit::change_once(double limit) {
    const View<Line, 1> line = searcher_.scratch->line;
    if (other_ >= 0 && uniform(searcher_.rng) < cut_elsewhere_share) {
        const Int cut = depot_between(data_, type_, line, lines_.length);
        shift(line, cut, 1 + below(searcher_.rng, lines_.length - 2));
    } else {
        lines_.length += change_order(line, lines_.length).more;
    }
    if (!are_halts_in_order(data_, line, lines_.length)) return false;
    const Int cut = depot_between(data_, type_, line, lines_.length);
    double after = split_between(0, cut);
    if (after < infinite_cost) after += split_between(cut, lines_.length - 1);
    return is_worth(after, limit) && write(cut);
}

// Change the order of the customers a little, or where the truck stops at launch sites. In place;
// tell between which places.
Places Resplit::change_order(View<Line, 1> line, Int length) const {
    const View<std::uint64_t, 1> rng = searcher_.rng;
    if (has_halts(data_) && uniform(rng) < halts_changed_share) {
        return change_halts(data_, type_, line, length, rng);
    }
    return shuffle(data_, line, length, rng);
}

// Cut a route's places in the line, `begin` to `end`, at least cost; return that. In place; maybe
// infinite.
double Resplit::split_between(Int begin, Int end) const {
    if (are_idle(data_, searcher_.scratch->line, begin, end)) return 0.0;
    const View<Line, 1> line = behind(searcher_.scratch->line.view(), begin);
    const Int count = end - begin + 1;
    if (overloads(data_, type_, line, 0, count - 1)) return infinite_cost;
    measure(data_, type_, line, count);
    return split(data_, type_, line, count, searcher_.scratch->split) +
           beside(data_, type_, line, count);
}

// Write places `begin` to `end` of the line into the part of a route that is kept aside. In place;
// false if that breaks a rule.
bool Resplit::write_between(Int slot, Int begin, Int end) const {
    const Fleet& now = searcher_.now;
    Route& route = now.route[slot];
    if (route.length > 0) --now.used[type_];
    route.length = route.sorties = route.trips = 0;
    now.cost[slot] = 0.0;
    if (are_idle(data_, searcher_.scratch->line, begin, end)) return true;
    route.type = type_;
    ++now.used[type_];
    return rewrite(data_, searcher_, slot, part_.first, part_.last, [&](const Stop& first) {
        return write_operations(data_, sequence_in(now, slot),
                                behind(searcher_.scratch->line.view(), begin), end - begin + 1,
                                first.kind);
    });
}

// Write what the line says into the part, and into the other route, if any, which begins at place
// `cut`. In place; false if that breaks a rule.
bool Resplit::write(Int cut) {
    Fleet& now = searcher_.now;
    touch(searcher_, slot_);
    if (other_ >= 0) touch(searcher_, other_);
    keep_aside(now, slot_, now.route.size() - 2);
    bool done = write_between(slot_, 0, cut);
    if (other_ >= 0) done = write_between(other_, cut, lines_.length - 1) && done;
    return done;
}

}  // namespace tandem
