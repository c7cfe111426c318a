// The quickest ways around obstacles, by the corners that see one another.
//
// A flight that is not straight goes from its origin to a corner, from corner to corner, and from a
// corner to its target. Who sees whom is a table of rows of different lengths: the entries of row
// `i` are those from `begin[i]` up to `begin[i + 1]`.
#include <limits>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "guard.h"
#include "travel/sights.h"

namespace tandem {
namespace {

constexpr double nowhere = std::numeric_limits<double>::infinity();

// How far a flight is, and how long it takes.
struct FlightLength {
    double distance = nowhere, duration = nowhere;
};

struct Network {
    Sights outward;  // from each node to corners
    Sights between;  // from each corner to others
    Sights inward;   // to each node from corners
    Turns turns;
};

struct FlightLegs {
    View<double, 2> distance;  // (node, node) infinite where there is no such flight
    View<double, 2> duration;

    void write(Int node, Int target, const FlightLength& flown) const {
        distance(node, target) = flown.distance;
        duration(node, target) = flown.duration;
    }
};

// Arrivals, the soonest first.
//
// Those far ahead wait in buckets of times alike, none of which is sorted before its time has come.
//
// Denardo and Fox (1979), shortest-route methods: 1. Reaching, pruning, and buckets, Operations
// Research 27:161-186.
class Frontier {
public:
    struct Arrival {
        double time;
        Int corner;

        // So that the soonest, and of those the first corner, is at the top of a heap.
        friend bool operator<(const Arrival& one, const Arrival& other) {
            return std::tie(other.time, other.corner) < std::tie(one.time, one.corner);
        }
    };

    // `longest` is the longest time from one arrival to another that it leads to.
    explicit Frontier(double longest)
        : buckets_(num_buckets), per_second_(longest > 0 ? (num_buckets - 2) / longest : 0.0) {}

    void push(double time, Int corner) {
        const auto bucket = Int(time * per_second_);
        if (bucket > now_) {
            at(bucket).push_back({time, corner});
            ++waiting_;
        } else {
            soon_.push_back({time, corner});
            std::push_heap(soon_.begin(), soon_.end());
        }
    }

    // Leave all out, and let times begin anew.
    void clear() {
        if (waiting_ > 0) {
            for (std::vector<Arrival>& bucket : buckets_) bucket.clear();
        }
        soon_.clear();
        now_ = waiting_ = 0;
    }

    // Take the soonest; false if there is none.
    bool pop(Arrival& arrival) {
        while (soon_.empty()) {
            if (waiting_ == 0) return false;
            std::swap(soon_, at(++now_));
            waiting_ -= Int(soon_.size());
            std::make_heap(soon_.begin(), soon_.end());
        }
        std::pop_heap(soon_.begin(), soon_.end());
        arrival = soon_.back();
        soon_.pop_back();
        return true;
    }

private:
    static constexpr Int num_buckets = 4096;

    std::vector<Arrival>& at(Int bucket) { return buckets_[std::size_t(bucket % num_buckets)]; }

    std::vector<std::vector<Arrival>> buckets_;
    std::vector<Arrival> soon_;  // a heap, of the bucket whose time has come
    double per_second_;          // buckets
    Int now_ = 0;
    Int waiting_ = 0;  // in buckets
};

// The longest flight of some, of those that there are.
double longest(View<const double, 1> durations) {
    double found = 0.0;
    for (const double duration : durations) {
        if (duration < nowhere) found = std::max(found, duration);
    }
    return found;
}

// Which nodes each corner is seen from, as entries of `inward`.
class Beholders {
public:
    struct Beholder {
        Int node, entry;
    };

    Beholders(const Sights& inward, std::size_t num_corners) : begin_(num_corners + 1) {
        for (const Int corner : inward.place) ++begin_[std::size_t(corner) + 1];
        for (std::size_t corner = 1; corner < begin_.size(); ++corner) {
            begin_[corner] += begin_[corner - 1];
        }
        beholder_.resize(std::size_t(inward.place.size()));
        std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
        for (Int node = 0; node + 1 < inward.begin.size(); ++node) {
            for (Int entry = inward.begin[node]; entry < inward.begin[node + 1]; ++entry) {
                beholder_[next[std::size_t(inward.place[entry])]++] = {node, entry};
            }
        }
    }

    std::span<const Beholder> of(Int corner) const {
        const auto at = std::size_t(corner);
        return {beholder_.data() + begin_[at], begin_[at + 1] - begin_[at]};
    }

private:
    std::vector<std::size_t> begin_;  // (corner + 1,)
    std::vector<Beholder> beholder_;
};

// The quickest flights from a node that bend at least once.
//
// A shortest way has the area of a corner on one side, before and behind it: else it could be cut
// short there. So a corner is left on the side on which it was reached soonest, or on both if they
// are as soon but for rounding.
//
// Dijkstra (1959), a note on two problems in connexion with graphs, Numer. Math. 1:269-271.
class Reach {
public:
    explicit Reach(const Network& network)
        : network_(network),
          flown_(std::size_t(network.between.begin.size() - 1)),
          sides_(flown_.size()),
          least_(std::size_t(network.inward.begin.size() - 1)),
          beholders_(network.inward, flown_.size()),
          ahead_(std::max(longest(network.outward.duration), longest(network.between.duration))) {}

