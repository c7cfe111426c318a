#include <utility>

#include "search/route/block.h"
#include "search/route/breaks.h"
#include "search/route/look_backs.h"
#include "search/route/pricing.h"
#include "search/route/routes.h"

namespace tandem {
namespace {

// Ways to a stop that are followed at most: more take longer than they save, where customers cost
// by when they are served.
constexpr std::size_t most_lean_ways = 48, most_ways = 8;

// So many are mostly enough.
constexpr std::size_t few = 8;

// Instants at which a route may begin that are tried at most where speeds change.
constexpr Int most_begins = 16;

// Lean where all lasts as long at any time, and customers cost the same.
template <bool is_lean>
class Choosing {
    using Way = tandem::Way<is_lean>;
    using OnLeg = tandem::OnLeg<is_lean>;

public:
    Choosing(const ProblemData& data, const Route& route, View<const Stop, 1> stops,
             double most_late, bool is_priced)
        : truck_(data, route.type),
          data_(data),
          type_(truck_.type),
          stops_(stops.first(route.length)),
          most_late_(most_late),
          is_priced_(is_priced),
          begins_count_(is_priced &&
                        (any_follows_departure(type_) || data.evaluation[route.type].timed)),
          begins_differ_(begins_count_),
          soonest_(std::size_t(stops_.size()), far),
          waiting_(is_joined() ? std::max(Int{0}, route.end - route.cum - begin_of(type_, stops))
                               : 0) {
        for (Int p = 0; !is_lean && is_priced_ && p < stops_.size(); ++p) {
            if (stops_[p].kind != customer_stop) continue;
            const Price& price = data.price[stops_[p].node];
            times_cost_ = times_cost_ || times_cost(price);
            begins_differ_ = begins_differ_ || price.waiting > 0.0;
        }
        for (std::vector<Way>* ways : {&here_, &there_}) ways->reserve(few);
    }

    // When each stop may be left at the soonest.
    const std::vector<Int>& soonest() const { return soonest_; }

    const std::vector<BreakChoice>& run() {
        Int begin = begin_of(type_, stops_);
        for (Int tried = 0; may_end(type_, begin) && (is_joined() || tried < most_begins);
             ++tried) {
            const Int next = next_begin(data_, truck_.k, begin);
            follow({begin, is_joined() ? next - 1 : begin});
            // Where it doesn't matter when it begins, sooner will do.
            if (next == far || (!begins_differ_ && !choices_.empty())) break;
            if (!is_joined() && data_.deadline.passed()) break;
            begin = next;
        }
        return choices_;
    }

private:
    // Follow all ways to the end that begin in an interval, in which the same breaks are due.
    void follow(Interval begins) {
        // One that is over before may be taken all the same, which saves pay.
        breaks_.clear();
        for (Int number = 0; number < num_breaks(type_); ++number) {
            const bool is_over = over_before(type_, number, begins.first);
            if (!is_over || !is_paid(type_, number)) breaks_.push_back({number, is_over});
        }
        taken_.clear();
        asked_.forget();
        timed_.clear();
        Int then = begins.first;
        for (Int& compared : compared_) {
            compared = std::min(then, begins.last);
            then += waiting_ / 2;
        }
        there_.clear();
        Way first;
        first.now = is_joined() ? TimeSegment{0, none} : TimeSegment{none, begins.first};
        first.begins = begins;
        there_.push_back(first);
        for (Int p = 0; p < stops_.size() && !there_.empty(); ++p) {
            here_.swap(there_);
            there_.clear();
            for (Way& way : here_) serve(p, way);
        }
    }

    // Tell whether all lasts as long at any time.
    bool is_joined() const { return is_lean || is_steady(type_); }

    const Chosen& break_at(Int index) const { return breaks_[std::size_t(index)]; }

    // Have a way go on from stop `p`, which it has reached, by each of the windows there. In place.
    void serve(Int p, Way& way) {
        if (!has_window(stops_[p])) {
            if (pass_depot(p, way)) leave(p, way);
            return;
        }
        const Int node = stops_[p].node;
        const Windows place = truck_.places[node], own = truck_.own[node];
        const TimeSegment reached = way.now;
        way.now = asked_.ready(p, way.now, way.noted);
        if (own.too_late(way.now.c)) return;
        for (Int begin = way.begins.first; begin <= way.begins.last;) {
            Way served = way;
            served.begins.first = begin;
            if (!narrow(served.begins, own.allowed_within(begin, way.now))) return;
            begin = served.begins.last + 1;
            served.now = place.start_within(served.begins.first, way.now);
            // Where speeds change, trips are held back by more than is known here.
            if (is_joined() && !asked_.keeps_limits(p, served.now, served.noted, served.begins)) {
                continue;
            }
            if (!is_cheap(p, reached, served)) continue;
            asked_.note(p, served.now, served.noted);
            served.now = behind(served.now, place.service_duration());
            leave(p, served);
        }
    }

