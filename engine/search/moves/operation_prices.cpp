#include "search/moves/operation_prices.h"

namespace tandem {
namespace {

// Return what the truck does on an operation.
Drive drive_between(const OperationData& by, const OperationRow& row, Int begin, Int end) {
    Drive drive{0, 0, end - begin - 1};
    for (Int place = begin; place < end; ++place) {
        const Int node = row[place].node;
        const Leg way = leg(by.drive, node, row[place + 1].node);
        drive.duration += by.by_truck[node].service_duration() + way.duration;
        drive.distance += way.distance;
    }
    return drive;
}

// Return what an operation costs where the drone flies across; infinite if it doesn't, or can't.
double cost_across(const OperationData& by, const OperationRow& row, Int begin, Int end,
                   const Drive& drive) {
    const ProblemData& data = *by.data;
    const OperationStop &from = row[begin], &to = row[end];
    if (from.flown == nobody || !data.strategy.crossings ||
        !is_launch_place(data.no_launch, from.node) || !is_launch_place(data.no_launch, to.node)) {
        return infinite_cost;
    }
    return cost_across(by, from.node, from.flown, to.node, drive);
}

// Return what an operation costs where the truck doesn't leave before the drone is back, or nobody
// is flown to; infinite if it has stops between, or if that is not below `most`.
double cost_waiting(const OperationData& by, const OperationRow& row, Int begin, Int end,
                    const Drive& drive, double most) {
    if (end != begin + 1) return infinite_cost;
    const OperationStop& from = row[begin];
    const double cost =
        usual_work_cost(*by.rate, drive.duration) + drive_cost(*by.rate, drive.distance);
    if (from.flown == nobody) return cost;
    return cost < most ? cost + loop_cost(by, from.node, from.flown) : infinite_cost;
}

// Return what an operation costs.
double operation_cost(const OperationData& by, const OperationRow& row, Int begin, Int end) {
    const Drive drive = drive_between(by, row, begin, end);
    const double across = cost_across(by, row, begin, end, drive);
    return by.rate->stop + std::min(across, cost_waiting(by, row, begin, end, drive, across));
}

}  // namespace

bool waits(const OperationData& by, const OperationRow& row, Int begin, Int end) {
    const Drive drive = drive_between(by, row, begin, end);
    const double across = cost_across(by, row, begin, end, drive);
    return cost_waiting(by, row, begin, end, drive, across) < across;
}

void price(const OperationData& by, const OperationRow& row) {
    for (Int begin = 0; begin < row.length() - 1;) {
        const Int end = row.end_behind(begin);
        row[begin].cost = operation_cost(by, row, begin, end);
        begin = end;
    }
}

void price_changed(const OperationData& by, const OperationRow& old, Int first, Int last,
                   const OperationRow& row) {
    const Int length = row.length(), least = std::min(length, last + 1 - first);
    Int before = 0, behind = 0;
    while (before < least && row[before].is_as(old[first + before])) ++before;
    while (behind < least && row[length - 1 - behind].is_as(old[last - behind])) ++behind;
    for (Int begin = 0; begin < length - 1;) {
        const Int end = row.end_behind(begin);
        if (end < before) {
            row[begin].cost = old[first + begin].cost;
        } else if (begin >= length - behind) {
            row[begin].cost = old[last + 1 - length + begin].cost;
        } else {
            row[begin].cost = operation_cost(by, row, begin, end);
        }
        begin = end;
    }
}

}  // namespace tandem
