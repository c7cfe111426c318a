// Who looks back to stops of a route: those who must be served soon, or some time, behind others.
#pragma once

#include <vector>

#include "rules/shift.h"
#include "search/route/lags.h"
#include "search/route/rarer.h"

namespace tandem {

// Notes on ways along a route when those are served to whom others look back.
class LookBacks {
public:
    LookBacks(const ProblemData& data, Int k, View<const Stop, 1> stops)
        : data_(data), k_(k), stops_(stops) {
        if (lags_count(data) || !data.max_between.empty() || time_aboard_counts(data)) note_asked();
    }

    // Tell whether nobody may look back on any route.
    bool empty() const { return asked_.empty(); }

    // Forget all that is noted.
    void forget() { noted_.clear(); }

    // Note when service or a trip begins at a stop on a way, if others look back to that. In place:
    // the number of the last one noted on it.
    void note(Int p, TimeSegment now, std::int32_t& noted) {
        if (empty() || asked(p).until < 0) return;
        noted_.push_back({now, p, noted});
        noted = std::int32_t(noted_.size()) - 1;
    }

    // Return when service may begin at a stop that is reached so, behind all who come first.
    TimeSegment ready(Int p, TimeSegment now, std::int32_t noted) const {
        if (empty()) return now;
        for_each_before(p, [&](Int q, Interval within, bool) {
            if (within.first > none) now = later(now, behind(noted_at(noted, q), within.first));
        });
        return now;
    }

    // Narrow when a route begins to what lets service begin soon enough behind others, who are of
    // its first trip: later ones may be held. In place; false if nothing does.
    bool keeps_limits(Int p, TimeSegment now, std::int32_t noted, Interval& begins) const {
        if (empty() || stops_[p].kind != customer_stop) return true;
        bool kept = true;
        if (time_aboard_counts(data_) && stops_[p].trip == 0) {
            const TimeSegment departure{0, leaves_first(data_.type[k_], none)};
            kept = narrow(begins,
                          lasting_within(data_.max_time_aboard[stops_[p].node], departure, now));
        }
        for_each_before(p, [&](Int q, Interval within, bool is_by_end) {
            if (!kept || stops_[q].trip > 0) return;
            const Int served =
                is_by_end ? data_.place.by_truck(data_.type[k_])[stops_[q].node].service_duration()
                          : 0;
            const TimeSegment since = behind(noted_at(noted, q), served);
            kept = narrow(begins, lasting_within(within.last, since, now));
        });
        return kept;
    }

    // When somebody comes to a stop, and the last one noted on that way.
    struct Come {
        TimeSegment now;
        std::int32_t noted;
    };

    // Tell whether one of two who come to a stop is no worse for those who look back, if it comes
    // no later.
    bool is_no_worse(Int p, Come one, Come other) const {
        if (empty()) return true;
        if (asked(p).is_ahead && !is_no_later(other.now, one.now)) return false;
        while (one.noted != other.noted) {
            const Noted& mine = noted_[std::size_t(one.noted)];
            const Noted& instead = noted_[std::size_t(other.noted)];
            const Asked& at = asked(mine.stop);
            if (at.until >= p && (!is_no_later(instead.start, mine.start) ||
                                  (at.is_awaited && !is_no_later(mine.start, instead.start)))) {
                return false;
            }
            one.noted = mine.before;
            other.noted = instead.before;
        }
        return true;
    }

private:
    // Who looks back to a stop.
    struct Asked {
        Int until = -1;           // the last stop that does
        bool is_awaited = false;  // any does that is served some time later at the soonest
        bool is_ahead = false;    // any does to this one, or one farther on
    };

    // When service began at a stop to which others look back.
    struct Noted {
        TimeSegment start;
        Int stop;
        std::int32_t before;
    };

    const Asked& asked(Int p) const { return asked_[std::size_t(p)]; }

    TimeSegment noted_at(std::int32_t number, Int stop) const {
        while (noted_[std::size_t(number)].stop != stop) {
            number = noted_[std::size_t(number)].before;
        }
        return noted_[std::size_t(number)].start;
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
                visit(q, Interval{none, data_.max_between(k_, stops_[q].node)}, true);
            }
        }
    }

    void note_asked() {
        asked_.resize(std::size_t(stops_.size()));
        for (Int p = 0; p < stops_.size(); ++p) {
            Asked& asked = asked_[std::size_t(p)];
            if (stops_[p].kind == start_stop && time_aboard_counts(data_) && p > 0) {
                asked.until = p;
                while (stops_[asked.until].kind != end_stop) ++asked.until;
            }
            for_each_before(p, [&](Int q, Interval within, bool) {
                Asked& before = asked_[std::size_t(q)];
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

    const ProblemData& data_;
    Int k_;
    View<const Stop, 1> stops_;
    std::vector<Asked> asked_;  // (stop,) nothing where nobody may
    std::vector<Noted> noted_;
};

}  // namespace tandem
