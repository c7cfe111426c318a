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
export function visitName({ kind, id }) {
  return ENDS.includes(kind) ? `${id}/${kind}` : id;
}

/** Return a request's customers, and the ends of its shipments as such. */
export function visitsOf({ customers, shipments = [] }) {
  if (!shipments.length) return customers;
  return [...customers, ...shipments.flatMap(endsOf)];
}

function endsOf({ id, amount, pickup, delivery, max_time_between: _, max_detour: __, ...whole }) {
  return [[ENDS[0], pickup], [ENDS[1], delivery]].map(([kind, end]) => ({
    ...whole, served_by: 'truck', ...end, id: visitName({ kind, id }), demand: amount,
  }));
}

/** Return who is left out, by the names of visits. */
export function leftOutOf({ unassigned }) {
  return unassigned.flatMap((out) => out.kind === 'shipment'
    ? ENDS.map((kind) => ({ ...out, id: visitName({ kind, id: out.id }) }))
    : [out]);
}
