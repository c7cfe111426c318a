/** What a plan's cost is made of. */

import { labelOf } from './schema.js';

/** Names of terms for people; a term without one is called as the service calls it. */
const NAMES = {
  fixed: 'Vehicles used',
  stops: 'Customers of trucks',
  time: 'Working time',
  earliness: 'Waiting for windows',
  unassigned: 'Left out',
};

/** Return `[term, name]` of all terms that count in some of the costs. */
export function costTerms(...costs) {
  const terms = new Set(costs.flatMap(Object.keys));
  return [...terms]
    .filter((term) => term !== 'total' && costs.some((cost) => cost[term]))
    .map((term) => [term, NAMES[term] ?? labelOf(term)]);
}
