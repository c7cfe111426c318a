/** A day as it happens: what changed a moment ago, who is late, who waits, what isn't told yet. */

import { clock, duration, money, percent, signed } from './format.js';
import { saidOf } from './said.js';
import { shipmentOf } from './visits.js';
import { nameOfVehicle } from './vehicle-labels.js';
import { t } from '../texts.js';

const LEAST = 60; // seconds that are worth a word
const PROMISED = 300; // seconds behind what was told that are
const SLOT = 7200; // seconds
const MOST_SLOTS = 6;

/**
 * Return what changed between two plans, by key of the customer: `{kind, text}`.
 *
 * @param before index of the plan that was seen last, null if it is the first
 */
export function changesOf(before, index) {
  const halts = [...index.halts].filter(([key]) => key[0] === 'c');
  const changes = halts.flatMap(([key, halt]) => {
    const change = before && changeOf(before.halts.get(key), halt);
    return change ? [[key, change]] : [];
  });
  const out = index.plan.unassigned.map(({ id }) => `c:${id}`)
    .filter((key) => before && (before.halts.has(key) || !before.customers.has(key.slice(2))));
  return new Map([...changes, ...out.map((key) => [key, { kind: 'out', text: t('live.out') }])]);
}

function changeOf(was, { vehicle, arrival }) {
  const { name } = vehicle;
  if (!was) return { kind: 'new', text: t('live.new'), vehicle: name };
  if (was.vehicle.name !== name) {
    return { kind: 'moved', text: `\u2192 ${nameOfVehicle(name)}`, vehicle: name };
  }
  const by = arrival - was.arrival;
  if (Math.abs(by) < LEAST) return null;
  return { kind: 'later', text: `${by < 0 ? '\u2212' : '+'}${duration(Math.abs(by))}` };
}

/** Return who comes late, the latest first: `{id, key, vehicle, by}`, `by` in seconds. */
export function lateOf({ orders }, index) {
  return orders.filter(({ state }) => state === 'planned').flatMap((order) => {
    const key = `c:${order.id}`;
    const behind = order.told === null ? 0 : order.arrival - order.told;
    const by = Math.max(index?.halts.get(key)?.lateness ?? 0, behind < PROMISED ? 0 : behind);
    return by < LEAST && !order.at_risk ? [] : [{ ...order, key, by }];
  }).sort((one, other) => other.by - one.by);
}

/** Return what mends an order that may be late, null if nothing is known or the plan is another. */
export function remedyFor({ orders }, { remedy, pinned }) {
  const byId = new Map(orders.map((each) => [each.id, each]));
  const isThere = ({ order, vehicle, after }) => !after || (byId.get(order)?.state === 'planned'
    && byId.get(order).vehicle === vehicle);
  return remedy && !pinned && remedy.events.every(isThere) ? remedy : null;
}

/** Return a remedy in words. */
export function liveRemedyInWords({ vehicle, arrival, cost }) {
  return t('live.sooner', {
    vehicle: nameOfVehicle(vehicle), at: clock(arrival), cost: signed(cost) });
}

/**
 * Return who waits, and why: those whom the plan leaves out, those it hasn't seen yet, and those
 * who ride along later for less.
 */
export function waitingOf({ orders }, plan) {
  const left = new Map(plan?.unassigned.map(({ id, reasons }) => [id, reasons?.[0]]));
  const later = new Map(plan?.outlook?.filter(({ leaves }) => !leaves)
    .map((each) => [each.id, each]));
  const why = (order) => {
    const { id, state } = order;
    if (isLeftOut(order)) return t('live.byHand');
    if (left.has(id)) return (left.get(id) && saidOf(left.get(id))) || t('live.out');
    if (state === 'waiting') return t('live.waits');
    return state === 'planned' && later.has(id) ? waitInWords(later.get(id)) : null;
  };
  return orders.map((order) => ({
    id: order.id, key: `c:${order.id}`, why: why(order), isByHand: isLeftOut(order) }))
    .filter((order) => order.why);
}

/** Tell whether an order was left out by hand. */
function isLeftOut({ state, pinned }) {
  return state === 'left_out' && Boolean(pinned) && pinned.vehicle === null;
}

function waitInWords({ departure, futures, later_in: count, saved }) {
  if (departure === null || !futures) return t('live.later');
  return t('live.laterFor', {
    at: clock(departure), count, futures, size: saved === null ? '' : money(saved) });
}

/** Return orders of which nobody told, by vehicle. */
export function doubtsOf({ orders }) {
  const doubts = orders.filter(({ state }) => state === 'doubtful');
  return [...new Set(doubts.map(({ vehicle }) => vehicle))]
    .map((vehicle) => [vehicle, doubts.filter((order) => order.vehicle === vehicle)]);
}

