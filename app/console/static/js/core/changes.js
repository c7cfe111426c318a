/** Changes to a problem; each returns the changed request. */

import { isInside } from './geometry.js';
import { removeIn, setIn } from './paths.js';
import { assumedDrones } from './presets.js';
import { windowsOf, withWindows } from './windows.js';
import { withoutNamed } from './relations.js';
import { proposed } from './zones.js';

const DECIMALS = { planar: 3, geographic: 6 };

/**
 * Return a location rounded to what a hand can place.
 *
 * @param {any} request
 * @param {Point} place
 * @returns {Point}
 */
export function rounded(request, [x, y]) {
  const digits = DECIMALS[request.coordinate_system ?? 'planar'];
  return [Number(x.toFixed(digits)), Number(y.toFixed(digits))];
}

/** Return a name that nothing in a list has yet. */
export function freeName(entries, stem) {
  const taken = new Set(entries.map(({ id }) => id));
  let number = entries.length + 1;
  while (taken.has(`${stem}-${number}`)) number += 1;
  return `${stem}-${number}`;
}

/** Add a customer as a brush says. */
export function addCustomer(request, location, brush) {
  const dimensions = request.fleet[0]?.capacity.length ?? 1;
  const demand = Array.from({ length: dimensions }, (_, index) => brush.demand[index] ?? 0);
  const customer = {
    id: freeName(request.customers, 'customer'),
    location: rounded(request, location),
    demand,
    service_duration: brush.service_duration,
    served_by: brush.served_by,
  };
  return { ...request, customers: [...request.customers, customer] };
}

/** Add a depot. */
export function addDepot(request, location) {
  const depot = { id: freeName(request.depots, 'depot'), location: rounded(request, location) };
  return { ...request, depots: [...request.depots, depot] };
}

/** Add a launch site. */
export function addSite(request, location) {
  const sites = request.launch_sites ?? [];
  const site = { id: freeName(sites, 'site'), location: rounded(request, location) };
  return { ...request, launch_sites: [...sites, site] };
}

/** Move a launch site. */
export function moveSite(request, id, location) {
  const position = request.launch_sites.findIndex((site) => site.id === id);
  return setIn(request, ['launch_sites', position, 'location'], rounded(request, location));
}

/** Remove a launch site. */
export function removeSite(request, id) {
  return { ...request, launch_sites: request.launch_sites.filter((site) => site.id !== id) };
}

/** Give customers windows, each `{earliest, latest}`; what the old ones cost stays. */
export function giveWindows(request, ids, windows) {
  const given = new Set(ids);
  const renewed = (customer) => {
    const old = windowsOf(customer);
    const price = old[old.length - 1]?.late_cost_per_hour;
    return withWindows(
      customer,
      windows.map((window, position) => {
        const { late_cost_per_hour: _, ...others } = old[position] ?? {};
        const isLast = position === windows.length - 1;
        return {
          ...others,
          ...(isLast && price !== undefined && { late_cost_per_hour: price }),
          ...window,
        };
      }));
  };
  return {
    ...request,
    customers: request.customers.map((customer) =>
      given.has(customer.id) ? renewed(customer) : customer),
  };
}

/**
 * Return the names of the customers within bounds.
 *
 * @param {any} request
 * @param {Bounds} bounds
 */
export function customersWithin(request, [west, south, east, north]) {
  return request.customers
    .filter(
      ({ location }) =>
        Array.isArray(location) &&
        location[0] >= west &&
        location[0] <= east &&
        location[1] >= south &&
        location[1] <= north)
    .map(({ id }) => id);
}

/** Remove customers, pinned or not. */
export function removeCustomers(request, ids) {
  const gone = new Set(ids);
  const customers = request.customers.filter(({ id }) => !gone.has(id));
  const relations = withoutNamed(request.relations, (name) => gone.has(name));
  const left = { ...request, customers, ...(relations && { relations }) };
  const pinned = request.replan?.pinned?.filter((id) => !gone.has(id));
  if (pinned?.length === request.replan?.pinned?.length) return left;
  return { ...left, replan: { ...request.replan, pinned } };
}

/** Move a customer. */
export function moveCustomer(request, id, location) {
  const position = request.customers.findIndex((customer) => customer.id === id);
  return setIn(request, ['customers', position, 'location'], rounded(request, location));
}

/** Add a no-fly area, or replace the one at a position. */
export function setArea(request, ring, position = request.airspace?.no_fly?.length ?? 0) {
  const corners = ring.map((corner) => rounded(request, corner));
  const rings = request.airspace?.no_fly ?? [];
  const changed = setIn(request, ['airspace', 'no_fly'], setIn(rings, [position], corners));
  return position < rings.length ? changed : proposed(changed);
}

/** Remove the no-fly areas at a point. */
export function eraseAreasAt(request, point) {
  const rings = request.airspace?.no_fly ?? [];
  const kept = rings.filter((ring) => !isInside(ring, point));
  return kept.length === rings.length ? request : setIn(request, ['airspace', 'no_fly'], kept);
}

/** Change how many vehicles of a type there are; a type with none left goes. */
export function addVehicles(request, typeIndex, change) {
  const { count } = request.fleet[typeIndex];
  if (count + change < 1) return removeIn(request, ['fleet', typeIndex]);
  return setIn(request, ['fleet', typeIndex, 'count'], count + change);
}

/** Give the vehicles of a type a drone more; a first one is as assumed, see `assumedDrones`. */
export function addDrone(request, typeIndex) {
  const { drones } = request.fleet[typeIndex];
  const keys = ['fleet', typeIndex, 'drones'];
  const first = Array.isArray(drones) ? drones[0] : drones;
  if (!first) return setIn(request, keys, assumedDrones(request));
  const place = Array.isArray(drones) ? [...keys, 0] : keys;
  return setIn(request, [...place, 'count'], first.count + 1);
}

/** Take the drones of all types away. */
export function withoutDrones(request) {
  return { ...request, fleet: request.fleet.map((type) => ({ ...type, drones: null })) };
}

/** Take all windows away, or make the last of each customer soft at a cost per hour of lateness. */
export function changeWindows(request, lateCostPerHour) {
  return {
    ...request,
    customers: request.customers.map((customer) => {
      if (lateCostPerHour === null) return withWindows(customer, []);
      const windows = windowsOf(customer);
      const soft = windows.slice(-1).map((window) => ({
        ...window,
        late_cost_per_hour: lateCostPerHour,
      }));
      return withWindows(customer, [...windows.slice(0, -1), ...soft]);
    }),
  };
}
