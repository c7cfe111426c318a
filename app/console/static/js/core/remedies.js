/** Remedies of unassigned customers as changes of the problem, and customers by what would help. */

import { getIn, parsePath, setIn } from './paths.js';

/** What changes customers, not vehicles; one by one, or all of their relations. */
const OF_CUSTOMERS = /^\$\.(customers|shipments|relations)/;
const OF_ONE = /^\$\.(customers|shipments|relations)\[/;

/**
 * Return a request as a remedy changes it, null if it has no place for that.
 *
 * @param request that is changed
 * @param changes of a remedy, `{path, by}` or `{path, to}`
 * @param told the request that the remedy was told for
 */
export function applied(request, changes, told = request) {
  return changes.reduce((changed, { path, by, to }) => {
    const keys = changed && placeIn(request, told, parsePath(path));
    const value = keys && getIn(changed, keys);
    if (!keys || (by !== undefined && typeof value !== 'number')) return null;
    return setIn(changed, keys, by === undefined ? to : Number((value + by).toFixed(6)));
  }, changes.length ? request : null);
}

/** Return where a request has a place of another one: who has an id may have moved in a list. */
function placeIn(request, told, keys) {
  return keys.reduce((found, key, at) => {
    const id = getIn(told, keys.slice(0, at + 1))?.id;
    if (!found || typeof key === 'string' || id === undefined) return found && [...found, key];
    const index = getIn(request, found)?.findIndex((each) => each.id === id) ?? -1;
    return index < 0 ? null : [...found, index];
  }, []);
}

/** Return what a remedy consists of, of one limit each. */
export function partsOf(remedy) {
  return remedy.parts?.length ? remedy.parts : [remedy];
}

/** Return what tells a remedy's kind from others: those of one kind can be done together. */
function kindOf(remedy) {
  return remedy ? JSON.stringify(partsOf(remedy).map(({ code, changes }) => [
    code,
    changes.filter(({ path }) => !OF_ONE.test(path))
      .map(({ path, to }) => [path, isMeasured(to) ? null : to]),
  ])) : '';
}

function isMeasured(to) {
  return (Array.isArray(to) ? to : [to]).every((value) => typeof value === 'number');
}

/** Return the changes of several remedies by their paths: of one place the most of all. */
function together(remedies) {
  const found = new Map();
  for (const change of remedies.flatMap(({ changes }) => changes)) {
    const { path, by, to } = found.get(change.path) ?? change;
    found.set(path, by === undefined
      ? { path, to: most(to, change.to) } : { path, by: most(by, change.by) });
  }
  return found;
}

function most(one, other) {
  if (Array.isArray(one)) return one.map((value, at) => most(value, other[at]));
  return one > other ? one : other;
}

function sizeOf({ changes: [first] }) {
  return [first?.by ?? first?.to].flat().reduce((sum, value) => sum + value, 0);
}

/** Return what one part of several remedies comes to: the largest, changed for all. */
function largestOf(parts) {
  const changes = together(parts);
  const largest = parts.reduce((one, other) => (sizeOf(other) > sizeOf(one) ? other : one));
  return { ...largest, changes: largest.changes.map(({ path }) => changes.get(path)) };
}

/**
 * Return the unassigned customers of a plan by what would help: `[{key, code, type, remedy,
 * members, changed, isForEach, others}]`, the largest group first, each customer in one group.
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
      const key = [reason.vehicle_type, reason.code, kindOf(remedyOf(reason)), zone].join('|');
      if (!groups.has(key)) groups.set(key, []);
      groups.get(key).push({ customer, reason });
    }
  }
  const without = unassigned.filter(({ reasons }) => !reasons.length);
  if (without.length) groups.set('', without.map((customer) => ({ customer, reason: null })));
  return oneEach([...groups]).map(([key, members]) => ({
    ...grouped(request, key, members, 0),
    others: isOneKind(members, 1) ? [grouped(request, `${key}|other`, members, 1)] : [],
  }));
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
    const rank = ([, [{ reason }, ...others]]) => (remedyOf(reason) ? 1e9 : 0) + others.length;
    open.sort((one, other) => rank(other) - rank(one));
    const [largest, ...others] = open;
    if (!largest) break;
    found.push(largest);
    largest[1].forEach(({ customer }) => taken.add(customer.id));
    left = others;
  }
  return found;
}

function remedyOf(reason, number = 0) {
  return reason?.remedies?.[number];
}

function isOneKind(members, number) {
  const kinds = new Set(members.map(({ reason }) => kindOf(remedyOf(reason, number))));
  return kinds.size === 1 && !kinds.has('');
}

function grouped(request, key, members, number) {
  const { reason } = members[0];
  const group = { key, code: reason?.code, type: reason?.vehicle_type, members };
  if (!remedyOf(reason, number)) {
    return { ...group, remedy: null, changed: null, isForEach: false };
  }
  const remedies = members.map((member) => remedyOf(member.reason, number));
  const changes = [...together(remedies).values()];
  return {
    ...group,
    remedy: {
      ...remedies[0],
      parts: partsOf(remedies[0]).map((_, at) => largestOf(
        remedies.map((remedy) => partsOf(remedy)[at]))),
    },
    changed: applied(request, changes),
    isForEach: changes.some(({ path }) => OF_CUSTOMERS.test(path)),
  };
}
