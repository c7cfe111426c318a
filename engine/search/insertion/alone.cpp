#include "search/insertion/alone.h"

#include "rules/breaks.h"
#include "search/insertion/shipments.h"
#include "search/route/refresh.h"

namespace tandem {
namespace {

constexpr Int most_orders = 24;       // by truck: all of four pickups
constexpr Int most_flown_orders = 6;  // where drones serve some end: all of three
constexpr Int fewer_orders = 2;       // likewise, of more than three
constexpr Int few_pickups = 3;

constexpr Int most_flights = 15;  // from a stop to another, to fetch one pickup: all of five

// How many orders there are of so many pickups, `most` of them at most.
Int orders_of(Int count, Int most) {
    Int orders = 1;
    for (; count > 1 && orders < most; --count) orders *= count;
    return std::min(orders, most);
}

// The most orders that are tried.
Int most_orders_of(Int count, bool by_drone) {
    if (!by_drone) return most_orders;
    return count > few_pickups ? fewer_orders : most_flown_orders;
}

// The ways in which a vehicle of a type serves a shipment on a trip of its own: by truck in several
// orders, or so that drones fetch all pickups from where the trip begins, or one on some flights,
// the shortest first, and perhaps deliver from where it ends, or from the last pickup by truck.
class PartWays {
public:
    PartWays(const ProblemData& data, Int k, Int node, bool by_drone, Int flights)
        : data_(data),
          k_(k),
          by_drone_(by_drone),
          pickups_(pickups_of(data.pair, node)),
          delivery_(data.pair[node].partner),
          rows_(flies(data) ? num_drone_rows(data.type, k) : 0),
          orders_(orders_of(pickups_.count, most_orders_of(pickups_.count, by_drone))),
          flights_(std::min(flights, pickups_.count * (pickups_.count + 1) / 2)),
          fetchings_(by_drone ? 1 + rows_ * (1 + pickups_.count * flights_) : 1),
          bringings_(by_drone ? 1 + ways_to_bring * rows_ : 1) {}

    Int number() const { return by_drone_ && rows_ == 0 ? 0 : orders_ * fetchings_ * bringings_; }

    // Lets a move serve it in one of them on a trip that begins at stop `start`, and with it if
    // that is to come from a depot; false if that may not be. In place.
    bool note(Int way, Int start, Int depot, Move& move) const {
        const Int order = way % orders_, bringing = way / orders_ % bringings_;
        const Int fetching = way / orders_ / bringings_;
        if (by_drone_ && fetching == 0 && bringing == 0) return false;
        const Fetching fetched = fetching_of(fetching);
        const auto numbers = in_order(all_numbers(), order);
        Int end = start + 1;
        if (depot >= 0) move.add(How::begin, depot, start);
        for (const Int number : numbers) {
            if (!fetched.takes(number)) move.add(How::serve, pickup(number), end++);
        }
        const Int driven = end - start - 1;
        if (bringing == 0) move.add(How::serve, delivery_, end++);
        if (depot >= 0) move.add(How::end, depot, end);
        for (const Int number : numbers) {
            if (!fetched.takes(number)) continue;
            if (!data_.can(fetched.row, 1, pickup(number))) return false;
            const Int launch = start + fetched.launch;
            move.add(How::fly, pickup(number), launch, launch + fetched.span,
                     first_drone(data_.type, k_, fetched.row));
        }
        return bringing == 0 || note_bringing(bringing - 1, driven, end, move);
    }

private:
    bool flies(const ProblemData& data) const {
        return data.can(k_, 1, delivery_) ||
               std::ranges::any_of(pickups_, [&](Int pickup) { return data.can(k_, 1, pickup); });
    }

    // Which pickups drones of a row fetch: all, one, or none; from which stop of the trip, and how
    // many stops later they are recovered.
    struct Fetching {
        static constexpr Int all = most_pickups;

        Int row = nowhere, flown = nowhere, launch = 0, span = 0;

