/** Remedies of unassigned customers as changes of the problem. */

import { getIn, removeIn, setIn } from './paths.js';
import { closingLater, windowsOf } from './windows.js';

const NUMBER = '([\\d.,]+)';
const SECONDS_PER_MINUTE = 60;
const METRES_PER_KM = 1000;

/**
 * Remedies by what they say; each returns the changed request.
 *
 * @type {[RegExp, Function, string?][]}
 */
const CHANGES = [
  [/^fits if .+ may serve it$/, allowType, 'VEHICLE'],
  [/^fits with one more vehicle$/, (request, { type }) => add(request, [...type, 'count'], 1)],
  [
    /^fits with one more battery at (.+)$/,
    (request, _, id) => add(request, [...depotAt(request, id), 'batteries'], 1),
  ],
  [
    /^fits with one more charger at (.+)$/,
    (request, _, id) => add(request, [...depotAt(request, id), 'chargers'], 1),
  ],
  [
    /^fits if .+ could make another trip$/,
    (request, { type }) =>
      setIn(request, [...type, 'max_trips'], (getIn(request, [...type, 'max_trips']) ?? 1) + 1),
  ],
  [
    new RegExp(`^served if unassigned_cost were above ${NUMBER}$`),
    (request, _, above) => ({
      ...request,
      unassigned_cost: justAbove(above),
    }),
  ],
  [
    new RegExp(`^served if its unassigned_cost were above ${NUMBER}$`),
    (request, { customer }, above) =>
      setIn(request, [...customer, 'unassigned_cost'], justAbove(above)),
  ],
  [
    /^fits if .+ had .+$/,
    (request, { type, customer }) =>
      union(request, [...type, 'skills'], getIn(request, [...customer, 'skills'])),
  ],
  [
    /^fits if capacity were at least /,
    (request, { type, customer }) =>
      raise(request, [...type, 'capacity'], mostOf(getIn(request, customer))),
  ],
  [
    /^fits if the drone capacity(?: of (.+))? were at least /,
    (request, { type, customer }, id) =>
      raise(
        request,
        [...dronesAt(request, type, id), 'capacity'],
        mostOf(getIn(request, customer)),
      ),
  ],
  [
    /^fits if .+ may pick up at any time$/,
    (request, { type }) => setIn(request, [...type, 'pickups'], 'any'),
  ],
  [
    new RegExp(`^fits if endurance(?: of (.+))? were ${NUMBER} minutes? longer$`),
    (request, { type }, id, more) =>
      add(
        request,
        [...dronesAt(request, type, id), 'endurance'],
        numberOf(more) * SECONDS_PER_MINUTE,
      ),
  ],
  [
    new RegExp(`^fits if max_range(?: of (.+))? were ${NUMBER} km longer$`),
    (request, { type }, id, more) =>
      add(request, [...dronesAt(request, type, id), 'max_range'], numberOf(more) * METRES_PER_KM),
  ],
  [
    /^fits without max_wind_kmh(?: of (.+))?$/,
    (request, { type }, id) =>
      setIn(request, [...dronesAt(request, type, id), 'max_wind_kmh'], null),
  ],
  [
    new RegExp(`^fits with a battery(?: of (.+))? of ${NUMBER} Wh more$`),
    (request, { type }, id, more) =>
      add(request, [...dronesAt(request, type, id), 'energy', 'battery_wh'], numberOf(more)),
  ],
  [
    new RegExp(`^fits if trips could be ${NUMBER} km longer$`),
    (request, { type }, more) =>
      add(request, [...type, 'max_trip_distance'], numberOf(more) * METRES_PER_KM),
  ],
  [
    new RegExp(`^fits if .+ could travel ${NUMBER} minutes? longer$`),
    (request, { type }, more) =>
      add(request, [...type, 'max_travel_duration'], numberOf(more) * SECONDS_PER_MINUTE),
  ],
  [
    new RegExp(`^fits if .+'s drivers could drive ${NUMBER} minutes? a day$`),
    (request, { type }, all) =>
      setIn(
        request,
        [...type, 'driving_rules', 'max_driving_per_day'],
        numberOf(all) * SECONDS_PER_MINUTE,
      ),
  ],
  [
    new RegExp(`^fits if its (?:last )?window closed ${NUMBER} minutes? later$`),
    (request, { customer }, more) =>
      closeLater(request, customer, windowsOf(getIn(request, customer)).length - 1, more),
  ],
  [
    new RegExp(`^fits if its window ${NUMBER} closed ${NUMBER} minutes? later$`),
    (request, { customer }, position, more) =>
      closeLater(request, customer, numberOf(position) - 1, more),
  ],
  [
    new RegExp(`^fits if it could be aboard ${NUMBER} minutes? longer$`),
    (request, { customer }, more) =>
      add(request, [...customer, 'max_time_aboard'], numberOf(more) * SECONDS_PER_MINUTE),
  ],
  [
    new RegExp(`^fits if .+'s shift ended ${NUMBER} minutes? later$`),
    (request, { type }, more) =>
      add(request, [...type, 'shift', 'latest'], numberOf(more) * SECONDS_PER_MINUTE),
  ],
  [
    new RegExp(`^fits if .+ could work ${NUMBER} minutes? more overtime$`),
    (request, { type }, more) =>
      add(request, [...type, 'overtime', 'max_duration'], numberOf(more) * SECONDS_PER_MINUTE),
  ],
  [
    /^fits if .+ could make 1 stop$/,
    (request, { type }) => setIn(request, [...type, 'max_stops'], 1),
  ],
  [
    /^fits if .+ could launch 1 sortie$/,
    (request, { type }) => setIn(request, [...type, 'max_sorties'], 1),
  ],
  [
    /^fits if .+ carried 1 battery(?: of (.+))?$/,
    (request, { type }, id) =>
      setIn(request, [...dronesAt(request, type, id), 'turnaround', 'batteries'], 1),
  ],
  [
    new RegExp(`^fits if (?!its )(.+) closed ${NUMBER} minutes? later$`),
    (request, _, id, more) =>
      add(
        request,
        [...depotAt(request, id), 'time_window', 'latest'],
        numberOf(more) * SECONDS_PER_MINUTE,
      ),
  ],
  [/^fits if drones may take off at (.+)$/, allowLaunches],
  [
    new RegExp(`^fits if .+ could work ${NUMBER} minutes? longer$`),
    (request, { type }, more) =>
      add(request, [...type, 'max_working_duration'], numberOf(more) * SECONDS_PER_MINUTE),
  ],
  [
    /^fits if a (?:truck|drone) may serve it$/,
    (request, { customer }) => setIn(request, [...customer, 'served_by'], 'either'),
  ],
];

