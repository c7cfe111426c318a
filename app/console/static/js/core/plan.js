/**
 * A plan as the views need it: vehicles, trips, sorties and halts, each with a key.
 *
 * Keys are `c:<customer>`, `d:<vehicle>/<trip>/<stop>` for depots, `v:<vehicle>`,
 * `t:<vehicle>/<trip>`, `s:<vehicle>/<trip>/<sortie>` and `l:<vehicle>/<trip>/<stop>` for the leg
 * that leads to a stop; vehicles count in the fleet's order.
 */

import { decodeLine } from './polyline.js';
import { placeOf } from './places.js';
import { standsOf } from './stands.js';
import { labelOfVehicle } from './vehicle-labels.js';
import { isVisit, visitName, visitsOf } from './visits.js';
import { windowAt } from './windows.js';

/** How exactly lines state places, which they round. */
const NEAR = 1e-5;

/**
 * Return the index of a plan, or null without one.
 *
 * @param given the number of each vehicle by name; without it they count in the fleet's order
 */
export function indexPlan(request, plan, given = null) {
  if (!plan) return null;
  const customers = new Map(visitsOf(request).map((visit) => [visit.id, visit]));
  const depots = new Map(request.depots.map((depot) => [`depot ${depot.id}`, depot]));
  standsOf(request).forEach((stand) => depots.set(`${stand.kind} ${stand.id}`, stand));
  const types = new Map(request.fleet.map((type) => [type.id, type]));
  const index = { request, plan, customers, depots, types, vehicles: [], halts: new Map() };
  // Replies put vehicles under way first; here each keeps its row, number and colour.
  const numbers = given ?? numbersOf(request, plan);
  index.vehicles = inOrder(request.fleet, plan, given).map((route, position) =>
    indexRoute(index, route, position, numbers.get(route.vehicle)));
  return index;
}

/** Return a plan's routes in the order of the fleet, those of a type by number. */
function inOrder(fleet, { routes }, given = null) {
  const types = new Map(fleet.map(({ id }, position) => [id, position]));
  const place = ({ type, vehicle }) => [
    types.get(type) ?? fleet.length,
    given ? given.get(vehicle) : Number(vehicle.slice(type.length + 1))];
  return [...routes].sort((first, second) => {
    const [[type, number], [otherType, otherNumber]] = [place(first), place(second)];
    return type - otherType || number - otherNumber;
  });
}

const numberings = new WeakMap();

/** Return the number of each vehicle of a plan, from 0; where it goes on from another, as there. */
export function numbersOf(request, plan) {
  if (numberings.has(plan)) return numberings.get(plan);
  const numbers = new Map(request.replan ? numbersOf({ fleet: request.fleet }, request.replan.plan)
    : []);
  for (const { vehicle } of inOrder(request.fleet, plan)) {
    if (!numbers.has(vehicle)) numbers.set(vehicle, numbers.size);
  }
  numberings.set(plan, numbers);
  return numbers;
}

function indexRoute(index, route, position, number) {
  const type = index.types.get(route.type);
  const vehicle = {
    key: `v:${position}`,
    index: position,
    number,
    label: labelOfVehicle(index.request.fleet, route.vehicle, route.type),
    name: route.vehicle,
    type,
    flies: Boolean(type?.flies),
    route,
    trips: [],
  };
  vehicle.trips = route.trips.map((trip, position) => indexTrip(index, vehicle, trip, position));
  return vehicle;
}

function indexTrip(index, vehicle, reply, number) {
  const place = `${vehicle.index}/${number}`;
  const several = vehicle.route.trips.length > 1;
  const trip = {
    key: `t:${place}`,
    index: number,
    vehicle,
    reply,
    label: several ? `${vehicle.label}.${number + 1}` : vehicle.label,
    stops: [],
    sorties: [],
  };
  trip.stops = reply.stops.map((stop, position) => {
    const key = isVisit(stop) ? `c:${visitName(stop)}` : `d:${place}/${position}`;
    // A truck may come back to a depot or a customer for its drones.
    const source = isVisit(stop)
      ? placedAt(index.customers.get(visitName(stop)), stop.alternative)
      : stop.kind === 'break'
        ? undefined
        : (index.depots.get(`${stop.kind} ${stop.id}`) ??
        index.depots.get(`depot ${stop.id}`) ??
        index.customers.get(stop.id));
    return remember(index, {
      ...haltOf(key, stop, trip, source), stop: position, sortie: null, waiting: stop.waiting,
      load: stop.load,
    });
  });
  reply.stops.forEach(({ geometry, kind }, position) => {
    const halt = trip.stops[position];
    // A break is drawn where the stop before it is.
    if (kind === 'break') halt.location = trip.stops[position - 1].location;
    const places = [trip.stops[position - 1]?.location, halt.location];
    halt.line = lineOf(geometry, places) ?? places.filter(Boolean);
  });
  trip.sorties = reply.sorties.map((sortie, position) => {
    const key = `s:${place}/${position}`;
    const entry = {
      key, trip, reply: sortie, drone: sortie.drone, from: trip.stops[sortie.launch_stop],
      to: trip.stops[sortie.recovery_stop], visits: [],
    };
    entry.visits = sortie.customers.map((visit) => {
      const source = placedAt(index.customers.get(visit.id), visit.alternative);
      const halt = haltOf(`c:${visit.id}`, { ...visit, kind: 'customer' }, trip, source);
      return remember(index, {
        ...halt,
        stop: null,
        sortie: entry,
        load: source.demand,
        waiting: visit.service_start - visit.arrival - (visit.setup ?? 0),
      });
    });
    const places = [entry.from, ...entry.visits, entry.to].map((halt) => halt?.location);
    entry.lines = [...sortie.customers.map(({ geometry }) => geometry), sortie.recovery_geometry]
      .map((geometry, index) => lineOf(geometry, places.slice(index, index + 2)));
    return entry;
  });
  return trip;
}