/** Return by how much an order is late, or how likely it will be. */
export function lateInWords({ by, chance }) {
  if (by >= LEAST) return t('live.late', { by: duration(by) });
  return chance === null || chance === undefined ? t('live.atRisk')
    : t('live.risk', { share: percent(chance) });
}

/** Return what stands beside customers on the map and in lists, by key: `{kind, text}`. */
export function newsOf(day, index, changes) {
  const late = lateOf(day, index).map((order) => [order.key, {
    kind: order.by < LEAST ? 'later' : 'late', text: lateInWords(order) }]);
  const doubts = day.orders.filter(({ state }) => state === 'doubtful')
    .map(({ id }) => [`c:${id}`, { kind: 'doubt', text: '?' }]);
  return new Map([...changes, ...late, ...doubts]);
}

/** Return marks of where vehicles were told to be, each with how long ago: `{location, text}`. */
export function sightingsOf({ vehicles, now }) {
  return vehicles.filter(({ position }) => position).map((vehicle) => ({
    location: vehicle.position,
    text: t('live.sighted', {
      vehicle: nameOfVehicle(vehicle.vehicle),
      ago: duration(Math.max(0, now - vehicle.position_at)),
    }),
  }));
}

/** Return the events that make one problem's orders another's: what isn't told yet. */
export function untoldOf(base, request) {
  const [was, now] = [base, request].map(({ customers }) =>
    new Map(customers.map((customer) => [customer.id, customer])));
  const isOther = (customer) => was.get(customer.id) !== customer
    && JSON.stringify(was.get(customer.id)) !== JSON.stringify(customer);
  return [
    ...request.customers.filter(isOther).map((customer) => ({
      kind: was.has(customer.id) ? 'order.changed' : 'order.placed', customer })),
    ...base.customers.filter(({ id }) => !now.has(id))
      .map(({ id }) => ({ kind: 'order.cancelled', order: id }))];
}

/**
 * Return the events that keep orders where they were put by hand, or out of plans, in the plan that
 * has them so.
 */
export function pinsOf(index, moved) {
  const customers = new Set(index.request.customers.map(({ id }) => id));
  const pins = moved.flatMap((id) => {
    const halt = index.halts.get(`c:${id}`);
    const order = customers.has(id) ? id : shipmentOf(index.request, id)?.id;
    if (!order) return [];
    if (!halt) return [{ kind: 'order.pinned', order, left_out: true }];
    const beside = (by) => halt.trip.stops[halt.stop + by]?.id;
    const [before, behind] = order === id && halt.stop !== null ? [beside(-1), beside(1)] : [];
    return [pinOf(order, halt, customers.has(before) && before),
      ...(customers.has(behind) ? [pinOf(behind, halt, id)] : [])];
  });
  return [...new Map(pins.map((pin) => [pin.order, pin])).values()];
}

function pinOf(order, { vehicle }, after) {
  return { kind: 'order.pinned', order, vehicle: vehicle.name, ...(after && { after }) };
}

/** Return the events that keep orders with the vehicles of a plan, or let go of them. */
export function locksOf(index, ids, isLocked) {
  const orders = new Map(ids.map((id) => [shipmentOf(index.request, id)?.id ?? id, id]));
  return [...orders].map(([order, id]) => (isLocked
    ? pinOf(order, index.halts.get(`c:${id}`)) : { kind: 'order.pinned', order, undone: true }));
}

/** Return a problem with what isn't told yet. */
export function withUntold(base, events) {
  const customers = new Map(base.customers.map((customer) => [customer.id, customer]));
  for (const { customer, order } of events) {
    if (customer) customers.set(customer.id, customer);
    else customers.delete(order);
  }
  return events.length ? { ...base, customers: [...customers.values()] } : base;
}

/** Return slots to choose from: the one that was asked for, else those ahead today. */
export function slotsFor({ fleet }, { time_window: asked }, now, until) {
  if (asked) return [asked];
  const ends = fleet.map(({ shift }) => shift?.latest).filter(Boolean);
  const end = Math.max(until, ...ends);
  const first = Math.ceil(now / 3600) * 3600;
  const count = Math.min(Math.ceil(Math.max(end - first, 1) / SLOT), MOST_SLOTS);
  const slots = Array.from({ length: count }, (_, at) => ({
    earliest: first + at * SLOT, latest: first + (at + 1) * SLOT }));
  return [{ earliest: now }, ...slots];
}

/** Return a slot in words. */
export function slotInWords({ earliest, latest }) {
  return latest === null || latest === undefined ? t('live.anyTime')
    : t('live.slot', { from: clock(earliest), until: clock(latest) });
}
