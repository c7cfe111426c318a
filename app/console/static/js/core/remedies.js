/** Unassigned customers by what would help. */

import { applyRemedy, numberOf } from './remedy-changes.js';
import { partsOf } from './remedy-parts.js';

/** Remedies that change the vehicles of a type by so much: the largest suffices for all. */
const BY_SO_MUCH =
  /(longer|later|more|more overtime|one more vehicle|another trip|were above [\d.,]+)$/;

/**
 * Return a remedy without its numbers and names, which tells its kind from others; of several
 * limits with them: the largest of one may be no other's.
 */
function kindOf({ remedy }) {
  if (remedy && isOfSeveral(remedy)) return remedy;
  return remedy ? remedy.replace(/[\d.,]*\d/g, '#') : '';
}

function isOfSeveral(remedy) {
  return partsOf(remedy).length > 1;
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
  const first = applyRemedy(request, most.customer.id, most.reason, most.customer.kind);
  const isForEach = first !== null && ['customers', 'shipments', 'relations'].some(
    (all) => first[all] !== request[all]);
  const { remedy } = most.reason;
  const suffices = !isForEach && (BY_SO_MUCH.test(remedy) || isOfSeveral(remedy));
  const changed =
    first === null || suffices
      ? first
      : ordered.reduce(
          (so, { customer, reason: own }) => 
            applyRemedy(so, customer.id, own, customer.kind) ?? so,
          request,
        );
  return { key, code: reason.code, type: reason.vehicle_type, remedy: most.reason.remedy, members,
    changed, isForEach, others: othersOf(request, key, members) };
}
