/** Whom vehicles visit: customers, and shipments where they are picked up and delivered. */

/** Kinds of stops that are visits; a shipment's ends are customers of the service's, too. */
const KINDS = new Set(['customer', 'pickup', 'delivery']);

/** Kinds of a shipment's ends, in the order of the day. */
export const ENDS = ['pickup', 'delivery'];

/** Tell whether a stop is a visit, and no depot, launch site or break. */
export function isVisit({ kind }) {
  return KINDS.has(kind);
}

/** Return what a visit is called among all: a shipment's delivery `parcel/delivery`. */
export function visitName({ kind, id, part = null }) {
  if (!ENDS.includes(kind)) return id;
  return part === null ? `${id}/${kind}` : `${id}/${kind}/${part}`;
}

/**
 * Return the ends of a shipment: `{name, keys, end, amount}`, the keys of where it states them.
 *
 * What is delivered of several pickups is the sum of their amounts.
 */
export function endsOf({ id, amount, pickup, pickups = [], delivery }) {
  const parts = pickups.map((end, at) => ({
    name: visitName({ kind: 'pickup', id, part: end.id }), keys: ['pickups', at], end,
    amount: end.amount,
  }));
  const whole = amount ?? sums(pickups.map((part) => part.amount ?? []));
  if (pickup) parts.push({ name: `${id}/pickup`, keys: ['pickup'], end: pickup, amount: whole });
  return [...parts, { name: `${id}/delivery`, keys: ['delivery'], end: delivery, amount: whole }];
}

function sums([first = [], ...rest]) {
  return first.map((amount, place) =>
    rest.reduce((sum, other) => sum + (other[place] ?? 0), amount));
}

/** Return a request's customers, and the ends of its shipments as such. */
export function visitsOf({ customers, shipments = [] }) {
  if (!shipments.length) return customers;
  return [...customers, ...shipments.flatMap(visitsTo)];
}

function visitsTo(shipment) {
  const { pickup: _, pickups: __, delivery: ___, max_time_between: _4, max_detour: _5,
    ...whole } = shipment;
  return endsOf(shipment).map(({ name, end, amount }) => ({
    ...whole, served_by: 'truck', ...end, id: name, demand: amount,
  }));
}

/** Return the shipment with an end of a name: `{id, names}`, of all ends; else undefined. */
export function shipmentOf({ shipments = [] }, name) {
  const whole = shipments.find((each) => endsOf(each).some((end) => end.name === name));
  return whole && { id: whole.id, names: endsOf(whole).map((end) => end.name) };
}

/** Return the names of visits of customers and shipments, which are named by their ids. */
export function visitNamesOf({ customers, shipments = [] }, ids) {
  return ids.flatMap((id) => {
    const whole = customers.every((customer) => customer.id !== id)
      && shipments.find((shipment) => shipment.id === id);
    return whole ? endsOf(whole).map(({ name }) => name) : [id];
  });
}

function namesOf({ id, parts = [] }) {
  const pickups = parts.length ? parts : [null];
  return [...pickups.map((part) => visitName({ kind: 'pickup', id, part })), `${id}/delivery`];
}

/** Return who is left out, by the names of visits. */
export function leftOutOf({ unassigned }) {
  return unassigned.flatMap((out) => out.kind === 'shipment'
    ? namesOf(out).map((id) => ({ ...out, id }))
    : [out]);
}
