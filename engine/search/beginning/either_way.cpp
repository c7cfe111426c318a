// Savings where routes may be driven either way, and loads alone limit them.
//
// Pairs of near neighbours come first. Routes that are not full once all near their end are served
// go on to whomever that saves most, wherever he is: as if all pairs had been looked at, so that
// what serves places far away has room for nobody on the way there. By neighbours alone, those
// places take as much room of more vehicles, and no search of small changes mends that.
#include <cmath>
#include <queue>

#include "rules/shift.h"
#include "search/beginning/savings.h"

namespace tandem {

namespace {

// A customer at the end of a route, whom it is joined to by what that costs more, as a rule less
// than 0; before anybody was looked for, nobody.
struct Extension {
    Int excess, end, other;
};

// Those that cost least come first; of equals, those of lower numbers.
struct CostsMore {
    bool operator()(const Extension& one, const Extension& other) const {
        return one.excess != other.excess ? one.excess > other.excess : one.end > other.end;
    }
};

// Customers whose numbers follow each other, and who mostly are near each other.
struct Block {
    Int first, size;  // ends of routes among them
    Int middle;       // one of them
    Int radius;       // how far others are from there
    Int farthest;     // how far ends are from the depot at most
};

// Routes that become longer at either end.
class EitherWay {
public:
    EitherWay(const ProblemData& data, Int k)
        : data_(data),
          type_(data.type[k]),
          legs_(legs_of(data.leg, type_.travel)),
          joining_(data),
          size_(std::max(Int{1}, Int(std::sqrt(double(data.num_nodes))))),
          home_({data.num_nodes}),
          ends_({data.num_nodes}) {
        for (Int node = data.num_depots; node < data.num_nodes; ++node) {
            Chain& link = chain()[node];
            link.before = link.behind = nowhere;
            link.route = node;
            link.length = 1;
            set_up_cargo(data, node, cargo()[node]);
            home_[node] = leg(legs_, type_.begins_at, node).distance;
        }
        list_ends(k);
    }

    // Joins pairs in order, and other ends of routes in between.
    void join_all(Int ranks, View<const Int, 1> keys) {
        wait_for_last(ranks);
        for (const Int key : keys) {
            data_.deadline.go_on_late();
            const auto [a, b] = pair(data_, ranks, key);
            extend_until(excess_of(a, b));
            join(a, b);
        }
        extend_until(0);
    }

    // Writes who comes before and behind each.
    void write(const Beside& beside) {
        for (Int node = data_.num_depots; node < data_.num_nodes; ++node) {
            chain()[node].last = nowhere;
        }
        for (Int node = data_.num_depots; node < data_.num_nodes; ++node) {
            if (chain()[node].last == nowhere && !is_amid(node)) set_out(node);
        }
        joining_.write(beside);
    }

private:
    View<Chain, 1> chain() const { return joining_.chain; }
    View<Cargo, 2> cargo() const { return joining_.cargo; }

    // How much more is driven if two follow one another.
    Int excess_of(Int a, Int b) const { return leg(legs_, a, b).distance - home_[a] - home_[b]; }

    // Whether a customer has one beside him on both sides.
    bool is_amid(Int node) const {
        return chain()[node].before != nowhere && chain()[node].behind != nowhere;
    }

    // The customer who stands for a route; shortens the way there.
    //
    // References: Tarjan and van Leeuwen (1984), worst-case analysis of set union algorithms,
    // Journal of the ACM 31:245-281.
    Int route_of(Int node) const {
        while (chain()[node].route != node) {
            node = chain()[node].route = chain()[chain()[node].route].route;
        }
        return node;
    }

    // Whether a vehicle may serve two routes, who stand for them, as one.
    bool may_become_one(Int one, Int other) const {
        return one != other && allows_stops(type_, chain()[one].length + chain()[other].length) &&
               may_join(type_, cargo()[one], cargo()[other]);
    }

    // Whether a route has no room for anybody.
    bool is_full(Int route) const {
        return !allows_stops(type_, chain()[route].length + 1) ||
               !holds(type_, plus(cargo()(route, 0).most, least_));
    }

    void join(Int a, Int b) {
        if (is_amid(a) || is_amid(b)) return;
        const Int one = route_of(a), other = route_of(b);
        if (!may_become_one(one, other)) return;
        chain()[other].route = one;
        chain()[one].length += chain()[other].length;
        add_cargo(cargo()[one], cargo()[other]);
        link_to(a, b);
        link_to(b, a);
    }

    // Puts a customer beside one who has room there.
    void link_to(Int at, Int node) {
        Chain& link = chain()[at];
        (link.before == nowhere ? link.before : link.behind) = node;
    }

