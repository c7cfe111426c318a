/**
 * Which vehicles of two plans are the same, judged by whom they serve.
 *
 * A planner numbers vehicles as it comes to them, so that a plan with a vehicle fewer may have the
 * same tours under other names. People know a vehicle by its tour.
 */

import { munkres } from '../../vendor/munkres-2.0.4/munkres.js';
import { customersOf } from './replanning.js';

/**
 * Return `[{before, now, shared}]`: names of vehicles, `shared` counts the customers of both.
 *
 * Vehicles of a type that both fleets have are paired with each other alone. Who has departed is
 * who it was.
 *
 * @param former, entry entries of the plans
 */
export function matchVehicles(former, entry) {
  const departed = new Set((entry.plan.replan?.settled ?? []).map(({ vehicle }) => vehicle));
  const [before, now] = [former, entry].map(({ plan }) => plan.routes);
  const owners = new Map(
    before.flatMap((route, index) => customersOf(route).map((id) => [id, index])));
  const mayPair = pairing(former.request, entry.request, departed);
  const shared = now.map((route) => {
    const counts = Array(before.length).fill(0);
    for (const id of customersOf(route)) if (owners.has(id)) counts[owners.get(id)] += 1;
    return counts;
  });
  // Below one customer in sum, so that of pairs that are worth the same equal names win.
  const sameName = 1 / (now.length + 1);
  const worth = now.map((route, index) =>
    before.map((other, otherIndex) => {
      if (!mayPair(other, route)) return 0;
      if (departed.has(route.vehicle)) return owners.size + 1;
      return shared[index][otherIndex] + (route.vehicle === other.vehicle ? sameName : 0);
    }));
  return munkres(worth.map((row) => row.map((each) => -each)))
    .filter(([index, otherIndex]) => worth[index][otherIndex] > 0)
    .sort(([one], [other]) => one - other)
    .map(([index, otherIndex]) => ({
      before: before[otherIndex].vehicle, now: now[index].vehicle,
      shared: shared[index][otherIndex],
    }));
}

function pairing(formerRequest, request, departed) {
  const [before, now] = [formerRequest, request].map(
    ({ fleet }) => new Set(fleet.map(({ id }) => id)));
  return (other, route) => {
    if (departed.has(route.vehicle) || departed.has(other.vehicle)) {
      return route.vehicle === other.vehicle;
    }
    return route.type === other.type || !now.has(other.type) || !before.has(route.type);
  };
}

/**
 * Return the plan of an entry, its vehicles named as those of the former plan with their tours.
 *
 * Vehicles of a type are alike, so names may change hands within it, but for those that a
 * customer asks for by name. A plan that goes on from another keeps its names.
 */
export function withFormerNames(former, entry) {
  const { request, plan } = entry;
  if (plan.replan) return plan;
  const wanted = new Set(request.customers.flatMap(({ vehicles, vehicle_costs: costs }) => [
    ...(vehicles?.allowed ?? []), ...(vehicles?.forbidden ?? []), ...Object.keys(costs ?? {})]));
  const matched = new Map(matchVehicles(former, entry).map(({ before, now }) => [now, before]));
  const names = new Map();
  for (const { id, count } of request.fleet) {
    const own = Array.from({ length: count }, (_, number) => `${id}-${number + 1}`);
    if (own.some((name) => wanted.has(name))) continue;
    const used = plan.routes.filter(({ type }) => type === id).map(({ vehicle }) => vehicle);
    for (const [name, given] of exchanged(used, own, matched)) names.set(name, given);
  }
  return renamed(plan, names);
}

/** Return `[[name, given]]`: matched names where there are such vehicles, else what is left. */
function exchanged(used, own, matched) {
  const free = new Set(own);
  const formers = used.map((name) => (free.delete(matched.get(name)) ? matched.get(name) : null));
  return used.map((name, index) => {
    const given = formers[index] ?? (free.has(name) ? name : [...free][0]);
    free.delete(given);
    return [name, given];
  });
}

function renamed(plan, names) {
  if ([...names].every(([name, given]) => name === given)) return plan;
  const given = (name) => names.get(name) ?? name;
  return {
    ...plan,
    routes: plan.routes.map((route) => ({
      ...route,
      vehicle: given(route.vehicle),
      trips: route.trips.map((trip) => ({
        ...trip,
        sorties: trip.sorties.map((sortie) => ({
          ...sortie,
          drone: given(route.vehicle) + sortie.drone.slice(route.vehicle.length),
        })),
      })),
    })),
  };
}

/**
 * Return the number of each vehicle of an entry, by name: that of the vehicle which had its tour.
 *
 * Numbers tell what colour and number a vehicle has on the map. In a plan that goes on from another
 * a vehicle keeps its own, as it is under way.
 *
 * @param former an entry of the plans
 * @param formerNumbers its numbers, by name
 */
export function numbersAfter(former, formerNumbers, entry) {
  const routes = entry.plan.routes.map(({ vehicle }) => vehicle);
  const matched = entry.plan.replan
    ? new Map(routes.map((name) => [name, name]))
    : new Map(matchVehicles(former, entry).map(({ before, now }) => [now, before]));
  const given = new Map(
    routes.flatMap((name) => {
      const number = formerNumbers.get(matched.get(name));
      return number === undefined ? [] : [[name, number]];
    }));
  // Who stood in the former plan and has no part in this one keeps its number for the next.
  const taken = new Set([...given.values(), ...formerNumbers.values()]);
  let next = 0;
  for (const name of routes) {
    if (given.has(name)) continue;
    while (taken.has(next)) next += 1;
    taken.add(next);
    given.set(name, next);
  }
  return given;
}
