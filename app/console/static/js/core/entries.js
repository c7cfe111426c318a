/**
 * Entries of the list of plans: `{number, name, request, plan, numbers}`.
 *
 * `numbers` tells the colour and number of each vehicle, by name.
 */

import { numbersAfter, withFormerNames } from './matching.js';
import { numbersOf } from './plan.js';

/** Return the numbers of an entry's vehicles by name. */
export function numbersIn({ request, plan, numbers }) {
  return numbers ? new Map(Object.entries(numbers)) : numbersOf(request, plan);
}

/**
 * Return the entry of a plan, its vehicles named and numbered as those of the plan before that had
 * their tours.
 *
 * @param former the entry that was looked at before, null for the first
 * @param made `{number, name, request, plan}`
 */
export function entryAfter(former, made) {
  if (!former) return made;
  const entry = { ...made, plan: withFormerNames(former, made) };
  const numbers = numbersAfter(former, numbersIn(former), entry);
  return { ...entry, numbers: Object.fromEntries(numbers) };
}
