#include "travel/quarter.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace tandem {
namespace {

constexpr double nearest = 1e-3;      // metres north within which nothing hides what is behind
constexpr double rounding = 1e-9;     // radians by which wedges are widened
constexpr std::size_t most_open = 4;  // ranges of slopes: more take longer than they save
constexpr double endless = std::numeric_limits<double>::infinity();
constexpr double half_turn = std::numbers::pi;

struct Range {
    double low = endless, high = -endless;

    void include(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }

    double length() const { return std::max(high - low, 0.0); }
};

// Within which angle of an edge a line runs that leaves its end no farther than some slack beside
// it; endless if all do.
double slack_angle(const Point2& edge, double slack) {
    const double length = std::hypot(edge.x, edge.y);
    return length > slack ? std::asin(slack / length) + rounding : endless;
}

// Where a line with an edge's ends gets to, so far north.
double x_at(const Edge& edge, double y) {
    return edge.a.x + (edge.b.x - edge.a.x) * ((y - edge.a.y) / (edge.b.y - edge.a.y));
}

// Sums of counts that stand one behind, in place: where each cell's entries begin.
void add_up(std::vector<Int>& counts) {
    for (std::size_t cell = 1; cell < counts.size(); ++cell) counts[cell] += counts[cell - 1];
}

}  // namespace

Quarter::Quarter(const std::vector<Corner>& corners, const std::vector<Edge>& edges) {
    bound(corners, edges.size());
    file_corners(corners);
    file_parts(edges);
}

// As many square cells as there are edges, about.
void Quarter::bound(const std::vector<Corner>& corners, std::size_t num_edges) {
    Range x, y;
    for (const Corner& corner : corners) {
        x.include(corner.place.x);
        y.include(corner.place.y);
    }
    if (!corners.empty()) low_ = {x.low, y.low};
    const double count = double(std::max(num_edges, std::size_t{1}));
    cell_ = std::max({std::sqrt(x.length() * y.length() / count), x.length() / most_cells,
                      y.length() / most_cells, narrowest});
    columns_ = std::min(Int(x.length() / cell_) + 1, most_cells);
    rows_ = std::min(Int(y.length() / cell_) + 1, most_cells);
}

void Quarter::file_corners(const std::vector<Corner>& corners) {
    corner_begin_.assign(std::size_t(columns_ * rows_) + 1, 0);
    const auto cell_of = [&](const Corner& corner) {
        const Int column = column_of(corner.place.x);
        return std::size_t(row_of(corner.place.y) * columns_ + column);
    };
    for (const Corner& corner : corners) ++corner_begin_[cell_of(corner) + 1];
    add_up(corner_begin_);
    number_.resize(corners.size());
    corner_.resize(corners.size());
    std::vector<Int> next(corner_begin_.begin(), corner_begin_.end() - 1);
    for (std::size_t number = 0; number < corners.size(); ++number) {
        const auto place = std::size_t(next[cell_of(corners[number])]++);
        number_[place] = Int(number);
        corner_[place] = corners[number];
    }
}

void Quarter::file_parts(const std::vector<Edge>& edges) {
    part_begin_.assign(std::size_t(columns_ * rows_) + 1, 0);
    const auto for_each = [&](const auto& visit) {
        for (const Edge& edge : edges) {
            for_each_cell(edge.a.y <= edge.b.y ? edge : Edge{edge.b, edge.a}, visit);
        }
    };
    for_each([&](std::size_t cell, const Edge&) { ++part_begin_[cell + 1]; });
    add_up(part_begin_);
    part_.resize(std::size_t(part_begin_.back()));
    std::vector<Int> next(part_begin_.begin(), part_begin_.end() - 1);
    for_each([&](std::size_t cell, const Edge& part) { part_[std::size_t(next[cell]++)] = part; });
}

