/** What a plan's cost is made of. */

import { labelOf } from './schema.js';
import { t } from '../texts.js';

/** The least amount of money that is shown. */
const LEAST = 0.005;

/** Return `[term, name]` of all terms that count in some of the costs. */
export function costTerms(...costs) {
  const terms = new Set(costs.flatMap(Object.keys));
  return [...terms]
    .filter((term) => term !== 'total' && costs.some((cost) => cost[term]))
    .map((term) => [term, nameOf(term)]);
}

/** Return a term's name for people; one that has none is called as the service calls it. */
function nameOf(term) {
  return t(`term.${term}`, { defaultValue: labelOf(term) });
}

/** Tell whether a problem states what leaving anybody out costs. */
export function statesPenalty({ unassigned_cost: price }) {
  return price !== null && price !== undefined;
}

/** Return what of a plan's cost is a penalty for customers left out that nobody stated. */
export function penaltyOf({ request, plan }) {
  if (!plan.cost.unassigned || statesPenalty(request)) return 0;
  const prices = new Map(request.customers.map(({ id, unassigned_cost: price }) => [id, price]));
  const stated = plan.unassigned.reduce((sum, { id }) => sum + (prices.get(id) ?? 0), 0);
  const penalty = plan.cost.unassigned - stated;
  return penalty < LEAST ? 0 : penalty;
}

/**
 * Return the class of a change of what is paid; to serve fewer for less is no saving.
 *
 * @param {number} change
 * @param {boolean} isForFewer
 */
export function judged(change, isForFewer) {
  if (Math.abs(change) < LEAST || (change < 0 && isForFewer)) return '';
  return change > 0 ? 'delta-bad' : 'delta-good';
}

/** Tell whether a plan serves fewer than another. */
export function servesFewer({ plan }, { plan: former }) {
  return plan.summary.served < former.summary.served;
}

/** Return what a plan costs, without penalties that nobody stated. */
export function trueCost(entry) {
  return entry.plan.cost.total - penaltyOf(entry);
}

/** Return a plan's cost by term, as `CostReply`, without penalties that nobody stated. */
export function trueTerms(entry) {
  const { cost } = entry.plan;
  const penalty = penaltyOf(entry);
  const unassigned = penalty ? Math.max(cost.unassigned - penalty, 0) : cost.unassigned;
  return { ...cost, unassigned, total: trueCost(entry) };
}