    // Turns all on a route so that it begins with one at its end.
    void set_out(Int node) {
        for (Int before = nowhere; node != nowhere;) {
            Chain& link = chain()[node];
            const Int behind = link.behind == before ? link.before : link.behind;
            link.before = before;
            link.behind = behind;
            link.last = node;
            before = node;
            node = behind;
        }
    }

    // Lists all whom the type may serve, in blocks, and the least that any of them is brought.
    void list_ends(Int k) {
        least_ = {far, far, far};
        for (Int first = data_.num_depots; first < data_.num_nodes; first += size_) {
            const Int behind = std::min(first + size_, data_.num_nodes);
            Block block{first, 0, first + (behind - first) / 2, 0, 0};
            for (Int node = first; node < behind; ++node) {
                if (!data_.can(k, 0, node)) continue;
                ends_[first + block.size++] = node;
                block.radius = std::max(block.radius, leg(legs_, block.middle, node).distance);
                block.farthest = std::max(block.farthest, home_[node]);
                const Amount demand = cargo()(node, 0).most;
                for (std::size_t axis = 0; axis < demand.size(); ++axis) {
                    least_[axis] = std::min(least_[axis], demand[axis]);
                }
            }
            blocks_.push_back(block);
        }
    }

    // Lets each customer wait until all neighbours have been tried, which are sorted by how far
    // they are; none, who has all.
    void wait_for_last(Int ranks) {
        if (ranks >= data_.num_nodes - data_.num_depots - 1) return;
        for (const Block& block : blocks_) {
            for (Int index = block.first; index < block.first + block.size; ++index) {
                const Int node = ends_[index];
                Int most = std::numeric_limits<Int>::min();
                for (Int rank = 0; rank < ranks; ++rank) {
                    const Int other = data_.near(node, rank);
                    if (other >= 0) most = std::max(most, excess_of(node, other));
                }
                waiting_.push({std::min(most, Int{0}), node, nowhere});
            }
        }
    }

    // Joins ends of routes to whomever they should be, as long as that costs less than so much.
    void extend_until(Int excess) {
        while (!waiting_.empty() && waiting_.top().excess < excess) {
            const Extension next = waiting_.top();
            waiting_.pop();
            if (is_amid(next.end)) continue;
            const Int route = route_of(next.end);
            if (is_full(route)) continue;
            if (next.other != nowhere && !is_amid(next.other) &&
                may_become_one(route, route_of(next.other))) {
                join(next.end, next.other);
                continue;
            }
            data_.deadline.go_on_late();
            const Extension found = best_for(next.end, route);
            if (found.other != nowhere) waiting_.push(found);
        }
    }

    // Whom an end of a route is best joined to; nobody if that saves nothing.
    Extension best_for(Int end, Int route) {
        Extension best{0, end, nowhere};
        const Int number = Int(blocks_.size());
        const Int own = (end - data_.num_depots) / size_;
        for (Int index = 0; index < number; ++index) {
            Block& block = blocks_[std::size_t((own + index) % number)];
            if (block.size == 0) continue;
            const Int away = leg(legs_, end, block.middle).distance - block.radius;
            if (std::max(away, Int{0}) - home_[end] - block.farthest >= best.excess) continue;
            look_among(block, route, best);
        }
        return best;
    }

    // Looks for a better one among ends, and lists no more who isn't.
    void look_among(Block& block, Int route, Extension& best) {
        Int left = block.first;
        block.farthest = 0;
        for (Int index = block.first; index < block.first + block.size; ++index) {
            const Int node = ends_[index];
            if (is_amid(node)) continue;
            const Int other = route_of(node);
            if (is_full(other)) continue;
            ends_[left++] = node;
            block.farthest = std::max(block.farthest, home_[node]);
            const Int excess = excess_of(best.end, node);
            if (excess < best.excess && may_become_one(route, other)) {
                best.excess = excess;
                best.other = node;
            }
        }
        block.size = left - block.first;
    }

    const ProblemData& data_;
    const VehicleType& type_;
    const TravelLegs legs_;
    const ChainCargo joining_;
    const Int size_;              // of a block
    const OwnRows<Int, 1> home_;  // (node,) how far the depot is
    const OwnRows<Int, 1> ends_;  // (number,) ends of routes, by blocks
    std::vector<Block> blocks_;
    Amount least_;  // that a customer is brought
    std::priority_queue<Extension, std::vector<Extension>, CostsMore> waiting_;
};

}  // namespace

void join_either_way(const ProblemData& data, Int k, Int ranks, View<const Int, 1> keys,
                     const Beside& beside) {
    EitherWay routes(data, k);
    routes.join_all(ranks, keys);
    routes.write(beside);
}

}  // namespace tandem