function numberOf(text) {
  return Number(text.replaceAll(',', ''));
}

function depotAt(request, id) {
  return ['depots', request.depots.findIndex((depot) => depot.id === id)];
}

/** Let all vehicles of a type serve a customer. */
function allowType(request, { type, customer }) {
  const { id } = getIn(request, type);
  const { allowed, forbidden } = getIn(request, [...customer, 'vehicles']) ?? {};
  if (allowed) return union(request, [...customer, 'vehicles', 'allowed'], [id]);
  const types = new Set(request.fleet.map((other) => other.id));
  const isOfType = (name) =>
    name === id || (!types.has(name) && name.replace(/-[1-9]\d*$/, '') === id);
  const others = (forbidden ?? []).filter((name) => !isOfType(name));
  return others.length
    ? setIn(request, [...customer, 'vehicles', 'forbidden'], others)
    : removeIn(request, [...customer, 'vehicles']);
}

/** Let drones take off at a depot. */
function allowLaunches(request, _, id) {
  const depots = request.depots.map((depot) =>
    depot.id === id ? { ...depot, launch: true } : depot);
  return { ...request, depots };
}

/** Return where the drones that a remedy names are stated. */
function dronesAt(request, type, id) {
  const { drones, flies } = getIn(request, type);
  if (flies) return type;
  const place = Array.isArray(drones) ? [drones.findIndex((each) => each.id === id)] : [];
  return [...type, 'drones', ...place];
}

function closeLater(request, keys, position, minutes) {
  const later = numberOf(minutes) * SECONDS_PER_MINUTE;
  return setIn(request, keys, closingLater(getIn(request, keys), position, later));
}

function justAbove(price) {
  return Math.ceil((numberOf(price) + 0.01) * 100) / 100;
}

function add(request, keys, more) {
  return setIn(request, keys, Math.round(((getIn(request, keys) ?? 0) + more) * 1000) / 1000);
}

function union(request, keys, more) {
  return setIn(request, keys, [...new Set([...(getIn(request, keys) ?? []), ...more])]);
}

function raise(request, keys, least) {
  return setIn(
    request,
    keys,
    getIn(request, keys).map((value, index) => Math.max(value, least[index])),
  );
}

/** Return the most that a customer asks for at once, per dimension. */
function mostOf({ demand, pickup }) {
  return demand.map((amount, index) => Math.max(amount, pickup?.[index] ?? 0));
}

