// Who sees whom past obstacles.
//
// Obstacles are segments, the edges of areas that no line of sight may meet. They are filed under
// the cells of a grid that they cross, so that a line of sight is compared only with those on its
// way.
#include <cmath>
#include <limits>

#include "guard.h"
#include "travel/quarter.h"

namespace tandem {
namespace {

constexpr Int few_edges = 12;  // with no more, every line of sight is compared with all
constexpr Int nothing = -1;

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

// Edges by the cells that they cross.
class Grid {
public:
    explicit Grid(View<const double, 2> edges) : edges_(edges) {
        bound();
        begin_.assign(std::size_t(columns_ * rows_) + 1, 0);
        for_each_entry([&](Int cell, Int) { ++begin_[std::size_t(cell) + 1]; });
        for (std::size_t cell = 1; cell < begin_.size(); ++cell) begin_[cell] += begin_[cell - 1];
        entry_.resize(std::size_t(begin_.back()));
        std::vector<Int> next(begin_.begin(), begin_.end() - 1);
        for_each_entry(
            [&](Int cell, Int edge) { entry_[std::size_t(next[std::size_t(cell)]++)] = edge; });
    }

    // How many pairs of edges share a cell, so that they may cross.
    Int pairs_nearby() const {
        Int pairs = 0;
        for (std::size_t cell = 1; cell < begin_.size(); ++cell) {
            const Int count = begin_[cell] - begin_[cell - 1];
            pairs += count * (count - 1) / 2;
        }
        return pairs;
    }

    bool has_few() const { return edges_.size() <= few_edges; }

    // An edge that the line of sight between two points meets, or nothing.
    Int hiding(const Point2& here, const Point2& there) const {
        const Point2 to{there.x - here.x, there.y - here.y};
        Int found = nothing;
        if (has_few()) {
            for (Int edge = 0; edge < edges_.size() && found == nothing; ++edge) {
                if (meets(to, seen_from(here, edge))) found = edge;
            }
            return found;
        }
        any_cell(here, there, [&](Int cell) {
            const auto last = std::size_t(begin_[std::size_t(cell) + 1]);
            for (auto at = std::size_t(begin_[std::size_t(cell)]); at < last; ++at) {
                if (!meets(to, seen_from(here, entry_[at]))) continue;
                found = entry_[at];
                return true;
            }
            return false;
        });
        return found;
    }

    // Whether the line of sight between two points meets this edge.
    bool is_hiding(Int edge, const Point2& here, const Point2& there) const {
        return meets({there.x - here.x, there.y - here.y}, seen_from(here, edge));
    }

private:
    Edge seen_from(const Point2& here, Int edge) const {
        return {{edges_(edge, 0) - here.x, edges_(edge, 1) - here.y},
                {edges_(edge, 2) - here.x, edges_(edge, 3) - here.y}};
    }

    // As many square cells as there are edges, about.
    void bound() {
        Point2 high{-std::numeric_limits<double>::infinity(),
                    -std::numeric_limits<double>::infinity()};
        low_ = {-high.x, -high.y};
        for (Int edge = 0; edge < edges_.size(); ++edge) {
            for (const Int end : {Int{0}, Int{2}}) {
                low_ = {std::min(low_.x, edges_(edge, end)),
                        std::min(low_.y, edges_(edge, end + 1))};
                high = {std::max(high.x, edges_(edge, end)),
                        std::max(high.y, edges_(edge, end + 1))};
            }
        }
        if (edges_.empty()) low_ = high = {0.0, 0.0};
        const double width = high.x - low_.x;
        const double height = high.y - low_.y;
        const double count = double(std::max(edges_.size(), Int{1}));
        cell_ = std::max({std::sqrt(width * height / count), width / most_cells,
                          height / most_cells, narrowest});
        columns_ = std::min(Int(width / cell_) + 1, most_cells);
        rows_ = std::min(Int(height / cell_) + 1, most_cells);
    }

    template <typename Visit>
    void for_each_entry(const Visit& visit) const {
        for (Int edge = 0; edge < edges_.size(); ++edge) {
            any_cell({edges_(edge, 0), edges_(edge, 1)}, {edges_(edge, 2), edges_(edge, 3)},
                     [&](Int cell) {
                         visit(cell, edge);
                         return false;
                     });
        }
    }

