/** How the day's steps stand: by what the service knows, and what it wasn't told yet. */

import { PROOF } from './queue.js';
import { REASONS } from './reasons.js';
import { language, t } from './texts.js';

/** In place of a step: what is new, and what was taken away, was seen. */
export const CHANGES = 'changes';

/** Return what holds of steps, by id: `{state, reason, isSent}`. */
export function standings(standing, waiting) {
  const found = new Map(
    standing.map(({ id, state, reason }) => [id, { state, reason, isSent: true }]),
  );
  for (const { step, kind, reason } of waiting.filter((event) => event.kind !== PROOF)) {
    found.set(step, { state: kind === 'undone' ? 'open' : kind, reason, isSent: false });
  }
  return found;
}

/** Of whom the driver tells that the vehicle has broken down, in place of a step. */
export const VEHICLE = 'vehicle';

/** Tell whether the vehicle has broken down. */
export function isBroken(found) {
  return found.get(VEHICLE)?.state === 'failed';
}

/** Return what is new since the driver looked, and what was taken away: `{added, gone}`, steps. */
export function newsOf({ seen = [], steps }) {
  const places = (list) => new Set(list.filter(isServing).map(nameOf));
  const [was, now] = [places(seen), places(steps)];
  return {
    added: steps.filter((step) => isServing(step) && !was.has(nameOf(step))),
    gone: seen.filter((step) => isServing(step) && !now.has(nameOf(step))),
  };
}

const isServing = ({ kind }) => kind === 'stop' || kind === 'launch';

const nameOf = ({ kind, place, customers }) =>
  (kind === 'stop' ? place : customers.map(({ id }) => id).join());

/** Tell whether other steps are to be done, or in another order. */
export function isOther(before, now) {
  const ids = (steps) => steps.map(({ id }) => id).join();
  return ids(before) !== ids(now);
}

/** Return the first step of which nothing holds, or null. */
export function nextStep(steps, found) {
  return steps.find(({ id }) => (found.get(id)?.state ?? 'open') === 'open') ?? null;
}

/** Return how many steps are over. */
export function countOver(steps, found) {
  return steps.filter(({ id }) => (found.get(id)?.state ?? 'open') !== 'open').length;
}

/** Whether a step can fail. */
export function mayFail({ kind }) {
  return kind in REASONS;
}

/** Return what a step is called. */
export function titleOf({ kind, place, place_kind: placeKind, drone, customers }) {
  if (kind === 'stop') return place;
  const flown = drone ? drone.slice(drone.lastIndexOf('/') + 1) : '';
  const names = customers.map(({ id }) => id).join(', ');
  const title = t(`title.${kind}`, { place, drone: flown, names });
  // The driver goes there for that alone.
  return placeKind === 'launch_site' ? t('title.there', { title, place }) : title;
}

/** Return amounts such as `12 / 3.5`, or `12 kg / 3.5 l` where units are known. */
export function amounts(values, units = []) {
  const options = { maximumFractionDigits: 3 };
  return values
    .map((value, at) => [value.toLocaleString(language(), options), units[at]])
    .map((amount) => amount.filter(Boolean).join('\u00a0'))
    .join(' / ');
}

/** Return whether something is handed over or taken in at all. */
export function isSome(values) {
  return Boolean(values?.some((value) => value > 0));
}

/** Return a number to call without what people put between digits. */
export function telephone(text) {
  return `tel:${text.replace(/\(0\)/g, '').replace(/[^+\d*#]/g, '')}`;
}
