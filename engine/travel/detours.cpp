// The quickest ways around obstacles, by the corners that see one another.
//
// A flight that is not straight goes from its origin to a corner, from corner to corner, and from a
// corner to its target. Who sees whom is a table of rows of different lengths: the entries of row
// `i` are those from `begin[i]` up to `begin[i + 1]`.
#include <algorithm>
#include <functional>
#include <limits>
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

    // Take the soonest; false if there is none, and times begin anew.
    bool pop(Arrival& arrival) {
        while (soon_.empty()) {
            if (waiting_ == 0) {
                now_ = 0;
                return false;
            }
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

// The quickest flights from a node to all corners.
//
// Dijkstra (1959), a note on two problems in connexion with graphs, Numer. Math. 1:269-271.
class Reach {
public:
    explicit Reach(const Network& network)
        : network_(network),
          flown_(static_cast<std::size_t>(network.between.begin.size() - 1)),
          ahead_(std::max(longest(network.outward.duration), longest(network.between.duration))) {}

    // Let those of another node be there.
    void start_from(Int node) {
        std::fill(flown_.begin(), flown_.end(), Flown{});
        const Sights& outward = network_.outward;
        for (Int entry = outward.begin[node]; entry < outward.begin[node + 1]; ++entry) {
            Flown& there = to(outward.place[entry]);
            there = {outward.distance[entry], outward.duration[entry]};
            if (there.duration < nowhere) ahead_.push(there.duration, outward.place[entry]);
        }
        Ahead::Arrival arrival{};
        while (ahead_.pop(arrival)) {
            if (!(arrival.time > to(arrival.corner).duration)) {
                go_on_from(arrival.corner, arrival.time);
            }
        }
    }

    // The quickest flight to a node.
    Flown flown_to(Int target) {
        Flown least;
        const Sights& inward = network_.inward;
        for (Int entry = inward.begin[target]; entry < inward.begin[target + 1]; ++entry) {
            const Flown& here = to(inward.place[entry]);
            const double total = here.duration + inward.duration[entry];
            if (total < least.duration) least = {here.distance + inward.distance[entry], total};
        }
        return least;
    }

private:
    Flown& to(Int corner) { return flown_[static_cast<std::size_t>(corner)]; }

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
    Ahead ahead_;
};

// Write the quickest flights that bend at least once, those wanted of some rows. Where a flight
// back is as long as the flight there (`mutual`), each is worked out once.
void fly_around(const Network& network, View<const bool, 2> wanted, bool mutual, Int first,
                Int last, const FlightLegs& legs) {
    Reach reach(network);
    for (Int node = first; node < last; ++node) {
        const View<const bool, 1> row = wanted[node];
        const Int begin = mutual ? node : 0;
        if (std::none_of(row.begin() + begin, row.end(), std::identity{})) continue;
        reach.start_from(node);
        for (Int target = begin; target < row.size(); ++target) {
            if (!row[target]) continue;
            const Flown flown = reach.flown_to(target);
            legs.write(node, target, flown);
            if (mutual) legs.write(target, node, flown);
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