    // Whether that is so of any cell that a segment crosses, row by row from its start on.
    template <typename Test>
    bool any_cell(const Point2& from, const Point2& to, const Test& test) const {
        const double pad = margin * cell_;
        const double lowest = std::min(from.y, to.y) - pad;
        const double highest = std::max(from.y, to.y) + pad;
        if (highest < low_.y || lowest > low_.y + cell_ * double(rows_)) return false;
        const Int bottom = within((lowest - low_.y) / cell_, rows_);
        const Int top = within((highest - low_.y) / cell_, rows_);
        const bool up = from.y <= to.y;
        const double slope = to.y == from.y ? 0.0 : (to.x - from.x) / (to.y - from.y);
        for (Int number = bottom; number <= top; ++number) {
            const Int row = up ? number : bottom + top - number;
            const double floor = low_.y + cell_ * double(row) - pad;
            const auto [left, right] = slope == 0.0
                                           ? Span{std::min(from.x, to.x), std::max(from.x, to.x)}
                                           : crossing(from, to, slope, floor);
            if (any_in_row(row, left - pad, right + pad, from.x <= to.x, test)) return true;
        }
        return false;
    }

    struct Span {
        double left, right;
    };

    // From where to where a segment lies within a row that begins at a height.
    Span crossing(const Point2& from, const Point2& to, double slope, double floor) const {
        const double ceiling = floor + cell_ * (1 + 2 * margin);
        const double low = std::clamp(floor, std::min(from.y, to.y), std::max(from.y, to.y));
        const double high = std::clamp(ceiling, std::min(from.y, to.y), std::max(from.y, to.y));
        const double one = from.x + slope * (low - from.y);
        const double other = from.x + slope * (high - from.y);
        return {std::min(one, other), std::max(one, other)};
    }

    template <typename Test>
    bool any_in_row(Int row, double left, double right, bool rightwards, const Test& test) const {
        if (right < low_.x || left > low_.x + cell_ * double(columns_)) return false;
        const Int first = within((left - low_.x) / cell_, columns_);
        const Int last = within((right - low_.x) / cell_, columns_);
        for (Int number = first; number <= last; ++number) {
            const Int column = rightwards ? number : first + last - number;
            if (test(row * columns_ + column)) return true;
        }
        return false;
    }

    static Int within(double place, Int count) {
        return Int(std::clamp(place, 0.0, double(count - 1)));
    }

    View<const double, 2> edges_;  // (edge, 4) x and y of both ends
    Point2 low_{};                 // corner of the grid
    double cell_ = 1.0;            // metres
    Int columns_ = 1, rows_ = 1;
    std::vector<Int> begin_;  // (cell + 1,) where its edges begin in `entry_`
    std::vector<Int> entry_;
};

// What hid the last that was looked at in each direction: it hides most others there, too.
class Screens {
public:
    explicit Screens(const Grid& grid) : grid_(grid) { last_.fill(nothing); }

    bool hide(const Point2& here, const Point2& there) {
        if (grid_.has_few()) return grid_.hiding(here, there) != nothing;
        Int& last = last_[direction(there.x - here.x, there.y - here.y)];
        if (last != nothing && grid_.is_hiding(last, here, there)) return true;
        const Int found = grid_.hiding(here, there);
        if (found != nothing) last = found;
        return found != nothing;
    }

private:
    static constexpr std::size_t directions = 1024;

    static std::size_t direction(double x, double y) {
        const double reach = std::abs(x) + std::abs(y);
        if (reach == 0) return 0;
        const double quarter = y / reach;  // grows from -1 to 1 on the right, and falls on the left
        const double turn = x >= 0 ? quarter + 1 : 3 - quarter;
        return std::min(std::size_t(turn * (directions / 4.0)), directions - 1);
    }

