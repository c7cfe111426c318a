/** A plan as rows of bars: what each vehicle and drone does when. Times in seconds. */

import { dronesOfSortie } from './drones.js';
import { launchDurations } from './launches.js';
import { nameOfVehicle, titleOfVehicle } from './vehicle-labels.js';
import { isVisit } from './visits.js';

/** What bars mean, in the order of the legend. */
export const ACTIVITIES = ['drive', 'fly', 'serve', 'wait', 'handle', 'reload', 'charge', 'rest'];

/**
 * Return one row per vehicle and per drone that flies, vehicles followed by their drones.
 *
 * A bar is `{kind, from, until, key}`; `key` is what it stands for (see `plan.js`).
 */
export function timelineRows(index) {
  return index.vehicles.flatMap((vehicle) => [
    {
      key: vehicle.key, kind: 'vehicle', label: titleOfVehicle(vehicle), vehicle,
      bars: vehicleBars(vehicle),
    },
    ...droneRows(vehicle)]);
}

/** So many idle vehicles have a row at most. */
const MOST_IDLE = 100;

/** Return a row for each vehicle that a plan doesn't use, to give somebody to. */
export function idleRows({ request, vehicles }) {
  const used = new Set(vehicles.map(({ name }) => name));
  return request.fleet.flatMap((type) =>
    Array.from({ length: Math.min(type.count ?? 1, MOST_IDLE) }, (_, at) => `${type.id}-${at + 1}`)
      .filter((name) => !used.has(name))
      .map((name) => ({
        key: `idle ${name}`, kind: 'idle', name, label: nameOfVehicle(name), type, bars: [],
      })));
}

/**
 * Return when a row's vehicle doesn't work, or all its depots are closed: `[from, until]` each.
 *
 * @param range what is seen
 */
export function closedOf({ type, vehicle }, { depots }, range) {
  const kind = type ?? vehicle.type;
  const used = new Set([kind?.depot ?? depots[0].id, ...(kind?.reload_depots ?? [])]);
  const hours = depots.filter(({ id }) => used.has(id)).map((depot) => depot.time_window);
  return [...between([kind?.shift], range), ...between(hours, range)];
}

/** Return what lies outside all of some windows, within a range; one that isn't stated is all. */
function between(windows, [first, last]) {
  const within = (time) => Math.min(Math.max(time, first), last);
  const open = windows.map((stated) =>
    [within(stated?.earliest ?? first), within(stated?.latest ?? last)]);
  open.sort(([from], [other]) => from - other);
  const closed = [];
  let since = first;
  for (const [from, until] of [...open, [last, last]]) {
    if (from > since) closed.push([since, from]);
    since = Math.max(since, until);
  }
  return closed;
}

function vehicleBars(vehicle) {
  const reload = vehicle.type?.reload_duration ?? 0;
  return vehicle.trips.flatMap((trip, number) => {
    const bars = [];
    if (number > 0 && reload > 0) {
      const loaded = trip.stops[0].arrival;
      bars.push({ kind: 'reload', from: loaded - reload, until: loaded, key: trip.stops[0].key });
    }
    for (const { start, end } of trip.reply.charging ?? []) {
      bars.push({ kind: 'charge', from: start, until: end, key: trip.stops[0].key });
    }
    trip.stops.forEach((halt, position) => {
      const before = trip.stops[position - 1];
      if (before) {
        bars.push({
          kind: vehicle.flies ? 'fly' : 'drive', from: before.departure, until: halt.arrival,
          key: trip.key, to: halt.key,
        });
      }
      bars.push(...stopBars(halt, vehicle.type?.id));
    });
    return bars.filter(isSeen);
  });
}

/** Tell whether a bar is drawn: service is, however short, so that every stop can be found. */
function isSeen(bar) {
  return bar.until > bar.from || (bar.kind === 'serve' && bar.key[0] === 'c');
}

/** Return the bar of a setup, if there is one: work for the customer, as service is. */
function setupBars({ arrival, setup, key }) {
  return setup > 0 ? [{ kind: 'serve', from: arrival, until: arrival + setup, key }] : [];
}