// Visit the cells that an edge crosses, each with its part in that row. Parts of one edge in two
// rows meet in one point.
template <typename Visit>
void Quarter::for_each_cell(const Edge& edge, const Visit& visit) const {
    const Int top = row_of(edge.b.y);
    Edge part = edge;
    for (Int row = row_of(edge.a.y); row <= top; ++row) {
        const double ceiling = floor_of(row + 1);
        part.b = row == top || ceiling >= edge.b.y ? edge.b : Point2{x_at(edge, ceiling), ceiling};
        const Int last = column_of(std::max(part.a.x, part.b.x));
        for (Int column = column_of(std::min(part.a.x, part.b.x)); column <= last; ++column) {
            visit(std::size_t(row * columns_ + column), part);
        }
        part.a = part.b;
    }
}

Quarter::Columns Quarter::columns_seen(const Point2& from, Int row, const Slopes& slopes) const {
    const double pad = margin * cell_;
    const double begin = std::max(floor_of(row) - from.y - pad, 0.0);
    const double end = floor_of(row + 1) - from.y + pad;
    const double left = from.x + slopes.from * (slopes.from < 0 ? end : begin) - pad;
    const double right = from.x + slopes.to * (slopes.to < 0 ? begin : end) + pad;
    if (left > low_.x + cell_ * double(columns_ + 1) || right < low_.x - cell_) {
        return {};
    }
    return {column_of(left), column_of(right)};
}

// Open the view to all ways that may bend at a corner, and hardly any others.
void Lookout::open_wedge(const Corner& corner) {
    open_.assign(1, {-1.0, 1.0});
    const Point2 to{-corner.before.x, -corner.before.y};
    const Point2& away = corner.after;
    const double turn = std::atan2(to.x * away.y - to.y * away.x, to.x * away.x + to.y * away.y);
    const double more = slack_angle(to, slack_);
    const double wide = turn + more + slack_angle(away, slack_);
    // What turns right is no convex corner of one area.
    if (turn <= 0 || !(wide < half_turn)) return;
    // Slopes fall as ways turn left, from due east.
    double right = std::atan2(to.y, to.x) - more;
    right -= std::floor(right / half_turn) * half_turn;
    const auto slope = [](double angle) {
        // Exactly, at the bounds of the quarter, or what lies there would be lost.
        if (angle <= half_turn / 4) return 1.0;
        return angle >= 3 * half_turn / 4 ? -1.0 : 1.0 / std::tan(angle);
    };
    const double left = right + wide;
    if (left <= half_turn) {
        close(-2.0, slope(left));
        close(slope(right), 2.0);
    } else {
        close(slope(right), slope(left - half_turn));
    }
}

// Close what lies behind a part of an edge.
void Lookout::close_behind(const Point2& here, const Edge& part) {
    Edge seen{{part.a.x - here.x, part.a.y - here.y}, {part.b.x - here.x, part.b.y - here.y}};
    if (seen.b.y <= nearest) return;
    if (seen.a.y < nearest) seen.a = {x_at(seen, nearest), nearest};
    const double one = seen.a.x / seen.a.y;
    const double other = seen.b.x / seen.b.y;
    close(std::min(one, other), std::max(one, other));
}

// Close all slopes between two.
void Lookout::close(double from, double to) {
    const auto first = std::find_if(open_.begin(), open_.end(),
                                    [&](const Slopes& slopes) { return slopes.to > from; });
    const auto end =
        std::find_if(first, open_.end(), [&](const Slopes& slopes) { return slopes.from >= to; });
    if (first == end || !(from < to)) return;
    const Slopes left{first->from, from};
    const Slopes right{to, std::prev(end)->to};
    if (open_.size() >= most_open && end - first == 1 && left.from < left.to &&
        right.from < right.to) {
        return;
    }
    const auto next = open_.erase(first, end);
    const auto behind = right.from < right.to ? open_.insert(next, right) : next;
    if (left.from < left.to) open_.insert(behind, left);
}

}  // namespace tandem