    // Fly from a node, at least until no flight to any of some others can be quicker.
    void fly_from(Int node, std::span<const Int> targets) {
        std::ranges::fill(flown_, FlightLength{});
        std::ranges::fill(least_, FlightLength{});
        const Sights& outward = network_.outward;
        for (Int entry = outward.begin[node]; entry < outward.begin[node + 1]; ++entry) {
            const FlightLength flown{outward.distance[entry], outward.duration[entry]};
            reach(outward.place[entry], flown, network_.turns.reached[entry]);
        }
        Frontier::Arrival arrival{};
        for (Int number = 0; ahead_.pop(arrival); ++number) {
            if (number % looks_back == 0 && arrival.time > longest_to(targets)) break;
            if (arrival.time > to(arrival.corner).duration) continue;
            land_from(arrival.corner);
            go_on_from(arrival.corner);
        }
        ahead_.clear();
    }

    const FlightLength& flown_to(Int target) const { return least_[std::size_t(target)]; }

private:
    static constexpr Int looks_back = 64;     // arrivals until it is looked whether all are reached
    static constexpr double rounding = 1e-9;  // seconds within which ways take as long

    FlightLength& to(Int corner) { return flown_[std::size_t(corner)]; }

    double longest_to(std::span<const Int> targets) const {
        double found = 0.0;
        for (const Int target : targets) {
            const bool is_seen = network_.inward.begin[target] < network_.inward.begin[target + 1];
            if (is_seen) found = std::max(found, flown_to(target).duration);
        }
        return found;
    }

    void land_from(Int corner) {
        const FlightLength here = to(corner);
        for (const auto& [node, entry] : beholders_.of(corner)) {
            const double total = here.duration + network_.inward.duration[entry];
            FlightLength& there = least_[std::size_t(node)];
            if (total < there.duration) {
                there = {here.distance + network_.inward.distance[entry], total};
            }
        }
    }

    void go_on_from(Int corner) {
        const Sights& between = network_.between;
        const Turns& turns = network_.turns;
        const FlightLength here = to(corner);
        const auto sides = sides_[std::size_t(corner)];
        const Int first =
            (sides & Turns::left) != 0 ? between.begin[corner] : turns.only_left_end[corner];
        const Int last = (sides & Turns::right) != 0 ? between.begin[corner + 1]
                                                     : turns.only_right_begin[corner];
        for (Int entry = first; entry < last; ++entry) {
            const double total = here.duration + between.duration[entry];
            const Int next = between.place[entry];
            if (total > to(next).duration + rounding) continue;
            reach(next, {here.distance + between.distance[entry], total}, turns.arrived[entry]);
        }
    }

    // Come to a corner with its area on some sides.
    void reach(Int corner, const FlightLength& flown, std::int32_t sides) {
        if (!(flown.duration < nowhere)) return;
        FlightLength& there = to(corner);
        std::int32_t& kept = sides_[std::size_t(corner)];
        if (flown.duration < there.duration) {
            kept = there.duration - flown.duration <= rounding ? kept | sides : sides;
            there = flown;
        } else if (flown.duration <= there.duration + rounding && (sides & ~kept) != 0) {
            kept |= sides;
        } else {
            return;
        }
        ahead_.push(there.duration, corner);
    }

    const Network& network_;
    std::vector<FlightLength> flown_;  // (corner,)
    std::vector<std::int32_t> sides_;  // (corner,) on which its area may lie
    std::vector<FlightLength> least_;  // (node,)
    Beholders beholders_;
    Frontier ahead_;
};

// Which flights are looked for: those wanted from some places of an order.
struct WantedFlights {
    View<const bool, 2> wanted;
    View<const std::int64_t, 1> order;  // (node,)
    bool mutual;                        // a flight back is as long as the flight there
    Int first, last;
};

// Write the quickest flights that bend at least once, those back with them if they are mutual.
void fly_around(const Network& network, const WantedFlights& asked, const FlightLegs& legs) {
    Reach reach(network);
    std::vector<Int> targets;
    for (Int place = asked.first; place < asked.last; ++place) {
        const Int node = asked.order[place];
        const View<const bool, 1> row = asked.wanted[node];
        targets.clear();
        for (Int other = asked.mutual ? place : 0; other < asked.order.size(); ++other) {
            if (row[asked.order[other]]) targets.push_back(asked.order[other]);
        }
        if (targets.empty()) continue;
        reach.fly_from(node, targets);
        for (const Int target : targets) {
            legs.write(node, target, reach.flown_to(target));
            if (asked.mutual) legs.write(target, node, reach.flown_to(target));
        }
    }
}

}  // namespace
}  // namespace tandem

extern "C" int tandem_fly_around(const tandem_sights* outward, const tandem_sights* between,
                                 const tandem_sights* inward, const tandem_turns* turns,
                                 const tandem_bool_2d* wanted, const tandem_i64_1d* order,
                                 bool mutual, int64_t first, int64_t last,
                                 const tandem_f64_2d* distance, const tandem_f64_2d* duration) {
    return tandem::guarded([&] {
        const tandem::Network network{*outward, *between, *inward, {*turns}};
        tandem::fly_around(network, {*wanted, *order, mutual, first, last}, {*distance, *duration});
    });
}
