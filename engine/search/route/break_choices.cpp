#include "search/route/break_choices.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "rules/driving.h"
#include "rules/hub.h"
#include "rules/lag.h"
#include "rules/load.h"
#include "rules/pair.h"
#include "rules/shift.h"
#include "rules/start.h"
#include "search/route/block.h"
#include "search/route/breaks.h"
#include "search/route/lags.h"
#include "search/route/rarer.h"

namespace tandem {
namespace {

// Ways to a stop that are followed at most.
constexpr std::size_t most_ways = 48;

// A break that is taken.
struct Taken {
    PlacedBreaks::One one;
    std::int32_t before;
};

// A break that may be taken, or is over before the route begins.
struct Chosen {
    Int number;
    bool is_over;
};

// When service began at a stop to which others look back.
struct Noted {
    TimeSegment start;
    Int stop;
    std::int32_t before;
};

// Who looks back to a stop.
struct Asked {
    Int until = -1;           // the last stop that does
    bool is_awaited = false;  // any does that is served some time later at the soonest
    bool is_ahead = false;    // any does to this one, or one farther on
};

// A way to have come somewhere.
struct Way {
    TimeSegment now;            // when the truck is there, by when the route begins
    Interval begins;            // for which that holds
    std::int32_t next = 0;      // the first break, of those due, that may still be taken
    std::int32_t left_out = 0;  // bits of those before that aren't
    std::int32_t last = -1;     // break taken
    std::int32_t noted = -1;    // the last one, likewise
};

// A way on a leg: when the truck stands where it last had a break, and when it is at its end.
struct OnLeg {
    Way way;
    TimeSegment here, there;
    RestPlace place;
};

class Choosing {
public:
    Choosing(const ProblemData& data, const Route& route, View<const Stop, 1> stops)
        : truck_(data, route.type),
          data_(data),
          type_(truck_.type),
          stops_(stops.first(route.length)),
          begins_count_(data.evaluation[route.type].timed || any_follows_departure(type_)),
          soonest_(static_cast<std::size_t>(stops_.size()), far) {
        if (lags_count(data) || !data.max_between.empty() || time_aboard_counts(data)) {
            note_what_is_asked();
        }
    }

    // When each stop may be left at the soonest.
    const std::vector<Int>& soonest() const { return soonest_; }

    const std::vector<BreakChoice>& run() {
        const Int soonest = begin_of(type_, stops_);
        for (Int begin = soonest; may_end(type_, begin);) {
            const Int next = later_begin(type_, begin);
            follow({begin, std::min(next, far) - 1});
            // Where it doesn't matter when it begins, sooner will do.
            if (next == far || (!begins_count_ && !choices_.empty())) break;
            begin = next;
        }
        return choices_;
    }

private:
    // Write what is asked of stops behind them.
    void note_what_is_asked() {
        asked_.resize(static_cast<std::size_t>(stops_.size()));
        for (Int p = 0; p < stops_.size(); ++p) {
            Asked& asked = asked_[static_cast<std::size_t>(p)];
            if (stops_[p].kind == start_stop && time_aboard_counts(data_) && p > 0) {
                asked.until = p;
                while (stops_[asked.until].kind != end_stop) ++asked.until;
            }
            for_each_before(p, [&](Int q, Interval within, bool) {
                Asked& before = asked_[static_cast<std::size_t>(q)];
                before.until = p;
                before.is_awaited = before.is_awaited || within.first > 0;
            });
        }
        bool is_ahead = false;
        for (auto asked = asked_.rbegin(); asked != asked_.rend(); ++asked) {
            is_ahead = is_ahead || asked->until >= 0;
            asked->is_ahead = is_ahead;
        }
    }

    // Call `visit` with each stop that a customer's looks back to, how long after it service is to
    // begin, and whether its end counts, not its beginning.
    template <class Visit>
    void for_each_before(Int p, const Visit& visit) const {
        if (stops_[p].kind != customer_stop) return;
        const Int node = stops_[p].node;
        const bool is_brought = !data_.max_between.empty() && is_delivery(data_.pair, node);
        const View<const Lag, 1> lags = lags_of(data_.lag, node);
        for (Int q = 0; q < p; ++q) {
            if (stops_[q].kind != customer_stop) continue;
            for (const Lag& lag : lags) {
                if (lag.node == stops_[q].node) visit(q, Interval{lag.least, lag.most}, false);
            }
            if (is_brought && brings(data_.pair, stops_[q].node, node)) {
                visit(q, Interval{none, data_.max_between(truck_.k, stops_[q].node)}, true);
            }
        }
    }

