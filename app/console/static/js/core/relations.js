/** Who goes with whom: what names customers, and follows them when they go or are renamed. */

import { endsOf } from './visits.js';

/** Fields that say nothing of relations of a kind. */
const NEEDLESS = { before: ['scope'] };
const OF_ORDERS = ['min_lag', 'max_lag', 'same_vehicle'];

/** Return the fields of a relation that say nothing of its kind, and aren't stated. */
export function needlessIn(relation) {
  const names = NEEDLESS[relation.kind] ?? OF_ORDERS;
  return names.filter((name) => relation[name] === undefined);
}

/** Return the problem in which a relation that was an order says nothing of orders any more. */
export function ofTheirKinds(former, changed) {
  if (former.relations?.length !== changed.relations?.length) return changed;
  const wasOrder = (at) => former.relations[at].kind === 'before';
  const without = (relation) => Object.fromEntries(
    Object.entries(relation).filter(([name]) => !OF_ORDERS.includes(name)));
  return {
    ...changed,
    ...(changed.relations && { relations: changed.relations.map((relation, at) => (
      wasOrder(at) && relation.kind !== 'before' ? without(relation) : relation)) }),
  };
}

/** Return the problem with a relation more. */
export function relate(request, kind, customers) {
  return { ...request, relations: [...(request.relations ?? []), { kind, customers }] };
}

/** Return relations without names; those that bind nobody any more are left out. */
export function withoutNamed(relations, isGone) {
  return relations?.map((relation) => ({
    ...relation, customers: relation.customers.filter((name) => !isGone(name)),
  })).filter(({ customers }, index) => customers.length > 1
    || customers.length === relations[index].customers.length);
}

/** Return the problem whose relations call a customer by another name. */
export function renamed(request, former, name) {
  if (!request.relations?.some(({ customers }) => customers.includes(former))) return request;
  return {
    ...request,
    relations: request.relations.map((relation) => ({
      ...relation,
      customers: relation.customers.map((each) => (each === former ? name : each)),
    })),
  };
}

/** Return the problem with other shipments than before, whose ends relations name as they do. */
export function withShipments(former, changed) {
  if (!changed.relations) return changed;
  const [before, after] = [former, changed].map(
    ({ shipments = [] }) => shipments.map((each) => endsOf(each).map(({ name }) => name)));
  const names = new Map(before.length === after.length
    ? before.flatMap((ends, at) => (ends.length === after[at].length
      ? ends.map((name, end) => [name, after[at][end]]) : []))
    : []);
  const called = (name) => names.get(name) ?? name;
  const there = new Set(after.flat());
  const gone = new Set(before.flat().map(called).filter((name) => !there.has(name)));
  const relations = changed.relations.map((relation) => ({
    ...relation, customers: relation.customers.map(called),
  }));
  return { ...changed, relations: withoutNamed(relations, (name) => gone.has(name)) };
}
