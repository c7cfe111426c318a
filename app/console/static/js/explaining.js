/** Asks the service why customers are served where they are; what it told is kept by plan. */

import { postExplain } from './api.js';
import { showFailure } from './actions.js';
import { store } from './store.js';

const CUSTOMER_SECONDS = 1;
const DRONES_SECONDS = 3;

/** Ask about a customer of an entry of `plans`, or about a `shipmentOf` it, the whole of it. */
export const askWhy = (entry, customer, whole = undefined) =>
  ask(entry, whole?.names[0] ?? customer, {
    ...(whole ? { shipment: whole.id } : { customer }),
    options: { time_limit: CUSTOMER_SECONDS },
  });

/**
 * Ask what the drones of an entry of `plans` save.
 *
 * @param isQuiet that nobody asked: a failure is told to nobody
 */
export const askDrones = (entry, isQuiet = false) =>
  ask(entry, null, { drones: true, options: { time_limit: DRONES_SECONDS } }, isQuiet);

/** Stands for the question why drones fly nothing. */
export const IDLE = Symbol('idle drones');

/** Ask why drones fly nothing in an entry of `plans`. */
export const askIdle = (entry, isQuiet = false) =>
  ask(entry, IDLE, { idle_drones: true, options: { time_limit: CUSTOMER_SECONDS } }, isQuiet);

/**
 * Return what was told of a customer, or of drones for null: `{state, told}`, or undefined.
 *
 * `state` is `asking`, `told` or `failed`.
 */
export function toldOf(why, entry, customer) {
  return entry && why.plan === entry.plan ? why.answers.get(customer) : undefined;
}

async function ask(entry, name, question, isQuiet = false) {
  note(entry, name, { state: 'asking' });
  try {
    const told = await postExplain({ problem: entry.request, plan: entry.plan, ...question });
    note(entry, name, { state: 'told', told });
  } catch (error) {
    note(entry, name, isQuiet ? { state: 'failed' } : undefined);
    if (!isQuiet) showFailure(error);
  }
}

/** Keep an answer; those about other plans are dropped, and come too late if they come. */
function note(entry, name, answer) {
  store.set(({ why }) => {
    if (why.plan !== entry.plan && answer?.state !== 'asking') return {};
    const answers = new Map(why.plan === entry.plan ? why.answers : []);
    answers.set(name, answer);
    return { why: { plan: entry.plan, answers } };
  });
}