    // Note what it costs when a customer is served who is reached so. In place; false if too much.
    bool is_cheap(Int p, TimeSegment reached, Way& way) {
        if constexpr (is_lean)
            return true;
        else
            return is_cheap_when(p, reached, way);
    }

    bool is_cheap_when(Int p, TimeSegment reached, Way& way) {
        const Int node = stops_[p].node, begin = way.begins.first;
        if (!times_cost_ || stops_[p].kind != customer_stop || !times_cost(data_.price[node])) {
            return true;
        }
        timed_.push_back({reached, way.now, node, way.timed});
        way.timed = std::int32_t(timed_.size()) - 1;
        way.late += lateness_cost(data_, node, way.now.at(begin));
        for (std::size_t index = 0; index < most_compared; ++index) {
            const Int then = compared_[index];
            way.missed[index] += lateness_cost(data_, node, way.now.at(then)) +
                                 waiting_cost(data_, node, reached.at(then));
        }
        return way.late < most_late_;
    }

    // Have a way begin or end a trip. In place; false if it can't.
    bool pass_depot(Int p, Way& way) {
        const Stop& stop = stops_[p];
        if (stop.kind == start_stop) {
            const Int ready = leaves_first(type_, p > 0 ? stop.release : none);
            way.now.c = std::max(way.now.c, ready);
            asked_.note(p, way.now, way.noted);
            return be_by(way, leaves_by(type_, truck_.places, stop.node));
        }
        way.now.c = let_in(type_, truck_.places, stop.node, way.now.c);
        return be_by(way, std::min(last_end(type_), closes_at(type_, truck_.places, stop.node)));
    }

    // Narrow when a route begins to what lets it be there by then. In place.
    static bool be_by(Way& way, Int latest) {
        return way.now.c <= latest && narrow(way.begins, {none, latest - way.now.d});
    }

    void leave(Int p, const Way& way) {
        Int& soonest = soonest_[std::size_t(p)];
        soonest = std::min(soonest, way.now.at(way.begins.first));
        if (p + 1 == stops_.size()) return end(way);
        if (stops_[p].kind == end_stop) {
            Way next = way;
            next.now = behind(next.now, stops_[p].gap);
            return keep(p + 1, next);
        }
        drive(p, {way, way.now, travel(p, way.now), RestPlace::departure});
    }

    // When the leg behind stop `p` ends.
    TimeSegment travel(Int p, TimeSegment leave) const {
        const Int to = stops_[p + 1].node;
        if (is_joined()) return behind(leave, truck_.duration_of_leg(stops_[p], to));
        return {none, LegLeft(truck_.speeds, truck_.duration_of_leg(stops_[p], to)).end(leave.c)};
    }