/**
 * Return the line of a leg that is told, null if it doesn't lead from one place to the other.
 *
 * @param {string | undefined} geometry
 * @param {Point[]} ends
 */
function lineOf(geometry, [from, to]) {
  if (!geometry || !from || !to) return null;
  const line = decodeLine(geometry);
  return line.length > 1 && near(line[0], from) && near(line[line.length - 1], to) ? line : null;
}

function near([x, y], [otherX, otherY]) {
  return Math.abs(x - otherX) < NEAR && Math.abs(y - otherY) < NEAR;
}

/** Return a customer as it is at the place that is used, its own unless that is told. */
function placedAt(customer, alternative) {
  const place = customer?.alternatives?.find(({ id }) => id === alternative);
  if (!place) return customer;
  const { id: _id, cost: _cost, service_duration: service, ...there } = place;
  const { location: _place, time_window: _one, time_windows: _several, ...rest } = customer;
  const own = service == null ? {} : { service_duration: service, service_duration_by_type: {} };
  return { ...rest, ...there, ...own };
}

function haltOf(key, reply, trip, source) {
  return {
    key,
    kind: reply.kind,
    id: reply.id,
    alternative: reply.alternative ?? null,
    part: reply.part ?? null,
    trip,
    vehicle: trip.vehicle,
    source,
    location: placeOf(source ?? {}),
    window: isOfItsOwn(reply, source) ? windowAt(source, reply.service_start) : null,
    arrival: reply.arrival,
    serviceStart: reply.service_start,
    setup: reply.setup ?? 0,
    departure: reply.departure,
    lateness: reply.lateness?.seconds ?? reply.lateness,
    chance: reply.lateness?.chance ?? null,
    energyLeft: reply.energy_left_wh ?? null,
  };
}

/** Tell whether a stop keeps the window of its place, as one of a truck that comes back doesn't. */
function isOfItsOwn({ kind }, source) {
  return kind !== 'launch_site' || source?.kind === 'launch_site';
}

function remember(index, halt) {
  index.halts.set(halt.key, halt);
  return halt;
}

/**
 * Return the first and last instant of a plan, `[0, 3600]` if nothing happens.
 *
 * @returns {Span}
 */
export function spanOf(index) {
  const trips = index.vehicles.flatMap((vehicle) => vehicle.trips);
  const starts = trips.flatMap((trip) => [
    trip.stops[0].arrival,
    ...trip.sorties.map((sortie) => sortie.reply.launch_time)]);
  const ends = trips.map((trip) => trip.stops[trip.stops.length - 1].departure);
  if (!trips.length) return [0, 3600];
  const [start, end] = [Math.min(...starts), Math.max(...ends)];
  return end > start ? [start, end] : [start, start + 60];
}

/** Tell whether a halt is reached by air: on a sortie, or by a vehicle that flies. */
export function isByAir({ sortie, vehicle }) {
  return Boolean(sortie) || vehicle.flies;
}

/** Return the trip or vehicle that a key belongs to, as the key's own parts. */
export function partsOf(index, key) {
  if (!index || !key || key[0] === 'z') return {};
  const [kind, place] = [key[0], key.slice(2)];
  if (kind === 'c' || kind === 'd') {
    const halt = index.halts.get(key);
    return halt ? { vehicle: halt.vehicle, trip: halt.trip, sortie: halt.sortie, halt } : {};
  }
  const [vehicle, trip, sortie] = place.split('/').map(Number);
  const found = { vehicle: index.vehicles[vehicle] };
  if (kind !== 'v') found.trip = found.vehicle?.trips[trip];
  if (kind === 's') found.sortie = found.trip?.sorties[sortie];
  if (kind === 'l') found.leg = found.trip?.stops[sortie];
  return found;
}

/** Return the keys of what belongs to the trip or the vehicle that a key names. */
export function keysWithin(index, key) {
  const { vehicle, trip } = partsOf(index, key);
  const trips = key[0] === 'v' ? vehicle?.trips : trip && [trip];
  return (trips ?? []).flatMap((each) => [
    each.key,
    ...each.stops.filter(isVisit).map((halt) => halt.key),
    ...each.sorties.flatMap((sortie) => [sortie.key, ...sortie.visits.map((visit) => visit.key)])]);
}

/** Tell whether what one key names is or contains what another names. */
export function contains(index, outer, key) {
  if (!outer || !key) return false;
  if (outer === key) return true;
  const [whole, part] = [partsOf(index, outer), partsOf(index, key)];
  if (outer[0] === 'v') return whole.vehicle !== undefined && whole.vehicle === part.vehicle;
  if (outer[0] === 't') return whole.trip !== undefined && whole.trip === part.trip;
  return outer[0] === 's' && whole.sortie !== undefined && whole.sortie === part.sortie;
}
