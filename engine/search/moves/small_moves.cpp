#include "search/moves/small_moves.h"

#include <cmath>

#include "search/moves/operation_prices.h"
#include "search/moves/rewrite.h"

namespace tandem {
namespace {

constexpr Int moves_each = 15;         // for each customer of the trips
constexpr Int most_moves = 6000;       // however many there are
constexpr Int enough_customers = 100;  // from which on no trip more is changed at a time

constexpr Int near_neighbours = 10;  // among how many nearest neighbours of a customer one is drawn

// How often a customer goes elsewhere, trades places with another, stops are reversed, or some go
// elsewhere together; else truck and drone meet elsewhere.
constexpr double relocate_share = 0.35, swap_share = 0.15, reverse_share = 0.15;
constexpr double segment_share = 0.15;

constexpr double part_share = 0.15;  // how often an operation is parted where a stop is inserted
constexpr Int longest_segment = 5;   // stops that go elsewhere together
constexpr Int longest_reversed = 50;
constexpr Int longest_flown = 4;  // legs of the truck while the drone flies, where it begins to

}  // namespace

bool SmallMoves::attempt() {
    gather();
    searcher_.count->movable = customers_;
    if (customers_ < 2) {
        forget();
        return false;
    }
    cost_ = searcher_.value->cost;
    best_ = searcher_.value->best;
    improved_ = false;
    const Int moves = std::min(most_moves, moves_each * customers_);
    for (Int move = 0; move < moves; ++move) change();
    forget();
    return write();
}

// Take the trip of a random customer, and those of his neighbours, one a route.
void SmallMoves::gather() {
    num_trips_ = customers_ = 0;
    const Int node = draw_customer(data_, searcher_.now, searcher_.count->focus, searcher_.rng);
    if (searcher_.now.where[node].slot < 0) return;
    add_trip(node);
    for (const Int other : data_.near[node]) {
        if (other < 0 || num_trips_ == most_changing || customers_ >= enough_customers) return;
        if (searcher_.now.where[other].slot >= 0) add_trip(other);
    }
}

// Add a customer's trip, if what its operations cost tells what it does.
void SmallMoves::add_trip(Int node) {
    const Fleet& now = searcher_.now;
    const Int slot = now.where[node].slot;
    const Route& route = now.route[slot];
    for (Int number = 0; number < num_trips_; ++number) {
        if (trip(number).slot == slot) return;
    }
    const Int type = route.type;
    if (data_.type[type].drones != 1 || data_.evaluation[type].priced ||
        may_save_more(data_, route)) {
        return;
    }
    const Trip& there = now.trip(slot, now.stop(slot, stop_beside(now, node)).trip);
    const Int room = data_.num_nodes + more_places;
    const View<OperationStop, 1> rows = searcher_.scratch->operations;
    const auto part = [&](Int number) { return OperationRow(rows.part(number * room, room), 0); };
    Changing& added = trip(num_trips_);
    added = {slot,
             there.first,
             there.last,
             type,
             0,
             Amount{},
             part(2 * num_trips_),
             part(2 * num_trips_ + 1),
             false,
             OperationData(data_, type)};
    if (!read(added)) return;
    price(*added.by, added.row);
    if (cost(type, added.row, 0, added.row.length() - 1) == infinite_cost) return;
    note(num_trips_, 0, added.row.length() - 1);
    customers_ += added.customers;
    ++num_trips_;
}

// Write a trip as operations; false if it isn't such. In place.
//
// There is no place for a flight that the truck waits for before another from the same stop.
bool SmallMoves::read(Changing& trip) {
    const Fleet& fleet = searcher_.now;
    const View<const Stop, 1> stops = fleet.stop[trip.slot];
    const View<const Sortie, 1> sorties =
        fleet.sortie[trip.slot].first(fleet.route[trip.slot].sorties);
    Int s = 0, recovery = trip.first;
    while (s < sorties.size() && sorties[s].launch < trip.first) ++s;
    trip.row.clear();
    for (Int p = trip.first; p <= trip.last; ++p) {
        if (stops[p].kind == halt_stop) return false;
        OperationStop here{std::int32_t(stops[p].node), nobody, p >= recovery};
        if (has_window(stops[p])) take_on(trip, here.node);
        if (s < sorties.size() && sorties[s].launch == p && p < trip.last) {
            if (sorties[s].count > 1) return false;
            here.flown = std::int32_t(sorties[s].nodes[0]);
            recovery = sorties[s].recovery;
            take_on(trip, here.flown);
            ++s;
        }
        if (s < sorties.size() && sorties[s].launch == p) return false;
        trip.row.append(here);
    }
    return true;
}

// Count a customer of a trip. In place.
void SmallMoves::take_on(Changing& trip, Int node) {
    trip.load = plus(trip.load, demand_of(data_.place[0][node]));
    searcher_.scratch->moved_customers.at(customers_ + trip.customers++) = node;
}

// Note where who is between two places of a trip's row is. In place.
void SmallMoves::note(Int trip, Int first, Int last) {
    const OperationRow& row = this->trip(trip).row;
    for (Int place = first; place <= last; ++place) {
        const OperationStop& stop = row[place];
        const auto number = std::int32_t(trip), at = std::int32_t(place);
        if (stop.node >= data_.num_depots) served(stop.node) = {number, at, false};
        if (stop.flown != nobody) served(stop.flown) = {number, at, true};
    }
}

// Forget where everybody is. In place.
void SmallMoves::forget() {
    for (const Int node : searcher_.scratch->moved_customers.view().first(customers_)) {
        served(node).trip = nobody;
    }
}

// Change something, if it is accepted. In place.
void SmallMoves::change() {
    const Int node = searcher_.scratch->moved_customers[random(customers_)];
    double drawn = uniform(searcher_.rng);
    const auto falls_to = [&drawn](double share) { return (drawn -= share) < 0.0; };
    bool done = false;
    if (falls_to(relocate_share)) {
        done = relocate(node);
    } else if (falls_to(swap_share)) {
        done = trade(node);
    } else if (falls_to(reverse_share)) {
        done = reverse(node);
    } else if (falls_to(segment_share)) {
        done = move_segment(node);
    } else {
        done = move_joint(node);
    }
    if (done) keep_if_best();
}

// Let a customer be served beside a neighbour, by truck or drone.
bool SmallMoves::relocate(Int node) {
    const Int other = neighbour(node);
    if (other == nowhere) return false;
    const bool flies = coin();
    const TripSpan from = around(node);
    const TripSpan to = flies ? widened(widened(around(other))) : around(other);
    if (!may_serve(to.trip, node, flies)) return false;
    if (from.trip == to.trip && from.first < to.last && to.first < from.last) {
        Draft both =
            draft(0, {to.trip, std::min(from.first, to.first), std::max(from.last, to.last)});
        return remove(both.row, node) && insert_beside(both.row, other, node, flies) &&
               decide({&both});
    }
    Changing &source = trip(from.trip), &target = trip(to.trip);
    const Amount load = plus(target.load, demand_of(data_.place[0][node]));
    if (from.trip != to.trip && (source.customers == 1 || !holds(data_.type[target.type], load))) {
        return false;
    }
    Draft left = draft(0, from), right = draft(1, to);
    if (!remove(left.row, node) || !insert_beside(right.row, other, node, flies)) return false;
    if (from.first > to.first) std::swap(left, right);
    // What comes behind moves, so that it is replaced first.
    if (!decide({&right, &left})) return false;
    if (from.trip != to.trip) {
        source.load = minus(source.load, demand_of(data_.place[0][node]));
        target.load = load;
        --source.customers;
        ++target.customers;
    }
    return true;
}

// Insert a customer beside another, where that may be. In place; false if it can't be.
bool SmallMoves::insert_beside(OperationRow& row, Int other, Int node, bool flies) const {
    Int place = find(row, other);
    if (row[place].node != other) {
        // The drone serves the other: the customer goes anywhere on that operation.
        if (!flies) place += random(row.end_behind(place) - place);
    } else if (!flies && (place == row.length() - 1 || (place > 0 && coin()))) {
        --place;
    }
    if (!flies) {
        row.insert_stop(place, node);
        if (!row[place + 1].joint && uniform(searcher_.rng) < part_share)
            row.part(place + 1, coin());
        return true;
    }
    const Int begin = row.begin_of(place);
    if (begin < row.length() - 1 && row[begin].flown != nobody) {
        const Int end = row.end_behind(begin);
        if (end == begin + 1) return false;
        const Int joint = begin + 1 + random(end - begin - 1);
        const bool left = coin();
        row.part(joint, left);
        return left ? row.insert_flight(joint, end, node) : row.insert_flight(begin, joint, node);
    }
    const Int legs = 1 + random(longest_flown);
    const Int launch = place - random(legs + 1);
    return launch >= 0 && launch + legs < row.length() &&
           row.insert_flight(launch, launch + legs, node);
}

// Let a customer and a neighbour trade places.
bool SmallMoves::trade(Int node) {
    const Int other = neighbour(node);
    if (other == nowhere) return false;
    const Served one = served(node), two = served(other);
    if (!may_serve(one.trip, other, one.flown) || !may_serve(two.trip, node, two.flown)) {
        return false;
    }
    Changing &source = trip(one.trip), &target = trip(two.trip);
    const Amount gained = demand_of(data_.place[0][node]), lost = demand_of(data_.place[0][other]);
    if (one.trip != two.trip &&
        (!holds(data_.type[source.type], plus(minus(source.load, gained), lost)) ||
         !holds(data_.type[target.type], plus(minus(target.load, lost), gained)))) {
        return false;
    }
    const auto put = [](const Draft& draft, const Served& at, Int who) {
        OperationStop& stop = draft.row[at.place - draft.span.first];
        (at.flown ? stop.flown : stop.node) = std::int32_t(who);
    };
    const TripSpan from = around(node), to = around(other);
    if (one.trip == two.trip && from.first < to.last && to.first < from.last) {
        Draft both =
            draft(0, {to.trip, std::min(from.first, to.first), std::max(from.last, to.last)});
        put(both, one, other);
        put(both, two, node);
        return decide({&both});
    }
    Draft left = draft(0, from), right = draft(1, to);
    put(left, one, other);
    put(right, two, node);
    if (!decide({&left, &right})) return false;
    if (one.trip != two.trip) {
        source.load = plus(minus(source.load, gained), lost);
        target.load = plus(minus(target.load, lost), gained);
    }
    return true;
}

// Reverse stops so that a customer comes beside a neighbour.
bool SmallMoves::reverse(Int node) {
    const Int other = neighbour(node);
    if (other == nowhere) return false;
    const Served one = served(node), two = served(other);
    if (one.flown || two.flown || one.trip != two.trip) return false;
    Int first = std::min(one.place, two.place), last = std::max(one.place, two.place);
    if (coin()) {
        ++first;
    } else {
        --last;
    }
    if (first >= last || last - first >= longest_reversed) return false;
    Draft all = draft(0, beyond(one.trip, first, last));
    all.row.reverse(first - all.span.first, last - all.span.first);
    return decide({&all});
}

// Move some stops, of which a customer is the first or last, so that it comes beside a neighbour.
bool SmallMoves::move_segment(Int node) {
    const Int other = neighbour(node);
    if (other == nowhere) return false;
    const Served one = served(node), two = served(other);
    if (one.flown || two.flown || one.trip != two.trip) return false;
    const Int longer = 1 + random(longest_segment - 1);
    const bool is_first = coin();
    const Int first = is_first ? one.place : one.place - longer;
    const Int last = first + longer;
    if (first < 1 || last > trip(one.trip).row.length() - 2) return false;
    if (first <= two.place && two.place <= last) return false;
    // Those that make room go with the neighbour or without.
    const bool forward = two.place > last, with_other = coin();
    const Int beside = with_other ? two.place : two.place + (forward ? -1 : 1);
    const Int begin = forward ? first : beside, end = forward ? beside : last;
    if (end - begin <= longer || end - begin >= longest_reversed) return false;
    Draft all = draft(0, beyond(one.trip, begin, end));
    OperationRow& row = all.row;
    const Int low = begin - all.span.first, high = end - all.span.first;
    // The segment comes last where it came first, and the other way round.
    row.reverse(low, high);
    const Int cut = forward ? high - longer : low + longer + 1;
    row.reverse(forward ? low : cut, forward ? cut - 1 : high);
    // The segment is reversed now, and the neighbour before or behind it.
    if ((forward == with_other) == is_first) {
        row.reverse(forward ? cut : low, forward ? high : cut - 1);
    }
    return decide({&all});
}

// Let truck and drone meet one stop earlier or later than at a customer, or where the operation
// ends that he is flown to on.
bool SmallMoves::move_joint(Int node) {
    const Served& at = served(node);
    const OperationRow& row = trip(at.trip).row;
    const Int place = at.flown && coin() ? row.end_behind(at.place) : at.place;
    if (place < 1 || place > row.length() - 2 || !row[place].joint) return false;
    Draft all = draft(0, beyond(at.trip, place, place));
    return all.row.move_joint(place - all.span.first, coin()) && decide({&all});
}

// Take drafts for trips, those that come later in a trip first, if they are accepted.
bool SmallMoves::decide(std::initializer_list<const Draft*> drafts) {
    double more = 0.0;
    bool moved = false;
    for (const Draft* draft : drafts) {
        const TripSpan& span = draft->span;
        const Changing& source = trip(span.trip);
        price_changed(*source.by, source.row, span.first, span.last, draft->row);
        more += cost(source.type, draft->row, 0, draft->row.length() - 1) - draft->before;
        moved = moved || draft->row.length() != span.last - span.first + 1;
    }
    if (more > 0.0 && uniform(searcher_.rng) >= std::exp(-more / searcher_.value->temperature)) {
        return false;
    }
    for (const Draft* draft : drafts) {
        Changing& changed = trip(draft->span.trip);
        changed.row.replace(draft->span.first, draft->span.last, draft->row);
        changed.is_changed = true;
    }
    for (const Draft* draft : drafts) {
        const TripSpan& span = draft->span;
        note(span.trip, span.first, moved ? trip(span.trip).row.length() - 1 : span.last);
    }
    cost_ += more;
    return true;
}

// Keep the trips as they are if all costs least. In place.
void SmallMoves::keep_if_best() {
    if (!(cost_ < best_ - same_share * std::abs(best_))) return;
    best_ = cost_;
    improved_ = true;
    for (Int number = 0; number < num_trips_; ++number) {
        Changing& each = trip(number);
        each.best.copy(each.row, 0, each.row.length() - 1);
    }
}

// Return a near neighbour of a customer whose trip is changed, too; `nowhere` if none was drawn.
Int SmallMoves::neighbour(Int node) const {
    const View<const std::int32_t, 1> near = data_.near[node];
    const Int other = near[random(std::min(near_neighbours, near.size()))];
    return other < 0 || served(other).trip == nobody ? nowhere : other;
}

// Return the operations that begin at some stop up to `first` and end at one from `last` on.
SmallMoves::TripSpan SmallMoves::beyond(Int number, Int first, Int last) const {
    const OperationRow& row = trip(number).row;
    return {number, row.begin_of(first - 1), row.end_behind(last)};
}

// Return the operations that change without a customer.
SmallMoves::TripSpan SmallMoves::around(Int node) const {
    const Served at = served(node);
    const OperationRow& row = trip(at.trip).row;
    if (!at.flown) return beyond(at.trip, at.place, at.place);
    return {at.trip, at.place, row.end_behind(at.place)};
}

// Return some operations, and those before and behind, if any.
SmallMoves::TripSpan SmallMoves::widened(TripSpan span) const {
    const OperationRow& row = trip(span.trip).row;
    if (span.first > 0) span.first = row.begin_of(span.first - 1);
    if (span.last < row.length() - 1) span.last = row.end_behind(span.last);
    return span;
}

// Copy operations to change them.
SmallMoves::Draft SmallMoves::draft(Int number, TripSpan span) const {
    const Int room = data_.num_nodes + more_places;
    const View<OperationStop, 1> rows = searcher_.scratch->drafts;
    Draft draft{span, {rows.part(number * room, room), 0}, 0.0};
    const Changing& source = trip(span.trip);
    draft.row.copy(source.row, span.first, span.last);
    draft.before = cost(source.type, source.row, span.first, span.last);
    return draft;
}

// Return the place of a customer, or where the operation begins that he is flown to on.
Int SmallMoves::find(const OperationRow& row, Int node) {
    Int place = 0;
    while (row[place].node != node && row[place].flown != node) ++place;
    return place;
}

// Remove a customer from operations. In place; false if they can't do without.
bool SmallMoves::remove(OperationRow& row, Int node) const {
    const Int place = find(row, node);
    if (row[place].node == node) return row.remove_stop(place, coin());
    row.remove_flight(place);
    return true;
}

// Tell whether a customer may be served on a trip by truck, or `flown` to.
bool SmallMoves::may_serve(Int number, Int node, bool flown) const {
    return data_.can(trip(number).type, flown ? 1 : 0, node);
}

// Return what the operations of a truck of type `k` from one stop to another cost, once priced.
double SmallMoves::cost(Int k, const OperationRow& row, Int first, Int last) const {
    double sum = 0.0;
    for (Int place = first; place < last; place = row.end_behind(place)) sum += row[place].cost;
    if (data_.vehicle_cost.empty()) return sum;
    for (Int place = first; place <= last; ++place) {
        const OperationStop& stop = row[place];
        sum += data_.vehicle_cost(k, stop.node);
        if (stop.flown != nobody) sum += data_.vehicle_cost(k, stop.flown);
    }
    return sum;
}

// Write the trips that were changed, as they were at best if that is better than ever before. In
// place; false if none was, or if one breaks a rule.
bool SmallMoves::write() const {
    // All are touched first: where customers are has to be known anew of each if one can't be so.
    bool changed = false;
    for (Int number = 0; number < num_trips_; ++number) {
        if (!trip(number).is_changed) continue;
        changed = true;
        touch(searcher_, trip(number).slot);
    }
    for (Int number = 0; number < num_trips_; ++number) {
        const Changing& each = trip(number);
        if (each.is_changed && !write(each, improved_ ? each.best : each.row)) return false;
    }
    return changed;
}

// Write a trip into its route. In place; false if that breaks a rule.
bool SmallMoves::write(const Changing& trip, const OperationRow& row) const {
    const Fleet& now = searcher_.now;
    keep_aside(now, trip.slot, now.route.size() - 2);
    return rewrite(data_, searcher_, trip.slot, trip.first, trip.last, [&](const Stop& first) {
        const Sequence sequence = sequence_in(now, trip.slot);
        for (Int place = 0; place < row.length() - 1; ++place) {
            const OperationStop& stop = row[place];
            const Int p = sequence.route.length;
            if (!add_stop(sequence, stop.node, place > 0 ? customer_stop : first.kind)) {
                return false;
            }
            if (stop.flown == nobody) continue;
            const Int end = row.end_behind(place);
            const Int to = waits(*trip.by, row, place, end) ? p : p + end - place;
            if (!add_sortie(sequence, p, to, 0, stop.flown)) return false;
        }
        return true;
    });
}

}  // namespace tandem
