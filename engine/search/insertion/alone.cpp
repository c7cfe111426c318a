#include "search/insertion/alone.h"

#include "rules/driving.h"
#include "search/insertion/shipments.h"
#include "search/route/refresh.h"

namespace tandem {
namespace {

constexpr Int most_orders = 24;       // by truck: all of four pickups
constexpr Int most_flown_orders = 6;  // where drones serve some end: all of three
constexpr Int fewer_orders = 2;       // likewise, of more than three
constexpr Int few_pickups = 3;

constexpr Int most_flights = 15;  // from a stop to another, to fetch one pickup: all of five

// From a launch site and back, from the start to it, or from it to the end.
constexpr Int ways_by_halt = 3;

// From which stop to which a drone delivers on a trip that ends at stop `end`, behind the last
// pickup: from the end, from that pickup there, or from that pickup and back.
constexpr Int ways_to_bring = 3;

struct FlightEnds {
    Int launch, recovery;
};

constexpr FlightEnds bringing_flight(Int way, Int end) {
    return {way == 0 ? end : end - 1, way == 2 ? end - 1 : end};
}

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

// The ways in which a vehicle of a type serves a customer, or a shipment by its first pickup, on a
// trip of its own: by truck in several orders, or so that drones fetch all pickups from where the
// trip begins, or one on some flights, the shortest first, and perhaps deliver. A customer is like
// one pickup that needn't be delivered.
class WaysAlone {
public:
    // `flights`: so many to fetch one pickup at most; of one, the trip is no other route's.
    WaysAlone(const ProblemData& data, Int k, Int node, bool by_drone, Int flights)
        : data_(data),
          k_(k),
          by_drone_(by_drone),
          pickups_(is_pickup(data.pair, node) ? pickups_of(data.pair, node)
                                              : Pickups{.node = {node}, .count = 1}),
          delivery_(is_pickup(data.pair, node) ? data.pair[node].partner : nowhere),
          rows_(by_drone && flies() ? num_drone_rows(data.type, k) : 0),
          orders_(orders_of(pickups_.count, most_orders_of(pickups_.count, by_drone))),
          ends_(pickups_.count + (is_single() && may_cross() ? 1 : 0)),
          flights_(std::min(flights, ends_ * (ends_ + 1) / 2)),
          halts_(flights > 1 && is_single() && has_halts(data) ? data.near_halts.shape(1) : 0),
          fetchings_((by_drone && !is_delivered() ? 0 : 1) + rows_ * fetchings_of_row()),
          bringings_(by_drone && is_delivered() ? 2 + ways_to_bring * rows_ : 1) {}

    Int number() const { return by_drone_ && rows_ == 0 ? 0 : orders_ * fetchings_ * bringings_; }

    // Lets a move serve it in one of them on a trip that begins at stop `start`, and with it if
    // that is to come from a depot; false if that may not be. In place.
    bool note(Int way, Int start, Int depot, Move& move) const {
        const Int bringing = way / orders_ % bringings_;
        const Fetching fetched = fetching_of(way / orders_ / bringings_);
        if (by_drone_ && fetched.row < 0 && bringing == 0) return false;
        if (fetched.by_halt >= 0 && fetched.halt < 0) return false;
        const auto numbers = in_order(all_numbers(), way % orders_);
        Int end = start + 1, driven = 0;
        if (depot >= 0) move.add(How::begin, depot, start);
        if (fetched.by_halt >= 0) move.add(How::halt, fetched.halt, end++);
        for (const Int number : numbers) {
            if (fetched.takes(number)) continue;
            move.add(How::serve, pickup(number), end++);
            ++driven;
        }
        if (is_delivered() && bringing == 0) move.add(How::serve, delivery_, end++);
        if (depot >= 0) move.add(How::end, depot, end);
        for (const Int number : numbers) {
            if (!fetched.takes(number)) continue;
            if (!data_.can(fetched.row, 1, pickup(number))) return false;
            const auto [launch, recovery] = fetched.flight(start, driven, end);
            move.add(How::fly, pickup(number), launch, recovery, drone_of(fetched.row));
        }
        return bringing == 0 || bring(bringing - 1, fetched.row, {driven, end}, move);
    }

    // Writes a route that serves it in one of them; false if that may not be. In place.
    bool serve(const Fleet& fleet, Int slot, Int way) const {
        Move move{};
        const Sequence sequence = sequence_in(fleet, slot);
        return note(way, 0, nowhere, move) && begin_empty(sequence, data_.type[k_], k_) &&
               apply(sequence, move) && refresh(data_, fleet, slot);
    }

private:
    bool is_single() const { return pickups_.count == 1; }
    bool is_delivered() const { return delivery_ != nowhere; }
    Int pickup(Int number) const { return pickups_.node[std::size_t(number)]; }
    Int drone_of(Int row) const { return first_drone(data_.type, k_, row); }

    // Whether a drone may fly across an empty trip: who drives may have to stay on the way.
    bool may_cross() const {
        const VehicleType& type = data_.type[k_];
        return type.begins_at != type.ends_at || data_.evaluation[k_].retimed || limits_work(type);
    }

    bool flies() const {
        return (is_delivered() && data_.can(k_, 1, delivery_)) ||
               std::ranges::any_of(pickups_, [&](Int pickup) { return data_.can(k_, 1, pickup); });
    }

    // Which pickups drones of a row fetch: all, one, or none; from which of the stops before the
    // delivery, and how many later they are recovered; or how by a launch site.
    struct Fetching {
        static constexpr Int all = most_pickups;

