#include "search/route/breaks.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "search/route/block.h"
#include "search/route/rest_placing.h"
#include "search/route/waits.h"

namespace tandem {
namespace {

constexpr std::size_t most_labels = most_breaks + 1;

// Breaks taken so far, and when the truck then is somewhere, `far` if never.
struct Label {
    Int time = far;
    Waited waited;
    std::array<Int, most_breaks> stop{};  // by which of those due it is, the stop before it
    std::array<RestPlace, most_breaks> place{};

    Label with(Int number, Int before, RestPlace where, Int then) const {
        Label next = *this;
        next.time = then;
        next.stop[static_cast<std::size_t>(number)] = before;
        next.place[static_cast<std::size_t>(number)] = where;
        return next;
    }
};

// Whoever is served too long behind another may not be by other breaks, or if the trip begins
// later.
void take_sooner(Label& label, const Label& other) {
    if (other.time == far) return;
    const bool kept = other.waited.excess <= label.waited.excess;
    if (label.time == far || other.waited.excess < label.waited.excess ||
        (kept && other.time < label.time)) {
        label = other;
    }
}

class Placing {
public:
    Placing(const ProblemData& data, const Route& route, View<Stop, 1> stops,
            View<Sortie, 1> sorties)
        : truck_(data, route.type),
          type_(truck_.type),
          stops_(stops.first(route.length)),
          sorties_(sorties.first(route.sorties)),
          due_(type_, begin_of(type_, stops)) {
        truck_.begin = begin_of(type_, stops);
    }

    bool run() {
        make_ready(truck_, stops_, sorties_);
        at(0).time = type_.shift_earliest;
        Int p = 0;
        while (true) {
            if (stops_[p].kind == start_stop) {
                launched_ = 0;
                first_of_trip_ = sortie_;
            }
            const Int last = last_of_block(p);
            pass_block(p, last);
            if (last + 1 == stops_.size()) return write();
            if (stops_[last].kind == end_stop) {
                for (Label& label : labels_) {
                    if (label.time < far) label.time += stops_[last].gap;
                }
            } else {
                drive(last);
            }
            p = last + 1;
        }
    }

private:
    Label& at(Int number) { return labels_[static_cast<std::size_t>(number)]; }

    // Return the last stop of the block that begins at stop `p`, and pass its sorties.
    Int last_of_block(Int p) {
        Int last = p;
        behind_ = sortie_;
        for (; behind_ < sorties_.size() && sorties_[behind_].launch <= last; ++behind_) {
            last = std::max(last, sorties_[behind_].recovery);
        }
        return last;
    }

    Break next_break(Int number) const { return break_of(type_, due_[number], truck_.begin); }

    // Whether a break after `number` others may be taken behind a stop with what is aboard there.
    bool may_be_behind(Int p, Int number) const { return !is_among(stops_[p].heavy, due_[number]); }

    // Give up who is too late for a break that is due.
    void drop_late() {
        for (Int number = 0; number < due_.count(); ++number) {
            if (at(number).time > next_break(number).latest) at(number).time = far;
        }
    }

    // Whether who takes a break before its window opens may as well do so later: drones may be
    // launched before, which makes nobody later.
    bool may_put_off() const { return !sorties_.empty() && !waits_.count(); }

    // Let the labels at the beginning of a block be those at its end.
    void pass_block(Int first, Int last) {
        drop_late();
        if (behind_ == sortie_) {
            for (Label& label : labels_) {
                if (label.time < far) leave_alone(first, label);
            }
            return;
        }
        std::array<Label, most_labels> left;
        for (Int number = 0; number <= due_.count(); ++number) {
            if (at(number).time < far) fly(first, last, number, left);
        }
        labels_ = left;
        launched_ += behind_ - sortie_;
        sortie_ = behind_;
    }

    // Let the truck leave a stop without launches; `far` if it can't.
    void leave_alone(Int p, Label& label) {
        Stop& stop = stops_[p];
        const Int time = label.time;
        truck_.time_alone(stop, time);
        label.time = time > stop.hi || time < stop.lo ? far : std::max(time + stop.d, stop.c);
        if (!waits_.count() || label.time == far) return;
        label.time = std::max(label.time, waits_.leave_alone(p, time, label.waited));
    }