    // Have a way drive the leg behind stop `p`, with no more breaks and with each more.
    void drive(Int p, const OnLeg& leg) {
        Way come = leg.way;
        come.now = behind(leg.there, setup_after(data_.setup, stops_[p].node, stops_[p + 1].node));
        if (may_wait_for_next(come, leg.there)) keep(p + 1, come);
        if (leg.way.next == Int(breaks_.size())) return;
        OnLeg rested = leg;
        for (Int index = leg.way.next; index < Int(breaks_.size()); ++index) {
            rested.way.next = std::int32_t(index) + 1;
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
        return way.next == Int(breaks_.size()) || may_be_left_out(way.next, way.begins, there);
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
        return truck_.served_at(next, reached) <= break_of(type_, number, 0).earliest;
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
        const Int begin = leg.way.begins.first;
        const auto end = [&](TimeSegment time) {
            const TimeSegment over = pause.end(time);
            return is_joined() ? over : TimeSegment{none, over.at(begin)};
        };
        const Int driven = leg.there.d - leg.here.d;
        leg.here = end(is_there ? leg.there : leg.here);
        leg.there = place != RestPlace::departure ? end(leg.there)
                    : is_joined()                 ? behind(leg.here, driven)
                                                  : travel(p, leg.here);
        leg.place = place;
        taken_.push_back({{number, p, place}, leg.way.last});
        leg.way.last = std::int32_t(taken_.size()) - 1;
        drive(p, leg);
    }

    // Tell whether one way to a stop is no worse than another, whatever comes.
    bool is_no_worse(Int p, const Way& one, const Way& other) const {
        if (one.next != other.next || one.left_out != other.left_out) return false;
        if constexpr (!is_lean) {
            for (std::size_t index = 0; times_cost_ && index < most_compared; ++index) {
                if (one.missed[index] > other.missed[index]) return false;
            }
        }
        if (asked_.empty() && !begins_count_) {
            return one.now.at(one.begins.first) <= other.now.at(other.begins.first);
        }
        if (!is_no_later(one.now, other.now) || one.begins.first > other.begins.first ||
            one.begins.last < other.begins.last) {
            return false;
        }
        return asked_.is_no_worse(p, {one.now, one.noted}, {other.now, other.noted});
    }

    // Keep a way to a stop unless another is no worse; where there are too many, that goes which is
    // last.
    void keep(Int p, const Way& way) {
        for (const Way& other : there_) {
            if (is_no_worse(p, other, way)) return;
        }
        std::erase_if(there_, [&](const Way& other) { return is_no_worse(p, way, other); });
        if (there_.size() < (is_lean ? most_lean_ways : most_ways)) {
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
        for (Int index = 0; index < Int(breaks_.size()); ++index) {
            if (index < way.next && !is_among(way.left_out, index)) continue;
            if (!may_be_left_out(index, way.begins, way.now)) return;
        }
        PlacedBreaks placed;
        Int unpaid = 0;
        for (std::int32_t number = way.last; number >= 0;) {
            const Taken& taken = taken_[std::size_t(number)];
            placed = placed.with_more(0, taken.one);
            if (!is_paid(type_, taken.one.number)) unpaid += length_of(type_, taken.one.number);
            number = taken.before;
        }
        std::int32_t timed = -1;
        if constexpr (!is_lean) timed = way.timed;
        const std::optional<Begun>& timing =
            best_begin_.of({way.begins, way.now, unpaid, timed}, timed_);
        if (timing) choices_.push_back({placed.from(timing->begin), *timing});
    }

    Truck truck_;
    const ProblemData& data_;
    const VehicleType& type_;
    View<const Stop, 1> stops_;
    LookBacks asked_{data_, truck_.k, stops_};
    const double most_late_;
    const bool is_priced_;      // it matters what it costs, not only when it is over
    bool times_cost_ = false;   // customers cost by when they are served
    const bool begins_count_;   // how a way goes on hangs on when the route begins
    bool begins_differ_;        // what it costs does
    std::vector<Int> soonest_;  // (stop,)
    std::vector<Chosen> breaks_;
    std::vector<Way> here_, there_;
    std::vector<Taken> taken_;
    std::vector<TimedCustomer> timed_;
    const Int waiting_;  // how long a route waits without breaks
    std::array<Int, most_compared> compared_{};
    BestBegin best_begin_{data_, truck_.k};
    std::vector<BreakChoice> choices_;
};

// Tell whether ways along a route may be lean.
bool may_be_lean(const ProblemData& data, const Tour& tour) {
    const auto& [route, stops, trips, sorties] = tour;
    return is_steady(data.type[route.type]) &&
           std::none_of(&stops[0], &stops[0] + route.length, [&](const Stop& stop) {
               return stop.kind == customer_stop && times_cost(data.price[stop.node]);
           });
}

template <bool is_lean>
void note_soonest_of(const ProblemData& data, const Tour& tour) {
    const auto& [route, stops, trips, sorties] = tour;
    Choosing<is_lean> choosing(data, route, stops, no_bar, false);
    choosing.run();
    for (Int p = 0; p < route.length; ++p) {
        stops[p].leave = choosing.soonest()[std::size_t(p)];
    }
}

}  // namespace

std::vector<BreakChoice> break_choices(const ProblemData& data, const Tour& tour,
                                       double most_late) {
    const auto& [route, stops, trips, sorties] = tour;
    std::vector<BreakChoice> choices =
        may_be_lean(data, tour) ? Choosing<true>(data, route, stops, most_late, true).run()
                                : Choosing<false>(data, route, stops, most_late, true).run();
    const auto value = [](const BreakChoice& choice) {
        return std::pair{choice.timing.cost(), choice.timing.end};
    };
    std::ranges::sort(choices, [&](const BreakChoice& one, const BreakChoice& other) {
        return value(one) < value(other);
    });
    return choices;
}

void note_soonest(const ProblemData& data, const Tour& tour) {
    const bool is_lean = is_steady(data.type[tour.route.type]);
    return (is_lean ? note_soonest_of<true> : note_soonest_of<false>)(data, tour);
}

}  // namespace tandem
