#include "search/moves/best_part.h"

#include "randomness.h"
#include "search/moves/rewrite.h"

namespace tandem {
namespace {

constexpr unsigned never = ~0U;  // no stop at a launch site, whoever has been served

// Return a number that tells a part apart from others.
Int hash_of(const PartToPlan& part) {
    std::uint64_t hash = 14695981039346656037U;
    const auto add = [&](Int number) { hash = (hash ^ std::uint64_t(number)) * 1099511628211U; };
    for (const Int number : {part.type, part.from, part.to, part.customers}) add(number);
    std::for_each_n(part.customer.begin(), part.customers, add);
    std::for_each_n(part.halt.begin(), part.halts, add);
    return Int(hash);
}

}  // namespace

bool BestPart::attempt() {
    const Fleet& now = searcher_.now;
    const Int node = draw_customer(data_, now, searcher_.count->focus, searcher_.rng);
    const Int slot = now.where[node].slot;
    if (slot < 0 || data_.type[now.route[slot].type].drones != 1) return false;
    const TogetherPart part = draw(slot, stop_beside(now, node));
    if (part.customers < 1) return false;
    PartScratch& scratch = searcher_.scratch->part;
    scratch.part = read(slot, part);
    const Int planned = hash_of(scratch.part);
    if (planned == searcher_.count->planned) return false;
    searcher_.count->planned = planned;
    BestOperations best(data_, scratch);
    return best.find() && write(slot, part, best);
}

// Draw the stops between which a part is planned: some around stop `p`, as far as that goes.
BestPart::TogetherPart BestPart::draw(Int slot, Int p) const {
    const Fleet& now = searcher_.now;
    const Trip& trip = now.trip(slot, now.stop(slot, p).trip);
    const Int most = searcher_.scratch->part.customers;
    while (!is_joint(slot, p)) --p;
    TogetherPart part{p, p, 0};
    bool may_begin_before = true, may_end_later = true;
    while (may_begin_before || may_end_later) {
        const bool ahead = may_begin_before && (!may_end_later || uniform(searcher_.rng) < 0.5);
        TogetherPart wider = part;
        if (ahead) {
            if (wider.first > trip.first) do
                    --wider.first;
                while (!is_joint(slot, wider.first));
        } else {
            if (wider.last < trip.last) do
                    ++wider.last;
                while (!is_joint(slot, wider.last));
        }
        wider.customers = served_between(slot, wider.first, wider.last);
        const bool fits = wider.customers >= 0 && wider.customers <= most &&
                          wider.last - wider.first > part.last - part.first;
        if (fits) {
            part = wider;
        } else if (ahead) {
            may_begin_before = false;
        } else {
            may_end_later = false;
        }
    }
    return part;
}

// Tell whether no drone is in the air while the truck is at a stop.
bool BestPart::is_joint(Int slot, Int p) const {
    const Fleet& now = searcher_.now;
    const View<const Sortie, 1> sorties = sorties_of(now, slot);
    return std::ranges::none_of(
        sorties, [p](const Sortie& sortie) { return sortie.launch < p && p < sortie.recovery; });
}

// Return how many are served between two stops; -1 if several are on one flight.
Int BestPart::served_between(Int slot, Int first, Int last) const {
    const Fleet& now = searcher_.now;
    Int served = 0;
    for (Int p = first + 1; p < last; ++p) served += now.stop(slot, p).kind == customer_stop;
    for (const Sortie& sortie : sorties_of(now, slot)) {
        if (sortie.launch < first || sortie.launch >= last) continue;
        if (sortie.count > 1) return -1;
        ++served;
    }
    return served;
}

// Return whom a part serves, and where the truck may stop for its drone.
PartToPlan BestPart::read(Int slot, const TogetherPart& part) const {
    const Fleet& now = searcher_.now;
    PartToPlan read{};
    read.type = now.route[slot].type;
    read.from = now.stop(slot, part.first).node;
    read.to = now.stop(slot, part.last).node;
    const auto add = [&](Int node) { read.customer[std::size_t(read.customers++)] = node; };
    for (Int p = part.first + 1; p < part.last; ++p) {
        if (now.stop(slot, p).kind == customer_stop) add(now.stop(slot, p).node);
    }
    for (const Sortie& sortie : sorties_of(now, slot)) {
        if (sortie.launch >= part.first && sortie.launch < part.last) add(sortie.nodes[0]);
    }
    std::sort(read.customer.begin(), read.customer.begin() + read.customers);
    add_halts(slot, part, read);
    return read;
}

// List launch sites near the customers of a part. In place.
void BestPart::add_halts(Int slot, const TogetherPart& part, PartToPlan& read) const {
    const Int most = std::min(most_sites, searcher_.scratch->part.halts);
    for (Int rank = 0; rank < data_.near_halts.shape(1); ++rank) {
        for (Int number = 0; number < read.customers; ++number) {
            const Int halt = data_.near_halts(read.customer[std::size_t(number)], rank);
            const auto end = read.halt.begin() + read.halts;
            if (read.halts == most) return;
            if (halt < 0 || std::find(read.halt.begin(), end, halt) != end) continue;
            const unsigned need = needed(slot, part, read, halt);
            if (need == never) continue;
            read.halt[std::size_t(read.halts)] = halt;
            read.need[std::size_t(read.halts++)] = need;
        }
    }
}

// Return which customer of a part has to be served before a stop at a launch site, as a bit.
unsigned BestPart::needed(Int slot, const TogetherPart& part, const PartToPlan& read,
                          Int halt) const {
    if (!may_halt(data_.halts, read.type, halt)) return never;
    const Int after = data_.halt_after[halt];
    if (after < 0) return 0;
    for (Int number = 0; number < read.customers; ++number) {
        if (read.customer[std::size_t(number)] == after) {
            return 1U << unsigned(number);
        }
    }
    const Place& place = searcher_.now.where[after];
    if (place.slot != slot) return never;
    const Int by =
        place.position >= 0 ? place.position : searcher_.now.sortie(slot, place.sortie).recovery;
    return by <= part.first ? 0 : never;
}

// Write the operations in place of a part. In place; false if that breaks a rule.
bool BestPart::write(Int slot, const TogetherPart& part, const BestOperations& best) {
    const Fleet& now = searcher_.now;
    touch(searcher_, slot);
    keep_aside(now, slot, now.route.size() - 2);
    return rewrite(data_, searcher_, slot, part.first, part.last, [&](const Stop& first) {
        if (!add_stop(sequence_in(now, slot), first.node, first.kind)) return false;
        for (Int number = 0; number < best.count(); ++number) {
            if (!write_operation(slot, best, best.operation(number))) return false;
        }
        return true;
    });
}

// Write an operation behind the last stop of a route, but not the part's last stop. In place; false
// if there is no room.
bool BestPart::write_operation(Int slot, const BestOperations& best,
                               const PlannedOperation& operation) {
    const Sequence sequence = sequence_in(searcher_.now, slot);
    const Int& length = sequence.route.length;
    const Int p = length - 1;
    bool fits = true;
    best.on_the_way(operation, [&](Spot customer) {
        fits = fits && add_stop(sequence, best.node(customer), customer_stop);
    });
    const bool waits = operation.from == operation.to && length == p + 1;
    if (!waits && operation.to != best.last()) {
        fits = fits && add_stop(sequence, best.node(operation.to),
                                best.is_customer(operation.to) ? customer_stop : halt_stop);
    }
    if (!fits || operation.flown == no_spot) return fits;
    const Int to = operation.to == best.last() ? length : length - 1;
    return add_sortie(sequence, p, to, 0, best.node(operation.flown));
}

}  // namespace tandem
