// Who sees whom past obstacles.
//
// Obstacles are segments, the edges of areas that no line of sight may meet. Seen from one point,
// each edge covers a range of angles; it is filed under the few nodes of a binary tree over all
// angles that make up its range, so that a line of sight is compared only with the edges on its
// way.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "guard.h"
#include "travel/sights.h"

namespace tandem {
namespace {

constexpr Int levels = 10;
constexpr Int leaves = Int{1} << levels;  // of the tree of angles
constexpr Int few_edges = 12;             // with no more, every line of sight is compared with all
constexpr double narrowest = 1e-9;        // range of angles divided: below, rounding would decide
constexpr double margin = 0.01;           // share of a leaf by which an edge's range is widened
constexpr Int outside = -1;

struct Point2 {
    double x, y;
};

// From one point to another.
struct Edge {
    Point2 a, b;
};

// The angles that an edge covers, from high to low where it lies across the end of angles.
struct Range {
    double low, high;
};

// Where angles end: opposite to a direction towards the edges, so that few lie across it.
Point2 middle(const std::vector<Edge>& seen) {
    double x = 0.0;
    double y = 0.0;
    for (const Edge& edge : seen) {
        x += edge.a.x;
        y += edge.a.y;
    }
    const double length = std::sqrt(x * x + y * y);
    return length > 0 ? Point2{x / length, y / length} : Point2{1.0, 0.0};
}

// What grows with the angle from the centre: 0 there, 1 at a right one, -2 to 2.
double angle_of(const Point2& to, const Point2& centre) {
    const double along = to.x * centre.x + to.y * centre.y;
    const double across = to.y * centre.x - to.x * centre.y;
    const double reach = std::abs(along) + std::abs(across);
    if (reach == 0) return 0.0;
    const double share = across / reach;
    if (along >= 0) return share;
    return across >= 0 ? 2.0 - share : -2.0 - share;
}

// Whether the segment from the origin to a point meets an edge.
bool meets(const Point2& to, const Edge& edge) {
    const auto& [a, b] = edge;
    if (std::max(a.x, b.x) < std::min(0.0, to.x) || std::min(a.x, b.x) > std::max(0.0, to.x) ||
        std::max(a.y, b.y) < std::min(0.0, to.y) || std::min(a.y, b.y) > std::max(0.0, to.y)) {
        return false;
    }
    const double side_a = to.x * a.y - to.y * a.x;
    const double side_b = to.x * b.y - to.y * b.x;
    if ((side_a > 0 && side_b > 0) || (side_a < 0 && side_b < 0)) return false;
    const Point2 along{b.x - a.x, b.y - a.y};
    const double side_origin = along.y * a.x - along.x * a.y;
    const double side_end = along.x * (to.y - a.y) - along.y * (to.x - a.x);
    return !((side_origin > 0 && side_end > 0) || (side_origin < 0 && side_end < 0));
}

// Edges as seen from one point, filed by angle where there are many.
class Panorama {
public:
    explicit Panorama(View<const double, 2> edges)
        : edges_(edges), seen_(static_cast<std::size_t>(edges.size())) {}

    // Look from a point.
    void look_from(const Point2& here) {
        for (Int row = 0; row < edges_.size(); ++row) {
            seen_[static_cast<std::size_t>(row)] = {
                {edges_(row, 0) - here.x, edges_(row, 1) - here.y},
                {edges_(row, 2) - here.x, edges_(row, 3) - here.y}};
        }
        if (!has_few()) file();
    }

    // Whether the line of sight to what lies there meets an edge.
    bool hides(const Point2& to) const {
        if (has_few()) {
            return std::any_of(seen_.begin(), seen_.end(),
                               [&](const Edge& edge) { return meets(to, edge); });
        }
        const Int leaf = leaf_of(angle_of(to, centre_));
        if (leaf == outside) return false;
        for (Int node = leaf + leaves; node > 0; node >>= 1) {
            for (Int entry = heads_[static_cast<std::size_t>(node)]; entry >= 0;) {
                const Filed& filed = filed_[static_cast<std::size_t>(entry)];
                if (meets(to, seen_[filed.edge])) return true;
                entry = filed.next;
            }
        }
        return false;
    }

private:
    // An edge in the list of a node of the tree.
    struct Filed {
        std::size_t edge;
        Int next;
    };

    bool has_few() const { return edges_.size() <= few_edges; }

    void file() {
        heads_.fill(-1);
        filed_.clear();
        centre_ = middle(seen_);
        write_ranges();
        for (std::size_t edge = 0; edge < seen_.size(); ++edge) {
            const auto [low, high] = ranges_[edge];
            const double begin = (low - lowest_) * scale_ - margin;
            const double end = (high - lowest_) * scale_ + margin;
            if (low > high) {
                file(edge, begin, static_cast<double>(leaves));
                file(edge, 0.0, end);
            } else {
                file(edge, begin, end);
            }
        }
    }

