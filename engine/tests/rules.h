/* What tests in Python ask the engine's rules. Results are written to `found`, in the order that
 * each comment says. */
#ifndef TANDEM_TESTS_RULES_H
#define TANDEM_TESTS_RULES_H

#include "include/tandem.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Start and end of service, waiting, lateness, whether it is too late. */
void service_at(const tandem_node* place, int64_t rows, int64_t arrival, int64_t* found);
/* The last arrivals: as late, allowed, free, in the same window. */
void last_arrivals(const tandem_node* place, int64_t rows, int64_t arrival, int64_t leave,
                   int64_t* found);
/* The pair of the start, first and last arrival at the block's beginning. */
void within_block(const tandem_node* place, int64_t rows, int64_t time, int64_t d, int64_t c,
                  int64_t* found);
/* The opening of the window that serves an arrival. */
void window_of(const tandem_node* place, int64_t rows, int64_t arrival, int64_t* found);
/* Closing and width. */
void extent_of(const tandem_node* place, int64_t rows, int64_t* found);

/* Departure, since when work counts, whether it has begun. */
void begun_at(const tandem_vehicle_type* type, int64_t time, int64_t* found);
/* Overtime, whether shift and working duration allow it, and the number of stops. */
void worked_until(const tandem_vehicle_type* type, int64_t departure, int64_t end, int64_t stops,
                  int64_t* found);
/* Whether so many sorties are allowed. */
void sorties_allowed(const tandem_vehicle_type* type, int64_t count, int64_t* found);

/* What a leg and hovering leave of a full battery, and the longest hovering. */
void energy_taken(const tandem_vehicle_type* type, int64_t weight, int64_t duration,
                  int64_t* found);
/* Whether a battery limits drones, whether they hover at customers. */
void battery_limits(const tandem_vehicle_type* type, int64_t* found);

/* Take-off, arrival, when it is back, and recovered. `place` is the drones' at the customer. */
void flown(const tandem_vehicle_type* type, const tandem_node* place, int64_t rows, int64_t begin,
           int64_t out, int64_t home, int64_t* found);
/* Whether a sortie is short enough. */
void endures(const tandem_vehicle_type* type, int64_t takeoff, int64_t back, int64_t begin,
             int64_t* found);
/* Whether a flight lasts, whether it is marked as none. */
void lasts(const tandem_vehicle_type* type, const tandem_node* place, int64_t rows, int64_t out,
           int64_t home, int64_t* found);
/* First and last arrival at a block's beginning that the endurance allows. */
void enduring(const tandem_vehicle_type* type, int64_t takeoff_d, int64_t takeoff_c, int64_t d,
              int64_t c, int64_t* found);
/* What is left of the battery. */
void battery_left(const tandem_vehicle_type* type, const tandem_node* place, int64_t rows,
                  int64_t out, int64_t home, int64_t takeoff, int64_t served, int64_t begin,
                  int64_t* found);
/* Begin of the launch, its duration, that with a recovery, until when endurance counts for who is
 * back at `time` and recovered 1 later, whether launches differ. */
void handled(const tandem_vehicle_type* type, int64_t time, int64_t launched, int64_t* found);

/* Whether a vehicle holds the demands of all `places`, each of so many `rows`; whether the last
 * fits on top of the others; whether a drone lifts them. */
void demands_held(const tandem_vehicle_type* type, const tandem_node* places, int64_t count,
                  int64_t rows, int64_t* found);
/* Whether a demand is within the capacity, both in sum: what is asked for, and what is left. */
void capacity_left(const tandem_vehicle_type* type, const tandem_node* place, int64_t* found);
/* Whether a vehicle may serve some in turn; where there is room for one `more` behind each stop.
 * `amounts` is (node, tier, 8). */
void rooms_between(const tandem_vehicle_type* type, const int64_t* amounts, int64_t nodes,
                   int64_t tiers, const int64_t* route, int64_t length, int64_t more,
                   int64_t* found);

/* When a leg ends, and starts, whether speeds never change. */
void clocked(const tandem_vehicle_type* type, const int64_t* times, int64_t changes,
             const int64_t* factors, int64_t duration, int64_t time, int64_t* found);

/* All legs of a travel, looked up in three ways: (way, origin, to, 2); and from here on how near
 * places are: (node, node). */
void all_legs(const tandem_legs* legs, const tandem_legs* back, int64_t travel, int64_t nodes,
              int64_t* found);
/* The distances alone, to and from: (2, origin, to). */
void all_distances(const tandem_legs* legs, const tandem_legs* back, int64_t travel, int64_t nodes,
                   int64_t* found);

/* The engine's clock, in nanoseconds. */
void steady_clock_at(int64_t* found);

#ifdef __cplusplus
}
#endif

#endif
