/**
 * Going on from a plan: what of it has departed by an instant, and the request that plans on.
 *
 * Times in seconds. What is said of a route here is what the service settles, see
 * `docs/use/replanning.md`; where a reply tells how far it settled a vehicle, that counts.
 */

import { clock } from './format.js';
import { droneCount } from './drones.js';
import { launchDurations } from './launches.js';
import { removeIn, setIn } from './paths.js';
import { t } from '../texts.js';

/** Return the request that goes on from a plan at an instant; null: nothing has happened yet. */
export function goOnFrom(request, plan, now) {
  const { replan } = request;
  // What was pinned or broken stays so while the day goes on.
  const kept = replan && {
    pinned: pinnedIn(plan, replan),
    pin_all: replan.pin_all,
    unavailable: replan.unavailable,
    // What a broken vehicle had fetched isn't back any sooner.
    parcels_back: replan.parcels_back >= now ? replan.parcels_back : undefined,
  };
  return { ...request, replan: { ...withoutUndefined(kept ?? {}), plan, freeze_before: now } };
}

function pinnedIn(plan, { pinned = [] }) {
  const served = new Set(plan.routes.flatMap(customersOf));
  return pinned.filter((id) => served.has(id));
}

function withoutUndefined(entries) {
  return Object.fromEntries(Object.entries(entries).filter(([, value]) => value !== undefined));
}

/**
 * Return the request that looks for a cheaper plan from an entry on.
 *
 * Whoever is locked stays with its vehicle and at its place in the order.
 */
export function furtherFrom(request, entry, locks = []) {
  const replan = { ...request.replan, plan: entry.plan };
  const pinned = [...new Set([...(replan.pinned ?? []), ...locks])];
  if (pinned.length) replan.pinned = pinnedIn(entry.plan, { pinned });
  if (pinnedIn(entry.plan, { pinned: locks }).length) replan.keep_order = true;
  return { ...request, replan };
}

/** Return a request that plans from nothing. */
export function fromNothing(request) {
  return request.replan ? removeIn(request, ['replan']) : request;
}

/** Return the names of the customers whom a route serves, by truck or by drone. */
export function customersOf(route) {
  return route.trips.flatMap(({ stops, sorties = [] }) => [
    ...stops.filter(({ kind }) => kind === 'customer').map(({ id }) => id),
    ...sorties.flatMap(({ customers }) => customers.map(({ id }) => id))]);
}

/** Pin customers to their vehicles, or let go of them. */
export function setPinned(request, ids, isPinned) {
  const others = (request.replan.pinned ?? []).filter((id) => !ids.includes(id));
  return setIn(request, ['replan', 'pinned'], isPinned ? [...others, ...ids] : others);
}

/** Mark a vehicle as broken or whole again; its customers can't be pinned to it. */
export function setBroken(request, vehicle, isBroken) {
  const others = (request.replan.unavailable ?? []).filter((name) => name !== vehicle);
  const names = isBroken ? [...others, vehicle] : others;
  const marked = setIn(request, ['replan', 'unavailable'], names);
  const route = request.replan.plan.routes.find((other) => other.vehicle === vehicle);
  return isBroken && route ? setPinned(marked, customersOf(route), false) : marked;
}

/** Return the names of the fleet's vehicles that the plan given doesn't use. */
export function idleVehicles(request) {
  const used = new Set(request.replan.plan.routes.map(({ vehicle }) => vehicle));
  return request.fleet
    .flatMap(({ id, count }) => Array.from({ length: count }, (_, at) => `${id}-${at + 1}`))
    .filter((name) => !used.has(name));
}

/** Whether a name is that of a drone, not of its truck. */
export function isDrone(name) {
  return name.includes('/drone-');
}

/** Return the names of the drones that fly from the trucks of the plan given. */
export function dronesOnTheWay(request) {
  const types = new Map(request.fleet.map((type) => [type.id, type]));
  return request.replan.plan.routes.flatMap(({ type, vehicle }) =>
    Array.from({ length: droneCount(types.get(type)) }, (_, at) => `${vehicle}/drone-${at + 1}`));
}

/**
 * Return how far a route is settled: `{trip, stop, left, flights, isBroken}`.
 *
 * `trip` and `stop` are of the last stop that can't be changed (-1 where nothing has departed),
 * `left` counts the stops of that trip that the truck has left, `flights` are those of that trip
 * that have begun.
 */
export function progressOf(route, type, { freeze_before: now, unavailable = [] }) {
  const isBroken = unavailable.includes(route.vehicle);
  const progress = { trip: -1, stop: -1, left: 0, flights: [], isBroken };
  if (now === null || now === undefined) return progress;
  route.trips.forEach(({ stops, sorties = [] }, trip) => {
    const standing = stops.findIndex(({ departure }) => departure > now);
    const left = standing < 0 ? stops.length : standing;
    const launching = launchDurations(type, sorties);
    const flights = sorties.flatMap(({ launch_time: launch }, flight) =>
      launch - launching[flight] <= now ? [flight] : []);
    if (!left && !flights.length) return;
    const meetings = flights.map((flight) => sorties[flight].recovery_stop);
    const stop = Math.max(Math.min(left, stops.length - 1), ...meetings);
    Object.assign(progress, { trip, stop, left, flights });
  });
  return isBroken ? brokenOff(route, progress, now) : progress;
}

