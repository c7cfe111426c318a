// The nearest of points that lie in cells of a k-d tree.
//
// Friedman, Bentley and Finkel (1977), an algorithm for finding best matches in logarithmic
// expected time, ACM Transactions on Mathematical Software 3:209-226.
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "guard.h"
#include "travel/sights.h"

namespace tandem {
namespace {

// Points found before those too far are sorted out again.
constexpr Int spare = 64;

struct Found {
    double away;  // squared
    std::int32_t number;

    friend bool operator<(const Found& one, const Found& other) {
        return std::tie(one.away, one.number) < std::tie(other.away, other.number);
    }
};

// A cell to be looked into, and how far it is, squared.
struct Waiting {
    Int cell;
    double away;
};

// The squared distance from a point to a cell.
double to_cell(const Cells& cells, Int place, Int cell) {
    double square = 0.0;
    for (Int axis = 0; axis < cells.point.shape(1); ++axis) {
        const double at = cells.point(place, axis);
        const double beyond =
            std::max({cells.low(cell, axis) - at, at - cells.high(cell, axis), 0.0});
        square += beyond * beyond;
    }
    return square;
}

// The squared distance between two points.
double to_point(const Cells& cells, Int place, Int other) {
    double square = 0.0;
    for (Int axis = 0; axis < cells.point.shape(1); ++axis) {
        const double difference = cells.point(place, axis) - cells.point(other, axis);
        square += difference * difference;
    }
    return square;
}

// Finds the nearest points, for one after another.
class Finder {
public:
    Finder(const Cells& cells, Int ranks)
        : cells_(cells), ranks_(ranks), found_(std::size_t(ranks + spare)) {}

    // The points nearest to that in a place, nearest first; of those equally far, lower numbers
    // come first.
    const std::vector<Found>& nearest(Int place) {
        count_ = 0;
        reach_ = std::numeric_limits<double>::infinity();
        waiting_.assign(1, {0, 0.0});
        while (!waiting_.empty()) {
            const auto [cell, away] = waiting_.back();
            waiting_.pop_back();
            if (away < reach_) look_into(place, descend(place, cell));
        }
        part();
        std::sort(found_.begin(), found_.begin() + ranks_);
        return found_;
    }

private:
    // Go down to the cell of points that is nearest, and let the others wait.
    Int descend(Int place, Int cell) {
        while (cells_.half(cell, 0) >= 0) {
            Waiting one{cells_.half(cell, 0), to_cell(cells_, place, cells_.half(cell, 0))};
            Waiting other{cells_.half(cell, 1), to_cell(cells_, place, cells_.half(cell, 1))};
            if (other.away < one.away) std::swap(one, other);
            if (other.away < reach_) waiting_.push_back(other);
            cell = one.cell;
        }
        return cell;
    }

    void look_into(Int place, Int cell) {
        for (Int beside = cells_.first[cell]; beside < cells_.last[cell]; ++beside) {
            const double square = to_point(cells_, place, beside);
            if (!(square < reach_) || beside == place) continue;
            found_[std::size_t(count_++)] = {square, cells_.number[beside]};
            if (count_ < ranks_ + spare) continue;
            part();
            count_ = ranks_;
            reach_ = std::max_element(found_.begin(), found_.begin() + ranks_)->away;
        }
    }

    // Put the nearest first. By distance alone: which of those equally far stay is up to the cells.
    //
    // Hoare (1961), algorithm 65: find, Communications of the ACM 4:321-322.
    void part() {
        Found* const found = found_.data();
        Int left = 0;
        Int right = count_ - 1;
        while (left < right) {
            const double pivot = found[(left + right) / 2].away;
            Int low = left, high = right;
            while (low <= high) {
                while (found[low].away < pivot) ++low;
                while (pivot < found[high].away) --high;
                if (low <= high) std::swap(found[low++], found[high--]);
            }
            if (ranks_ - 1 <= high) {
                right = high;
            } else if (ranks_ - 1 >= low) {
                left = low;
            } else {
                return;
            }
        }
    }

    const Cells& cells_;
    Int ranks_;
    std::vector<Found> found_;
    std::vector<Waiting> waiting_;
    Int count_ = 0;
    double reach_ = 0.0;  // those farther are not among the nearest, squared
};

// Write the numbers of the points nearest to those of some places: (point, rank), of which there
// are fewer than points.
void write_nearest_in(const Cells& cells, Int begin, Int end, View<std::int32_t, 2> nearest) {
    Finder finder(cells, nearest.shape(1));
    for (Int place = begin; place < end; ++place) {
        const std::vector<Found>& found = finder.nearest(place);
        const View<std::int32_t, 1> row = nearest[cells.number[place]];
        for (Int rank = 0; rank < row.size(); ++rank) {
            row[rank] = found[std::size_t(rank)].number;
        }
    }
}

}  // namespace
}  // namespace tandem

extern "C" int tandem_write_nearest_in(const tandem_cells* cells, int64_t begin, int64_t end,
                                       const tandem_i32_2d* nearest) {
    return tandem::guarded([&] { tandem::write_nearest_in(*cells, begin, end, *nearest); });
}