    // Follow all ways to the end that begin in an interval, in which the same breaks are due.
    void follow(Interval begins) {
        // One that is over before may be taken all the same, which saves pay.
        breaks_.clear();
        for (Int number = 0; number < num_breaks(type_); ++number) {
            const bool is_over = over_before(type_, number, begins.first);
            if (!is_over || !is_paid(type_, number)) breaks_.push_back({number, is_over});
        }
        taken_.clear();
        noted_.clear();
        there_.clear();
        Way first;
        first.now = {0, none};
        first.begins = begins;
        there_.push_back(first);
        for (Int p = 0; p < stops_.size() && !there_.empty(); ++p) {
            here_.swap(there_);
            there_.clear();
            for (Way& way : here_) serve(p, way);
        }
    }

    const Chosen& break_at(Int index) const { return breaks_[static_cast<std::size_t>(index)]; }

    // Have a way go on from stop `p`, which it has reached, by each of the windows there. In place.
    void serve(Int p, Way& way) {
        if (!has_window(stops_[p])) {
            if (pass_depot(p, way)) leave(p, way);
            return;
        }
        const Int node = stops_[p].node;
        const Windows place = truck_.places[node], own = truck_.own[node];
        if (!asked_.empty()) {
            for_each_before(p, [&](Int q, Interval within, bool) {
                if (within.first > none)
                    way.now = later(way.now, behind(noted_at(way, q), within.first));
            });
        }
        if (own.too_late(way.now.c)) return;
        for (Int begin = way.begins.first; begin <= way.begins.last;) {
            Way served = way;
            served.begins.first = begin;
            if (!narrow(served.begins, own.allowed_within(begin, way.now))) return;
            begin = served.begins.last + 1;
            served.now = place.start_within(served.begins.first, way.now);
            if (!keeps_limits(p, served)) continue;
            note(p, served);
            served.now = behind(served.now, place.service_duration());
            leave(p, served);
        }
    }

    // Have a way begin or end a trip. In place; false if it can't.
    bool pass_depot(Int p, Way& way) {
        const Stop& stop = stops_[p];
        if (stop.kind == start_stop) {
            const Int ready = leaves_first(type_, p > 0 ? stop.release : none);
            way.now.c = std::max(way.now.c, ready);
            note(p, way);
            return be_by(way, leaves_by(type_, truck_.places, stop.node));
        }
        way.now.c = let_in(type_, truck_.places, stop.node, way.now.c);
        return be_by(way, std::min(last_end(type_), closes_at(type_, truck_.places, stop.node)));
    }

    // Narrow when a route begins to what lets it be there by then. In place.
    static bool be_by(Way& way, Int latest) {
        return way.now.c <= latest && narrow(way.begins, {none, latest - way.now.d});
    }

    // Narrow when a route begins to what lets service begin soon enough behind others, who are of
    // its first trip: later ones may be held. In place; false if nothing does.
    bool keeps_limits(Int p, Way& way) const {
        if (asked_.empty() || stops_[p].kind != customer_stop) return true;
        bool kept = true;
        if (time_aboard_counts(data_) && stops_[p].trip == 0) {
            const TimeSegment departure{0, leaves_first(type_, none)};
            kept = narrow(way.begins, lasting_within(data_.max_time_aboard[stops_[p].node],
                                                     departure, way.now));
        }
        for_each_before(p, [&](Int q, Interval within, bool is_by_end) {
            if (!kept || stops_[q].trip > 0) return;
            TimeSegment since = noted_at(way, q);
            if (is_by_end) {
                since = behind(since, truck_.places[stops_[q].node].service_duration());
            }
            kept = narrow(way.begins, lasting_within(within.last, since, way.now));
        });
        return kept;
    }

    // Note when service or a trip begins at a stop, if others look back to that. In place.
    void note(Int p, Way& way) {
        if (asked_.empty()) return;
        const Asked& asked = asked_[static_cast<std::size_t>(p)];
        if (asked.until < 0) return;
        noted_.push_back({way.now, p, way.noted});
        way.noted = static_cast<std::int32_t>(noted_.size()) - 1;
    }

    TimeSegment noted_at(const Way& way, Int stop) const {
        std::int32_t number = way.noted;
        while (noted_[static_cast<std::size_t>(number)].stop != stop) {
            number = noted_[static_cast<std::size_t>(number)].before;
        }
        return noted_[static_cast<std::size_t>(number)].start;
    }

