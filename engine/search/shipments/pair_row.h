// A route of shipments alone as a row of nodes, with what tells at once where one more fits.
#pragma once

#include <vector>

#include "rules/shift.h"
#include "rules/start.h"
#include "search/insertion/newcomer.h"
#include "search/route/state.h"

namespace tandem {

// A shipment that is to be inserted, as vehicles of the only type meet its ends.
struct PairToInsert {
    Newcomer pickup, delivery;
    Leg together;  // from one to the other
};

// Behind which stops the ends come: the delivery right behind the pickup where they are the same.
struct PairPlace {
    Int p, q;
};

// The stops of a vehicle, from where it begins to where it ends.
struct PairRow {
    std::vector<Int> node;
    std::vector<Front> front;  // up to where each is left
    std::vector<Rear> rear;    // from where each is reached
    std::vector<Int> gap;      // how long it takes to the next
    std::vector<Int> way;      // how far it is there
    std::vector<Amount> load;  // (stop, tier) on leaving
    Int distance = 0;          // of all
};

// What rows are made and looked at by: one type of trucks that make one trip each, and whose times
// and loads alone limit them.
class PairRows {
public:
    PairRows(const ProblemData& data, Int tiers)
        : data_(data),
          type_(data.type[0]),
          places_(data.place.by_truck(type_)),
          legs_(legs_of(data.leg, type_.travel)),
          begin_(leaves_first(type_, type_.shift_earliest)),
          end_(last_end(type_)),
          tiers_(tiers) {}

    PairToInsert pair_of(Int pickup) const;

    // Lets a row be that of a vehicle that serves nobody.
    void empty(PairRow& row) const;

    // Writes all that follows from the nodes of a row. False if somebody is served too late.
    bool time(PairRow& row) const;

    // Writes a row without one shipment or two, by their pickups; `nowhere`: no second.
    void leave_out(const PairRow& row, Int one, Int other, PairRow& without) const;

    // Inserts a shipment, but for what follows from that.
    void insert(PairRow& row, Int pickup, PairPlace place) const;

    // Calls `visit` with each place where a shipment fits.
    template <class Visit>
    void for_each_place(const PairRow& row, const PairToInsert& pair, const Visit& visit) const {
        const Int last = Int(row.node.size()) - 1;
        if (!takes_more(row)) return;
        for (Int p = 0; p < last; ++p) {
            if (pair.pickup.place.too_late(row.front[std::size_t(p)].time)) return;
            if (fits(row, p, pair.pickup.node)) {
                walk(row, pair, p, [&](Int q) { visit(PairPlace{p, q}); });
            }
        }
    }

    // How much longer the ways of a row take by a shipment at a place, and how much further they
    // are.
    static Leg more_by(const PairRow& row, const PairToInsert& pair, PairPlace place) {
        const auto& [pickup, delivery, together] = pair;
        const std::size_t p = std::size_t(place.p), q = std::size_t(place.q);
        Leg more{-row.gap[q], -row.way[q]};
        const auto add = [&](const Leg& way) {
            more = {more.duration + way.duration, more.distance + way.distance};
        };
        add(leg_from(pickup.inward, row.node[p]));
        add(leg_to(delivery.onward, row.node[q + 1]));
        if (p == q) {
            add(together);
        } else {
            add({-row.gap[p], -row.way[p]});
            add(leg_to(pickup.onward, row.node[p + 1]));
            add(leg_from(delivery.inward, row.node[q]));
        }
        return more;
    }

    // Whether a vehicle may stop for one shipment more.
    bool takes_more(const PairRow& row) const { return allows_stops(type_, Int(row.node.size())); }

    // Whether a shipment may be aboard when a stop is left.
    bool fits(const PairRow& row, Int p, Int pickup) const {
        for (Int tier = 0; tier < tiers_; ++tier) {
            const Amount more = picked_of(data_.amount, pickup, tier);
            if (!holds_in(type_, plus(row.load[std::size_t(p * tiers_ + tier)], more), tier))
                return false;
        }
        return true;
    }

private:
    // Calls `visit` with each stop behind which a shipment may be delivered that is picked up
    // behind stop `p`.
    template <class Visit>
    void walk(const PairRow& row, const PairToInsert& pair, Int p, const Visit& visit) const {
        const Int last = Int(row.node.size()) - 1;
        const auto& [pickup, delivery, together] = pair;
        Front front = row.front[std::size_t(p)];
        if (!front.serve(pickup.place, leg_from(pickup.inward, row.node[std::size_t(p)]).duration))
            return;
        for (Int q = p; !delivery.place.too_late(front.time); ++q) {
            const Int next = row.node[std::size_t(q + 1)];
            const Int out = q == p ? together.duration
                                   : leg_from(delivery.inward, row.node[std::size_t(q)]).duration;
            if (delivery.is_in_time({front.time + out}, row.rear[std::size_t(q + 1)],
                                    [&] { return leg_to(delivery.onward, next).duration; })) {
                visit(q);
            }
            if (q + 1 == last || !fits(row, q + 1, pickup.node)) return;
            front.drive(q == p ? leg_to(pickup.onward, next).duration : row.gap[std::size_t(q)]);
            if (!row.rear[std::size_t(q + 1)].allows(front)) return;
            front.serve(places_[next]);
        }
    }

    const ProblemData& data_;
    const VehicleType& type_;
    const NodeTable places_;
    const TravelLegs legs_;
    const Int begin_, end_;  // of each vehicle
    const Int tiers_;
};

// Reads the route in a slot. False if it breaks a rule.
bool read_row(const PairRows& rows, const Fleet& fleet, Int slot, PairRow& row);

// Tells whether the route in a slot has the stops of a row.
bool is_written(const Fleet& fleet, Int slot, const std::vector<Int>& nodes);

// Writes the route in a slot by its nodes, and where those are. False if it breaks a rule.
//
// How many routes there are is for the caller to say.
bool write_row(const ProblemData& data, const Fleet& fleet, Int slot,
               const std::vector<Int>& nodes);

// Writes all routes by the nodes of each slot. False if some break a rule.
template <class Nodes>
bool write_rows(const ProblemData& data, const Searcher& searcher, const Nodes& nodes_of) {
    const Fleet& now = searcher.now;
    for (Int slot = 0; slot < searcher.active.size(); ++slot) {
        const std::vector<Int>& nodes = nodes_of(slot);
        if (is_written(now, slot, nodes)) continue;
        now.route[slot].stamp = searcher.count->stamp;
        if (!write_row(data, now, slot, nodes)) return false;
        note_changed(searcher, slot);
    }
    list_active(searcher);
    now.used[0] = searcher.count->active;
    return true;
}

// Notes who is left out, by their pickups.
void write_missing(const ProblemData& data, const Searcher& searcher,
                   const std::vector<Int>& pickups);

}  // namespace tandem
