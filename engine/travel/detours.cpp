// The quickest ways around obstacles, by the corners that see one another.
//
// A flight that is not straight goes from its origin to a corner, from corner to corner, and from a
// corner to its target. Who sees whom is a table of rows of different lengths: the entries of row
// `i` are those from `begin[i]` up to `begin[i + 1]`.
#include <algorithm>
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
struct Flown {
    double distance = nowhere;
    double duration = nowhere;
};

struct Network {
    Sights outward;  // from each node to corners
    Sights between;  // from each corner to others
    Sights inward;   // to each node from corners
};

struct FlightLegs {
    View<double, 2> distance;  // (node, node) infinite where there is no such flight
    View<double, 2> duration;

    void write(Int node, Int target, const Flown& flown) const {
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
class Ahead {
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
    explicit Ahead(double longest)
        : buckets_(num_buckets), per_second_(longest > 0 ? (num_buckets - 2) / longest : 0.0) {}

    void push(double time, Int corner) {
        const auto bucket = static_cast<Int>(time * per_second_);
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
            waiting_ -= static_cast<Int>(soon_.size());
            std::make_heap(soon_.begin(), soon_.end());
        }
        std::pop_heap(soon_.begin(), soon_.end());
        arrival = soon_.back();
        soon_.pop_back();
        return true;
    }

private:
    static constexpr Int num_buckets = 4096;

    std::vector<Arrival>& at(Int bucket) {
        return buckets_[static_cast<std::size_t>(bucket % num_buckets)];
    }

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
        for (const Int corner : inward.place) ++begin_[static_cast<std::size_t>(corner) + 1];
        for (std::size_t corner = 1; corner < begin_.size(); ++corner) {
            begin_[corner] += begin_[corner - 1];
        }
        beholder_.resize(static_cast<std::size_t>(inward.place.size()));
        std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
        for (Int node = 0; node + 1 < inward.begin.size(); ++node) {
            for (Int entry = inward.begin[node]; entry < inward.begin[node + 1]; ++entry) {
                beholder_[next[static_cast<std::size_t>(inward.place[entry])]++] = {node, entry};
            }
        }
    }

    std::span<const Beholder> of(Int corner) const {
        const auto at = static_cast<std::size_t>(corner);
        return {beholder_.data() + begin_[at], begin_[at + 1] - begin_[at]};
    }

private:
    std::vector<std::size_t> begin_;  // (corner + 1,)
    std::vector<Beholder> beholder_;
};

// The quickest flights from a node that bend at least once.
//
// Dijkstra (1959), a note on two problems in connexion with graphs, Numer. Math. 1:269-271.
class Reach {
public:
    explicit Reach(const Network& network)
        : network_(network),
          flown_(static_cast<std::size_t>(network.between.begin.size() - 1)),
          least_(static_cast<std::size_t>(network.inward.begin.size() - 1)),
          beholders_(network.inward, flown_.size()),
          ahead_(std::max(longest(network.outward.duration), longest(network.between.duration))) {}

    // Fly from a node, at least until no flight to any of some others can be quicker.
    void fly_from(Int node, std::span<const Int> targets) {
        std::fill(flown_.begin(), flown_.end(), Flown{});
        std::fill(least_.begin(), least_.end(), Flown{});
        const Sights& outward = network_.outward;
        for (Int entry = outward.begin[node]; entry < outward.begin[node + 1]; ++entry) {
            Flown& there = to(outward.place[entry]);
            there = {outward.distance[entry], outward.duration[entry]};
            if (there.duration < nowhere) ahead_.push(there.duration, outward.place[entry]);
        }
        Ahead::Arrival arrival{};
        for (Int number = 0; ahead_.pop(arrival); ++number) {
            if (number % looks_back == 0 && arrival.time > longest_to(targets)) break;
            if (arrival.time > to(arrival.corner).duration) continue;
            land_from(arrival.corner);
            go_on_from(arrival.corner, arrival.time);
        }
        ahead_.clear();
    }

    const Flown& flown_to(Int target) const { return least_[static_cast<std::size_t>(target)]; }

private:
    static constexpr Int looks_back = 64;  // arrivals until it is looked whether all are reached

    Flown& to(Int corner) { return flown_[static_cast<std::size_t>(corner)]; }

    double longest_to(std::span<const Int> targets) const {
        double found = 0.0;
        for (const Int target : targets) {
            const bool is_seen = network_.inward.begin[target] < network_.inward.begin[target + 1];
            if (is_seen) found = std::max(found, flown_to(target).duration);
        }
        return found;
    }

    void land_from(Int corner) {
        const Flown here = to(corner);
        for (const auto& [node, entry] : beholders_.of(corner)) {
            const double total = here.duration + network_.inward.duration[entry];
            Flown& there = least_[static_cast<std::size_t>(node)];
            if (total < there.duration) {
                there = {here.distance + network_.inward.distance[entry], total};
            }
        }
    }

    void go_on_from(Int corner, double reached) {
        const Sights& between = network_.between;
        for (Int entry = between.begin[corner]; entry < between.begin[corner + 1]; ++entry) {
            const double total = reached + between.duration[entry];
            Flown& there = to(between.place[entry]);
            if (!(total < there.duration)) continue;
            there = {to(corner).distance + between.distance[entry], total};
            ahead_.push(total, between.place[entry]);
        }
    }

    const Network& network_;
    std::vector<Flown> flown_;  // (corner,)
    std::vector<Flown> least_;  // (node,)
    Beholders beholders_;
    Ahead ahead_;
};

// Write the quickest flights that bend at least once, those wanted of some rows. Where a flight
// back is as long as the flight there (`mutual`), each is worked out once.
void fly_around(const Network& network, View<const bool, 2> wanted, bool mutual, Int first,
                Int last, const FlightLegs& legs) {
    Reach reach(network);
    std::vector<Int> targets;
    for (Int node = first; node < last; ++node) {
        const View<const bool, 1> row = wanted[node];
        targets.clear();
        for (Int target = mutual ? node : 0; target < row.size(); ++target) {
            if (row[target]) targets.push_back(target);
        }
        if (targets.empty()) continue;
        reach.fly_from(node, targets);
        for (const Int target : targets) {
            legs.write(node, target, reach.flown_to(target));
            if (mutual) legs.write(target, node, reach.flown_to(target));
        }
    }
}

}  // namespace
}  // namespace tandem

extern "C" int tandem_fly_around(const tandem_sights* outward, const tandem_sights* between,
                                 const tandem_sights* inward, const tandem_bool_2d* wanted,
                                 bool mutual, int64_t first, int64_t last,
                                 const tandem_f64_2d* distance, const tandem_f64_2d* duration) {
    return tandem::guarded([&] {
        const tandem::Network network{tandem::sights_of(*outward), tandem::sights_of(*between),
                                      tandem::sights_of(*inward)};
        tandem::fly_around(network, *wanted, mutual, first, last, {*distance, *duration});
    });
}