    const Grid& grid_;
    std::array<Int, directions> last_{};
};

// Who looks to whom: each start to all ends or, where the ends are the starts (`mutual`), to those
// behind it.
struct Looks {
    View<const double, 2> starts, ends;
    bool mutual;
};

// Mark the ends that some starts, from `first` to before `last`, don't see. Pairs that are marked
// already are not looked at.
void mark_hidden(const Looks& looks, const Grid& grid, View<bool, 2> hidden, Int first, Int last) {
    const auto& [starts, ends, mutual] = looks;
    Screens screens(grid);
    for (Int row = first; row < last; ++row) {
        for (Int column = mutual ? row + 1 : 0; column < ends.size(); ++column) {
            if (hidden(row, column)) continue;
            hidden(row, column) =
                screens.hide({starts(row, 0), starts(row, 1)}, {ends(column, 0), ends(column, 1)});
        }
    }
}

// Mark the corners that no shortest way from each of some starts bends at.
void mark_dead_ends(View<const double, 2> starts, const Corners& corners, double slack,
                    View<bool, 2> hidden, Int first, Int last) {
    for (Int row = first; row < last; ++row) {
        for (Int corner = 0; corner < corners.size(); ++corner) {
            const Corner there = corners[corner];
            const Point2 line{there.place.x - starts(row, 0), there.place.y - starts(row, 1)};
            if (is_dead_end(line, there, slack)) hidden(row, corner) = true;
        }
    }
}

// The corners and edges of which a quarter of all directions is looked at: to the north or,
// mirrored so that it is the north, to the east.
Quarter quarter_of(const Corners& corners, View<const double, 2> edges, bool is_east) {
    const auto seen = [&](const Point2& point) {
        return is_east ? Point2{point.y, point.x} : point;
    };
    std::vector<Corner> corner;
    corner.reserve(std::size_t(corners.size()));
    for (Int number = 0; number < corners.size(); ++number) {
        const auto [place, before, after] = corners[number];
        corner.push_back(
            {seen(place), seen(is_east ? after : before), seen(is_east ? before : after)});
    }
    std::vector<Edge> edge;
    edge.reserve(std::size_t(edges.size()));
    for (Int row = 0; row < edges.size(); ++row) {
        edge.push_back(
            {seen({edges(row, 0), edges(row, 1)}), seen({edges(row, 2), edges(row, 3)})});
    }
    return {corner, edge};
}

// Write pairs of corners that see each other and between which a shortest way may go, each once.
class SightsWriter {
public:
    SightsWriter(const Corners& corners, View<const double, 2> edges, double slack,
                 View<std::int32_t, 2> pairs)
        : corners_(corners), edges_(edges), grid_(edges), slack_(slack), pairs_(pairs) {}

    // Those in a quarter from corners in some places, as long as all of one surely have room.
    // Returns the place to go on with.
    Int write(bool is_east, Int first, Int last) {
        const Quarter quarter = quarter_of(corners_, edges_, is_east);
        Lookout lookout(quarter, slack_);
        Screens screens(grid_);
        Int place = first;
        for (; place < last && written_ + corners_.size() <= pairs_.size(); ++place) {
            const Int one = quarter.number(place);
            const Point2 here = corners_[one].place;
            lookout.for_each_seen(place, [&](Int seen) {
                const Int other = quarter.number(seen);
                const Point2 there = corners_[other].place;
                // What lies between the quarters, or in one place, is seen once.
                const double east = std::abs(there.x - here.x), north = std::abs(there.y - here.y);
                if (is_east ? east <= north : north == 0 && other <= one) return;
                if (screens.hide(here, there)) return;
                pairs_(written_, 0) = std::int32_t(one);
                pairs_(written_, 1) = std::int32_t(other);
                ++written_;
            });
        }
        return place;
    }

    Int written() const { return written_; }

private:
    const Corners& corners_;
    View<const double, 2> edges_;
    Grid grid_;
    double slack_;
    View<std::int32_t, 2> pairs_;
    Int written_ = 0;
};

}  // namespace
}  // namespace tandem

extern "C" int tandem_mark_hidden(const tandem_f64_2d* starts, const tandem_f64_2d* ends,
                                  const tandem_f64_2d* edges, const tandem_bool_2d* hidden,
                                  int64_t first, int64_t last, bool mutual) {
    return tandem::guarded([&] {
        const tandem::Grid grid(*edges);
        tandem::mark_hidden({*starts, *ends, mutual}, grid, *hidden, first, last);
    });
}

extern "C" int tandem_count_nearby(const tandem_f64_2d* edges, int64_t* pairs) {
    return tandem::guarded([&] { *pairs = tandem::Grid(*edges).pairs_nearby(); });
}

extern "C" int tandem_mark_dead_ends(const tandem_f64_2d* starts, const tandem_f64_2d* corners,
                                     const tandem_f64_2d* before, const tandem_f64_2d* after,
                                     double slack, const tandem_bool_2d* hidden, int64_t first,
                                     int64_t last) {
    return tandem::guarded([&] {
        tandem::mark_dead_ends(*starts, {*corners, *before, *after}, slack, *hidden, first, last);
    });
}

extern "C" int tandem_write_sights(const tandem_f64_2d* corners, const tandem_f64_2d* before,
                                   const tandem_f64_2d* after, const tandem_f64_2d* edges,
                                   double slack, bool is_east, int64_t first, int64_t last,
                                   const tandem_i32_2d* pairs, int64_t* written, int64_t* next) {
    return tandem::guarded([&] {
        const tandem::Corners all(*corners, *before, *after);
        tandem::SightsWriter writer(all, *edges, slack, *pairs);
        *next = writer.write(is_east, first, last);
        *written = writer.written();
    });
}
