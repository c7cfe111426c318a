/** What differs between two problems, and between two plans. */

import { money } from './format.js';
import { matchVehicles } from './matching.js';
import { indexPlan } from './plan.js';
import { trueCost } from './terms.js';
import { isVisit, leftOutOf, visitName } from './visits.js';
import { t } from '../texts.js';
import { nameOfVehicle } from './vehicle-labels.js';

/** Return `[{path, before, after}]` of two requests; entries with an id are matched by it. */
export function requestDifferences(before, after, path = '') {
  if (before === after) return [];
  if (isObject(before) && isObject(after)) {
    const names = new Set([...Object.keys(before), ...Object.keys(after)]);
    return [...names].flatMap((name) =>
      requestDifferences(before[name], after[name], path ? `${path}.${name}` : name));
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
    (entries) => new Map(entries.map((entry) => [entry.id, entry])));
  const ids = new Set([...old.keys(), ...now.keys()]);
  return [...ids].flatMap((id) => {
    const place = `${path}[${id}]`;
    if (!old.has(id)) return [{ path: place, before: undefined, after: t('change.added') }];
    if (!now.has(id)) return [{ path: place, before: t('change.there'), after: undefined }];
    return requestDifferences(old.get(id), now.get(id), place);
  });
}

const MEASURES = [
  'served', 'vehicles', 'trips', 'sorties', 'distance', 'drone_distance', 'makespan'];

/** Return measures of two plans: `[{key, name, before, now}]`. */
export function planMeasures(before, now) {
  const summaries = MEASURES.map((key) => ({
    key, name: t(`measure.${key}`), before: before.summary[key], now: now.summary[key],
  }));
  return [
    ...summaries,
    {
      key: 'load_rate', name: t('measure.load_rate'), before: before.summary.load_rate.mean,
      now: now.summary.load_rate.mean,
    }];
}

/** Return what a plan costs and serves beside the former, in a sentence. */
export function planDifference(former, entry) {
  const change = trueCost(entry) - trueCost(former);
  const served = entry.plan.summary.served - former.plan.summary.served;
  const size = money(Math.abs(change));
  const costs =
    size === money(0)
      ? t('difference.same')
      : t(`difference.${change < 0 ? 'less' : 'more'}`, { size });
  if (!served) return t('difference.costs', { costs });
  const so = { count: Math.abs(served), costs };
  return served < 0 ? t('difference.fewer', so) : t('difference.further', so);
}

/**
 * Return customers that another vehicle or drone serves than before: `[{id, before, now}]`.
 *
 * Vehicles are the same that `pairs` of `matchVehicles` name, and drones of one type on them.
 */
export function movedCustomers(former, entry, pairs = matchVehicles(former, entry)) {
  const names = new Map(pairs.map(({ before, now }) => [before, now]));
  const [before, now] = [former, entry].map(({ request, plan }) => serversOf(request, plan));
  const stayed = (then, after) =>
    then && after && then.drone === after.drone &&
    (then.vehicle ? names.get(then.vehicle) === after.vehicle : !after.vehicle);
  return [...new Set([...before.keys(), ...now.keys()])]
    .filter((id) => !stayed(before.get(id), now.get(id)))
    .map((id) => ({ id, before: before.get(id)?.shown ?? null, now: now.get(id)?.shown ?? null }));
}

/** Return who serves each customer: `{vehicle, drone, shown}`, no vehicle for nobody. */
function serversOf(request, plan) {
  const nobody = { vehicle: null, drone: null, shown: t('difference.nobody') };
  const servers = new Map(leftOutOf(plan).map(({ id }) => [id, nobody]));
  for (const halt of indexPlan(request, plan).halts.values()) {
    if (!isVisit(halt)) continue;
    const { sortie, vehicle } = halt;
    servers.set(visitName(halt), {
      vehicle: vehicle.name,
      drone: sortie ? (sortie.reply.drone_type ?? 'drone') : null,
      shown: nameOfVehicle(sortie ? sortie.drone : vehicle.name),
    });
  }
  return servers;
}

/** Return the tours that go on under another vehicle's name, the longest first. */
export function renamedTours(pairs) {
  return pairs
    .filter(({ before, now, shared }) => before !== now && shared > 0)
    .sort((first, second) => second.shared - first.shared);
}