    // Time a block with sorties, after `number` breaks, with none and then with more of them.
    void fly(Int first, Int last, Int number, std::array<Label, most_labels>& left) {
        for (Int q = first; q < last; ++q) stops_[q].rests = 0;
        const Label come = at(number);
        Label label = come;
        leave_block(first, last, label);
        take_sooner(left[static_cast<std::size_t>(number)], label);
        if (number == due_.count()) return;
        Int from = first_worth_it(first, last, number, label.time);
        for (; number < due_.count(); ++number) {
            Label best;
            for (Int q = from; q < last; ++q) {
                if (!may_be_behind(q, number)) continue;
                for (const RestPlace place : {RestPlace::arrival, other_place(number)}) {
                    const Int before = stops_[q].rests;
                    stops_[q].rests = Rests(before).with(due_[number], place).packed();
                    Label next = label.with(number, q, place, come.time);
                    next.waited = come.waited;
                    leave_block(first, last, next);
                    take_sooner(best, next);
                    stops_[q].rests = before;
                }
                if (stops_[q].leave > next_break(number).latest) break;
            }
            if (best.time == far) return;
            label = best;
            from = label.stop[static_cast<std::size_t>(number)];
            stops_[from].rests =
                Rests(stops_[from].rests)
                    .with(due_[number], label.place[static_cast<std::size_t>(number)])
                    .packed();
            take_sooner(left[static_cast<std::size_t>(number + 1)], label);
        }
    }

    // The first stop of a block, timed without a break and left at `end`, behind which it is worth
    // taking one: before its window opens it had better be put off. The last one if nowhere is.
    Int first_worth_it(Int first, Int last, Int number, Int end) const {
        if (!may_put_off()) return first;
        const Int opens = next_break(number).earliest;
        const bool goes_on = last + 1 < stops_.size() && stops_[last].kind != end_stop;
        if (end <= opens && goes_on && may_be_behind(last, number)) return last;
        const auto launches = [&](Int p) {
            return std::any_of(&sorties_[sortie_], &sorties_[sortie_] + (behind_ - sortie_),
                               [&](const Sortie& sortie) { return sortie.launch == p; });
        };
        while (first + 1 < last && stops_[first + 1].leave <= opens && end < far &&
               !launches(first + 1) && may_be_behind(first + 1, number)) {
            ++first;
        }
        return first;
    }

    // Let the truck leave a block with sorties; `far` if it can't.
    void leave_block(Int first, Int last, Label& label) {
        for (Int s = sortie_; s < behind_; ++s) sorties_[s].state = sortie_waits;
        const Int time = label.time;
        BlockSums sums;
        sums.time = time;
        sums.oldest = sortie_;
        sums.launched = launched_;
        sums.first_sortie = first_of_trip_;
        label.time = far;
        if (waits_.count()) waits_.recall(label.waited);
        if (time_block(truck_, stops_, sorties_, first, sums) < 0) return;
        const Stop& stop = stops_[first];
        if (time > stop.hi || time < stop.lo) return;
        label.time = std::max(time + stop.d, stop.c);
        if (waits_.count()) waits_.pass({first, last + 1}, {sortie_, behind_}, label.waited);
    }

    // Where a break is taken that isn't taken where the truck arrives.
    RestPlace other_place(Int number) const {
        return may_rest_on_way(type_, due_[number]) ? RestPlace::way : RestPlace::departure;
    }

    // Let the labels at stop `p` be those where the next is reached.
    void drive(Int p) {
        const Int setup = setup_after(truck_.data.setup, stops_[p].node, stops_[p + 1].node);
        const auto travel = truck_.legs_end(stops_[p], stops_[p + 1].node);
        for (Int number = 0; number < due_.count(); ++number) {
            if (!is_put_off(at(number), number, p, travel)) {
                rest(at(number), number, p, RestPlace::departure);
            }
        }
        std::array<Label, most_labels> there;
        for (Int number = 0; number <= due_.count(); ++number) {
            if (at(number).time < far) ride(at(number), number, p, travel, there);
        }
        labels_ = there;
        for (Int number = 0; number < due_.count(); ++number) {
            rest(at(number), number, p, RestPlace::arrival);
        }
        for (Label& label : labels_) {
            if (label.time < far) label.time += setup;
        }
    }

