// Types of drones on one truck: rows of types, as if the truck had these drones alone.
//
// A truck with drones of one type is told by its own row. One with several has a row more for each
// of them, behind those of all trucks, which follow one another by their `drone_row`; in its own,
// what is said of drones holds for the most that any of them can, and all are counted.
#pragma once

#include "problem/instance.h"

namespace tandem {

// Whether a truck has drones of several types, or others follow those of a row.
inline bool are_several(const VehicleType& type) { return type.drone_row >= 0; }

// The row of the first drones on a truck; `next_drone_row` those behind.
inline Int first_drone_row(View<const VehicleType, 1> types, Int k) {
    return are_several(types[k]) ? types[k].drone_row : k;
}

// The row of a truck's next type of drones, `no_row` behind the last.
inline Int next_drone_row(View<const VehicleType, 1> types, Int row) {
    return are_several(types[row]) ? types[row].drone_row : no_row;
}

// The row of a truck's drone.
inline Int row_of_drone(View<const VehicleType, 1> types, Int k, Int drone) {
    Int row = first_drone_row(types, k);
    while (are_several(types[row]) && drone >= types[row].drones) {
        drone -= types[row].drones;
        row = types[row].drone_row;
    }
    return row;
}

// How many rows tell of the drones of a truck.
inline Int num_drone_rows(View<const VehicleType, 1> types, Int k) {
    Int count = 1;
    for (Int row = next_drone_row(types, first_drone_row(types, k)); row >= 0; ++count) {
        row = next_drone_row(types, row);
    }
    return count;
}

// The row of a truck's drones at a place in their order, from 0.
inline Int drone_row_at(View<const VehicleType, 1> types, Int k, Int place) {
    Int row = first_drone_row(types, k);
    for (Int behind = 0; behind < place; ++behind) row = next_drone_row(types, row);
    return row;
}

// The number of a truck's first drone of a row.
inline Int first_drone(View<const VehicleType, 1> types, Int k, Int row) {
    Int number = 0;
    for (Int other = first_drone_row(types, k); other != row; other = types[other].drone_row) {
        number += types[other].drones;
    }
    return number;
}

}  // namespace tandem
