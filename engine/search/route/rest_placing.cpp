

#include "search/route/rarer.h"
#include "search/route/rests.h"

namespace tandem {
namespace {

// Ways to a stop that are followed at most where drones fly or others are waited for. There each is
// timed with all of that, and few are known to be worse than another.
constexpr std::size_t few = 12;

// Two rows of labels: where somebody is, and where that comes.
class TwoRows {
public:
    TwoRows(std::size_t most, Int changing)
        : row_{RestLabels(most, changing), RestLabels(most, changing)} {}

    RestLabels& there() { return row_[there_]; }

    // Let those who came be those who are there, and nobody come yet; returns them. In place.
    const RestLabels& go_on() {
        const RestLabels& here = row_[there_];
        there_ = 1 - there_;
        row_[there_].clear();
        return here;
    }

private:
    std::array<RestLabels, 2> row_;
    std::size_t there_ = 0;
};

// A block as timed with some rests.
struct Timed {
    Int d, c, lo, hi, dep;
    bool done;  // no rule is broken
};

// When a stop within a block is left, `far` if never, the sum of the take-offs of drones that are
// out then, and by how much somebody of the block so far is served too long behind another.
struct Left {
    Int time, airborne, excess;
};

class Placing {
public:
    Placing(const RestRoute& route, BestRests& best, TakenRests& taken, std::size_t most)
        : route_(route),
          type_(route.type),
          stops_(route.stops),
          sorties_(route.sorties),
          best_(best),
          taken_(taken),
          rows_(most, route.truck.speeds.last_change()),
          inside_(most, route.truck.speeds.last_change()) {}

    // Follow all ways that may be best to the end.
    void run() {
        rows_.there().add(route_.beginning());
        Ahead ahead = route_.whole();
        for (Int p = 0; p < stops_.size();) {
            if (stops_[p].kind == start_stop) {
                launched_ = 0;
                first_of_trip_ = sortie_;
            }
            const Int last = last_of_block(p);
            const RestLabels& here = rows_.go_on();
            if (behind_ == sortie_) {
                const LegAhead way = route_.way_from(p, ahead, false);
                for (const RestLabel& label : here) pass(label, way);
                ahead = way.ahead;
            } else {
                const Ahead before = ahead;
                for (const RestLabel& label : here) ahead = fly(label, p, last, before);
                if (here.begin() == here.end()) return;
            }
            launched_ += behind_ - sortie_;
            sortie_ = behind_;
            p = last + 1;
        }
        for (const RestLabel& label : rows_.there()) best_.keep(label, route_.ending_of(label));
    }

private:
    // Return the last stop of the block that begins at a stop, and look at its sorties.
    Int last_of_block(Int first) {
        Int last = first;
        behind_ = sortie_;
        for (; behind_ < sorties_.size() && sorties_[behind_].launch <= last; ++behind_) {
            last = std::max(last, sorties_[behind_].recovery);
        }
        return last;
    }

    // Leave a stop without sorties, reached so, and come to the next.
    void pass(RestLabel label, const LegAhead& way) {
        Stop& stop = stops_[way.p];
        if (!route_.reach_alone(way.p, label.time)) return;
        if (waits_.count()) {
            stop.c = std::max(stop.c, waits_.leave_alone(way.p, label.time, label.waited));
            if (stop.c == far) return;
        }
        leave(label, way, way.p);
    }

    // Leave the block that begins with a stop, and come to the next.
    void leave(RestLabel label, const LegAhead& way, Int first) {
        if (!route_.leave_block(label, first)) return;
        if (route_.is_last(way.p)) {
            rows_.there().add(label);
        } else if (stops_[way.p].kind == end_stop) {
            route_.reload(label, way.p);
            rows_.there().add(label);
        } else {
            legs_.drive(label, way, rows_.there());
        }
    }

    // Leave a block with sorties, reached so with so much ahead, and come to the stop behind it.
    // Returns what is ahead there.
    //
    // Who drives on while drones are out may rest on each leg: of all ways to have come to a stop
    // those are followed that may be best. Each is timed once for the rests that it has.
    Ahead fly(const RestLabel& reached, Int first, Int last, Ahead ahead) {
        timed_.clear();
        left_.clear();
        inside_.go_on();
        inside_.there().add(reached);
        for (Int q = first; q < last; ++q) {
            const RestLabels& here = inside_.go_on();
            const LegAhead way = route_.way_from(q, ahead, true);
            ahead = way.ahead;
            for (RestLabel label : here) {
                if (label.timed < 0) time_inside(label, first, last, reached);
                const Left& left = left_of(label, q - first, last - first);
                label.time = left.time;
                if (label.time == far || !may_still_work(type_, label.driver, label.time)) continue;
                label.airborne = left.airborne;
                label.waited.excess = std::max(label.waited.excess, left.excess);
                legs_.drive(label, way, inside_.there());
            }
        }
        const LegAhead way = route_.way_from(last, ahead, false);
        for (RestLabel label : inside_.there()) {
            if (label.timed < 0 || waits_.count()) time_inside(label, first, last, reached);
            const Timed& timed = timed_[std::size_t(label.timed)];
            if (!timed.done) continue;
            if (waits_.count()) waits_.pass({first, last + 1}, {sortie_, behind_}, label.waited);
            label.time = reached.time;
            label.cum = reached.cum;
            label.airborne = 0;
            label.timed = -1;
            Stop& stop = stops_[first];
            stop.d = timed.d;
            stop.c = timed.c;
            stop.dep = timed.dep;
            if (timed.lo <= label.time && label.time <= timed.hi) leave(label, way, first);
        }
        route_.rest_nowhere(first, last);
        return way.ahead;
    }

