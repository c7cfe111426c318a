/** Vehicles whose drones fly nothing, and why, in words. */

import { droneCount } from './drones.js';
import { money, timesInWords } from './format.js';
import { t } from '../texts.js';

const AS_MUCH = 0.005;

/** Codes of the service that have words of their own here. */
const TOLD = new Set(
  ['KIND', 'CAPACITY', 'RANGE', 'SORTIES', 'LAUNCH', 'LOST', 'UNAVAILABLE', 'UNTRIED']);

/** Return the names of the vehicles in use that carry drones of which none flies. */
export function idleCarriers({ request, plan }) {
  const types = new Map(request.fleet.map((type) => [type.id, type]));
  return plan.routes
    .filter(({ type, trips }) =>
      droneCount(types.get(type)) > 0 && trips.every(({ sorties }) => !sorties?.length))
    .map(({ vehicle }) => vehicle);
}

/** Return the types of vehicles that fly by themselves where some don't: `{type, count, all}`. */
export function idleAtHubs({ request, plan }) {
  return request.fleet
    .filter(({ flies }) => flies)
    .map(({ id, count: all }) => ({
      type: id,
      count: all - plan.routes.filter(({ type, trips }) => type === id && trips.length > 0).length,
      all,
    }))
    .filter(({ count }) => count > 0);
}

/** Return why a vehicle's drones fly nothing, as the service told it, in words. */
export function idleInWords({ code, message, customer, cost }) {
  if (code === 'SAVES') return t('idleDrones.SAVES', { customer, sum: money(-cost) });
  if (code === 'COSTS_MORE') {
    return cost > AS_MUCH
      ? t('idleDrones.COSTS_MORE', { customer, sum: money(cost) })
      : t('idleDrones.SAME', { customer });
  }
  return TOLD.has(code) ? t(`idleDrones.${code}`) : timesInWords(message);
}
