/** Orders that come in and are cancelled: priced, put into the plan, taken out of it. */

import { edit, openTab, select, shownPlan } from './actions.js';
import { find } from './addressing.js';
import { askedFor, nowOf, orderOf, placeIn, withoutOrders, withSettled } from './core/orders.js';
import { goOnFrom } from './core/replanning.js';
import { askFit } from './hands.js';
import { askQuote } from './quoting.js';
import { store } from './store.js';
import { t } from './texts.js';

/** Note what is typed of an order. */
export function noteOrder(patch) {
  store.set(({ order }) => ({ order: { ...order, ...patch } }));
}

/**
 * Price an order as it is typed in the plan that is looked at, each vehicle's best place.
 *
 * Returns `{wrong, places, isTold}`: fields that can't be read, where its address may be if that is
 * not sure, and whether prices were told. Without a plan the order is added.
 */
export async function priceOrder(typed) {
  const { request, config } = store.get();
  const entry = shownPlan(store.get());
  let location = placeIn(request, typed.place);
  let address = null;
  const isSought = !location && typed.place.trim() && config.finds_addresses
    && request.coordinate_system === 'geographic';
  if (isSought) {
    const { places } = await find(typed.place.trim());
    if (places.length > 1) return { wrong: ['place'], places };
    location = places[0]?.location ?? null;
    address = typed.place.trim();
  }
  const both = [...(entry?.request.customers ?? []), ...request.customers];
  const customers = [...new Map(both.map((each) => [each.id, each])).values()];
  const { customer, wrong } = orderOf({ ...request, customers }, typed, location);
  if (wrong.length) return { wrong, places: [] };
  const isTold = await price(entry, { ...customer, ...(address && { info: { address } }) });
  return { wrong: [], places: [], isTold };
}

/** Price a new customer, or just add him where there is no plan; return whether that was done. */
async function price(entry, customer) {
  if (!entry) {
    edit((request) => ({ ...request, customers: [...request.customers, customer] }));
    select(`c:${customer.id}`);
    return true;
  }
  if (store.get().live) return askQuote(customer);
  const now = store.get().request.replan?.freeze_before ?? nowOf(entry.request);
  return askFit(customer, askedFor(entry.request, entry.plan, now));
}

/** Cancel orders, but for those that can't be any more, which is told. */
export function cancelOrders(ids) {
  const { request, settled } = withoutOrders(store.get().request, ids);
  edit(request);
  if (settled.length) {
    const names = settled.join(', ');
    store.set({ failure: {
      title: t('orders.notCancelled', { count: settled.length, names }),
      detail: t('orders.settled'),
    } });
  }
  const { selection } = store.get();
  if (ids.some((id) => selection === `c:${id}`) && !settled.includes(selection.slice(2))) {
    select(null);
  }
}

/**
 * Edit the problem so that it goes on from a plan; whoever is served by then is not cancelled,
 * which is told.
 *
 * @param former the problem that the plan was made for
 */
export function goOnWith(change, former) {
  const { request, back } = withSettled(change(store.get().request), former);
  edit(request);
  if (back.length) {
    const detail = t('orders.back', { count: back.length, names: back.join(', ') });
    store.set({ failure: { title: t('orders.backTitle'), detail } });
  }
}

/** Begin to go on from the plan that is looked at, at the minute that the clock shows. */
export function replanFromClock() {
  const { time } = store.get();
  const minute = Math.round(time / 60) * 60;
  store.set({ time: minute });
  replanFrom(minute);
}

/** Begin to go on from the plan that is looked at, at an instant in seconds. */
export function replanFrom(now) {
  const entry = shownPlan(store.get());
  if (!entry) return;
  store.set({ playing: false });
  goOnWith((request) => goOnFrom(request, entry.plan, Math.round(now)), entry.request);
  openTab('replan');
}