    // Time a block that is reached so with the rests of a label, which then knows that.
    void time_inside(RestLabel& label, Int first, Int last, const RestLabel& reached) {
        route_.rest_nowhere(first, last);
        taken_.for_each_from(first, label.last, [&](const TakenRest& rest) { route_.take(rest); });
        if (waits_.count()) waits_.recall(reached.waited);
        for (Int s = sortie_; s < behind_; ++s) sorties_[s].state = sortie_waits;
        for (Int p = first; p <= last; ++p) stops_[p].leave = far;
        BlockSums sums;
        sums.time = reached.time;
        sums.oldest = sortie_;
        sums.launched = launched_;
        sums.first_sortie = first_of_trip_;
        sums.driver = reached.driver;
        const bool done = time_block(route_.truck, stops_, sorties_, first, sums) == last;
        const Stop& stop = stops_[first];
        label.timed = std::int32_t(timed_.size());
        timed_.push_back({stop.d, stop.c, stop.lo, stop.hi, stop.dep, done});
        for (Int q = first; q < last; ++q) {
            const Int excess =
                waits_.count() ? excess_within(route_.truck.data, stops_, sorties_, {first, q + 1})
                               : 0;
            left_.push_back({stops_[q].leave, takeoffs_of_flying(q), excess});
        }
    }

    // When a label leaves a stop of the block that is timed so.
    const Left& left_of(const RestLabel& label, Int stop, Int stops) const {
        return left_[std::size_t(label.timed * stops + stop)];
    }

    // Return the sum of the take-offs of drones that are out when a stop is left.
    Int takeoffs_of_flying(Int q) const {
        Int sum = 0;
        for (Int s = sortie_; s < behind_; ++s) {
            if (sorties_[s].launch <= q && q < sorties_[s].recovery) sum += sorties_[s].takeoff;
        }
        return sum;
    }

    const RestRoute& route_;
    const VehicleType& type_;
    const View<Stop, 1> stops_;
    const View<Sortie, 1> sorties_;
    BestRests& best_;
    TakenRests& taken_;
    Waits waits_{route_.truck, stops_, sorties_};
    RestLegs legs_{route_, best_, taken_};
    TwoRows rows_;
    TwoRows inside_;  // likewise within a block
    std::vector<Timed> timed_;
    std::vector<Left> left_;  // (timing, stop)
    Int sortie_ = 0;          // the first not passed, and the first behind the block
    Int behind_ = 0;
    Int launched_ = 0;  // on the trip
    Int first_of_trip_ = 0;
};

}  // namespace

Int resting_in_gap(const VehicleType& type, const Stop& stop) {
    return rests_in_gaps(type) ? duration_of(type, Rests(stop.rests)) : 0;
}

Int driving_from(const ProblemData& data, const VehicleType& type, View<const Stop, 1> stops,
                 Int p) {
    const Int setup =
        is_steady(type) ? setup_after(data.setup, stops[p].node, stops[p + 1].node) : 0;
    return stops[p].gap - resting_in_gap(type, stops[p]) - setup;
}

void forget_rests(const VehicleType& type, Stop& stop) {
    stop.gap -= resting_in_gap(type, stop);
    stop.rests = 0;
}

void clear_rests(const VehicleType& type, View<Stop, 1> stops) {
    for (Stop& stop : stops) forget_rests(type, stop);
}

bool place_rests(const ProblemData& data, const Tour& tour, const LeastWork& least) {
    const RestRoute resting(data, tour, least);
    BestRests best;
    TakenRests taken;
    make_ready(resting.truck, resting.stops, resting.sorties);
    resting.note_latest();
    const bool looks_at_all =
        tour.route.sorties > 0 || lags_count(data) || !has_driving_rules(resting.type);
    if (looks_at_all || !rest_late(resting, best, taken)) {
        Placing(resting, best, taken, looks_at_all ? few : RestLabels::all).run();
    }
    if (!best.is_known()) return false;
    clear_rests(resting.type, resting.stops);
    taken.for_each_from(0, best.last(), [&](const TakenRest& rest) { resting.take(rest); });
    return true;
}

}  // namespace tandem