function serviceBy(type, customer) {
  return customer.service_duration_by_type?.[type] ?? customer.service_duration ?? 0;
}

function stopBars(halt, type) {
  const duration = isVisit(halt) ? serviceBy(type, halt.source) : 0;
  const served = Math.min(halt.serviceStart + duration, halt.departure);
  if (halt.kind === 'break') {
    return [
      { kind: 'wait', from: halt.arrival, until: halt.serviceStart, key: halt.key },
      { kind: 'rest', from: halt.serviceStart, until: halt.departure, key: halt.key }];
  }
  return [
    ...setupBars(halt),
    { kind: 'wait', from: halt.arrival + halt.setup, until: halt.serviceStart, key: halt.key },
    { kind: 'serve', from: halt.serviceStart, until: served, key: halt.key },
    { kind: 'handle', from: served, until: halt.departure, key: halt.key }];
}

function droneRows(vehicle) {
  const rows = new Map();
  const sorties = vehicle.trips.flatMap((trip) => {
    const durations = launchDurations(vehicle.type, trip.sorties.map(({ reply }) => reply));
    return trip.sorties.map((sortie, index) => [sortie, durations[index]]);
  });
  for (const [sortie, launching] of sorties) {
    if (!rows.has(sortie.drone)) {
      const label = sortie.drone.slice(sortie.drone.lastIndexOf('/') + 1);
      rows.set(sortie.drone, { key: sortie.drone, kind: 'drone', label, vehicle, bars: [] });
    }
    rows.get(sortie.drone).bars.push(...sortieBars(vehicle, sortie, launching));
  }
  return [...rows.values()].sort((first, second) =>
    first.key.localeCompare(second.key, 'en', { numeric: true }));
}

function sortieBars(vehicle, sortie, launching) {
  const { launch_time: launch, recovery_time: recovered } = sortie.reply;
  const drones = dronesOfSortie(vehicle.type, sortie.reply) ?? {};
  const landing = Math.max(recovered - (drones.recovery_duration ?? 0), launch);
  const bars = [
    { kind: 'handle', from: launch - launching, until: launch, key: sortie.key }];
  let since = launch;
  for (const halt of sortie.visits) {
    bars.push(
      { kind: 'fly', from: since, until: halt.arrival, key: sortie.key },
      ...setupBars(halt),
      { kind: 'wait', from: halt.arrival + halt.setup, until: halt.serviceStart, key: halt.key },
      { kind: 'serve', from: halt.serviceStart, until: halt.departure, key: halt.key });
    since = halt.departure;
  }
  bars.push(
    { kind: 'fly', from: since, until: landing, key: sortie.key },
    { kind: 'handle', from: landing, until: recovered, key: sortie.key });
  return bars.filter(isSeen);
}

/** Return the windows that matter in a row: `{key, earliest, latest, arrival}`, open ends null. */
export function rowWindows(row) {
  if (row.kind === 'idle') return [];
  const halts =
    row.kind === 'vehicle'
      ? row.vehicle.trips.flatMap((trip) => trip.stops)
      : row.vehicle.trips
          .flatMap((trip) => trip.sorties)
          .filter((sortie) => sortie.drone === row.key)
          .flatMap((sortie) => sortie.visits);
  return halts
    .filter((halt) => halt.window && (halt.window.earliest > 0 || halt.window.latest != null))
    .map((halt) => ({
      key: halt.key, earliest: halt.window.earliest ?? 0, latest: halt.window.latest ?? null,
      arrival: halt.arrival, late: halt.lateness > 0,
    }));
}

/** Return a step between marks on a time axis, so that no more than `most` fit into `seconds`. */
export function tickStep(seconds, most) {
  const steps = [60, 120, 300, 600, 900, 1800, 3600, 7200, 10800, 14400, 21600, 43200, 86400];
  const room = Math.max(most, 1); // a hidden timeline has none
  return steps.find((step) => seconds / step <= room) ?? Math.ceil(seconds / room / 86400) * 86400;
}
