"""Places for a customer on a route: behind a stop, on sorties, on trips of the customer's own."""

from model.kernel.alarm import rung
from model.kernel.compiled import inlined, pasted, spliced
from model.kernel.drone_types import (
    first_drone, first_drone_row, next_drone_row, row_of_drone,
)
from model.kernel.energy import charges_aboard
from model.kernel.flight import (
    can_serve, earliest_back, gone_by, recovery_end, take_off, unreachable, within_endurance,
)
from model.kernel.leg import (
    LegRow, leg, leg_from, leg_to, legs_from, legs_of, legs_to,
)
from model.kernel.records import Record, Records
from model.kernel.stop import end_of_service, places_by_air, places_of, service_duration, too_late
from model.problem import FloatArray
from model.search.insertion.cheapest_stop import is_simple
from model.search.insertion.evaluate import INFEASIBLE, price_move, price_stop, stands_alone
from model.search.insertion.new_trips import may_begin, more_trips_fit, part_fits
from model.search.route.edit import (
    AT_STOP, BY_SORTIE, FLIGHT_TRIP, NEW_TRIP, ON_SORTIE, TRIP_FROM, TRIP_UNTIL, copy_move,
)
from model.search.route.ends import detour_by_reload, is_apart
from model.search.route.goods import goods_may_join
from model.search.route.halts import (
    can_carry, load_cost, load_more, load_more_behind, room_behind, room_between, room_on,
)
from model.search.route.layout import END, MODE_PRICED, MODE_TIMED, NOWHERE, START, Fleet, World
from model.search.route.randomness import uniform
from model.search.route.rarer import loads_cost, tiers_of
from model.search.route.refresh import idle_time
from model.search.route.routes import lateness_cost
from model.search.route.state import Searcher
from model.search.route.vehicles import has_battery, may_fit

MAX_SPAN = 8
"""How many stops after its launch a sortie is recovered at most."""

AT_ONE_STOP = MAX_SPAN + 2
"""How many insertions begin at a stop at most, a customer behind it and sorties from there."""


@spliced
def add_offer(offer: Records, least: FloatArray, count: Record, cost: float, kind: int, slot: int,
              first: int) -> int:
    """List an insertion that costs at least `cost`; return where, to complete it. In place."""
    index = count.offers
    offer[index].kind, offer[index].slot, offer[index].first = kind, slot, first
    least[index] = cost
    count.offers += 1
    return index


@spliced
def stop_costs(world: World, k: int, inward: LegRow, onward: LegRow, stops: Records, p: int,
               node: int, spare: int, early: float, best: float) -> float:
    """Return what a customer behind stop `p` costs at least, or `best` if that is no less.

    Or not allowed. `spare` is the time that the route could work longer at no cost, `early` what
    its waiting costs, which may become less.
    """
    place = places_of(world.place, world.type[k])[node]
    here, there = stops[p].node, stops[p + 1].node
    out, on = leg_from(inward, here), leg_to(onward, there)
    cost = (out.distance + on.distance - stops[p].leg) * world.rate[k].distance - early
    cost += world.rate[k].stop
    mode = world.mode[k]
    if mode & MODE_TIMED:
        # While drones fly, the truck may have time before they are back.
        longer = out.duration + on.duration + service_duration(place) - stops[p].gap
        cost += max(0, longer - spare - stops[p].idle) * world.rate[k].time
    if cost >= best:
        return best
    arrival = stops[p].leave + out.duration
    following = end_of_service(place, arrival) + on.duration
    if too_late(place, arrival) or following > stops[p + 1].latest:
        return best
    if mode & MODE_PRICED:
        cost += (lateness_cost(world, node, arrival) + lateness_cost(world, there, following)
                 - lateness_cost(world, there, stops[p + 1].arrival))
    return cost


