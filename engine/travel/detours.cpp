// The quickest ways around obstacles, by the corners that see one another.
//
// A flight that is not straight goes from its origin to a corner, from corner to corner, and from a
// corner to its target. Who sees whom is a table of rows of different lengths: the entries of row
// `i` are those from `begin[i]` up to `begin[i + 1]`.
#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
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

// The quickest flights from a node to all corners.
//
// Dijkstra (1959), a note on two problems in connexion with graphs, Numer. Math. 1:269-271.
class Reach {
public:
    explicit Reach(const Network& network)
        : network_(network), flown_(static_cast<std::size_t>(network.between.begin.size() - 1)) {}

    // Let those of another node be there.
    void start_from(Int node) {
        std::fill(flown_.begin(), flown_.end(), Flown{});
        const Sights& outward = network_.outward;
        for (Int entry = outward.begin[node]; entry < outward.begin[node + 1]; ++entry) {
            Flown& there = to(outward.place[entry]);
            there = {outward.distance[entry], outward.duration[entry]};
            if (there.duration < nowhere) ahead_.emplace(there.duration, outward.place[entry]);
        }
        while (!ahead_.empty()) {
            const auto [reached, corner] = ahead_.top();
            ahead_.pop();
            if (!(reached > to(corner).duration)) go_on_from(corner, reached);
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
    using Arrival = std::pair<double, Int>;  // when, and at which corner

    Flown& to(Int corner) { return flown_[static_cast<std::size_t>(corner)]; }

    void go_on_from(Int corner, double reached) {
        const Sights& between = network_.between;
        for (Int entry = between.begin[corner]; entry < between.begin[corner + 1]; ++entry) {
            const double total = reached + between.duration[entry];
            Flown& there = to(between.place[entry]);
            if (!(total < there.duration)) continue;
            there = {to(corner).distance + between.distance[entry], total};
            ahead_.emplace(total, between.place[entry]);
        }
    }

    const Network& network_;
    std::vector<Flown> flown_;  // (corner,)
    std::priority_queue<Arrival, std::vector<Arrival>, std::greater<>> ahead_;
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
