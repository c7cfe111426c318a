/** Hands on the plan: customers are put elsewhere, locked, and given their best places. */

import * as api from './api.js';
import { showFailure, shownPlan, undo } from './actions.js';
import { addCustomer } from './core/changes.js';
import { numbersIn } from './core/entries.js';
import { judgedPlan, withCustomerAt, withRoute } from './core/moving.js';
import { takesAnotherTrip, withAnotherTrip } from './core/orders.js';
import { unlike } from './core/naming.js';
import { penaltyOf, trueCost } from './core/terms.js';
import { shipmentOf, visitNamesOf } from './core/visits.js';
import { nameOfVehicle } from './core/vehicle-labels.js';
import { stop } from './planning.js';
import { store } from './store.js';
import { t } from './texts.js';

const MOST_STEPS = 100;
const PLACES = 3;
const FIT_SECONDS = 1;

let work = Promise.resolve();

/**
 * Put a customer of the plan that is looked at elsewhere, and have that judged.
 *
 * @param place see `withCustomerAt`; null leaves the customer out
 * @param words what is done, such as `B to truck-2`
 */
export const moveCustomerTo = (id, place, words) =>
  change((entry) => ({
    request: entry.request,
    decided: withCustomerAt(entry.request, entry.plan, id, place),
    moved: [id],
    words,
  }));

/** Put a customer where the service found a place in the plan that is looked at, see `askFit`. */
export const takeFit = (fit, place) =>
  change((entry) => {
    if (entry.plan !== fit.entry.plan) return null;
    const { id } = fit.customer;
    const isNew = !fit.whole
      && entry.request.customers.every((customer) => customer.id !== id);
    const base = isFurther(fit, place)
      ? withAnotherTrip(fit.base, entry.plan, place)
      : fit.base;
    const request = isNew ? { ...base, customers: [...base.customers, fit.customer] } : base;
    const along = place.companions ?? [];
    const names = [...fit.whole?.names ?? [id], ...visitNamesOf(request, along)];
    return {
      request,
      added: isNew ? fit.customer : null,
      decided: withRoute(entry.plan, names, place.route),
      moved: names,
      words: t('hand.to', { id: [id, ...along].join(', '), vehicle: nameOfVehicle(place.vehicle) }),
    };
  });

/** Change the plan that is looked at once all earlier changes are judged. */
function change(decide) {
  work = work.then(async () => {
    if (store.get().run.state !== 'idle') await stop();
    const entry = shownPlan(store.get());
    const changed = entry && decide(entry);
    if (changed) await judge(entry, changed);
  }).catch(showFailure);
  return work;
}

async function judge(entry, { request, decided, moved, added = null, words }) {
  store.set({ judging: words });
  try {
    const verdict = await api.postCheck({ problem: api.withWays(request), plan: decided });
    store.set((state) => applied(state, entry, {
      request, added, moved, words, verdict, plan: judgedPlan(entry.plan, decided, verdict),
    }));
  } finally {
    store.set({ judging: null });
  }
}

/** Return what changes once a change is judged; nothing if the plan is no longer there. */
function applied(state, entry, { request, added, moved, words, verdict, plan }) {
  if (state.plans.every((other) => other.plan !== entry.plan)) return {};
  const { hand } = entry;
  const after = {
    ...entry,
    number: hand ? entry.number : state.plans[state.plans.length - 1].number + 1,
    name: hand ? entry.name : unlike(t('hand.byHand', { name: entry.name }), state.plans),
    request,
    plan,
    numbers: numbersWith(entry, plan),
    hand: {
      from: hand?.from ?? entry.number,
      fromName: hand?.fromName ?? entry.name,
      before: hand?.before ?? trueCost(entry),
      change: trueCost({ request, plan }) - trueCost(entry),
      penalty: penaltyOf({ request, plan }) - penaltyOf(entry),
      violations: verdict.violations,
      moved: [...(hand?.moved ?? []), ...moved],
      words,
    },
  };
  const now = state.live && !added ? state.request
    : requestWith(state.request, entry.request, request, added);
  const step = {
    before: { entry: hand ? entry : null, shown: state.shown, besides: state.besides,
      request: state.request },
    after: { entry: after, shown: after.number, besides: after.hand.from, request: now },
  };
  return {
    ...swapped(state, step, 'after'),
    fit: null,
    steps: [...state.steps.slice(-MOST_STEPS), step],
    undone: [],
    ...(now !== state.request && { ahead: [] }),
  };
}

/** Return the numbers of vehicles by name: each keeps its own, new ones get the next. */
function numbersWith(entry, plan) {
  const numbers = new Map(numbersIn(entry));
  let next = Math.max(-1, ...numbers.values()) + 1;
  for (const { vehicle } of plan.routes) {
    if (!numbers.has(vehicle)) {
      numbers.set(vehicle, next);
      next += 1;
    }
  }
  return Object.fromEntries(numbers);
}