@pasted
def offer_stops(world: World, searcher: Searcher, slot: int, first: int, last: int,
                node: int) -> None:
    """List a customer behind each stop of a trip from `first` to `last`, if that may be cheaper.

    For where more than distance counts. In place.
    """
    now, best = searcher.now, searcher.bound.best
    k, stops = now.route[slot].type, now.stop[slot]
    m = world.type[k].travel
    inward, onward = legs_to(world.back, m, node), legs_from(world.leg, m, node)
    spare, early = idle_time(now.route[slot]), now.early[slot]
    most = world.type[k].max_trip_distance - now.trip[slot, stops[first].trip].distance
    room = room_on(world, now, slot, k, node)
    for p in range(first, last + 1):
        cost = stop_costs(world, k, inward, onward, stops, p, node, spare, early, best)
        out, on = leg_from(inward, stops[p].node), leg_to(onward, stops[p + 1].node)
        if cost < best and loads_cost(world, k):
            cost += load_more_behind(world, now, slot, p, node, out.distance, on.distance)
        if (cost < best and out.distance + on.distance - stops[p].leg <= most
                and room_behind(room, p)):
            add_offer(searcher.offer, searcher.least, searcher.count, cost, AT_STOP, slot, p)


@spliced
def free_drone(world: World, fleet: Fleet, slot: int, launch: int, recovery: int,
               row: int) -> int:
    """Return a drone of a row that is aboard from stop `launch` to `recovery`; -1: there is none.

    That which flies least from and to these stops, so that drones fly side by side; on the trip, if
    drones are charged aboard.
    """
    sorties, stops = fleet.sortie[slot], fleet.stop[slot]
    charging = charges_aboard(world.type[row])
    chosen, fewest = NOWHERE, 0
    number = first_drone(world.type, fleet.route[slot].type, row)
    for drone in range(number, number + world.type[row].drones):
        free, beside = True, 0
        for s in range(fleet.route[slot].sorties):
            if sorties[s].drone == drone:
                first, last = sorties[s].launch, sorties[s].recovery
                same_trip = charging and stops[first].trip == stops[launch].trip
                if same_trip or (first <= recovery and launch <= last):
                    beside += 1
                if first < recovery and launch < last:
                    free = False
                if launch == recovery and first < launch < last:
                    free = False
                if first == last and launch < first < recovery:
                    free = False
                if first == launch and recovery > launch and last > first:
                    free = False
        if free and (chosen == NOWHERE or beside < fewest):
            chosen, fewest = drone, beside
    return chosen


@pasted
def offer_sorties(world: World, searcher: Searcher, slot: int, launch: int, node: int) -> None:
    """List sorties to a customer from stop `launch`, by each type of drones. As `offer_stops`."""
    route, stops, sorties = searcher.now.route[slot], searcher.now.stop[slot], (
        searcher.now.sortie[slot])
    row = first_drone_row(world.type, route.type)
    while row >= 0:
        if world.can[row, 1, node] and has_battery(
                world.type, route, sorties, searcher.now.trip[slot, stops[launch].trip], row):
            offer_flights(world, searcher, slot, launch, node, row)
        row = next_drone_row(world.type, row)


@spliced
def offer_flights(world: World, searcher: Searcher, slot: int, launch: int, node: int,
                  row: int) -> None:
    """List sorties to a customer from stop `launch` by drones of a row. As `offer_stops`."""
    now, best = searcher.now, searcher.bound.best
    k, stops = now.route[slot].type, now.stop[slot]
    kind, rate = world.type[row], world.rate[row]
    m = kind.drone_travel
    inward, onward = legs_to(world.back, m, node), legs_from(world.leg, kind.home_travel, node)
    out = leg_from(inward, stops[launch].node)
    place, left = places_by_air(world.place, kind)[node], gone_by(kind, stops[launch].leave)
    begun = stops[launch].arrival
    if launch > 0:
        begun = take_off(kind, begun, 0)
    service = service_duration(place)
    late = 0.0
    if world.mode[k] & MODE_PRICED:
        late = lateness_cost(world, node, begun + out.duration)
    begun = recovery_end(kind, begun) - idle_time(now.route[slot])
    first = launch if world.loops else launch + 1
    last, room = launch, room_on(world, now, slot, k, node)
    if world.crossings:
        last = min(launch + MAX_SPAN, now.trip[slot, stops[launch].trip].last)
    for recovery in range(first, last + 1):
        home = leg_to(onward, stops[recovery].node)
        met = stops[recovery].arrival
        flight = out.duration + service + home.duration
        if not within_endurance(kind, left, left, met):
            # Held back for the window, the truck leaves later and may wait less on its way.
            if earliest_back(place, left + out.duration, 0) <= left:
                break
            if met > earliest_back(place, left + out.duration, home.duration):
                continue
        # The truck leaves no sooner than the drone is aboard, whatever else it has time for.
        longer = max(0, begun + flight - stops[recovery].leave)
        cost = ((out.distance + home.distance) * rate.drone_distance
                + longer * rate.time + late - now.early[slot])
        if loads_cost(world, k):
            cost += load_more(world, now, slot, launch, recovery, node)
        if (cost < best and can_serve(kind, place, out.duration, home.duration)
                and room_between(room, launch, recovery)):
            index = add_offer(searcher.offer, searcher.least, searcher.count, cost, BY_SORTIE,
                              slot, launch)
            searcher.offer[index].last, searcher.offer[index].type = recovery, row


