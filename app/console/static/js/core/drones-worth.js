/** What a plan's drones do, in numbers. */

import { droneCount } from './drones.js';
import { isVisit } from './visits.js';

/**
 * Return `{drones, customers, ofHubs, present}`: drones of a plan that fly, whom they serve, how
 * many of them fly from hubs by themselves, and the drones that there are: those that vehicles in
 * use carry, and all of hubs.
 */
export function flownIn({ request, plan }) {
  const types = new Map(request.fleet.map((type) => [type.id, type]));
  const own = plan.routes.filter(({ type }) => types.get(type)?.flies);
  const sorties = plan.routes.flatMap(({ trips }) => trips.flatMap((trip) => trip.sorties ?? []));
  const served = own.flatMap(({ trips }) => trips.flatMap(({ stops }) => stops))
    .filter(isVisit).length;
  const carried = plan.routes.reduce((sum, { type }) => sum + droneCount(types.get(type)), 0);
  return {
    drones: new Set(sorties.map(({ drone }) => drone)).size + own.length,
    customers: sorties.reduce((sum, { customers }) => sum + customers.length, served),
    ofHubs: own.length,
    present: request.fleet.reduce((sum, { flies, count }) => sum + (flies ? count : 0), carried),
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