/** Return how far a broken vehicle came: to the last customer whose service had begun. */
function brokenOff(route, progress, now) {
  if (progress.trip < 0) return progress;
  const { stops, sorties = [] } = route.trips[progress.trip];
  const served = stops.filter((stop) => stop.service_start <= now).length;
  const flights = progress.flights.filter((flight) =>
    sorties[flight].customers.some((visit) => visit.service_start <= now));
  return { ...progress, stop: served - 1, flights };
}

/**
 * Return how far each vehicle of an entry of the plans is settled, by its name.
 *
 * @param entry with `request` and `plan`
 * @param request as it is edited; if it goes on from this plan, its instant counts
 */
export function settledParts(entry, request) {
  const ahead = request.replan?.plan === entry.plan;
  const replan = ahead ? request.replan : entry.replan ?? entry.request.replan;
  const parts = new Map();
  if (replan?.freeze_before === null || replan?.freeze_before === undefined) return parts;
  const told = new Map(entry.plan.replan?.settled.map((kept) => [kept.vehicle, kept]));
  const types = new Map(entry.request.fleet.map((type) => [type.id, type]));
  for (const route of entry.plan.routes) {
    const progress = progressOf(route, types.get(route.type), replan);
    if (ahead) parts.set(route.vehicle, progress);
    // The rest of a broken vehicle's way is lost in the plan given, and over in the new one.
    else if (told.has(route.vehicle)) {
      const { trip, stop } = told.get(route.vehicle);
      parts.set(route.vehicle, { ...progress, trip, stop, isOver: progress.isBroken });
    }
  }
  return parts;
}

/**
 * Return what of a plan is settled: `settled`, `lost` (a broken vehicle's) or `open`.
 *
 * @param {Map<string, any>} parts
 * @param {{vehicle: string, trip: number, stop?: number, flight?: number}} part
 */
export function standingOf(parts, { vehicle, trip, stop, flight }) {
  const part = parts.get(vehicle);
  if (!part) return 'open';
  if (part.isOver || trip < part.trip) return 'settled';
  const isCurrent = trip === part.trip;
  const has = flight === undefined ? stop <= part.stop : part.flights.includes(flight);
  if (isCurrent && has) return 'settled';
  return part.isBroken ? 'lost' : 'open';
}

/** Return the standing of what an index of a plan holds: a halt or a sortie. */
export function standingIn(parts, { vehicle, trip, stop, sortie, reply }) {
  if (!parts.size) return 'open';
  const flown = sortie ?? (reply && trip ? { reply, trip } : null);
  const flight = flown ? flown.trip.reply.sorties.indexOf(flown.reply) : undefined;
  const name = (vehicle ?? trip.vehicle).name;
  return standingOf(parts, { vehicle: name, trip: trip.index, stop, flight });
}

/** Return where a vehicle is at an instant, in words. */
export function whereabouts(route, progress, now) {
  if (progress.trip < 0) {
    return t('whereabouts.notDeparted', { at: clock(route.trips[0].stops[0].departure) });
  }
  const { stops } = route.trips[progress.trip];
  if (progress.left >= stops.length) {
    const next = route.trips[progress.trip + 1];
    const since = clock(stops[stops.length - 1].arrival);
    return next
      ? t('whereabouts.leavesAgain', { since, at: clock(next.stops[0].departure) })
      : t('whereabouts.back', { since });
  }
  const stop = stops[progress.left];
  return stop.arrival <= now
    ? t('whereabouts.at', { stop: stop.id, until: clock(stop.departure) })
    : t('whereabouts.onWay', { stop: stop.id, at: clock(stop.arrival) });
}

/** Return the customers of a route who aren't settled. */
export function openCustomers(route, progress) {
  return route.trips.flatMap(({ stops, sorties = [] }, trip) => {
    const isOpen = (place) =>
      standingOf(new Map([[route.vehicle, progress]]), {
        vehicle: route.vehicle, trip, ...place,
      }) !== 'settled';
    return [
      ...stops.filter(({ kind }, stop) => kind === 'customer' && isOpen({ stop })),
      ...sorties.filter((_, flight) => isOpen({ flight })).flatMap(({ customers }) => customers),
    ].map(({ id }) => id);
  });
}

/** Return the routes of the plan that a request goes on from: `[{route, type, progress, open}]`. */
export function basisRoutes(request) {
  const types = new Map(request.fleet.map((type) => [type.id, type]));
  return request.replan.plan.routes.map((route) => {
    const type = types.get(route.type);
    const progress = progressOf(route, type, request.replan);
    return { route, type, progress, open: openCustomers(route, progress) };
  });
}

/**
 * Return what may still be done about a customer: `{vehicle, isPlanned, mayPin, mayCancel}`.
 *
 * `vehicle` serves it in the plan given, null if none does.
 */
export function choicesOf(request, id) {
  const found = basisRoutes(request).find(({ route }) => customersOf(route).includes(id));
  if (!found) return { vehicle: null, isPlanned: false, mayPin: false, mayCancel: true };
  const isOpen = found.open.includes(id);
  return {
    vehicle: found.route.vehicle,
    isPlanned: true,
    mayPin: isOpen && !found.progress.isBroken,
    mayCancel: isOpen,
  };
}