@pasted
def offer_joining(world: World, searcher: Searcher, slot: int, node: int) -> None:
    """List a customer on each sortie of a route. As `offer_stops`."""
    now = searcher.now
    k, stops, sorties = now.route[slot].type, now.stop[slot], now.sortie[slot]
    for s in range(now.route[slot].sorties):
        sortie = sorties[s]
        row = row_of_drone(world.type, k, sortie.drone)
        flights = legs_of(world.leg, world.type[row].drone_travel)
        trip = stops[sortie.launch].trip
        if (sortie.count >= world.visits[row] or not world.can[row, 1, node]
                or not may_fit(world, now, slot, trip, k, node)
                or not goods_may_join(world, now, slot, trip, node)
                or not room_between(room_on(world, now, slot, k, node), sortie.launch,
                                    sortie.recovery)):
            continue
        may_carry = can_carry(world, row, sortie, 0, node)
        if not (may_carry or tiers_of(world) > 0):
            continue
        here = stops[sortie.launch].node
        for place in range(sortie.count + 1):
            there = stops[sortie.recovery].node
            if place < sortie.count:
                there = sortie.nodes[place]
            out, on, direct = (leg(flights, here, node), leg(flights, node, there),
                               leg(flights, here, there))
            cost = ((out.distance + on.distance - direct.distance) * world.rate[row].drone_distance
                    - now.early[slot])
            here = there
            if cost < searcher.bound.best and place > 0 and tiers_of(world) > 0:
                may_carry = can_carry(world, row, sortie, place, node)
            if cost < searcher.bound.best and may_carry:
                index = add_offer(searcher.offer, searcher.least, searcher.count, cost,
                                  ON_SORTIE, slot, place)
                searcher.offer[index].sortie = s


@pasted
def offer_flight_trips(world: World, searcher: Searcher, slot: int, node: int) -> None:
    """List trips that a drone flies alone to a customer. As `offer_stops`."""
    route, stops = searcher.now.route[slot], searcher.now.stop[slot]
    k = route.type
    depot, row = world.type[k].depot, first_drone_row(world.type, k)
    while row >= 0:
        flights = legs_of(world.leg, world.type[row].drone_travel)
        out, home = leg(flights, depot, node), leg(flights, node, depot)
        cost = (out.distance + home.distance) * world.rate[row].drone_distance
        cost -= searcher.now.early[slot]
        if (world.loops and not unreachable(max(out.duration, home.duration))
                and cost < searcher.bound.best and world.can[row, 1, node]
                and may_begin(world, k, node)):
            for p in range(-1, route.length):
                if p < 0 or stops[p].kind == END:
                    index = add_offer(searcher.offer, searcher.least, searcher.count, cost,
                                      FLIGHT_TRIP, slot, p)
                    searcher.offer[index].drone = first_drone(world.type, k, row)
        row = next_drone_row(world.type, row)


