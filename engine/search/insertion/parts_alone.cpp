#include "search/insertion/alone.h"
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

}  // namespace tandem