    // Tell whether a break is taken at the end of a leg, if not behind, by who is no later then;
    // and forget who took it before. In place.
    template <class Travel>
    bool is_put_off(const Label& label, Int number, Int p, const Travel& travel) {
        const Int opens = next_break(number).earliest;
        if (label.time > opens || !may_put_off() || !may_be_behind(p, number)) return false;
        at(number + 1).time = far;
        return travel(label.time) <= opens;
    }

    // Take a break where the truck is.
    void rest(const Label& label, Int number, Int p, RestPlace place) {
        const Break pause = next_break(number);
        if (label.time < far && pause.may_begin(label.time) && may_be_behind(p, number)) {
            take_sooner(at(number + 1), label.with(number, p, place, pause.end(label.time)));
        }
    }

    // Drive a leg, without breaks and with those that may be taken on the way.
    template <class Travel>
    void ride(const Label& left, Int number, Int p, const Travel& travel,
              std::array<Label, most_labels>& there) const {
        BrokenLeg leg(type_, truck_.begin, left.time, travel);
        Label label = left;
        while (true) {
            BrokenLeg rest_of_leg = leg;
            label.time = rest_of_leg.arrive();
            take_sooner(there[static_cast<std::size_t>(number)], label);
            if (number == due_.count() || !may_rest_on_way(type_, due_[number]) ||
                !may_be_behind(p, number) || !leg.rest(due_[number], RestPlace::way)) {
                return;
            }
            label = label.with(number, p, RestPlace::way, leg.time());
            ++number;
        }
    }

    static bool is_better(const Label& label, const Label& other) {
        return label.waited.excess < other.waited.excess ||
               (label.waited.excess == other.waited.excess && label.time < other.time);
    }

    // Write the breaks of the route that ends first, of those that lack none. False: all do.
    bool write() {
        const Label* best = nullptr;
        Int taken = 0;
        for (Int number = 0; number <= due_.count(); ++number) {
            const Label& label = at(number);
            if (label.time < far && (best == nullptr || is_better(label, *best)) &&
                (number == due_.count() ||
                 none_due(type_, due_[number], truck_.begin, label.time))) {
                best = &label;
                taken = number;
            }
        }
        if (best == nullptr) return false;
        clear_rests(type_, stops_);
        for (Int number = 0; number < taken; ++number) {
            const auto index = static_cast<std::size_t>(number);
            Stop& stop = stops_[best->stop[index]];
            stop.rests = Rests(stop.rests).with(due_[number], best->place[index]).packed();
        }
        return true;
    }

    Truck truck_;
    const VehicleType& type_;
    View<Stop, 1> stops_;
    View<Sortie, 1> sorties_;
    DueBreaks due_;
    std::array<Label, most_labels> labels_;
    Waits waits_{truck_, stops_, sorties_};
    Int sortie_ = 0;  // the first not passed, and the first behind the block
    Int behind_ = 0;
    Int launched_ = 0;  // on the trip
    Int first_of_trip_ = 0;
};

}  // namespace

bool lacks_break(const VehicleType& type, const Route& route, View<const Stop, 1> stops) {
    const Int begin = begin_of(type, stops);
    Int taken = 0;
    for (const Stop& stop : stops.first(route.length)) {
        const Rests rests(stop.rests);
        for (Int index = 0; index < rests.count(); ++index) taken |= Int{1} << rests.number(index);
    }
    for (Int number = 0; number < num_breaks(type); ++number) {
        if (!is_among(taken, number) && break_of(type, number, begin).latest < route.end &&
            !over_before(type, number, begin)) {
            return true;
        }
    }
    return false;
}

bool place_breaks(const ProblemData& data, const Route& route, View<Stop, 1> stops,
                  View<Sortie, 1> sorties) {
    return Placing(data, route, stops, sorties).run();
}

}  // namespace tandem
