// A trip with one drone as a row of operations, and changes of it.
#pragma once

#include "search/route/layout.h"

namespace tandem {

constexpr std::int32_t nobody = -1;

// A stop of the truck as operations see it.
struct OperationStop {
    std::int32_t node;
    std::int32_t flown;  // whom the drone serves meanwhile, from here on, or `nobody`
    bool joint;          // truck and drone are both here, so that one ends and the next begins
    double cost = 0.0;   // of the operation that begins here, where that was priced

    // Whether a stop is as another, whatever is known of its cost.
    bool is_as(const OperationStop& other) const {
        return node == other.node && flown == other.flown && joint == other.joint;
    }
};

// The stops of a trip, or of some of its operations from a joint stop to another.
//
// Between two joint stops truck and drone part, and the drone serves somebody: where it doesn't,
// all stops are joint.
class OperationRow {
public:
    OperationRow() = default;
    OperationRow(View<OperationStop, 1> room, Int length) : room_(room), length_(length) {}

    OperationStop& operator[](Int place) const { return room_[place]; }
    Int length() const { return length_; }

    // Return the last joint stop up to a place.
    Int begin_of(Int place) const {
        while (!room_[place].joint) --place;
        return place;
    }

    // Return the first joint stop behind a place, which isn't the last.
    Int end_behind(Int place) const {
        do ++place;
        while (!room_[place].joint);
        return place;
    }

    void clear() { length_ = 0; }
    void append(const OperationStop& stop) { room_.at(length_++) = stop; }

    // Take the stops of another from place `first` to `last`. In place.
    void copy(const OperationRow& other, Int first, Int last) {
        length_ = last + 1 - first;
        std::copy_n(other.room_.part(first, length_).begin(), length_,
                    room_.first(length_).begin());
    }

    // Put operations in place of those from stop `first` to `last`, which stays. In place.
    void replace(Int first, Int last, const OperationRow& by);

    // Remove a stop; where truck and drone met there, they meet before or behind, as `earlier`
    // says if either may be. In place; false if they can't meet.
    bool remove_stop(Int place, bool earlier);

    // Let nobody be flown to on the operation that begins at a stop. In place.
    void remove_flight(Int place);

    // Let the truck stop at a node behind a place. In place.
    void insert_stop(Int place, Int node);

    // Let truck and drone meet at a stop within an operation, `left` or else right of which the
    // drone flies then. In place.
    void part(Int place, bool left);

    // Let the drone serve a customer from one stop to another; false, with nothing changed, if it
    // flies between.
    bool insert_flight(Int launch, Int recovery, Int customer);

    // Let truck and drone meet one stop `earlier`, or else later, than at a joint stop. In place;
    // false, with nothing changed, if they can't.
    bool move_joint(Int place, bool earlier);

    // Reverse the order of some stops, with the operations between them. In place.
    void reverse(Int first, Int last);

private:
    // Let all stops be joint from which on no drone flies. In place.
    void join_idle(Int first);

    View<OperationStop, 1> room_;
    Int length_ = 0;
};

}  // namespace tandem
