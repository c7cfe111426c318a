/** Plans on the road: what is sent out, and how far drivers are, in words. */

import { clock } from './format.js';
import { goOnFrom } from './replanning.js';
import { language, t } from '../texts.js';

/** Return what sends a plan out; its seconds count from the day's midnight here, unless stated. */
export function dispatchOf({ request, plan }, now = new Date()) {
  return { problem: request, plan, ...dayOf(request, now) };
}

/** Return when a problem's day is: the day is today here, unless stated. */
export function dayOf(request, now = new Date()) {
  return {
    plan_start: request.plan_start ?? isoOf(midnight(now)),
    time_zone: request.time_zone ?? Intl.DateTimeFormat().resolvedOptions().timeZone,
  };
}

function midnight(instant) {
  return new Date(instant.getFullYear(), instant.getMonth(), instant.getDate());
}

/** Return an instant with the offset that holds here. */
function isoOf(instant) {
  const pad = (number) => String(number).padStart(2, '0');
  const ahead = -instant.getTimezoneOffset();
  const offset = [Math.floor(Math.abs(ahead) / 60), Math.abs(ahead) % 60].map(pad).join(':');
  const date = [instant.getFullYear(), instant.getMonth() + 1, instant.getDate()];
  const time = [instant.getHours(), instant.getMinutes(), instant.getSeconds()];
  const day = `${date[0]}-${date.slice(1).map(pad).join('-')}`;
  return `${day}T${time.map(pad).join(':')}${ahead < 0 ? '-' : '+'}${offset}`;
}

/** Return the plans on the road that have not ended, with when they were sent out, in words. */
export function openDispatches(dispatches, now = new Date()) {
  return dispatches
    .filter(({ ends_at: ends }) => new Date(ends) > now)
    .map(({ id, day, created_at: created, plan_start: start }) => ({
      id,
      day,
      words: t('standing.sentOut', {
        day: start.slice(0, 10),
        when: new Date(created).toLocaleString(language(), {
          dateStyle: 'medium',
          timeStyle: 'short',
        }),
      }),
    }));
}

/** Return links by vehicle, with the addresses and pictures told when they were made. */
export function linksByVehicle(dispatch) {
  return new Map(
    (dispatch?.reply.links ?? []).map((link) => [
      link.vehicle,
      { ...link, ...dispatch.made[link.id] }]));
}

/** Return what was told of links when they were made, with that of a reply. */
export function withMade(made, { links }) {
  const told = links.filter(({ url }) => url).map(({ id, url, qr }) => [id, { url, qr }]);
  return { ...made, ...Object.fromEntries(told) };
}

/** Seconds behind the plan from which on a driver is late. */
const LATE = 60;

/** Return how far a driver is, in words. */
export function standingText({ state, opened_at: opened, done, failed, steps, standing }) {
  if (state === 'revoked') return t('standing.revoked');
  const broken = isBrokenDown({ standing }) ? `${t('standing.broken')}; ` : '';
  const over = done + failed;
  const last = standing.reduce((latest, { time }) => Math.max(latest, time), -Infinity);
  const opening = opened ? t('standing.opened') : t('standing.unopened');
  const far = over ? t('standing.far', { over, steps, at: clock(last) }) : opening;
  const lost = failed ? `, ${t('standing.failures', { count: failed })}` : '';
  return `${broken}${far}${lost}${state === 'over' ? `; ${t('standing.over')}` : ''}`;
}

/** Tell whether a driver who isn't done is late, or has broken down. */
export function isInTrouble(link) {
  return link.state === 'open' && (isBrokenDown(link) || behindPlan(link) > 0);
}

/** Tell whether a vehicle has broken down. */
export function isBrokenDown({ standing }) {
  return standing.some(({ kind, state }) => kind === 'vehicle' && state === 'failed');
}

/** Return by how many seconds what a vehicle told last was late, 0 for less than a minute. */
export function behindPlan({ standing }) {
  const last = standing.reduce((latest, told) => (told.time >= latest.time ? told : latest),
    { time: 0, late: 0 });
  return last.late < LATE ? 0 : last.late;
}

/** What phones tell as known reasons, whatever their language. */
const REASONS = {
  'Nobody there': 'nobody',
  Refused: 'refused',
  'Wrong address': 'address',
  Damaged: 'damaged',
  'No time left': 'time',
  'Too much wind': 'wind',
  'Drone is broken': 'broken',
  'Battery is empty': 'battery',
  'Came back with the parcel': 'parcel',
  'Did not come back': 'lost',
  'Broken down': 'breakdown',
};

/** Return why a step failed: a known reason in the page's language, else the driver's own words. */
export function driverReason(told) {
  return told in REASONS ? t(`reason.${REASONS[told]}`) : told;
}

/**
 * Return the request that goes on from what drivers told: see `GET /dispatches/{id}/replan`.
 *
 * Whoever failed where a drone was launched or met, or by a drone, stays in the plan as if served,
 * and is ordered anew under another id.
 */
export function goOnAsTold(request, { replan, failed }) {
  // Of a flight that wasn't launched, the recovery may be told to have failed too.
  const isLast = (told) => (told.is_open ? 1 : 0);
  const sorted = [...failed].sort((one, other) => isLast(one) - isLast(other));
  const back = new Map(sorted.map((told) => [told.customer, told]));
  const ids = new Set(request.customers.map(({ id }) => id));
  const customers = request.customers.flatMap((customer) => {
    const told = back.get(customer.id);
    if (!told) return [customer];
    const time = Math.max(customer.release_time ?? 0, Math.ceil(told.parcel_back));
    const again = { ...customer, release_time: time };
    if (told.is_open) return [again];
    const id = nextOrder(customer.id);
    return ids.has(id) ? [customer] : [customer, { ...again, id }];
  });
  const changed = back.size ? { ...request, customers } : request;
  const next = goOnFrom(changed, replan.plan, replan.freeze_before);
  const broken = new Set([...(next.replan.unavailable ?? []), ...(replan.unavailable ?? [])]);
  return broken.size
    ? { ...next, replan: { ...next.replan, unavailable: [...broken] } }
    : next;
}

/** Return the id of a customer who is ordered anew: `B (again)`, then `B (again 2)`. */
export function nextOrder(id) {
  const [, name, number] = /^(.*) \(again(?: (\d+))?\)$/s.exec(id) ?? [null, id, null];
  if (name === id) return `${id} (again)`;
  return `${name} (again ${Number(number ?? 1) + 1})`;
}
