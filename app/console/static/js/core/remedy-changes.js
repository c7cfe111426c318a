/** Remedies of unassigned customers as changes of the problem. */

import { getIn, removeIn, setIn } from './paths.js';
import { endWindows, partsOf } from './remedy-parts.js';
import { endsOf } from './visits.js';
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
    /^fits if .+ could make (\d+) stops?$/,
    (request, { type }, count) => setIn(request, [...type, 'max_stops'], Number(count)),
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
    new RegExp(`^fits if its (?:last )?window at (.+) closed ${NUMBER} minutes? later$`),
    (request, { customer }, name, more) => {
      const place = placeAt(request, customer, name);
      return closeLater(request, place, windowsOf(getIn(request, place)).length - 1, more);
    },
  ],
  [
    new RegExp(`^fits if its window ${NUMBER} at (.+) closed ${NUMBER} minutes? later$`),
    (request, { customer }, position, name, more) =>
      closeLater(request, placeAt(request, customer, name), numberOf(position) - 1, more),
  ],
  [/^fits if (the (?:last )?window of its .+ later)$/, closeEndsLater],
  [
    new RegExp(`^fits if max_lag of its orders were at least ${NUMBER} minutes?$`),
    lengthenLags,
  ],
  [
    /^fits with one more vehicle of .+$/,
    (request, { type }) => add(request, [...type, 'count'], 1),
  ],
  [
    new RegExp(`^fits if max_time_between were at least ${NUMBER} minutes?`
      + `(?: and max_detour were at least ${NUMBER})?$`),
    (request, { customer }, minutes, detour) => {
      const longer = setIn(request, [...customer, 'max_time_between'],
        Math.round(numberOf(minutes) * SECONDS_PER_MINUTE * 1000) / 1000);
      return detour ? setIn(longer, [...customer, 'max_detour'], numberOf(detour)) : longer;
    },
  ],
  [
    new RegExp(`^fits if max_detour were at least ${NUMBER}$`),
    (request, { customer }, detour) =>
      setIn(request, [...customer, 'max_detour'], numberOf(detour)),
  ],
  [
    /^fits if break (.+) allowed (.+) aboard$/,
    (request, { type }, id, amounts) =>
      setIn(request, [...breakAt(request, type, id), 'max_load'],
        amounts.split(', ').map(Number)),
  ],
  [
    new RegExp(`^fits if break (.+) could begin ${NUMBER} minutes? later$`),
    (request, { type }, id, more) =>
      add(request, [...breakAt(request, type, id), 'start', 'latest'],
        numberOf(more) * SECONDS_PER_MINUTE),
  ],
  [
    /^fits without break (.+)$/,
    (request, { type }, id) => removeIn(request, breakAt(request, type, id)),
  ],
  [
    new RegExp(`^fits if .+'s drivers could (drive|work) ${NUMBER} minutes? without a rest$`),
    (request, { type }, what, all) =>
      setIn(
        request,
        [...type, 'driving_rules', what === 'drive' ? 'max_driving' : 'max_work_before_break'],
        numberOf(all) * SECONDS_PER_MINUTE,
      ),
  ],
  [
    /^fits if .+'s drivers may rest while drones fly$/,
    (request, { type }) => setIn(request, [...type, 'driving_rules', 'while_drones_fly'], true),
  ],
  [/^fits without its relations$/, unrelate],
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

export function numberOf(text) {
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

/** Let windows of a shipment close later, at each end that a remedy names. */
function closeEndsLater(request, { customer }, told) {
  return (endWindows(`fits if ${told}`) ?? []).reduce((changed, { end, name, minutes }) => {
    const number = name
      ? getIn(request, [...customer, 'pickups']).findIndex(({ id }) => id === name) : -1;
    const keys = [...customer, ...(number < 0 ? [end] : ['pickups', number])];
    const last = windowsOf(getIn(request, keys)).length - 1;
    return closeLater(changed, keys, last, minutes.split(' ')[0]);
  }, request);
}

/** Let so much time lie between a customer, or a shipment, and whoever is next in his orders. */
function lengthenLags(request, { id, customer: [all] }, minutes) {
  const names = all === 'customers' ? [id] : endsOf(
    request.shipments.find((shipment) => shipment.id === id)).map(({ name }) => name);
  const least = numberOf(minutes) * SECONDS_PER_MINUTE;
  const isIts = ({ max_lag: lag, customers }) =>
    typeof lag === 'number' && lag < least && customers.some((name) => names.includes(name));
  return {
    ...request,
    relations: request.relations.map((relation) =>
      (isIts(relation) ? { ...relation, max_lag: least } : relation)),
  };
}

/** Let relations bind a customer, or a shipment, no longer; of one alone nothing is left. */
function unrelate(request, { id, customer: [all] }) {
  const shipmentAt = new Map((request.shipments ?? []).flatMap(
    (shipment) => endsOf(shipment).map(({ name }) => [name, shipment.id])));
  const isIts = (name) => (all === 'shipments' ? shipmentAt.get(name) === id : name === id);
  // Ends of one shipment go together anyhow.
  const isLeft = ({ kind, customers }) => customers.length > 1 && (kind === 'before'
    || customers.some((name) => !shipmentAt.has(name)
      || shipmentAt.get(name) !== shipmentAt.get(customers[0])));
  const relations = request.relations
    .map((relation) => ({
      ...relation,
      customers: relation.customers.filter((name) => !isIts(name)),
    }))
    .filter(isLeft);
  return { ...request, relations };
}

/** Return which of a customer's other places has a name in plans. */
function placeAt(request, customer, name) {
  const { id, alternatives = [] } = getIn(request, customer);
  return [...customer, 'alternatives',
    alternatives.findIndex((place) => `${id}/${place.id}` === name)];
}

function breakAt(request, type, id) {
  return [...type, 'breaks', getIn(request, type).breaks.findIndex((each) => each.id === id)];
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

/** Return the most that a customer asks for at once, or a shipment is in all, per dimension. */
function mostOf({ demand, amount, pickup, pickups = [] }) {
  const parts = pickups.map((part) => part.amount);
  if (parts.length) return parts.reduce((all, part) => all.map((sum, index) => sum + part[index]));
  return amount ?? demand.map((value, index) => Math.max(value, pickup?.[index] ?? 0));
}

/**
 * Return the request as a remedy changes it, or null if the remedy is not one that is known.
 *
 * @param request that the plan was made for
 * @param id of the unassigned customer, or of the shipment
 * @param reason of the reply, with `vehicle_type` and `remedy`
 * @param kind of what is left out, as the reply says
 */
export function applyRemedy(request, id, reason, kind = 'customer') {
  const all = kind === 'shipment' ? 'shipments' : 'customers';
  const places = {
    id,
    type: ['fleet', request.fleet.findIndex((type) => type.id === reason.vehicle_type)],
    customer: [all, (request[all] ?? []).findIndex((customer) => customer.id === id)],
  };
  if (!reason.remedy || places.type[1] < 0 || places.customer[1] < 0) return null;
  return partsOf(reason.remedy).reduce(
    (changed, remedy) => changed && applyOne(changed, places, { ...reason, remedy }), request);
}

function applyOne(request, places, { remedy, code: cause }) {
  for (const [pattern, change, code] of CHANGES) {
    const match = pattern.exec(remedy);
    if (match && (!code || code === cause)) return change(request, places, ...match.slice(1));
  }
  return null;
}
