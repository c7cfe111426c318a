// Who is served some time behind others by the open vehicle: its truck waits for that, drones
// don't.
#pragma once

#include "rules/lag.h"
#include "simulation/state.h"

namespace tandem {

// From when to when service may begin at a customer, by those whom vehicles closed serve.
inline Span span_of(const Setting& setting, Int node) {
    return span_by(lags_of(setting.across, node), [&](Int other) { return setting.starts[other]; });
}

// When service begins at the stops and on the sorties of a log, which may be as tried.
template <class StopStart, class SortieStart>
struct Starts {
    const VehicleLog& log;
    StopStart of_stop;
    SortieStart of_sortie;

    // When service begins at a node, on the stops from one up to another and the sorties launched
    // there; `none` elsewhere, and in flight.
    Int at(Int node, Int first, Int behind) const {
        for (Int index = first; index < behind; ++index) {
            if (log.stop[index].node == node) return of_stop(index);
        }
        for (Int index = 0; index < log.count.sorties; ++index) {
            const LoggedSortie& sortie = log.sortie[index];
            const bool is_there = first <= sortie.launch_stop && sortie.launch_stop < behind;
            if (sortie.node == node && is_there && sortie.recovery_stop >= 0) {
                return of_sortie(index);
            }
        }
        return none;
    }

    // When service may begin at stop `index`, or one behind all, which is reached at `arrival`.
    Int ready_at(const Setting& setting, Int node, Int index, Int arrival) const {
        const Int soonest = soonest_behind(lags_of(setting.lag, node),
                                           [&](Int other) { return at(other, 0, index); });
        return std::max({arrival, soonest, span_of(setting, node).soonest});
    }

    // Call `visit` with each customer served from a stop on, his lags, and when service begins.
    template <class Visit>
    void for_each_behind(const Setting& setting, Int first, const Visit& visit) const {
        const auto look_at = [&](Int node) {
            if (node < setting.num_depots || !is_behind(setting.lag, node)) return;
            const Int start = at(node, first, log.count.stops);
            if (start != none) visit(lags_of(setting.lag, node), start);
        };
        for (const LoggedStop& stop : log.stop.first(log.count.stops)) look_at(stop.node);
        for (const LoggedSortie& sortie : log.sortie.first(log.count.sorties)) {
            look_at(sortie.node);
        }
    }

    // Tell whether all are served as long behind others as they should.
    bool keep_lags(const Setting& setting) const {
        bool kept = true;
        for_each_behind(setting, 0, [&](View<const Lag, 1> lags, Int start) {
            kept = kept && keeps_lags(lags, start,
                                      [&](Int other) { return at(other, 0, log.count.stops); });
        });
        return kept && keep_spans(setting);
    }

    // Tell whether nobody is served too late for those whom vehicles closed serve.
    bool keep_spans(const Setting& setting) const {
        for (Int index = 0; index < log.count.stops; ++index) {
            const Int node = log.stop[index].node;
            if (node >= setting.num_depots && of_stop(index) > span_of(setting, node).latest) {
                return false;
            }
        }
        return true;
    }

    // By how much somebody is served too long behind another from a stop on; at most 0 if nobody.
    Int most_excess(const Setting& setting, Int first) const {
        Int most = none;
        for_each_behind(setting, first, [&](View<const Lag, 1> lags, Int start) {
            most = std::max(most, excess_of_lags(lags, start, [&](Int other) {
                                return at(other, first, log.count.stops);
                            }));
        });
        return most;
    }
};

// As a log says.
inline auto logged_starts(const VehicleLog& log) {
    const auto of_stop = [&log](Int index) { return log.stop[index].start; };
    const auto of_sortie = [&log](Int index) { return log.sortie[index].start; };
    return Starts<decltype(of_stop), decltype(of_sortie)>{log, of_stop, of_sortie};
}

}  // namespace tandem
