/* The one place where the engine and Python meet: plain structs, functions that return codes. */
#ifndef TANDEM_H
#define TANDEM_H

#include <stdbool.h>
#include <stdint.h>

/* Rows that others own, without gaps: where the first is, and how many there are along each axis.
   In the engine, a view of them; `model/engine/header.py` declares them for Python. */
#ifdef __cplusplus
#include "view.h"
/* NOLINTBEGIN(bugprone-macro-parentheses): types. */
#define TANDEM_ROWS(name, row)              \
    using name##_1d = tandem::View<row, 1>; \
    using name##_2d = tandem::View<row, 2>; \
    using name##_3d = tandem::View<row, 3>; \
    using name##_4d = tandem::View<row, 4>; \
    using name##_5d = tandem::View<row, 5>
/* NOLINTEND(bugprone-macro-parentheses) */
extern "C" {
#endif
#pragma GCC visibility push(default)

/* A node, as much as fits a line of the processor's cache: when its window opens; the last arrival
   that is allowed, far where lateness only costs; service duration; release; the last arrival that
   is not late; demand in the first dimensions.
   There are as many tables of nodes, variants, as there are ways to be served: they differ in the
   service duration, in the first it is the customers' own. In those of drones that a battery
   limits, `demand` tells what weighs: of what is delivered, and of what is picked up. Where
   somebody has several windows, each node has more rows, one for each gap between two: its
   `window_latest` closes the window before, far behind the last, and its `window_earliest` opens
   the next. */
typedef struct tandem_node {
    int64_t window_earliest, arrival_limit, service_duration, release, window_latest;
    int64_t demand[3];
} tandem_node;

/* Where a node is, equal at one place, and how long whoever comes from elsewhere sets up there.
   Nobody has a row where nobody has to. Legs hold it, unless speeds change or it leads back. */
typedef struct tandem_setup {
    int64_t site, setup_duration;
} tandem_setup;

/* What lateness and waiting at a node cost per hour, in a search per ms, and being late at all. */
typedef struct tandem_price {
    double lateness, waiting, late;
} tandem_price;

/* Bits of the goods at a node that some others must not go with, and of those others: on one trip
   with them, and on one vehicle. Bits of the relations by which a customer goes with others: on one
   trip, and by one vehicle. Nobody has a row where all may go with all. */
typedef struct tandem_goods {
    int64_t held, barred_on_trip, barred_on_vehicle;
    int64_t kept_on_trip, kept_on_vehicle;
} tandem_goods;

/* Charged batteries, and places to charge, for vehicles that fly from a depot: how many there are,
   `unlimited` if enough, or how many are taken. */
typedef struct tandem_hub {
    int64_t batteries, chargers;
} tandem_hub;

/* An end of a shipment: the node of the other end, -1 where there is none, and whether the parcel
   is delivered here. Of several pickups, the delivery's other end is the first. Who stands for a
   node where that is inserted or left out: the first pickup of a shipment, the first of several
   places of a customer, else the node itself; and the next of those pickups or places, the first
   behind the last. Nobody has a row where there are neither. */
typedef struct tandem_pair {
    int64_t partner, is_delivery, unit, next_place;
} tandem_pair;

/* How long after service begins at another customer it begins at one whom relations name behind;
   `node` is -1 behind the last. Nobody has a row where no relation says so. */
typedef struct tandem_lag {
    int64_t node, least, most;
} tandem_lag;

/* From when to when service may begin at a customer, by those whom other vehicles serve. */
typedef struct tandem_span {
    int64_t soonest, latest;
} tandem_span;

/* That one vehicle more, or less, is charged at a depot from a time on. */
typedef struct tandem_plugging {
    int64_t depot, time, change;
} tandem_plugging;

/* A vehicle type. Its speed changes are a number, -1 without a profile. What a vehicle carries
   beside its customers' is taken from its capacity; what it has worked when it may begin (`begun`)
   is taken from its working duration, and costs as if it were fixed. The end of the shift and the
   longest working duration are with overtime; what is `usual` is without. Each launch of a trip but
   the first takes the `relaunch_duration`; no more sorties are flown than there are batteries. Its
   drones' powers are known at so many `points`, by weight; none if no battery limits them; aboard
   they gain a `charge`, from what each has at first. It picks up in any order, or after all that a
   trip delivers, which is something, or was before the trip begins here; what else it carries in
   the first dimension. No drone, nor who flies by itself, is in the air while it storms, nor on a
   flight to or from a zone in its hours, which are storms for those flights.
   `rules/drone_types.h` says which rows tell of which drones. Of one that flies by itself, what is
   said of drones holds for its trips; its legs hold launches and recoveries. Each of its trips
   takes a battery of the depot where it begins, or it is charged there, where it may have to wait
   for that (`shares_chargers`); rollouts let it fly so many `trips_uncharged` unless it has a place
   there all day. Its driver has so many breaks, in order, of a route that began at
   `breaks_since` if that isn't before all. Whose driver `must_rest`, does as `rules/driving.h`
   says. */
typedef struct tandem_vehicle_type {
    int64_t count, travel;
    int64_t depot, begins_at, ends_at, changes_ends;
    int64_t shift_earliest, busy_until, begun, shift_latest, max_working_duration;
    int64_t usual_end, usual_working;
    int64_t max_trip_distance, max_distance;
    int64_t limited_travel;      /* whose distances count for that */
    int64_t max_travel_duration; /* what driving rules allow in a day, if that is less */
    int64_t max_trips, max_stops, max_sorties, max_airborne;
    int64_t truck_waits, reload_duration, speed_changes;
    int64_t drone_row, drones, drone_travel, home_travel;
    int64_t endurance, waiting_counts;
    int64_t launch_duration, relaunch_duration, recovery_duration;
    int64_t straight_travel, max_range;
    int64_t variant, drone_variant;
    int64_t points, battery, lands, climb_duration, descent_duration, charge;
    int64_t flies, takes_batteries, trips_uncharged, shares_chargers;
    int64_t pickup_order, lifo; /* whether only what was loaded last can be unloaded */
    int64_t carried, capacity[9], payload[9];
    int64_t weights[24], cruise[24], hover[24], climb[24], descent[24];
    int64_t first_charge[256];
    int64_t storms, storm_from[32], storm_until[32];
    int64_t storm_zones[32]; /* bits of the zones whose hours it is; 0: for all that flies */
    int64_t breaks, breaks_since, break_earliest[8], break_latest[8], break_duration[8];
    int64_t break_after_departure[8]; /* whether both count from when the route begins */
    int64_t break_anywhere[8], break_unpaid[8];
    int64_t break_max_load[72]; /* (break, dimension) the most that may be aboard */
    int64_t must_rest;
    int64_t rest_durations[3]; /* of a whole rest, and of the first and the second part of one */
    int64_t max_driving, max_work, driven_before, worked_before;
    int64_t half_rested_before; /* whether the first part of a rest was the last */
    int64_t rests_in_flights;   /* whether the driver may rest while drones are out */
    int64_t work_interrupts;    /* whether other work that long interrupts driving as a rest does */
    int64_t share_before;       /* what a vehicle has done of the work, -1: it isn't used yet */
    int64_t keeps_hours;        /* whether depots' hours limit its trips more than its shift does */
} tandem_vehicle_type;

/* What a vehicle costs, and what per km, per customer of the truck and per hour, its drones' apart;
   per km and part of the first dimension aboard. In a search per mm and per ms. */
typedef struct tandem_rate {
    double fixed, distance, stop, time, overtime, drone_distance, drone_time, load;
} tandem_rate;

/* How routes of a type are timed and priced. */
typedef struct tandem_evaluation {
    bool timed;     /* working time costs or is limited */
    bool priced;    /* lateness, waiting or what is aboard cost, or all is timed again */
    bool held_back; /* trips must be held back before their cost is known */
    bool retimed; /* all behind a change is timed again: speeds, windows or charge change with it */
    bool lasting; /* what may last too long may wait: a change is timed with its whole route */
    bool by_detour;   /* an insertion costs what its detour does */
    bool by_distance; /* as that, with one trip of any distance, no releases and no drones */
} tandem_evaluation;

typedef struct tandem_leg_law {
    int64_t table, rounding, more, nowhere, sets_up;
    double metres, pace;
} tandem_leg_law;

typedef struct tandem_point {
    int64_t node, site, setup_duration;
    double x, y, z;
} tandem_point;

typedef struct tandem_cost {
    double fixed, distance, stops, time, overtime, lateness, earliness;
    double makespan, balance, too_few_vehicles, unassigned;
} tandem_cost;

/* What an action on a customer leads to. */
typedef struct tandem_outlook {
    int64_t arrival; /* at the customer */
    int64_t start;   /* of service */
    int64_t end;     /* of the trip if the vehicle went home afterwards */
} tandem_outlook;

typedef struct tandem_node_features {
    float x, y, is_depot, opening, closing, width, never_closes, may_not_be_late, slack_from_depot,
        capacity_share, share_of_demand, payload_share, service, release, lateness_price,
        waiting_price, can_drive, can_fly, way_home, nearness, unassigned_cost, pickup_share,
        between_windows, max_time_aboard, setup, barred, partner_x, partner_y, is_pickup,
        is_delivery, other_places, price, kept;
} tandem_node_features;

typedef struct tandem_type_features {
    float capacity, share_of_demand, fleet_share, count, fixed, per_km, per_hour, way_home,
        shift_earliest, usual_end, usual_working, max_trip_distance, max_trips, reload,
        speed_changes, drones, payload, endurance, flight_home, per_flight, can_drive, can_fly,
        way_out, way_back, overtime_price, overtime, per_stop, per_load, max_stops, max_sorties,
        pickup_order, other_depots, handling, charge, breaks, driving_limit, price;
} tandem_type_features;

typedef struct tandem_action_features {
    float kind[4], duration, nearness, cost, waiting, window_slack, lateness, load_share,
        capacity_share, shift_slack, way_home, distance_slack, working_slack, detour, excess,
        endurance_share, release_delay, next_way, third_way, next_excess, next_duration, next_slack,
        lost, detour_before, later_duration, price, delivers, delivery_way, delivery_hurry, joins,
        forsaken, rest;
} tandem_action_features;

typedef struct tandem_vehicle_features {
    float unserved, unserved_demand, demand_by_reserve, way_home, idle, clock, load_left,
        spare_reserve, trips_left, shift_slack, working_slack, flying, drone_aboard, load_by_demand,
        type[37], aboard, bound, rest_due;
} tandem_vehicle_features;

/* How many there are of each; the turn; the last stamp that was given. */
typedef struct tandem_search_counts {
    int64_t active, missing, absent, touched, turn, stamp, best_missing, customers;
    int64_t changed; /* slots, since the best; -1 where any may have */
    int64_t stay;    /* turns near one customer; 0: everywhere */
    int64_t focus;   /* that customer */
    int64_t planned; /* tells the part apart that was planned at best last */
    int64_t movable; /* customers of the trips that small moves changed last */
    int64_t to_drop; /* whom a turn may leave out beyond the best plan, if they seldom were */
} tandem_search_counts;

/* Costs of the routes as they are and at their best, and what the annealing goes by. */
typedef struct tandem_search_values {
    double cost, best, temperature;
    double cooling; /* factor of the temperature each turn */
    double longest; /* how long strings are at most where routes are long */
} tandem_search_values;

/* Arrays of others, row by row. */
TANDEM_ROWS(tandem_bool, bool);
TANDEM_ROWS(tandem_cost, tandem_cost);
TANDEM_ROWS(tandem_evaluation, const tandem_evaluation);
TANDEM_ROWS(tandem_f32, float);
TANDEM_ROWS(tandem_f64, double);
TANDEM_ROWS(tandem_goods, const tandem_goods);
TANDEM_ROWS(tandem_hub, tandem_hub);
TANDEM_ROWS(tandem_i32, int32_t);
TANDEM_ROWS(tandem_i64, int64_t);
TANDEM_ROWS(tandem_lag, const tandem_lag);
TANDEM_ROWS(tandem_leg_law, const tandem_leg_law);
TANDEM_ROWS(tandem_node, const tandem_node);
TANDEM_ROWS(tandem_outlook, tandem_outlook);
TANDEM_ROWS(tandem_pair, const tandem_pair);
TANDEM_ROWS(tandem_point, const tandem_point);
TANDEM_ROWS(tandem_price, const tandem_price);
TANDEM_ROWS(tandem_rate, const tandem_rate);
TANDEM_ROWS(tandem_setup, const tandem_setup);
TANDEM_ROWS(tandem_plugging, tandem_plugging);
TANDEM_ROWS(tandem_span, tandem_span);
TANDEM_ROWS(tandem_u64, uint64_t);
TANDEM_ROWS(tandem_vehicle_type, const tandem_vehicle_type);

typedef struct tandem_cells {
    tandem_f64_2d low, high;   /* (cell, axis) */
    tandem_i64_1d first, last; /* (cell,) its points, by their place in `point` */
    tandem_i64_2d half;        /* (cell, 2) the cells that it is halved into; -1 if it is not */
    tandem_f64_2d point;       /* (place, axis) */
    tandem_i32_1d number;      /* (place,) of the point */
} tandem_cells;

typedef struct tandem_sights {
    tandem_i64_1d begin;    /* (row + 1,) */
    tandem_i64_1d place;    /* (entry,) */
    tandem_f64_1d distance; /* (entry,) metres */
    tandem_f64_1d duration; /* (entry,) seconds, infinite where the wind is too strong */
} tandem_sights;

/* On which sides of ways to corners their areas may lie, as bits: 1 left, 2 right. The entries of a
   corner, in `between`, are those with the area on the left alone, on either, on the right alone.
 */
typedef struct tandem_turns {
    tandem_i32_1d reached;                         /* (entry of `outward`,) */
    tandem_i32_1d arrived;                         /* (entry of `between`,) at its end */
    tandem_i64_1d only_left_end, only_right_begin; /* (corner,) */
} tandem_turns;

typedef struct tandem_legs {
    tandem_i32_4d stated; /* (travel, origin, to, 2); null where some are computed */
    tandem_i64_5d table; /* (direction, table, node, node, 2) one direction if those are the same */
    tandem_point_1d point; /* (node,) */
    tandem_leg_law_1d law; /* (travel,) */
} tandem_legs;

/* A problem, as policies and the search read it. Where nobody states what a table tells, it has no
   rows. */
typedef struct tandem_problem_tables {
    int64_t num_depots, num_nodes, num_types;
    tandem_node_3d node;   /* (variant, node, 1 + gaps) */
    tandem_i64_3d amount;  /* (node, tier, entry) none where the demand of nodes tells all */
    tandem_price_1d price; /* (node,) per hour; in a search, per ms */
    tandem_goods_1d goods; /* (node,) */
    tandem_setup_1d setup; /* (node,) */
    tandem_i64_1d max_time_aboard; /* (node,) ms, FAR without limit */
    tandem_pair_1d pair;           /* (node,) */
    tandem_i64_2d max_between;     /* (type, node) ms from a pickup to its delivery, likewise */
    tandem_lag_2d lag, across;     /* (node, rank); the latter behind others on any vehicle, by less
                                      than nothing before them */
    tandem_f64_2d vehicle_cost;    /* (type, node) of being served by it, on top of all else */
    tandem_bool_1d no_launch;      /* (node,) no drone takes off or is recovered there */
    tandem_i64_1d zones;           /* (node,) bits of the zones with hours that hold it */
    tandem_hub_1d hub;             /* (depot,) none where all have enough */
    tandem_vehicle_type_1d type;   /* (row,) trucks first */
    tandem_rate_1d rate;           /* (row,) per km and hour; in a search, per mm and ms */
    tandem_bool_2d reload;         /* (type, node) where a trip may end and the next begin */
    tandem_i64_2d profile_time, profile_factor; /* (type, change), (type, change + 1) */
    double unassigned_cost;                     /* of whoever it costs least to leave out */
    tandem_f64_1d unassigned_more; /* (node,) what leaving out another costs above that */
} tandem_problem_tables;

TANDEM_ROWS(tandem_problem_tables, const tandem_problem_tables);

/* Problems as policies read them, padded to a common size. */
typedef struct tandem_instance {
    tandem_problem_tables_1d problem;  /* (problem,) */
    tandem_bool_3d can_drive, can_fly; /* (problem, row, node) all allows a truck, or drones, to */
    tandem_i64_4d duration, distance;  /* (problem, travel, node, node) */
    tandem_i64_3d neighbour; /* (problem, node, rank) nearest customers first, -1 behind the last */
} tandem_instance;

/* Running plans, a row per rollout, then scratch rows. They belong to the engine. */
typedef struct tandem_state tandem_state;

/* What Python sees of running plans. */
typedef struct tandem_state_seen {
    tandem_bool_2d served;      /* (rollout, node) */
    tandem_i64_1d num_unserved; /* (rollout,) */
    tandem_i64_2d used;         /* (rollout, type) vehicles opened */
    tandem_bool_1d done;        /* (rollout,) */
    tandem_cost_1d cost;        /* (rollout,) of the vehicles closed so far */
} tandem_state_seen;

/* The open vehicle of a rollout, on a trip. */
typedef struct tandem_under_way {
    int64_t type; /* -1 if there is none */
    int64_t node;
    int64_t service_end; /* there */
    int64_t distance;    /* of the trip */
    int64_t load[9];     /* left, by dimension */
} tandem_under_way;

typedef struct tandem_scales {
    tandem_f64_1d time;    /* (problem,) ms from a depot to a customer, mean */
    tandem_f64_1d near;    /* (problem,) ms from a customer to its nearest neighbour, mean */
    tandem_f64_1d horizon; /* (problem,) ms, the last limit stated, or a guess */
    tandem_f64_1d cost;    /* (problem,) cost of driving from a depot to a customer, mean */
    tandem_f64_1d amount;  /* (problem,) demand in the first dimension, or pickups if more */
} tandem_scales;

typedef struct tandem_observation {
    tandem_i64_1d count;       /* (rollout,) */
    tandem_i64_2d action;      /* (rollout, candidate) codes */
    tandem_i64_2d token;       /* (rollout, candidate) node, or number of nodes + type */
    tandem_outlook_2d outlook; /* (rollout, candidate) */
    tandem_f32_3d feature;     /* (rollout, candidate, number) */
    tandem_f32_2d glob;        /* (rollout, number) */
    tandem_i64_1d here;        /* (rollout,) token of the vehicle's place */
} tandem_observation;

typedef struct tandem_step_weights {
    tandem_f32_2d globe, globe_output, action, glimpse_bias, glimpse_output, action_query,
        action_mix;
    tandem_f32_1d globe_bias, globe_output_bias, action_bias, action_mix_bias, action_score;
} tandem_step_weights;

/* How a problem is searched: which moves there are, and where insertion looks. */
typedef struct tandem_strategy {
    bool loops;           /* sorties may end at the stop where they began */
    bool crossings;       /* and at others */
    bool two_opt_star;    /* routes swap their tails */
    bool resplit;         /* trips with one drone are split anew between truck and drone */
    bool small_moves;     /* trips with one drone are annealed by small moves, too */
    bool swap_vehicles;   /* vehicles drive others' routes, whose distance tells what they cost */
    bool change_vehicles; /* routes are timed anew with vehicles of other types */
    bool scan_all;        /* insertion looks at all routes, else beside neighbours alone */
    bool keep_places;     /* customers' best places on routes are kept from turn to turn */
    bool give_up_early;   /* a turn ends once it costs too much, as no insertion saves anything */
    bool fly_shipments;   /* drones may serve some end of a shipment */
    double blink;         /* how often a better place for a customer is overlooked */
} tandem_strategy;

/* What a plan costs as a whole: each ms until its last end, of how unequal what `measure` tells of
   its vehicles is, and each vehicle fewer than are to be used. */
typedef struct tandem_fairness {
    double makespan, balance, too_few;
    int64_t measure, min_vehicles;
    double used; /* how many vehicles, the sum of their shares and of the squares, their last end */
    double sum, squares;
    int64_t latest;
} tandem_fairness;

/* A problem as the search reads it. */
typedef struct tandem_problem_data {
    tandem_problem_tables problem;
    int64_t max_visits; /* customers on a sortie */
    tandem_strategy strategy;
    tandem_fairness fairness;
    bool all_optional;            /* nobody has to be served */
    bool unassigned_costs_differ; /* leaving out some costs more than others */
    tandem_bool_1d must_serve;    /* (node,) leaving it out costs more than any route for one */
    tandem_span_1d span;          /* (node,) as a route is timed, if there are orders across any */
    tandem_plugging_1d plugging;  /* (number,) of other routes as one is timed, by depot and time,
                                     and how many in the last row; none where nobody waits */
    tandem_bool_2d halts;     /* (type, depot) launch sites where it may stop; (0, 0) without any */
    tandem_i64_1d halt_after; /* (depot,) who is served before a stop there, or -1 */
    tandem_f64_1d halt_cost;  /* (depot,) of each stop there */
    tandem_i32_2d near_halts; /* (node, rank) launch sites near a customer, -1 behind the last */
    tandem_evaluation_1d evaluation; /* (row,) */
    tandem_i64_1d visits;            /* (row,) customers on a sortie */
    tandem_bool_3d can;              /* (row, 2, node) by truck, by drone */
    tandem_bool_2d splice;           /* (type, type) vehicles may end each other's routes */
    tandem_bool_2d swap;    /* (type, type) may drive others' routes at a cost by distance alone */
    tandem_legs leg, back;  /* duration, distance; the latter for those to a node */
    tandem_i32_2d near;     /* (node, rank) customers, nearest first, -1 behind the last */
    tandem_i32_2d granular; /* (node, rank) customers whom a truck would visit before or after */
    tandem_i64_1d deadline; /* (2,) when the search must end, as `model.engine.alarm` says */
} tandem_problem_data;

/* A search: its routes and all that it works with. It belongs to the engine. */
typedef struct tandem_search tandem_search;

/* What Python sees of a search. */
typedef struct tandem_seen {
    tandem_search_counts* count;
    tandem_search_values* value;
    tandem_u64_1d rng;                   /* (1,) */
    tandem_i64_1d active;                /* slots in use, and behind them those that are free */
    tandem_i64_1d missing, best_missing; /* customers left out */
    tandem_i64_1d absences;              /* (node,) turns after which a customer was left out */
    tandem_i64_1d used, best_used;       /* (type,) routes */
    tandem_f64_1d cost, best_cost;       /* (slot,) of each route */
    tandem_f64_3d alone; /* (type, 2, node) cost of a route that serves one customer */
} tandem_seen;

/* Functions return 0, or -1 without memory, or -2 after any other failure. */

int tandem_header(uint64_t* digest); /* of this file, the first 64 bits of its SHA-256 */

/* Plans. */

/* A plan, as numbers in order. Of each route: its type, the vehicle's number within that, and how
   many trips there are. Of each of these: from when to when the vehicle is charged before it, the
   same where it isn't; how many stops, sorties and breaks there are. Of a stop: its node, arrival,
   start of service, departure, how long whoever comes sets up, and whether it is a launch site
   where the truck stops for its drones. Of a sortie: the drone, the stops of launch and recovery,
   the take-off, when the recovery begins and ends, how many visits there are, and of each what is
   told of a stop. Of a break: its number, -1 of a rest that rules ask for, the stop before it,
   whether it is taken there (0), on the way (1), or at the next (2), when the truck stands, and
   when it begins and ends. */
typedef struct tandem_plan tandem_plan;

int tandem_open_plan(tandem_plan** plan);
int tandem_close_plan(tandem_plan* plan);
int tandem_numbers_of(tandem_plan* plan, tandem_i64_1d* numbers);

/* Travel. */

/* Write the numbers of the points nearest to those of some places, nearest first. */
int tandem_write_nearest_in(const tandem_cells* cells, int64_t begin, int64_t end,
                            const tandem_i32_2d* nearest);

/* Count the pairs of edges that are near enough to cross, roughly. */
int tandem_count_nearby(const tandem_f64_2d* edges, int64_t* pairs);

/* Mark the ends that each of some starts doesn't see past edges. */
int tandem_mark_hidden(const tandem_f64_2d* starts, const tandem_f64_2d* ends,
                       const tandem_f64_2d* edges, const tandem_bool_2d* hidden, int64_t first,
                       int64_t last, bool mutual);

/* Mark the corners that no shortest way from each of some starts bends at. */
int tandem_mark_dead_ends(const tandem_f64_2d* starts, const tandem_f64_2d* corners,
                          const tandem_f64_2d* before, const tandem_f64_2d* after, double slack,
                          const tandem_bool_2d* hidden, int64_t first, int64_t last);

/* Write the pairs of corners that see each other and that a shortest way may go between, those in a
   quarter of all directions from corners in some places of its grid, while there is room; and how
   many, and where to go on. */
int tandem_write_sights(const tandem_f64_2d* corners, const tandem_f64_2d* before,
                        const tandem_f64_2d* after, const tandem_f64_2d* edges, double slack,
                        bool is_east, int64_t first, int64_t last, const tandem_i32_2d* pairs,
                        int64_t* written, int64_t* next);

/* Write the quickest flights that bend at least once, from some of the nodes in an order; mutual,
   to those alone that come later. */
int tandem_fly_around(const tandem_sights* outward, const tandem_sights* between,
                      const tandem_sights* inward, const tandem_turns* turns,
                      const tandem_bool_2d* wanted, const tandem_i64_1d* order, bool mutual,
                      int64_t first, int64_t last, const tandem_f64_2d* distance,
                      const tandem_f64_2d* duration);

/* Simulation. */

/* Begin rollouts of problems, given by their rows, with scratch rows behind them, at least one. */
int tandem_open_state(const tandem_instance* instance, const tandem_i64_1d* problems,
                      int64_t scratch, tandem_state** state);
/* Give them back. */
int tandem_close_state(tandem_state* state);
/* Tell where that is which Python sees. */
int tandem_look_at_state(tandem_state* state, tandem_state_seen* seen);
/* Tell of the open vehicle of a rollout. */
int tandem_look_at_vehicle(tandem_state* state, int64_t r, tandem_under_way* vehicle);
/* Write the codes of the legal actions and what each on a customer leads to; tell how many. */
int tandem_legal_actions(const tandem_instance* instance, tandem_state* state, int64_t r,
                         int64_t scratch, const tandem_i64_1d* actions,
                         const tandem_outlook_1d* outlooks, int64_t* found);
/* Do one legal action. */
int tandem_apply(const tandem_instance* instance, tandem_state* state, int64_t r, int64_t action);
/* Tell the routes that legal actions make, from the first on. */
int tandem_tell_rollout(const tandem_instance* instance, tandem_state* state, int64_t r,
                        const tandem_i64_1d* actions, tandem_plan* plan);
/* Do legal actions from the `first` on up to the one that opens the next vehicle, at `behind`. */
int tandem_apply_route(const tandem_instance* instance, tandem_state* state, int64_t r,
                       const tandem_i64_1d* actions, int64_t first, int64_t* behind);
/* Write what each vehicle of legal actions costs as if there were no other. */
int tandem_price_routes(const tandem_instance* instance, tandem_state* state, int64_t r,
                        const tandem_i64_1d* actions, const tandem_cost_1d* price);
/* End a rollout that has no legal action left. */
int tandem_finish(const tandem_instance* instance, tandem_state* state, int64_t r);

/* Policy. */

/* Problems as policies see them. */
typedef struct tandem_scene {
    tandem_instance instance;
    tandem_scales scale;
    tandem_f32_3d type_token; /* (problem, type, number) */
} tandem_scene;

/* How a rollout begins and goes on. */
typedef struct tandem_course {
    double temperature;    /* 0 for the likeliest action at each step */
    tandem_u64_1d random;  /* (1,) state of random numbers, which is moved on */
    int64_t kept;          /* how many actions are given */
    tandem_i64_1d actions; /* codes */
} tandem_course;

/* List and describe legal actions of the rollouts `first` to `behind`; `most` of any of them. */
int tandem_observe(const tandem_scene* scene, tandem_state* state, int64_t first, int64_t behind,
                   int64_t scratch, const tandem_observation* seen, int64_t* most);
/* Do what was chosen of what was seen, then observe. */
int tandem_step(const tandem_scene* scene, tandem_state* state, int64_t first, int64_t behind,
                int64_t scratch, const tandem_i64_1d* choice, const tandem_observation* seen,
                int64_t* most);
/* Score the candidates of one rollout, before they are clipped. */
int tandem_candidate_scores(const tandem_step_weights* weights, const tandem_f32_2d* memory,
                            const tandem_observation* seen, int64_t r, const tandem_f32_1d* scores);
/* Choose the likeliest candidate, or one drawn by probability if the temperature isn't 0. */
int tandem_choose(const tandem_f32_1d* scores, double temperature, const tandem_u64_1d* random,
                  int64_t* choice);
/* Plan row `r` of the state by the policy, where the last row is scratch, until an alarm tells to
   give up; `count` of its actions, -1 if it was given up. */
int tandem_roll_out(const tandem_step_weights* weights, const tandem_f32_2d* memory,
                    const tandem_scene* scene, tandem_state* state, int64_t r,
                    const tandem_course* course, const tandem_i64_1d* alarm, int64_t* count);

/* Search: neighbourhood. */

/* Write all customers in the order of a walk to the nearest who wasn't met yet. */
int tandem_walk(const tandem_i32_2d* near, int64_t num_depots, const tandem_i64_1d* node);

/* Write the legs from nodes, the search's number `first` and behind. */
int tandem_write_legs(const tandem_i64_2d* duration, const tandem_i64_2d* distance,
                      const tandem_i64_1d* node, int64_t first, const tandem_i64_3d* legs);

/* The same in 32 bits. */
int tandem_write_narrow_legs(const tandem_i32_2d* duration, const tandem_i32_2d* distance,
                             const tandem_i64_1d* node, int64_t first, const tandem_i32_3d* legs);

/* Write how badly neighbours follow or precede customers. */
int tandem_write_misfit(const tandem_i64_2d* there, const tandem_i64_2d* back,
                        const tandem_i64_2d* other, int64_t first, const tandem_f64_1d* earliest,
                        const tandem_f64_1d* service, const tandem_f64_1d* latest,
                        const tandem_f64_2d* weight);

/* Search: route. */

/* Make room for a search: so many routes, and of each so many stops, trips and sorties. */
int tandem_open_search(const tandem_problem_data* data, int64_t routes, int64_t stops,
                       int64_t trips, int64_t sorties, tandem_search** search);
/* Give it back. */
int tandem_close_search(tandem_search* search);
/* Tell where that is which Python sees. */
int tandem_look_into(tandem_search* search, tandem_seen* seen);
/* Go on from the best routes. */
int tandem_go_back(tandem_search* search);

/* Search: insertion and moves. */

/* Write the cheapest legal places of a customer, or of a shipment by its first pickup, on a route
   as it is and on trips more of it: what each costs, and its placements as node, how (0: by truck
   at stop `from`, 1: a halt, 2 and 3: a trip begins or ends, 4: flown to from stop `from` to `to`
   by `drone`, 5: likewise, before others, 6: as customer number `to` of sortie `from`, 7: behind
   customer `from` on the same flight), from, to and drone; -1 behind the last of them. Those by
   truck alone come first, the cheapest first, then those with drones. */
int tandem_write_places(const tandem_problem_data* data, tandem_search* search, int64_t node,
                        int64_t slot, const tandem_f64_1d* costs, const tandem_i64_3d* placements,
                        int64_t* count);
/* Ruin and recreate; by an order, insert all who are left out instead. */
int tandem_anneal(const tandem_problem_data* data, tandem_search* search, int64_t turns,
                  int64_t order);

/* Search: linked. */

/* Routes as linked stops. They belong to the engine. */
typedef struct tandem_linked tandem_linked;

/* Make room for the routes of a search, and for so many changes of times in a turn, none where
   nothing limits times; neighbours are as near as in another search of the same problem, if any. */
int tandem_open_linked(const tandem_problem_data* data, tandem_search* search, int64_t moments,
                       const tandem_linked* like, tandem_linked** linked);
/* Give it back. */
int tandem_close_linked(tandem_linked* linked);
/* Link the routes of a search as they are, and of its best plan. */
int tandem_tie(const tandem_problem_data* data, tandem_search* search, tandem_linked* linked);
/* Ruin and recreate so many times among linked stops; by an order, link the routes of a search,
   insert all who are left out and write them back instead. */
int tandem_anneal_linked(const tandem_problem_data* data, tandem_search* search,
                         tandem_linked* linked, int64_t turns, int64_t order);
/* Let the routes of a search, and of its best plan, be those that are linked. */
int tandem_write_back(const tandem_problem_data* data, tandem_search* search,
                      tandem_linked* linked);

/* Search: beginning. */

/* Take all routes apart. */
int tandem_disband(const tandem_problem_data* data, tandem_search* search);
/* Take the route apart, without sorties, whose customers were left out after the fewest turns. */
int tandem_give_up_route(const tandem_problem_data* data, tandem_search* search);
/* Insert the shipments left out among the routes that there are, as `search/ejection` says, in so
   many rounds at most; `gently`, others hardly go other ways. `made` is how many, `done` whether
   all were; else the routes are as they were, or the best. */
int tandem_eject(const tandem_problem_data* data, tandem_search* search, int64_t rounds,
                 bool gently, int64_t* made, int64_t* done);
/* Move or exchange so many shipments at random, where all are served and rules are kept; by one
   vehicle more, too, if there is one. */
int tandem_move_shipments(const tandem_problem_data* data, tandem_search* search, int64_t moves,
                          bool by_one_more);
/* Let the routes be those of one plan, some of them exchanged for as many of another that serve
   nearly the same shipments; whoever fits nowhere then is left out. Plans are the ends that each
   route serves, in order, ended by -1. Not `done`: the routes are the best ones, or as before. */
int tandem_exchange_routes(const tandem_problem_data* data, tandem_search* search,
                           const tandem_i64_1d* one, const tandem_i64_1d* other, int64_t* done);
/* Write which type's trucks drive least for each customer alone. */
int tandem_write_nearest_types(const tandem_problem_data* data, const tandem_i64_1d* nearest);
/* Write keys of customers and their nearest neighbours, by how much more is driven by a type if
   they follow one another, but for its last bits, and then by their numbers. */
int tandem_write_pairs(const tandem_problem_data* data, int64_t k, int64_t ranks,
                       const tandem_i64_1d* keys);
/* Join routes end to end, or `either_way` at either end, pair after pair; write who comes before
   and behind each customer, and how far the routes of all are whom the type may serve. */
int tandem_join(const tandem_problem_data* data, int64_t k, int64_t ranks,
                const tandem_i64_1d* keys, bool either_way, const tandem_i64_2d* beside,
                int64_t* length);
/* Begin with the routes of a plan; those that break a rule are left to be planned anew. */
int tandem_begin(const tandem_problem_data* data, tandem_search* search,
                 const tandem_i64_1d* numbers);
/* Price a route for a customer alone anew, whose window or whom he is served by has changed. */
int tandem_price_alone(const tandem_problem_data* data, tandem_search* search, int64_t node);
/* Tell what the truck's legs between customers cost on average, and what those left out do. */
int tandem_leg_cost(const tandem_problem_data* data, tandem_search* search, double* cost,
                    double* missing);
/* Tell the routes of the best plan, whose trips begin as late as costs nothing; fails if nobody can
   drive one. Or those alone that a whole lacks, by its places; one without trips is gone. */
int tandem_tell_best(const tandem_problem_data* data, tandem_search* search, tandem_plan* plan);
int tandem_tell_changed(const tandem_problem_data* data, tandem_search* search,
                        tandem_search* whole, tandem_plan* plan);

/* Tell the sum of digests of all that insertions were found to cost since the last call, in builds
   with TANDEM_TRACED; nought in others. */
int tandem_take_trace(int64_t* digest);

/* Search: sharing. */

/* Write the slot of each node's route, -1 if it is left out, -2 if another thread's. */
int tandem_write_slots(tandem_search* search, const tandem_i64_1d* slots);
/* Write how many batteries each route takes of each depot, (slot, depot). */
int tandem_write_taken(const tandem_problem_data* data, tandem_search* search,
                       const tandem_i64_2d* taken);
/* Write whom each route serves, in order, ended by -1; tell how many numbers that takes. */
int tandem_write_served(tandem_search* search, const tandem_i64_1d* nodes, int64_t* count);
/* Tell how many routes and sorties the best plan has. */
int tandem_size_of_best(tandem_search* search, int64_t* routes, int64_t* sorties);
/* Go on from the routes that a thread owns, in so many slots, and the customers missing; so many
   vehicles of each type are used, by others too. */
int tandem_take_part(const tandem_problem_data* data, tandem_search* whole, tandem_search* part,
                     int64_t slots, const tandem_i64_1d* owner, int64_t number,
                     const tandem_i64_1d* missing, const tandem_i64_1d* used);
/* Go on from all routes as they are, or from the best ones. */
int tandem_take_all(const tandem_problem_data* data, tandem_search* whole, tandem_search* part);
int tandem_take_best(const tandem_problem_data* data, tandem_search* search);
/* Have a part's routes, or its best, beside those there are, or alone, and whom it leaves out. */
int tandem_add_routes(const tandem_problem_data* data, tandem_search* whole, tandem_search* part,
                      bool best, bool alone);
/* Let the best plan take over the parts of the routes as they are that cost less. */
int tandem_take_better_parts(const tandem_problem_data* data, tandem_search* search);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif
#endif
