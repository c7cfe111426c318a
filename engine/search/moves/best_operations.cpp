#include "search/moves/best_operations.h"

#include <bit>

namespace tandem {
namespace {

constexpr Spot start = 0;

}  // namespace

BestOperations::BestOperations(const ProblemData& data, PartScratch& scratch)
    : data_(data),
      part_(scratch.part),
      scratch_(scratch),
      rate_(data.rate[part_.type]),
      by_(data, part_.type),
      customers_(Spot(part_.customers)),
      spots_(Spot(part_.customers + part_.halts + 2)),
      sets_(Int{1} << part_.customers),
      all_(unsigned(sets_ - 1)) {
    const PartToPlan& part = part_;
    node_[start] = part.from;
    std::copy_n(part.customer.begin(), part.customers, node_.begin() + 1);
    std::copy_n(part.halt.begin(), part.halts, node_.begin() + 1 + part.customers);
    std::copy_n(part.need.begin(), part.halts, need_.begin() + 1 + part.customers);
    node_[std::size_t(spots_ - 1)] = part.to;
    for (Spot customer = 1; customer <= customers_; ++customer) {
        if (data.can(part.type, 0, node(customer))) driven_ |= bit(customer);
    }
}

bool BestOperations::find() {
    find_ways();
    find_flights();
    find_across();
    if (data_.deadline.passed()) return false;
    for (unsigned set = 0; set <= all_; ++set) {
        for (Spot spot = 0; spot < spots_; ++spot) reached(set, spot).cost = infinite_cost;
    }
    reached(0, start) = {0.0, 0, no_spot, no_spot};
    for (unsigned set = 0; set <= all_; ++set) {
        if (data_.deadline.passed()) return false;
        for (Spot from = 0; from < last(); ++from) halt_from(set, from);
        for (Spot from = 0; from < last(); ++from) go_on_from(set, from);
    }
    if (reached(all_, last()).cost == infinite_cost) return false;
    trace();
    return true;
}

// Find how the truck drives from each place to each other, by way of any customers.
void BestOperations::find_ways() {
    for (Spot from = 0; from < last(); ++from) {
        for (unsigned set = 0; set <= all_; ++set) {
            for (Spot to = 1; to < spots_; ++to) {
                if (set & (bit_of(from) | bit_of(to))) continue;
                way(from, set, to) = set == 0 ? beyond({}, from, to) : best_way(from, set, to);
            }
        }
    }
}

// Return a way that goes on from a place, whose service counts when the truck leaves it.
PartScratch::Via BestOperations::beyond(const PartScratch::Via& by, Spot place, Spot to) const {
    const Leg on = leg(by_.drive, node(place), node(to));
    const Int service = by_.by_truck[node(place)].service_duration();
    return {by.duration + service + on.duration, by.distance + on.distance, place};
}

PartScratch::Via BestOperations::best_way(Spot from, unsigned set, Spot to) const {
    PartScratch::Via best{};
    double least = infinite_cost;
    for (Spot before = 1; before <= customers_; ++before) {
        if (!(set & bit(before))) continue;
        const PartScratch::Via by = beyond(way(from, set & ~bit(before), before), before, to);
        const double cost = way_cost(by);
        if (cost < least) {
            least = cost;
            best = by;
        }
    }
    return best;
}

// Return what a way costs, but for stops.
double BestOperations::way_cost(const PartScratch::Via& by) const {
    return usual_work_cost(rate_, by.duration) + drive_cost(rate_, by.distance);
}

// Find how long flights take from each place to each other.
void BestOperations::find_flights() {
    for (Spot from = 0; from < last(); ++from) {
        for (Spot customer = 1; customer <= customers_; ++customer) {
            for (Spot to = 1; to < spots_; ++to) {
                flight(from, customer, to) =
                    way_by_air(by_, node(from), node(customer), node(to)).flight.duration();
            }
        }
    }
}

// Find whom the drone serves at best while the truck goes from each place to each other.
void BestOperations::find_across() {
    const bool crosses = data_.strategy.crossings && !waits_for_drones(data_.type[part_.type]);
    for (Spot from = 0; from < last(); ++from) {
        if (data_.deadline.passed()) return;
        for (unsigned set = 0; set <= all_; ++set) {
            for (Spot to = 1; to < spots_; ++to) {
                const bool may_be =
                    crosses && launches(from) && launches(to) && !(set & bit_of(from));
                scratch_.across[at(from, set, to)] =
                    may_be ? best_across(from, set, to)
                           : PartScratch::Across{infinite_cost, no_spot};
            }
        }
    }
}

// Return the cheapest operation from one place to another by which all of a set are served.
PartScratch::Across BestOperations::best_across(Spot from, unsigned set, Spot to) const {
    PartScratch::Across best{infinite_cost, no_spot};
    const unsigned others = set & ~bit_of(to);
    const Int stay = stay_beside_launch(*by_.type, by_.by_truck[node(from)].service_duration());
    if (is_customer(to) && (!(set & bit(to)) || !drives(to))) return best;
    for (Spot flown = 1; flown <= customers_; ++flown) {
        const unsigned inner = others & ~bit(flown);
        // Who is flown to is not back before the truck stops there again.
        if (!(others & bit(flown)) || !flies(flown) || (need(to) & bit(flown))) continue;
        if ((inner & ~driven_) || (from == to && inner == 0)) continue;
        const PartScratch::Via& by = way(from, inner, to);
        const Int working = std::max(flight(from, flown, to), by.duration + stay);
        // It costs this much at least.
        if (usual_work_cost(rate_, working) + drive_cost(rate_, by.distance) >= best.cost) continue;
        const Drive drive{by.duration, by.distance, std::popcount(inner)};
        const double cost =
            cost_across(by_, node(from), node(flown), node(to), drive) + stop_cost(to);
        if (cost < best.cost) best = {cost, flown};
    }
    return best;
}

// Return what it costs that the truck stops at a place.
double BestOperations::stop_cost(Spot spot) const {
    if (spot == last()) return 0.0;
    return is_customer(spot) ? rate_.stop : data_.halt_cost[node(spot)];
}

// Note how a place is reached, if that costs least so far. In place.
void BestOperations::reach(unsigned set, Spot spot, const PartScratch::Reached& how) {
    PartScratch::Reached& best = reached(set, spot);
    if (how.cost < best.cost) best = how;
}

// Tell whether truck and drone may come to a place together, some having been served by then.
bool BestOperations::may_come(unsigned set, Spot spot) const {
    return spot == last() ? set == all_ : !(need(spot) & ~set);
}

// Return what it costs to drive on together from a place to another.
double BestOperations::drive_on(Spot from, Spot to) const {
    return way_cost(way(from, 0, to)) + stop_cost(to);
}

// Drive on from a place to launch sites, or the last stop. In place.
void BestOperations::halt_from(unsigned set, Spot from) {
    const double before = reached(set, from).cost;
    if (before == infinite_cost) return;
    for (Spot to = Spot(customers_ + 1); to < spots_; ++to) {
        if (to == from || !may_come(set, to)) continue;
        reach(set, to, {before + drive_on(from, to), set, from, no_spot});
    }
}

// Go on from a place by all operations that serve anybody. In place.
void BestOperations::go_on_from(unsigned set, Spot from) {
    const double before = reached(set, from).cost;
    if (before == infinite_cost) return;
    const unsigned rest = all_ & ~set;
    for (Spot customer = 1; customer <= customers_; ++customer) {
        if (!(rest & bit(customer))) continue;
        const unsigned then = set | bit(customer);
        if (drives(customer)) {
            reach(then, customer, {before + drive_on(from, customer), set, from, no_spot});
        }
        if (flies(customer)) {
            const double loop = loop_cost(by_, node(from), node(customer));
            reach(then, from, {before + loop, set, from, customer});
        }
    }
    for (unsigned more = rest; more != 0; more = (more - 1) & rest) {
        const PartScratch::Across* across = &scratch_.across[at(from, more, 0)];
        for (Spot to = 1; to < spots_; ++to) {
            if (across[to].cost == infinite_cost || !may_come(set | more, to)) continue;
            reach(set | more, to, {before + across[to].cost, set, from, across[to].flown});
        }
    }
}

// Write down the operations in order.
void BestOperations::trace() {
    count_ = 0;
    unsigned set = all_;
    for (Spot to = last(); set != 0 || to != start;) {
        const PartScratch::Reached& how = reached(set, to);
        scratch_.planned.at(count_++) = {how.from, to, how.flown, set & ~how.before};
        set = how.before;
        to = how.from;
    }
    const View<PlannedOperation, 1> planned = scratch_.planned.view().first(count_);
    std::ranges::reverse(planned);
}

}  // namespace tandem