/** Return the problem as it is edited, with a customer who came by hand. */
function requestWith(edited, planned, request, added) {
  if (!added || edited === planned) return request;
  if (edited.customers.some(({ id }) => id === added.id)) return edited;
  const fleet = edited.fleet === planned.fleet ? request.fleet : edited.fleet;
  return { ...edited, fleet, customers: [...edited.customers, added] };
}

/** Return the state with one side of a step. */
function swapped({ plans, live, request: told }, step, side) {
  const { entry, shown, besides } = step[side];
  // What a day was told meanwhile stays.
  const isAsTold = live && step.before.request === step.after.request;
  const request = isAsTold ? told : step[side].request;
  const { number } = step.after.entry;
  const others = plans.filter((other) => other.number !== number);
  return { plans: entry ? [...others, entry] : others, shown, besides, request };
}

/** Tell whether a side of a step is how things stand. */
function stands(state, step, side) {
  if (!step) return false;
  const { entry, shown, request } = step[side];
  const plan = (entry ?? shownPlan(state))?.plan;
  return (state.live || state.request === request) && state.shown === shown
    && shownPlan(state)?.plan === plan;
}

/** Return the last change by hand that may be taken back. */
export function stepBack(state) {
  const step = state.steps[state.steps.length - 1];
  return stands(state, step, 'after') ? step : null;
}

/** Return the change by hand that may be made again. */
export function stepForth(state) {
  const step = state.undone[state.undone.length - 1];
  return stands(state, step, 'before') ? step : null;
}

/** Take the last change by hand back; tell whether there was one. */
export function undoStep() {
  const step = stepBack(store.get());
  if (step) {
    store.set((state) => ({
      ...swapped(state, step, 'before'), steps: state.steps.slice(0, -1),
      undone: [...state.undone, step],
    }));
  }
  return step !== null;
}

/** Tell whether there is something to undo. */
export const isUndoable = (state) => state.past.length > 0 || stepBack(state) !== null;

/** Undo the last change by hand, or of the problem. */
export const undoLast = () => undoStep() || undo();

/** Make a change by hand again; tell whether there was one. */
export function redoStep() {
  const step = stepForth(store.get());
  if (step) {
    store.set((state) => ({
      ...swapped(state, step, 'after'), steps: [...state.steps, step],
      undone: state.undone.slice(0, -1),
    }));
  }
  return step !== null;
}

/** Tell whether a place that was found takes a trip more than the problem allows. */
export function isFurther(fit, place) {
  return takesAnotherTrip(fit.base, fit.entry.plan, place);
}

/**
 * Ask for the best places of a customer, `{id}`, or of one whom the problem doesn't have yet.
 *
 * @param order `{base, asked}` if it is an order that comes in: see `askedFor`; then the best place
 * of each vehicle is told
 *
 * Returns whether they were told.
 */
export async function askFit(customer, order = null) {
  const entry = shownPlan(store.get());
  if (!entry) return false;
  const known = entry.request.customers.some(({ id }) => id === customer.id);
  const whole = known ? undefined : shipmentOf(entry.request, customer.id);
  const { base, asked } = order ?? { base: entry.request, asked: entry.request };
  const fit = {
    customer: whole ? { id: whole.id } : customer, whole, entry, base, isOrder: order !== null,
    told: null,
  };
  store.set({ fit });
  try {
    const told = await api.postFit({
      problem: api.withWays(asked), plan: entry.plan, ...subjectOf(customer, known, whole),
      count: PLACES, one_per_vehicle: fit.isOrder, options: { time_limit: FIT_SECONDS },
    });
    store.set((state) => (state.fit === fit ? { fit: { ...fit, told } } : {}));
    return true;
  } catch (error) {
    store.set((state) => (state.fit === fit ? { fit: null } : {}));
    showFailure(error);
    return false;
  }
}

function subjectOf(customer, known, whole) {
  if (whole) return { shipment: whole.id };
  return known ? { customer: customer.id } : { new_customer: customer };
}

/** Ask for the best places of a new customer at a point of the map. */
export function askFitAt(point) {
  const { request, brush } = store.get();
  const { customers } = addCustomer(request, point, brush);
  return askFit(customers[customers.length - 1]);
}

/** Lock customers to their vehicles, or let go of them. */
export function setLocked(ids, isLocked) {
  store.set(({ locks }) => {
    const others = locks.filter((id) => !ids.includes(id));
    return { locks: isLocked ? [...others, ...ids] : others };
  });
}
