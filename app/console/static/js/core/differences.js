/** What differs between two problems, and between two plans. */

import { indexPlan } from './plan.js';

/** Return `[{path, before, after}]` of two requests; entries with an id are matched by it. */
export function requestDifferences(before, after, path = '') {
  if (before === after) return [];
  if (isObject(before) && isObject(after)) {
    const names = new Set([...Object.keys(before), ...Object.keys(after)]);
    return [...names].flatMap((name) =>
      requestDifferences(before[name], after[name], path ? `${path}.${name}` : name),
    );
  }
  if (hasIds(before) && hasIds(after)) return entryDifferences(before, after, path);
  const same = JSON.stringify(before ?? null) === JSON.stringify(after ?? null);
  return same ? [] : [{ path, before, after }];
}

function isObject(value) {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}

function hasIds(value) {
  return Array.isArray(value) && value.every((entry) => isObject(entry) && 'id' in entry);
}

function entryDifferences(before, after, path) {
  const [old, now] = [before, after].map(
    (entries) => new Map(entries.map((entry) => [entry.id, entry])),
  );
  const ids = new Set([...old.keys(), ...now.keys()]);
  return [...ids].flatMap((id) => {
    const place = `${path}[${id}]`;
    if (!old.has(id)) return [{ path: place, before: undefined, after: 'added' }];
    if (!now.has(id)) return [{ path: place, before: 'there', after: undefined }];
    return requestDifferences(old.get(id), now.get(id), place);
  });
}

const MEASURES = {
  served: 'Customers served',
  vehicles: 'Vehicles',
  trips: 'Trips',
  sorties: 'Flights',
  distance: 'Driven',
  drone_distance: 'Flown',
  makespan: 'Last return',
};

/** Return measures of two plans: `[{key, name, before, now}]`. */
export function planMeasures(before, now) {
  const summaries = Object.entries(MEASURES).map(([key, name]) => ({
    key,
    name,
    before: before.summary[key],
    now: now.summary[key],
  }));
  return [
    ...summaries,
    {
      key: 'load_rate',
      name: 'Mean load rate',
      before: before.summary.load_rate.mean,
      now: now.summary.load_rate.mean,
    },
  ];
}

/** Return customers that another vehicle or drone serves than before: `[{id, before, now}]`. */
export function movedCustomers(former, entry) {
  const [before, now] = [former, entry].map(({ request, plan }) => serversOf(request, plan));
  const ids = new Set([...before.keys(), ...now.keys()]);
  return [...ids]
    .filter((id) => before.get(id) !== now.get(id))
    .map((id) => ({ id, before: before.get(id) ?? null, now: now.get(id) ?? null }));
}

function serversOf(request, plan) {
  const servers = new Map(plan.unassigned.map(({ id }) => [id, 'nobody']));
  for (const halt of indexPlan(request, plan).halts.values()) {
    if (halt.kind === 'customer') {
      servers.set(halt.id, halt.sortie ? halt.sortie.drone : halt.vehicle.name);
    }
  }
  return servers;
}
