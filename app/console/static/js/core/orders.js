/** Orders that come in and are cancelled while a plan stands. */

import { freeName, removeCustomers } from './changes.js';
import { dayOf } from './day.js';
import { parseClock, parseNumber } from './format.js';
import { placeOf } from './places.js';
import { setIn } from './paths.js';
import { basisRoutes, customersOf, goOnFrom } from './replanning.js';

const POINTED = '([-\u2212]?\\d+(?:\\.\\d+)?)';
const ANY_NUMBER = '([-\u2212]?\\d+(?:[.,]\\d+)?)';
const CLOSE_PAIR = new RegExp(`^\\(?${POINTED},${POINTED}\\)?$`);
const PAIR = new RegExp(`^\\(?${ANY_NUMBER}(?:;|,? ) ?${ANY_NUMBER}\\)?$`);

/** What a new order is before anything of it is typed. */
export const NOTHING_TYPED = { place: '', amount: '', opens: '', closes: '', name: '' };

/**
 * Return where a text says that somebody is, null where it names no place that is known here.
 *
 * On the globe two numbers are latitude and longitude, as maps copy them; else x and y. A name is
 * that of a customer or depot.
 */
export function placeIn(request, text) {
  const trimmed = text.trim().replace(/\s+/g, ' ');
  const [, first, second] = CLOSE_PAIR.exec(trimmed) ?? PAIR.exec(trimmed) ?? [];
  if (second !== undefined) {
    const pair = [parseNumber(first), parseNumber(second)];
    return request.coordinate_system === 'geographic' ? pair.reverse() : pair;
  }
  const name = trimmed.toLowerCase();
  return placeOf([...request.customers, ...request.depots].find(
    ({ id }) => name !== '' && id.toLowerCase() === name));
}

/** Return a place as `placeIn` reads it. */
export function placeText(request, [x, y]) {
  return request.coordinate_system === 'geographic' ? `${y}, ${x}` : `${x}, ${y}`;
}

/**
 * Return `{customer, wrong}`: the customer of an order, and the names of fields that can't be read.
 *
 * @param typed texts, as `NOTHING_TYPED` has them
 * @param location where the order goes, null where that isn't known
 */
export function orderOf(request, typed, location) {
  const dimensions = request.fleet[0]?.capacity.length ?? 1;
  const stated = typed.amount.trim();
  const amounts = stated === '' ? [1] : stated.split(/\s*;\s*|,?\s+/).map(parseNumber);
  const [opens, closes] = [typed.opens, typed.closes].map((text) =>
    text.trim() === '' ? null : parseClock(text));
  const id = typed.name.trim() || freeName(request.customers, 'order');
  const wrong = [
    [!location, 'place'],
    [amounts.length > dimensions || amounts.some((each) => each === null || each < 0), 'amount'],
    [typed.opens.trim() !== '' && (opens === null || opens < 0), 'opens'],
    [typed.closes.trim() !== '' && (closes === null || closes < (opens ?? 0)), 'closes'],
    [request.customers.some((other) => other.id === id), 'name'],
  ].filter(([isWrong]) => isWrong).map(([, name]) => name);
  const window = {
    ...(opens !== null && { earliest: opens }),
    ...(closes !== null && { latest: closes }),
  };
  const customer = {
    id,
    location,
    demand: Array.from({ length: dimensions }, (_, index) => amounts[index] ?? 0),
    service_duration: usualService(request),
    ...(Object.keys(window).length && { time_window: window }),
  };
  return { customer, wrong };
}

/** Return how long most customers are served. */
function usualService({ customers }) {
  const counts = new Map();
  for (const { service_duration: duration = 0 } of customers) {
    counts.set(duration, (counts.get(duration) ?? 0) + 1);
  }
  return [...counts].sort(([, one], [, other]) => other - one)[0]?.[0] ?? 0;
}

/** Return the seconds of a plan's day that it is now, null unless it is dated today. */
export function nowOf(request, now = new Date()) {
  const day = dayOf(request);
  if (!day) return null;
  const seconds = Math.floor(day.since(now.getTime()) / 60) * 60;
  return seconds >= 0 && day.clockAt(seconds).days === 0 ? seconds : null;
}

/**
 * Return the problem in which places for an order are sought: what has happened by now stays, and
 * every vehicle may make a trip more than is stated.
 */
export function askedFor(request, plan, now) {
  const base = now === null ? request : goOnFrom(request, plan, now);
  const fleet = base.fleet.map((type) => ({ ...type, max_trips: (type.max_trips ?? 1) + 1 }));
  return { base, asked: { ...base, fleet } };
}

/** Tell whether a place is on a trip more than its vehicle's type may make. */
export function takesAnotherTrip(request, plan, { vehicle, position }) {
  const route = plan.routes.find((other) => other.vehicle === vehicle);
  const type = request.fleet.find(({ id }) => id === route?.type);
  return Boolean(type && position.own_trip && route.trips.length >= (type.max_trips ?? 1));
}

/** Return a problem in which vehicles of the type of one may make a trip more. */
export function withAnotherTrip(request, plan, { vehicle }) {
  const { type } = plan.routes.find((route) => route.vehicle === vehicle);
  const at = request.fleet.findIndex(({ id }) => id === type);
  return setIn(request, ['fleet', at, 'max_trips'], (request.fleet[at].max_trips ?? 1) + 1);
}

/**
 * Return `{request, settled}`: a problem without some orders, and those of them that can't be
 * cancelled, since they are served, or a vehicle is on its way to them.
 */
export function withoutOrders(request, ids) {
  const stay = settledIn(request);
  const cancelled = ids.filter((id) => !stay.has(id));
  return {
    request: cancelled.length ? removeCustomers(request, cancelled) : request,
    settled: ids.filter((id) => stay.has(id)),
  };
}

/** Return the names of those who are settled by the plan that a problem goes on from. */
function settledIn(request) {
  if (!request.replan?.plan?.routes) return new Set();
  return new Set(basisRoutes(request).flatMap(({ route, open }) => {
    const free = new Set(open);
    return customersOf(route).filter((id) => !free.has(id));
  }));
}

/**
 * Return `{request, back}`: a problem that has whoever is settled by the plan that it goes on from,
 * and the names of those who were cancelled too late and had to be taken up again.
 *
 * @param former the problem that the plan was made for
 */
export function withSettled(request, former) {
  const known = new Set(request.customers.map(({ id }) => id));
  const settled = settledIn(request);
  const lost = (former?.customers ?? []).filter(({ id }) => settled.has(id) && !known.has(id));
  if (!lost.length) return { request, back: [] };
  return {
    request: { ...request, customers: [...request.customers, ...lost] },
    back: lost.map(({ id }) => id),
  };
}
