/** What a plan's drones do, in numbers. */

import { droneCount } from './drones.js';

/**
 * Return `{drones, customers, carried}`: drones of a plan that fly, whom they serve, and the drones
 * that its vehicles in use carry.
 */
export function flownIn({ request, plan }) {
  const types = new Map(request.fleet.map((type) => [type.id, type]));
  const sorties = plan.routes.flatMap(({ trips }) => trips.flatMap((trip) => trip.sorties ?? []));
  return {
    drones: new Set(sorties.map(({ drone }) => drone)).size,
    customers: sorties.reduce((sum, { customers }) => sum + customers.length, 0),
    carried: plan.routes.reduce((sum, { type }) => sum + droneCount(types.get(type)), 0),
  };
}

/**
 * Return the share of what trucks alone would cost that drones save, by two searches of the same
 * length; null where no figure can be told.
 *
 * Prices of who is left out count like other costs, so that both must leave out nobody.
 */
export function savedShare(told) {
  const { saves, trucks_alone: alone, with_drones: flown } = told ?? {};
  if (saves === null || !alone || !flown || alone.unassigned || flown.unassigned) return null;
  return alone.cost.total > 0 ? saves / alone.cost.total : null;
}