        bool takes(Int number) const { return row >= 0 && (flown == all || flown == number); }
    };

    Fetching fetching_of(Int way) const {
        Fetching fetched;
        if (way == 0) return fetched;
        const Int count = pickups_.count, each = 1 + count * flights_;
        const Int single = (way - 1) % each - 1;
        fetched.row = drone_row_at(data_.type, k_, (way - 1) / each);
        fetched.flown = single < 0 ? Fetching::all : single / flights_;
        Int& launch = fetched.launch = single < 0 ? 0 : single % flights_;
        // There is a flight fewer of each span more.
        for (; launch >= count - fetched.span; ++fetched.span) launch -= count - fetched.span;
        return fetched;
    }

    Int pickup(Int number) const { return pickups_.node[std::size_t(number)]; }

    Pickups all_numbers() const {
        Pickups numbers{{}, pickups_.count};
        for (Int number = 0; number < pickups_.count; ++number) {
            numbers.node[std::size_t(number)] = number;
        }
        return numbers;
    }

    // Notes that a drone of a row delivers from the trip's end, or the last of so many pickups by
    // truck; false if that may not be.
    bool note_bringing(Int number, Int driven, Int end, Move& move) const {
        const Int row = drone_row_at(data_.type, k_, number / ways_to_bring);
        const Int way = number % ways_to_bring;
        if (!data_.can(row, 1, delivery_) || (way > 0 && driven == 0)) return false;
        const auto [launch, recovery] = bringing_flight(way, end);
        move.add(How::fly_first, delivery_, launch, recovery, first_drone(data_.type, k_, row));
        return true;
    }

    const ProblemData& data_;
    const Int k_;
    const bool by_drone_;
    const Pickups pickups_;
    const Int delivery_, rows_, orders_, flights_, fetchings_, bringings_;
};

// Writes a route that serves a shipment alone in one of the ways. False if it may not. In place.
bool serve(const ProblemData& data, const Fleet& fleet, Int slot, Int k, const PartWays& ways,
           Int way) {
    Move move{};
    const Sequence sequence = sequence_in(fleet, slot);
    return ways.note(way, 0, nowhere, move) && begin_empty(sequence, data.type[k], k) &&
           apply(sequence, move) && refresh(data, fleet, slot);
}

}  // namespace

void try_parts_trip(const Insertion& insertion, Int slot, Int behind) {
    const auto& [data, searcher, node, enlarge, best] = insertion;
    const Fleet& fleet = searcher.now;
    const Int k = fleet.route[slot].type;
    for (const bool by_drone : {false, true}) {
        const PartWays ways(data, k, node, by_drone, 1);
        for (Int way = 0; way < ways.number(); ++way) {
            Move move{};
            move.between(slot, k, behind, behind + 1);
            if (!ways.note(way, behind + 1, data.type[k].depot, move)) continue;
            best.try_move(price_move(data, fleet, move, node, best.cost), move);
        }
    }
}

bool serve_parts_alone(const ProblemData& data, const Fleet& fleet, Int slot, Int k, Int node,
                       bool by_drone) {
    const PartWays ways(data, k, node, by_drone, most_flights);
    double best = infeasible;
    Int chosen = 0;
    for (Int way = 0; way < ways.number(); ++way) {
        if (!serve(data, fleet, slot, k, ways, way) || fleet.cost[slot] >= best) continue;
        best = fleet.cost[slot];
        chosen = way;
    }
    return best < infeasible && serve(data, fleet, slot, k, ways, chosen);
}

bool serve_parts_anyhow(const ProblemData& data, const Fleet& fleet, Int slot, Int k, Int node,
                        View<std::uint64_t, 1> rng) {
    const PartWays driven(data, k, node, false, most_flights);
    const PartWays flown(data, k, node, true, most_flights);
    const Int way = below(rng, driven.number() + flown.number());
    return way < driven.number() ? serve(data, fleet, slot, k, driven, way)
                                 : serve(data, fleet, slot, k, flown, way - driven.number());
}

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
