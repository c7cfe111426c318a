// Corners of obstacles, where shortest ways bend.
#pragma once

#include "problem/instance.h"

namespace tandem {

// Of grids in which corners and edges are looked up.
constexpr Int most_cells = 2048;    // on each side
constexpr double margin = 1e-6;     // share of a cell by which what is looked at is widened
constexpr double narrowest = 1e-3;  // metres: cells are no smaller

struct Point2 {
    double x, y;
};

// From one point to another.
struct Edge {
    Point2 a, b;
};

// A place, and from there the neighbours on the area's boundary.
struct Corner {
    Point2 place, before, after;
};

// Whether no shortest way that leads along a line bends at a corner.
//
// Such a way leaves the area on one side: if the line through the corner has the corner's two edges
// on different sides, by more than some slack, the way may be cut short there.
inline bool is_dead_end(const Point2& line, const Corner& corner, double slack) {
    const double one = line.x * corner.before.y - line.y * corner.before.x;
    const double other = line.x * corner.after.y - line.y * corner.after.x;
    const double near = slack * slack * (line.x * line.x + line.y * line.y);
    return (one * other < 0) & (one * one > near) & (other * other > near);
}

// Corners by number.
class Corners {
public:
    Corners(View<const double, 2> place, View<const double, 2> before, View<const double, 2> after)
        : place_(place), before_(before), after_(after) {}

    Int size() const { return place_.size(); }

    Corner operator[](Int number) const {
        const Point2 place{place_(number, 0), place_(number, 1)};
        return {place,
                {before_(number, 0) - place.x, before_(number, 1) - place.y},
                {after_(number, 0) - place.x, after_(number, 1) - place.y}};
    }

private:
    View<const double, 2> place_, before_, after_;
};

}  // namespace tandem
