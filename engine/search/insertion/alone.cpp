#include "search/insertion/alone.h"

#include "rules/breaks.h"
#include "search/insertion/shipments.h"
#include "search/route/refresh.h"

namespace tandem {
namespace {

// From where to where a drone flies on an empty trip: from the start and back, to the end, or from
// the end and back; from a launch site and back, from the start to it, or from it to the end.
constexpr Int ways_to_fly = 3, ways_by_halt = 3;

// The ways in which a route of a type serves a customer alone, or a shipment, by its pickup.
class WaysAlone {
public:
    WaysAlone(const ProblemData& data, Int k, Int node, bool by_drone)
        : data_(data), k_(k), node_(node), by_drone_(by_drone) {}

    Int number() const { return begun_ * ways_to_deliver(); }

    // Writes a route that serves it in one of them; false if that may not be. In place.
    bool serve(const Fleet& fleet, Int slot, Int way) const {
        Move move{};
        const Sequence sequence = sequence_in(fleet, slot);
        return note(way % begun_, way / begun_, move) &&
               begin_empty(sequence, data_.type[k_], k_) && apply(sequence, move) &&
               refresh(data_, fleet, slot);
    }

private:
    // Whether a drone may fly across an empty trip: a driver may have a break meanwhile.
    static bool may_cross(const VehicleType& type) {
        return type.begins_at != type.ends_at || has_breaks(type);
    }

    bool is_delivered() const { return is_pickup(data_.pair, node_); }

    Int drone_of(Int row) const { return first_drone(data_.type, k_, row); }

    // How many ways there are to deliver: by truck, on the sortie that fetches, or by a drone of a
    // row from where the route ends, or from the pickup's stop and back there or to the end.
    Int ways_to_deliver() const {
        const bool flies = is_delivered() && data_.can(k_, 1, data_.pair[node_].partner);
        return flies ? ways_to_bring * num_drone_rows(data_.type, k_) + 2 : 1;
    }

    // Notes how it is served in one of the ways, and delivered; false if that may not be. In place.
    bool note(Int option, Int delivering, Move& move) const {
        const bool halting = option >= flights_, drives_on = is_delivered() && delivering == 0;
        const Int place = halting ? (option - flights_) / ways_by_halt : option;
        const Int row = drone_row_at(data_.type, k_, place / (halting ? halts_ : options_));
        if (by_drone_ && !data_.can(row, 1, node_)) return false;
        if (halting) {
            const Int halt = data_.near_halts(node_, place % halts_);
            if (halt < 0) return false;
            move.add(How::halt, halt, 1);
        } else if (!by_drone_) {
            move.add(How::serve, node_, 1);
        }
        const Int stops = move.count;
        if (drives_on) move.add(How::serve, data_.pair[node_].partner, stops + 1);
        const Int end = move.count + 1;
        if (by_drone_) {
            const Int flight = halting ? (option - flights_) % ways_by_halt : option % options_;
            const std::array loops{Bringing{0, 0}, Bringing{0, end}, Bringing{end, end}};
            const std::array by_halt{Bringing{1, 1}, Bringing{0, 1}, Bringing{1, end}};
            const auto [from, to] = (halting ? by_halt : loops)[std::size_t(flight)];
            move.add(How::fly, node_, from, to, drone_of(row));
        }
        return !is_delivered() || drives_on || bring(delivering, row, end, move);
    }

    // Notes how a drone delivers what is fetched; false if it may not. In place.
    bool bring(Int way, Int fetching, Int end, Move& move) const {
        const Int delivery = data_.pair[node_].partner;
        if (way == 1) {
            move.add(How::ride, delivery, node_);
            return by_drone_ && data_.visits[fetching] >= 2 && data_.can(fetching, 1, delivery);
        }
        const Int row = drone_row_at(data_.type, k_, (way - 2) / ways_to_bring);
        const Int bringing = (way - 2) % ways_to_bring;
        if (!data_.can(row, 1, delivery) || (bringing > 0 && by_drone_)) return false;
        const auto [launch, recovery] = bringing_flight(bringing, end);
        move.add(How::fly, delivery, launch, recovery, drone_of(row));
        return true;
    }

    const ProblemData& data_;
    const Int k_, node_;
    const bool by_drone_;
    const Int options_ = by_drone_ && may_cross(data_.type[k_]) ? ways_to_fly : 1;
    const Int halts_ = by_drone_ && has_halts(data_) ? data_.near_halts.shape(1) : 0;
    const Int flights_ = by_drone_ ? options_ * num_drone_rows(data_.type, k_) : 1;
    const Int begun_ = flights_ + ways_by_halt * halts_ * num_drone_rows(data_.type, k_);
};

}  // namespace

bool serve_alone(const ProblemData& data, const Fleet& fleet, Int slot, Int k, Int node,
                 bool by_drone) {
    if (is_gathered(data.pair, node))
        return serve_parts_alone(data, fleet, slot, k, node, by_drone);
    const WaysAlone all(data, k, node, by_drone);
    double best = infeasible;
    Int chosen = 0, end = far;
    bool done = false;
    // The last time, the best of them is written once more.
    for (Int tried = 0; tried < (all.number() == 1 ? 1 : all.number() + 1); ++tried) {
        const Int way = tried == all.number() ? chosen : tried;
        done = all.serve(fleet, slot, way);
        const bool is_sooner =
            data.fairness.makespan > 0.0 && fleet.cost[slot] == best && fleet.route[slot].end < end;
        if (done && (fleet.cost[slot] < best || is_sooner)) {
            best = fleet.cost[slot];
            end = fleet.route[slot].end;
            chosen = way;
        }
    }
    return done;
}

bool serve_alone_anyhow(const ProblemData& data, const Fleet& fleet, Int slot, Int k, Int node,
                        View<std::uint64_t, 1> rng) {
    if (is_gathered(data.pair, node)) return serve_parts_anyhow(data, fleet, slot, k, node, rng);
    const WaysAlone driven(data, k, node, false), flown(data, k, node, true);
    const Int way = below(rng, driven.number() + flown.number());
    return way < driven.number() ? driven.serve(fleet, slot, way)
                                 : flown.serve(fleet, slot, way - driven.number());
}

}  // namespace tandem