/**
 * Return the request as a remedy changes it, or null if the remedy is not one that is known.
 *
 * @param request that the plan was made for
 * @param id of the unassigned customer
 * @param reason of the reply, with `vehicle_type` and `remedy`
 */
export function applyRemedy(request, id, reason) {
  const places = {
    type: ['fleet', request.fleet.findIndex((type) => type.id === reason.vehicle_type)],
    customer: ['customers', request.customers.findIndex((customer) => customer.id === id)],
  };
  if (!reason.remedy || places.type[1] < 0 || places.customer[1] < 0) return null;
  for (const [pattern, change, code] of CHANGES) {
    const match = pattern.exec(reason.remedy);
    if (match && (!code || code === reason.code)) return change(request, places, ...match.slice(1));
  }
  return null;
}

/** Remedies that change the vehicles of a type by so much: the largest suffices for all. */
const BY_SO_MUCH =
  /(longer|later|more|more overtime|one more vehicle|another trip|were above [\d.,]+)$/;

/** Return a remedy without its numbers and names, which tells its kind from others. */
function kindOf({ remedy }) {
  return remedy ? remedy.replace(/[\d.,]*\d/g, '#') : '';
}

function sizeOf({ remedy }) {
  return numberOf(/[\d.,]*\d/.exec(remedy)?.[0] ?? '0');
}

/**
 * Return the unassigned customers of a plan by what would help: `[{key, code, type, remedy,
 * members, changed, isForEach}]`, the largest group first, each customer in one group.
 *
 * `members` are `{customer, reason}`; `changed` is the request with the remedy for all of them,
 * null if none is known; `isForEach` says that it changes the customers, not the vehicles;
 * `others` are groups of the same members by the other remedy that all of them have.
 */
export function groupUnassigned(request, unassigned) {
  const groups = new Map();
  for (const customer of unassigned) {
    for (const reason of customer.reasons) {
      const zone = reason.zone?.message ?? '';
      const key = [reason.vehicle_type, reason.code, kindOf(reason), zone].join('|');
      if (!groups.has(key)) groups.set(key, []);
      groups.get(key).push({ customer, reason });
    }
  }
  const without = unassigned.filter(({ reasons }) => !reasons.length);
  if (without.length) groups.set('', without.map((customer) => ({ customer, reason: null })));
  return oneEach([...groups]).map(([key, members]) => grouped(request, key, members));
}

/** Leave each customer in the largest group, those with a remedy before those without. */
function oneEach(groups) {
  const found = [];
  const taken = new Set();
  let left = groups;
  while (left.length) {
    const open = left
      .map(([key, members]) => [key, members.filter(({ customer }) => !taken.has(customer.id))])
      .filter(([, members]) => members.length);
    const rank = ([, [{ reason }, ...others]]) =>
      (reason?.remedy ? 1e9 : 0) + others.length;
    open.sort((one, other) => rank(other) - rank(one));
    const [largest, ...others] = open;
    if (!largest) break;
    found.push(largest);
    largest[1].forEach(({ customer }) => taken.add(customer.id));
    left = others;
  }
  return found;
}

/** Return a reason as its other remedy has it, null if there is none. */
export function otherReason({ other_remedy: other, ...reason }) {
  return other ? { ...reason, remedy: other } : null;
}

function othersOf(request, key, members) {
  const others = members.map(({ customer, reason }) => ({
    customer,
    reason: reason && otherReason(reason),
  }));
  return others.every(({ reason }) => reason) ? [grouped(request, `${key}|other`, others)] : [];
}

function grouped(request, key, members) {
  const { reason } = members[0];
  if (!reason?.remedy) {
    return { key, code: reason?.code, type: reason?.vehicle_type, remedy: null, members,
      changed: null, isForEach: false, others: [] };
  }
  const ordered = [...members].sort((one, other) => sizeOf(other.reason) - sizeOf(one.reason));
  const [most] = ordered;
  const first = applyRemedy(request, most.customer.id, most.reason);
  const isForEach = first !== null && first.customers !== request.customers;
  const suffices = !isForEach && BY_SO_MUCH.test(most.reason.remedy);
  const changed =
    first === null || suffices
      ? first
      : ordered.reduce(
          (so, { customer, reason: own }) => applyRemedy(so, customer.id, own) ?? so,
          request,
        );
  return { key, code: reason.code, type: reason.vehicle_type, remedy: most.reason.remedy, members,
    changed, isForEach, others: othersOf(request, key, members) };
}
