#include "search/moves/operation_row.h"

#include <utility>

namespace tandem {

void OperationRow::replace(Int first, Int last, const OperationRow& by) {
    const Int longer = by.length_ - (last + 1 - first);
    const View<OperationStop, 1> room = room_.first(length_ + std::max(Int{0}, longer));
    const auto begin = room.begin() + first, rest = room.begin() + last;
    const auto end = room.begin() + length_;
    if (longer > 0) std::move_backward(rest, end, end + longer);
    if (longer < 0) std::move(rest, end, rest + longer);
    std::copy_n(by.room_.begin(), by.length_ - 1, begin);
    length_ += longer;
}

bool OperationRow::remove_stop(Int place, bool earlier) {
    if (room_[place].joint) {
        const Int before = begin_of(place - 1);
        const bool can_before = before < place - 1, can_behind = !room_[place + 1].joint;
        const std::int32_t flown = room_[place].flown;
        if (room_[before].flown == nobody) {
            // Who was launched here is launched where the truck comes from, or at the next stop.
            if (flown != nobody && can_behind && !earlier) {
                room_[place + 1] = {room_[place + 1].node, flown, true};
            } else {
                room_[before].flown = flown;
            }
        } else if (flown != nobody) {
            if (!can_before && !can_behind) return false;
            const Int joint = can_before && (earlier || !can_behind) ? place - 1 : place + 1;
            room_[joint].flown = flown;
            room_[joint].joint = true;
        } else if (can_before && earlier) {
            room_[place - 1].joint = true;
        }
    }
    std::move(room_.begin() + place + 1, room_.begin() + length_, room_.begin() + place);
    --length_;
    return true;
}

void OperationRow::join_idle(Int first) {
    for (Int place = first; place < length_ && !room_[place].joint; ++place) {
        room_[place].joint = true;
    }
}

void OperationRow::remove_flight(Int place) {
    room_[place].flown = nobody;
    join_idle(place + 1);
}

void OperationRow::insert_stop(Int place, Int node) {
    const bool joint = room_[begin_of(place)].flown == nobody;
    const View<OperationStop, 1> room = room_.first(length_ + 1);
    const auto behind = room.begin() + place + 1, end = room.begin() + length_;
    std::move_backward(behind, end, end + 1);
    room_[place + 1] = {std::int32_t(node), nobody, joint};
    ++length_;
}

void OperationRow::part(Int place, bool left) {
    const Int begin = begin_of(place);
    room_[place].joint = true;
    if (left) {
        join_idle(place + 1);
        return;
    }
    std::swap(room_[place].flown, room_[begin].flown);
    for (Int before = begin + 1; before < place; ++before) room_[before].joint = true;
}

bool OperationRow::insert_flight(Int launch, Int recovery, Int customer) {
    if (!room_[recovery].joint) return false;
    for (Int place = launch; place < recovery; ++place) {
        if (!room_[place].joint || room_[place].flown != nobody) return false;
    }
    room_[launch].flown = std::int32_t(customer);
    for (Int place = launch + 1; place < recovery; ++place) room_[place].joint = false;
    return true;
}

bool OperationRow::move_joint(Int place, bool earlier) {
    OperationStop& here = room_[place];
    const Int begin = begin_of(place - 1);
    const bool flies_before = room_[begin].flown != nobody, flies_behind = here.flown != nobody;
    const Int to = earlier ? place - 1 : place + 1;
    OperationStop& next = room_[to];
    if (earlier ? begin < to : flies_behind && !next.joint) {
        next.joint = true;
        std::swap(here.flown, next.flown);
        here.joint = earlier ? !flies_behind : !flies_before;
        return true;
    }
    if (earlier ? !flies_before && flies_behind : flies_before && !flies_behind) {
        if (earlier) std::swap(here.flown, next.flown);
        here.joint = false;
        return true;
    }
    return false;
}

void OperationRow::reverse(Int first, Int last) {
    std::reverse(room_.begin() + first, room_.begin() + last + 1);
    // Who was flown to behind a joint stop is now flown to from that which comes before.
    Int before = nowhere;
    std::int32_t behind_all = nobody;
    for (Int place = first; place <= last; ++place) {
        OperationStop& here = room_[place];
        if (!here.joint) continue;
        if (before == nowhere) {
            behind_all = here.flown;
        } else {
            room_[before].flown = here.flown;
        }
        before = place;
    }
    if (before == nowhere) return;
    room_[before].flown = behind_all;
    if (room_[begin_of(first - 1)].flown == nobody) join_idle(first);
    if (behind_all == nobody) join_idle(before + 1);
}

}  // namespace tandem