@pasted
def offer_trips(world: World, searcher: Searcher, slot: int, node: int) -> None:
    """List a customer where a trip more begins or ends. As `offer_stops`."""
    now = searcher.now
    route, stops, best = now.route[slot], now.stop[slot], searcher.bound.best
    k = route.type
    m, depot, rate = world.type[k].travel, world.type[k].depot, world.rate[k].distance
    legs, inward = legs_of(world.leg, m), legs_to(world.back, m, node)
    out, home = leg_from(inward, depot).distance, leg(legs, node, depot).distance
    for p in range(-1, route.length):
        kind = NEW_TRIP
        cost = (out + home) * rate
        if p >= 0 and stops[p].kind != END:
            if stops[p].flying > 0 or stops[p].kind == START or stops[p + 1].kind == END:
                continue
            here, there = stops[p].node, stops[p + 1].node
            base = -stops[p].leg
            until = (base + leg_from(inward, here).distance + home
                     + leg(legs, depot, there).distance) * rate
            cost = (base + leg(legs, here, depot).distance + out
                    + leg(legs, node, there).distance) * rate
            kind = TRIP_FROM
            if until < cost:
                kind, cost = TRIP_UNTIL, until
            if cost < best and not part_fits(world, now, slot, p, node, kind == TRIP_UNTIL):
                continue
        cost += world.rate[k].stop - now.early[slot]
        if kind != NEW_TRIP and loads_cost(world, k):
            # Each of two trips carries less, at best next to nothing.
            cost -= load_cost(world, now, slot)
        if kind == NEW_TRIP and not may_begin(world, k, node):
            continue
        if cost < best and (p < 0 or not too_late(world.place[0, node], stops[p].leave)):
            add_offer(searcher.offer, searcher.least, searcher.count, cost, kind, slot, p)


@pasted
def offer_trips_apart(world: World, searcher: Searcher, slot: int, node: int) -> None:
    """As `offer_trips`, where trips don't all begin and end at one place."""
    now = searcher.now
    route, stops, best = now.route[slot], now.stop[slot], searcher.bound.best
    k = route.type
    rate, end = world.rate[k].distance, route.length - 1
    for p in range(-1, route.length):
        kind, first = NEW_TRIP, True
        if p < 0:
            here, there = stops[0].node, stops[1].node
        elif p == end:
            here, there, first = stops[p - 1].node, stops[p].node, False
        elif stops[p].kind == END:
            here, there = stops[p].node, stops[p + 2].node
        elif stops[p].flying > 0 or stops[p].kind == START or stops[p + 1].kind == END:
            continue
        else:
            here, there, kind = stops[p].node, stops[p + 1].node, TRIP_UNTIL
        cost = detour_by_reload(world, k, here, node, there, first) * rate
        if kind == TRIP_UNTIL:
            behind = detour_by_reload(world, k, here, node, there, False) * rate
            if behind < cost:
                kind, cost = TRIP_FROM, behind
        cost += world.rate[k].stop - now.early[slot]
        if loads_cost(world, k):
            # Whoever was served may be carried less far, at best next to nowhere.
            cost -= load_cost(world, now, slot)
        if kind == NEW_TRIP and not may_begin(world, k, node):
            continue
        if cost < best:
            add_offer(searcher.offer, searcher.least, searcher.count, cost, kind, slot, p)


@inlined
def price_offer(world: World, fleet: Fleet, move: Record, node: int, least: float,
                acc: Record) -> float:
    """Return what an insertion costs, at least `least`; INFEASIBLE if it can't be.

    In place: a sortie's drone.
    """
    kind, slot, p = move.kind, move.slot, move.first
    if kind == BY_SORTIE:
        move.drone = free_drone(world, fleet, slot, p, move.last, move.type)
        if move.drone < 0:
            return INFEASIBLE
    elif kind == AT_STOP:
        if stands_alone(world, fleet, slot, p, node):
            return price_stop(world, fleet, slot, p, node)
    elif (kind in (NEW_TRIP, TRIP_FROM, TRIP_UNTIL) and is_simple(world, fleet, slot)
          and not is_apart(world, fleet.route[slot].type)):
        return least if more_trips_fit(world, fleet, slot, p, node, kind) else INFEASIBLE
    return price_move(world, fleet, move, node, acc)


@pasted
def take_cheapest(world: World, searcher: Searcher, node: int) -> None:
    """Let the move be the cheapest of the insertions listed, if it is the best, but for blinks.

    Those that may be cheapest are priced first, so that most need not be; none is once the search
    must end. In place.
    """
    bound, least, offer = searcher.bound, searcher.least, searcher.offer
    left = searcher.count.offers
    while left > 0 and not rung(world.stop):
        first = 0
        for index in range(1, left):
            if least[index] < least[first]:
                first = index
        if least[first] >= bound.best:
            break
        cost = price_offer(world, searcher.now, offer[first], node, least[first], searcher.acc)
        if cost < bound.best and uniform(searcher.rng) >= bound.blink:
            bound.best = cost
            copy_move(offer[first], searcher.move)
        left -= 1
        least[first] = least[left]
        offer[first] = offer[left]
    searcher.count.offers = 0
