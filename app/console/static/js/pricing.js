/** Prices of remedies before they are applied: what a short search from the plan on comes to. */

import { postPlan } from './api.js';
import { shownPlan } from './actions.js';
import { shortSeconds } from './core/limits.js';
import { furtherFrom } from './core/replanning.js';
import { trueCost } from './core/terms.js';
import { store } from './store.js';

/** Groups that are priced without being asked to, and customers up to which they are. */
const MOST_GROUPS = 3;
const MOST_CUSTOMERS = 2000;

/** Return the price of a group's remedy in an entry of `plans`, or undefined; see `priceGroup`. */
export function priceOf(prices, entry, group) {
  return prices.plan === entry.plan ? prices.found.get(group.key) : undefined;
}

/** Price the largest groups of an entry of `plans`, one after another, while it is looked at. */
export async function priceLargest(entry, groups) {
  if (entry.request.customers.length > MOST_CUSTOMERS) return;
  const ways = groups.flatMap((group) => [group, ...group.others]);
  for (const group of ways.filter(({ changed }) => changed).slice(0, MOST_GROUPS)) {
    const { prices, run, tab } = store.get();
    const isWanted = shownPlan(store.get()) === entry && tab === 'unassigned';
    if (!isWanted || run.state !== 'idle') return;
    if (!priceOf(prices, entry, group)) await priceGroup(entry, group);
  }
}

/**
 * Plan a moment on with a group's remedy and keep what came of it: `{state, served, cost}`.
 *
 * `served` counts who is served more, `cost` is what that costs more, penalties that nobody stated
 * left out.
 */
export async function priceGroup(entry, group) {
  note(entry, group, { state: 'asking' });
  const { search_iterations: unused, ...options } = entry.request.options ?? {};
  const seconds = shortSeconds(entry.request);
  const request = { ...group.changed, options: { ...options, time_limit: seconds } };
  try {
    const plan = await postPlan(furtherFrom(request, entry));
    note(entry, group, {
      state: 'told',
      served: plan.summary.served - entry.plan.summary.served,
      cost: trueCost({ request, plan }) - trueCost(entry),
    });
  } catch (error) {
    note(entry, group, { state: 'failed', reason: error.message });
  }
}

/** Keep a price; those in other plans are dropped, and come too late if they come. */
function note(entry, { key }, price) {
  store.set(({ prices }) => {
    if (prices.plan !== entry.plan && price.state !== 'asking') return {};
    const found = new Map(prices.plan === entry.plan ? prices.found : []);
    found.set(key, price);
    return { prices: { plan: entry.plan, found } };
  });
}