    void write_ranges() {
        ranges_.clear();
        lowest_ = 2.0;
        double highest = -2.0;
        for (const Edge& edge : seen_) {
            const double one = angle_of(edge.a, centre_);
            const double other = angle_of(edge.b, centre_);
            const double low = std::min(one, other);
            const double high = std::max(one, other);
            if (high - low <= 2.0 - 1e-6) {
                ranges_.push_back({low, high});
                lowest_ = std::min(lowest_, low);
                highest = std::max(highest, high);
                continue;
            }
            // It passes behind, or so near that it can't be told on which side.
            const bool near = high - low < 2.0 + 1e-6;
            ranges_.push_back(near ? Range{-2.0, 2.0} : Range{high, low});
            lowest_ = -2.0;
            highest = 2.0;
        }
        scale_ = static_cast<double>(leaves) / std::max(highest - lowest_, narrowest);
    }

    // File an edge under all nodes of the tree that make up its range, in leaves.
    void file(std::size_t edge, double begin, double end) {
        Int left = within(begin) + leaves;
        Int right = within(end) + leaves + 1;
        for (; left < right; left >>= 1, right >>= 1) {
            if (left & 1) put(edge, left++);
            if (right & 1) put(edge, --right);
        }
    }

    void put(std::size_t edge, Int node) {
        Int& head = heads_[static_cast<std::size_t>(node)];
        filed_.push_back({edge, head});
        head = static_cast<Int>(filed_.size()) - 1;
    }

    static Int within(double place) {
        return std::clamp(static_cast<Int>(place), Int{0}, leaves - 1);
    }

    // The leaf of an angle, or `outside` if no edge is there.
    Int leaf_of(double angle) const {
        const double place = (angle - lowest_) * scale_;
        if (place < -margin || place > static_cast<double>(leaves) + margin) return outside;
        return within(place);
    }

    View<const double, 2> edges_;  // (edge, 4) x and y of both ends
    std::vector<Edge> seen_;
    std::vector<Range> ranges_;  // (edge,)
    std::vector<Filed> filed_;
    std::array<Int, 2 * leaves> heads_{};  // (node,) the first that is filed there
    Point2 centre_{};
    double lowest_ = 0.0;  // angle of all edges
    double scale_ = 0.0;   // leaves per angle
};

// Mark the ends that each of some starts doesn't see. Pairs that are marked already are not looked
// at, and only the ends behind each start where the ends are the starts (`mutual`).
void mark_hidden(View<const double, 2> starts, View<const double, 2> ends, Panorama& panorama,
                 View<bool, 2> hidden, Int first, Int last, bool mutual) {
    for (Int row = first; row < last; ++row) {
        const Point2 here{starts(row, 0), starts(row, 1)};
        panorama.look_from(here);
        for (Int column = mutual ? row + 1 : 0; column < ends.size(); ++column) {
            if (hidden(row, column)) continue;
            hidden(row, column) =
                panorama.hides({ends(column, 0) - here.x, ends(column, 1) - here.y});
        }
    }
}

// Corners, and their neighbours on their area's boundary: (corner, 2) each.
struct Corners {
    View<const double, 2> place, before, after;
};

// Mark the corners that no shortest way from each of some starts bends at.
//
// Such a way leaves the area on one side: if the line through a start and a corner has the corner's
// two edges on different sides, by more than some slack, the way may be cut short there.
void mark_dead_ends(View<const double, 2> starts, const Corners& corners, double slack,
                    View<bool, 2> hidden, Int first, Int last) {
    const auto& [place, before, after] = corners;
    for (Int row = first; row < last; ++row) {
        for (Int corner = 0; corner < place.size(); ++corner) {
            const double x = place(corner, 0) - starts(row, 0);
            const double y = place(corner, 1) - starts(row, 1);
            const auto side = [&](View<const double, 2> of) {
                return x * (of(corner, 1) - place(corner, 1)) -
                       y * (of(corner, 0) - place(corner, 0));
            };
            const double near = slack * std::sqrt(x * x + y * y);
            const double one = side(before);
            const double other = side(after);
            if ((one > near && other < -near) || (one < -near && other > near)) {
                hidden(row, corner) = true;
            }
        }
    }
}

}  // namespace
}  // namespace tandem

extern "C" int tandem_mark_hidden(const tandem_f64_2d* starts, const tandem_f64_2d* ends,
                                  const tandem_f64_2d* edges, const tandem_bool_2d* hidden,
                                  int64_t first, int64_t last, bool mutual) {
    return tandem::guarded([&] {
        tandem::Panorama panorama(*edges);
        tandem::mark_hidden(*starts, *ends, panorama, *hidden, first, last, mutual);
    });
}

extern "C" int tandem_mark_dead_ends(const tandem_f64_2d* starts, const tandem_f64_2d* corners,
                                     const tandem_f64_2d* before, const tandem_f64_2d* after,
                                     double slack, const tandem_bool_2d* hidden, int64_t first,
                                     int64_t last) {
    return tandem::guarded([&] {
        tandem::mark_dead_ends(*starts, {*corners, *before, *after}, slack, *hidden, first, last);
    });
}
