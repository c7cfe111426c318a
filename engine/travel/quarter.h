// What is seen from corners of obstacles in a quarter of all directions, from northwest to
// northeast.
//
// A way that leads there is told by its slope: how far east it gets for every metre north. Edges
// are cut where rows of a grid begin, so that all of a row is nearer than what the next one has.
// Row by row, the slopes become fewer at which the view is open, until none is left: all that lies
// behind isn't looked at.
#pragma once

#include <vector>

#include "travel/corners.h"

namespace tandem {

// Slopes from one to another, both of them included.
struct Slopes {
    double from, to;
};

// Corners and edges, row by row in the cells of a grid.
class Quarter {
public:
    Quarter(const std::vector<Corner>& corners, const std::vector<Edge>& edges);

    Int size() const { return Int(number_.size()); }

    // The number of the corner in a place.
    Int number(Int place) const { return number_[std::size_t(place)]; }

    const Corner& corner(Int place) const { return corner_[std::size_t(place)]; }

    Int rows() const { return rows_; }

    Int row_of(double y) const { return within((y - low_.y) / cell_, rows_); }

    // Columns of a row, from the first to the last.
    struct Columns {
        Int first = 0, last = -1;

        bool is_empty() const { return first > last; }
    };

    // The columns in which a way from a place may cross a row that has some slope.
    Columns columns_seen(const Point2& from, Int row, const Slopes& slopes) const;

    // Visit the places of the corners in some columns of a row.
    template <typename Visit>
    void for_each_corner(Int row, const Columns& columns, const Visit& visit) const {
        const auto [begin, end] = cells(row, columns);
        for (Int place = corner_begin_[begin]; place < corner_begin_[end]; ++place) visit(place);
    }

    // Visit the parts of edges that lie in a row and cross some of its columns. Their ends `a` are
    // not north of their ends `b`.
    template <typename Visit>
    void for_each_part(Int row, const Columns& columns, const Visit& visit) const {
        const auto [begin, end] = cells(row, columns);
        for (auto part = std::size_t(part_begin_[begin]); part < std::size_t(part_begin_[end]);
             ++part) {
            visit(part_[part]);
        }
    }

private:
    struct Cells {
        std::size_t begin, end;
    };

    Cells cells(Int row, const Columns& columns) const {
        return {std::size_t(row * columns_ + columns.first),
                std::size_t(row * columns_ + columns.last + 1)};
    }

    static Int within(double place, Int count) {
        return Int(std::clamp(place, 0.0, double(count - 1)));
    }

    double floor_of(Int row) const { return low_.y + cell_ * double(row); }

    Int column_of(double x) const { return within((x - low_.x) / cell_, columns_); }

    void bound(const std::vector<Corner>& corners, std::size_t num_edges);
    void file_corners(const std::vector<Corner>& corners);
    void file_parts(const std::vector<Edge>& edges);

    template <typename Visit>
    void for_each_cell(const Edge& edge, const Visit& visit) const;

    Point2 low_{};       // corner of the grid
    double cell_ = 1.0;  // metres
    Int columns_ = 1, rows_ = 1;
    std::vector<Int> corner_begin_;  // (cell + 1,) where its corners begin
    std::vector<Int> number_;        // (place,)
    std::vector<Corner> corner_;     // (place,)
    std::vector<Int> part_begin_;    // (cell + 1,) where its parts of edges begin
    std::vector<Edge> part_;
};

// Looks from one corner after another.
class Lookout {
public:
    Lookout(const Quarter& quarter, double slack) : quarter_(quarter), slack_(slack) {}

    // Visit the places of the corners to which a shortest way may lead straight from that in a
    // place, with those of few others that are hidden.
    template <typename Visit>
    void for_each_seen(Int place, const Visit& visit) {
        const Corner& here = quarter_.corner(place);
        open_wedge(here);
        for (Int row = quarter_.row_of(here.place.y); row < quarter_.rows(); ++row) {
            seen_.clear();
            bool is_inside = false;
            for (const Slopes& slopes : open_) {
                const auto columns = quarter_.columns_seen(here.place, row, slopes);
                seen_.push_back(columns);
                if (columns.is_empty()) continue;
                is_inside = true;
                quarter_.for_each_corner(row, columns, [&](Int other) {
                    if (may_lead_to(here, quarter_.corner(other), slopes)) visit(other);
                });
            }
            // What has left the grid doesn't come back.
            if (!is_inside) return;
            for (const auto& columns : seen_) {
                if (columns.is_empty()) continue;
                quarter_.for_each_part(row, columns,
                                       [&](const Edge& part) { close_behind(here.place, part); });
            }
        }
    }

private:
    bool may_lead_to(const Corner& here, const Corner& there, const Slopes& slopes) const {
        const Point2 line{there.place.x - here.place.x, there.place.y - here.place.y};
        return line.y >= 0 && line.x >= slopes.from * line.y && line.x <= slopes.to * line.y &&
               !is_dead_end(line, here, slack_) && !is_dead_end(line, there, slack_);
    }

    void open_wedge(const Corner& corner);
    void close_behind(const Point2& here, const Edge& part);
    void close(double from, double to);

    const Quarter& quarter_;
    double slack_;
    std::vector<Slopes> open_;            // in their order, apart from each other
    std::vector<Quarter::Columns> seen_;  // of a row, for each range that was open
};

}  // namespace tandem