    void leave(Int p, const Way& way) {
        Int& soonest = soonest_[static_cast<std::size_t>(p)];
        soonest = std::min(soonest, way.now.at(way.begins.first));
        if (p + 1 == stops_.size()) return end(way);
        if (stops_[p].kind == end_stop) {
            Way next = way;
            next.now = behind(next.now, stops_[p].gap);
            return keep(p + 1, next);
        }
        const Int duration = truck_.duration_of_leg(stops_[p], stops_[p + 1].node);
        drive(p, {way, way.now, behind(way.now, duration), RestPlace::departure});
    }

    // Have a way drive the leg behind stop `p`, with no more breaks and with each more.
    void drive(Int p, const OnLeg& leg) {
        Way come = leg.way;
        come.now = behind(leg.there, setup_after(data_.setup, stops_[p].node, stops_[p + 1].node));
        if (may_wait_for_next(come, leg.there)) keep(p + 1, come);
        OnLeg rested = leg;
        for (Int index = leg.way.next; index < static_cast<Int>(breaks_.size()); ++index) {
            rested.way.next = static_cast<std::int32_t>(index) + 1;
            if (!is_among(stops_[p].heavy, break_at(index).number) &&
                !is_put_off(p, leg, break_at(index).number))
                rest(p, rested, index);
            // Those behind may be taken without it if the route may end before.
            if (!may_be_left_out(index, rested.way.begins, leg.there)) return;
            rested.way.left_out |= 1 << index;
        }
    }

    // Narrow when a route begins to what lets it end at an instant without a break. In place; false
    // if nothing does.
    bool may_be_left_out(Int index, Interval& begins, TimeSegment end) const {
        const Chosen& chosen = break_at(index);
        return chosen.is_over || JoinedBreak(type_, chosen.number).lets(begins, end);
    }

    // Narrow when a route begins to what lets the next break begin at the end of a leg, or later,
    // or be left out as the route ends before. In place; false if nothing does.
    bool may_wait_for_next(Way& way, TimeSegment there) const {
        return way.next == static_cast<Int>(breaks_.size()) ||
               may_be_left_out(way.next, way.begins, there);
    }

    // Tell whether a break had better be taken behind the next stop: it opens no sooner than that
    // is left. Where it matters when the route begins, that isn't known.
    bool is_put_off(Int p, const OnLeg& leg, Int number) const {
        const Stop& next = stops_[p + 1];
        if (begins_count_ || !asked_.empty() || next.kind != customer_stop ||
            is_among(next.heavy, number)) {
            return false;
        }
        const Int reached = leg.there.at(leg.way.begins.first) +
                            setup_after(data_.setup, stops_[p].node, next.node);
        return truck_.places[next.node].end_of_service(reached) <=
               break_of(type_, number, 0).earliest;
    }

    // Take a break at each place of a leg behind those before, and go on.
    void rest(Int p, const OnLeg& leg, Int index) {
        const Int number = break_at(index).number;
        const bool on_way = may_rest_on_way(type_, number);
        if (leg.place == RestPlace::departure) rest(p, leg, number, RestPlace::departure);
        if (leg.place != RestPlace::arrival && on_way) rest(p, leg, number, RestPlace::way);
        // On its way it may be taken then as well.
        if (leg.place == RestPlace::arrival || !on_way) rest(p, leg, number, RestPlace::arrival);
    }

    void rest(Int p, OnLeg leg, Int number, RestPlace place) {
        const JoinedBreak pause(type_, number);
        const bool is_there = place == RestPlace::arrival;
        if (!pause.lets(leg.way.begins, is_there ? leg.there : leg.here)) return;
        const Int driven = leg.there.d - leg.here.d;
        leg.here = pause.end(is_there ? leg.there : leg.here);
        leg.there = place == RestPlace::departure ? behind(leg.here, driven) : pause.end(leg.there);
        leg.place = place;
        taken_.push_back({{number, p, place}, leg.way.last});
        leg.way.last = static_cast<std::int32_t>(taken_.size()) - 1;
        drive(p, leg);
    }

