/** Names of plans by what changed since the plan before, such as `one van fewer`. */

import { fieldChange } from './changed-words.js';
import { requestDifferences } from './differences.js';
import { droneCount } from './drones.js';
import { clock } from './format.js';
import { fromNothing } from './replanning.js';
import { labelOf, withinSentence } from './schema.js';
import { windowsInWords, windowsOf } from './windows.js';
import { t } from '../texts.js';

const MOST_PARTS = 2;
const LONGEST = 60;
const LARGEST_WORD = 6;

/** Sections of a problem by how a change of them is called. */
const SECTIONS = {
  'airspace.no_fly': 'areas', 'airspace.wind': 'wind', 'airspace.buffer': 'buffer',
  depots: 'depots', matrices: 'matrices',
};

/**
 * Return the name of a plan.
 *
 * @param former the plan before, null for the first
 * @param request what is planned
 * @param isFurther whether the search goes on from the former plan
 */
export function planName(former, request, isFurther = false) {
  if (!former) return t('name.first');
  const parts = changedParts(former.request, request);
  const shown = parts.slice(0, MOST_PARTS);
  if (parts.length > MOST_PARTS) {
    shown.push(t('name.more', { count: parts.length - MOST_PARTS }));
  }
  const now = request.replan?.freeze_before;
  if (isFurther) shown.push(t('name.improved'));
  else if (now !== null && now !== undefined && now !== former.request.replan?.freeze_before) {
    shown.push(t('name.replanned', { at: clock(now) }));
  } else if (!shown.length) shown.push(searchName(former.request, request));
  return shown.join(', ');
}

/** Return a name that no other plan has: `planned again (2)`. */
export function unlike(name, plans) {
  const taken = new Set(plans.map((entry) => entry.name));
  let [free, number] = [name, 1];
  while (taken.has(free)) {
    number += 1;
    free = `${name} (${number})`;
  }
  return free;
}

/**
 * @param {{options?: Options}} before
 * @param {{options?: Options}} now
 */
function searchName({ options: before = {} }, { options: now = {} }) {
  if (before.time_limit === now.time_limit || now.time_limit === undefined) {
    return t('name.again');
  }
  return t('name.plannedFor', { seconds: now.time_limit });
}

/** Return what differs between two problems, in few words each. */
function changedParts(before, now) {
  const changes = requestDifferences(fromNothing(before), fromNothing(now)).filter(
    ({ path }) => !/^options\b|\.info\b/.test(path));
  const [ofCustomers, others] = parted(changes, ({ path }) => path.startsWith('customers['));
  const [ofFleet, rest] = parted(others, ({ path }) => path.startsWith('fleet['));
  return [
    ...fleetParts(ofFleet, before, now),
    ...customerParts(ofCustomers, before, now),
    ...new Set(rest.map(sectionPart)),
  ].map((text) => (text.length > LONGEST ? `${text.slice(0, LONGEST - 1)}\u2026` : text));
}

function parted(entries, isFirst) {
  return [entries.filter(isFirst), entries.filter((entry) => !isFirst(entry))];
}

function sectionPart(change) {
  const { path, before, after } = change;
  const whole = path === 'airspace' ? `${path}.${Object.keys(after ?? before)[0]}` : path;
  const found = Object.keys(SECTIONS).find((section) => whole.startsWith(section));
  return found ? t(`name.other.${SECTIONS[found]}`) : fieldChange(change);
}

function fleetParts(changes, before, now) {
  const [ofDrones, others] = parted(changes, ({ path }) => /\]\.drones$/.test(path));
  return [...others.map((change) => typePart(change, before, now)), ...dronesPart(ofDrones, now)];
}

/** Return drones that come or go: of all types, or of one. */
function dronesPart(changes, now) {
  if (!changes.length) return [];
  if (!now.fleet.some((type) => droneCount(type))) return [t('name.dronesOff')];
  const [{ path, before, after }] = changes;
  const isOther = now.fleet.length === 1 && before;
  if (changes.length > 1 || isOther) return [t('name.other.drones')];
  const [, id] = /\[(.*)\]/.exec(path);
  return [after ? t('name.dronesOnOf', { id }) : t('name.dronesOffOf', { id })];
}

/** Return what became of a vehicle type: more, fewer, another field. */
function typePart(change, before, now) {
  const [, id, field] = /^fleet\[(.*?)\](?:\.(.*))?$/.exec(change.path);
  const [then, after] = [before, now].map(
    ({ fleet }) => fleet.find((type) => type.id === id)?.count ?? 0);
  if (field !== undefined && field !== 'count') return fieldChange(change);
  const size = Math.abs(after - then);
  const amount = t('name.amount', {
    number: size > LARGEST_WORD ? String(size) : t(`name.number.${size}`),
    id: size > 1 && /[a-z]$/i.test(id) ? t('name.several', { id }) : id,
  });
  if (after > then) return t('name.vehicleMore', { amount });
  return after || size === 1 ? t('name.vehicleFewer', { amount }) : t('name.without', { id });
}

function customerParts(changes, before, now) {
  const [whole, fields] = parted(changes, ({ path }) => path.endsWith(']'));
  const added = whole.filter(({ before: there }) => there === undefined).map(idOf);
  const gone = whole.filter(({ after: there }) => there === undefined).map(idOf);
  const [ofWindows, others] = parted(fields, ({ path }) => /\]\.time_windows?\b/.test(path));
  return [
    ...many(added, (id) => t('name.added', { id }), (count) => t('name.addedMany', { count })),
    ...many(gone, (id) => t('name.without', { id }), (count) => t('name.withoutMany', { count })),
    ...windowParts(ofWindows, before, now),
    ...fieldParts(others)];
}

function many(ids, one, several) {
  if (!ids.length) return [];
  return [ids.length === 1 ? one(ids[0]) : several(ids.length)];
}

function idOf({ path }) {
  return /^customers\[(.*?)\](?:\.|$)/.exec(path)[1];
}

function windowParts(changes, before, now) {
  const ids = [...new Set(changes.map(idOf))];
  if (!ids.length) return [];
  const found = now.customers.filter(({ id }) => ids.includes(id));
  if (ids.length === 1) {
    const to = ` ${t('format.to')} `;
    const windows = windowsInWords(windowsOf(found[0])).replaceAll(to, '\u2013');
    return [t('name.window', { id: ids[0], windows })];
  }
  if (!now.customers.some((customer) => windowsOf(customer).length)) return [t('name.windowsOff')];
  const isSoft = changes.every(({ path, after }) => /late_cost_per_hour$/.test(path) && after);
  if (isSoft) return [t('name.windowsSoft')];
  return [t('name.windowsOf', { count: ids.length })];
}

/** Return changes of other fields of customers, those of one field together. */
function fieldParts(changes) {
  const byField = new Map();
  for (const change of changes) {
    const field = /\]\.([^.]*)/.exec(change.path)[1];
    if (!byField.has(field)) byField.set(field, []);
    byField.get(field).push(change);
  }
  return [...byField].map(([field, group]) =>
    group.length === 1
      ? fieldChange(group[0])
      : t('name.fieldOf', { count: group.length, field: withinSentence(labelOf(field)) }));
}

/** Return how many vehicles a fleet has. */
export function fleetSize(fleet) {
  return fleet.reduce((sum, { count = 1 }) => sum + count, 0);
}