        Int row = nowhere, flown = nowhere, launch = 0, span = 0;
        Int by_halt = nowhere, halt = nowhere;

        bool takes(Int number) const { return row >= 0 && (flown == all || flown == number); }

        // From which stop to which, of a trip with so many pickups by truck. Behind these, its end.
        FlightEnds flight(Int start, Int driven, Int end) const {
            if (by_halt >= 0) {
                return std::array{FlightEnds{1, 1}, FlightEnds{0, 1},
                                  FlightEnds{1, end}}[std::size_t(by_halt)];
            }
            const auto stop = [&](Int number) { return number > driven ? end : start + number; };
            return {stop(launch), stop(launch + span)};
        }
    };

    // How many ways there are to fetch by drones of a row.
    Int fetchings_of_row() const {
        return (is_single() ? 0 : 1) + pickups_.count * flights_ + ways_by_halt * halts_;
    }

    Fetching fetching_of(Int way) const {
        Fetching fetched;
        if (!by_drone_ || (is_delivered() && way-- == 0)) return fetched;
        fetched.row = drone_row_at(data_.type, k_, way / fetchings_of_row());
        way %= fetchings_of_row();
        if (!is_single() && way-- == 0) {
            fetched.flown = Fetching::all;
            return fetched;
        }
        fetched.flown = std::min(way / flights_, pickups_.count - 1);
        if (way >= pickups_.count * flights_) {
            way -= pickups_.count * flights_;
            fetched.by_halt = way % ways_by_halt;
            fetched.halt = data_.near_halts(pickup(0), way / ways_by_halt);
            return fetched;
        }
        Int& launch = fetched.launch = way % flights_;
        // There is a flight fewer of each span more.
        for (; launch >= ends_ - fetched.span; ++fetched.span) launch -= ends_ - fetched.span;
        return fetched;
    }

    Pickups all_numbers() const {
        Pickups numbers{{}, pickups_.count};
        for (Int number = 0; number < pickups_.count; ++number) {
            numbers.node[std::size_t(number)] = number;
        }
        return numbers;
    }

    // How many pickups a trip has by truck, and where it ends.
    struct Driven {
        Int count, end;
    };

    // Lets drones deliver: on the sortie that fetches, or by one of a row from the trip's end, or
    // the last pickup by truck; false if that may not be. In place.
    bool bring(Int number, Int fetching, Driven driven, Move& move) const {
        if (number == 0) {
            move.add(How::ride, delivery_, pickup(0));
            return is_single() && fetching >= 0 && data_.visits[fetching] >= 2 &&
                   data_.can(fetching, 1, delivery_);
        }
        const Int row = drone_row_at(data_.type, k_, (number - 1) / ways_to_bring);
        const Int way = (number - 1) % ways_to_bring;
        if (!data_.can(row, 1, delivery_) || (way > 0 && driven.count == 0)) return false;
        const auto [launch, recovery] = bringing_flight(way, driven.end);
        move.add(How::fly, delivery_, launch, recovery, drone_of(row));
        return true;
    }

    const ProblemData& data_;
    const Int k_;
    const bool by_drone_;
    const Pickups pickups_;
    const Int delivery_, rows_, orders_, ends_, flights_, halts_, fetchings_, bringings_;
};

}  // namespace

void try_pair_trips(const Insertion& insertion, Int slot) {
    const auto& [data, searcher, node, enlarge, best] = insertion;
    const Fleet& fleet = searcher.now;
    const Int k = fleet.route[slot].type;
    for (Int p = -1; p < fleet.route[slot].length; ++p) {
        if (p >= 0 && fleet.stop(slot, p).kind != end_stop) continue;
        for (const bool by_drone : {false, true}) {
            const WaysAlone ways(data, k, node, by_drone, 1);
            for (Int way = 0; way < ways.number(); ++way) {
                Move move{};
                move.between(slot, k, p, p + 1);
                if (!ways.note(way, p + 1, data.type[k].depot, move)) continue;
                best.try_move(price_move(data, fleet, move, node, best.cost), move);
            }
        }
    }
}

bool serve_alone(const ProblemData& data, const Fleet& fleet, Int slot, Int k, Int node,
                 bool by_drone) {
    const WaysAlone all(data, k, node, by_drone, most_flights);
    const Int number = all.number();
    if (number <= 1) return number == 1 && all.serve(fleet, slot, 0);
    double best = infeasible;
    Int chosen = 0, end = far;
    for (Int way = 0; way < number; ++way) {
        if (!all.serve(fleet, slot, way)) continue;
        const bool is_sooner =
            data.fairness.makespan > 0.0 && fleet.cost[slot] == best && fleet.route[slot].end < end;
        if (fleet.cost[slot] < best || is_sooner) {
            best = fleet.cost[slot];
            end = fleet.route[slot].end;
            chosen = way;
        }
    }
    return best < infeasible && all.serve(fleet, slot, chosen);
}

bool serve_alone_anyhow(const ProblemData& data, const Fleet& fleet, Int slot, Int k, Int node,
                        View<std::uint64_t, 1> rng) {
    const WaysAlone driven(data, k, node, false, most_flights);
    const WaysAlone flown(data, k, node, true, most_flights);
    const Int way = below(rng, driven.number() + flown.number());
    return way < driven.number() ? driven.serve(fleet, slot, way)
                                 : flown.serve(fleet, slot, way - driven.number());
}

}  // namespace tandem