    // Tell whether one way to a stop is no worse than another, whatever comes.
    bool is_no_worse(Int p, const Way& one, const Way& other) const {
        if (one.next != other.next || one.left_out != other.left_out) return false;
        if (asked_.empty() && !begins_count_) {
            return one.now.at(one.begins.first) <= other.now.at(other.begins.first);
        }
        if (!is_no_later(one.now, other.now) || one.begins.first > other.begins.first ||
            one.begins.last < other.begins.last) {
            return false;
        }
        if (!asked_.empty() && asked_[static_cast<std::size_t>(p)].is_ahead &&
            !is_no_later(other.now, one.now)) {
            return false;
        }
        std::int32_t mine = one.noted, others = other.noted;
        while (mine != others) {
            const Noted& noted = noted_[static_cast<std::size_t>(mine)];
            const Noted& instead = noted_[static_cast<std::size_t>(others)];
            const Asked& asked = asked_[static_cast<std::size_t>(noted.stop)];
            if (asked.until >= p &&
                (!is_no_later(instead.start, noted.start) ||
                 (asked.is_awaited && !is_no_later(noted.start, instead.start)))) {
                return false;
            }
            mine = noted.before;
            others = instead.before;
        }
        return true;
    }

    // Keep a way to a stop unless another is no worse; where there are too many, that goes which is
    // last.
    void keep(Int p, const Way& way) {
        for (const Way& other : there_) {
            if (is_no_worse(p, other, way)) return;
        }
        std::erase_if(there_, [&](const Way& other) { return is_no_worse(p, way, other); });
        if (there_.size() < most_ways) {
            there_.push_back(way);
            return;
        }
        const auto when = [](const Way& one) { return one.now.at(one.begins.first); };
        Way& last = *std::max_element(
            there_.begin(), there_.end(),
            [&](const Way& one, const Way& other) { return when(one) < when(other); });
        if (when(way) < when(last)) last = way;
    }

    // Note a way that has come to the end, unless a break is due that it lacks.
    void end(Way way) {
        for (Int index = 0; index < static_cast<Int>(breaks_.size()); ++index) {
            if (index < way.next && !is_among(way.left_out, index)) continue;
            if (!may_be_left_out(index, way.begins, way.now)) return;
        }
        BreakChoice choice{PlacedBreaks(), way.now.at(way.begins.first), 0};
        Int unpaid = 0;
        for (std::int32_t number = way.last; number >= 0;) {
            const Taken& taken = taken_[static_cast<std::size_t>(number)];
            choice.placed = choice.placed.with_more(0, taken.one);
            if (!is_paid(type_, taken.one.number)) unpaid += length_of(type_, taken.one.number);
            number = taken.before;
        }
        // It may as well wait at the depot.
        const Int begin = std::min(way.begins.last, way.now.c - way.now.d);
        choice.placed = choice.placed.from(std::max(way.begins.first, begin));
        const Int since = has_begun(type_) ? choice.end - type_.shift_earliest
                                           : std::max(way.now.d, way.now.c - way.begins.last);
        choice.working = since - unpaid;
        if (may_work(type_, choice.working)) choices_.push_back(choice);
    }

    Truck truck_;
    const ProblemData& data_;
    const VehicleType& type_;
    View<const Stop, 1> stops_;
    const bool begins_count_;   // whether it matters when the route may begin
    std::vector<Int> soonest_;  // (stop,)
    std::vector<Chosen> breaks_;
    std::vector<Asked> asked_;  // (stop,) nothing where nothing is
    std::vector<Way> here_, there_;
    std::vector<Taken> taken_;
    std::vector<Noted> noted_;
    std::vector<BreakChoice> choices_;
};

}  // namespace

bool has_breaks_alone(const ProblemData& data, Int k) {
    const VehicleType& type = data.type[k];
    return has_breaks(type) && !has_driving_rules(type) && !orders_cross(data) &&
           !shares_chargers(type);
}

bool joins_breaks(const ProblemData& data, const Route& route, View<const Stop, 1> stops) {
    return has_breaks_alone(data, route.type) && is_steady(data.type[route.type]) &&
           route.sorties == 0 &&
           std::none_of(&stops[0], &stops[0] + route.length, [&](const Stop& stop) {
               return stop.kind == customer_stop && times_cost(data.price[stop.node]);
           });
}

std::vector<BreakChoice> break_choices(const ProblemData& data, const Route& route,
                                       View<const Stop, 1> stops) {
    return Choosing(data, route, stops).run();
}

void note_soonest(const ProblemData& data, const Route& route, View<Stop, 1> stops) {
    Choosing choosing(data, route, stops);
    choosing.run();
    for (Int p = 0; p < route.length; ++p) {
        stops[p].leave = choosing.soonest()[static_cast<std::size_t>(p)];
    }
}

}  // namespace tandem
