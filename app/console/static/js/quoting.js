/** Orders that aren't accepted yet: priced slot by slot in a day as it goes on, and accepted. */

import { indexOf, select, showFailure, shownPlan } from './actions.js';
import * as api from './api.js';
import { slotsFor } from './core/living.js';
import { spanOf } from './core/plan.js';
import { store } from './store.js';

/** Ask in which slots a new customer may come, and what each costs. */
export async function askQuote(order) {
  const { live, request } = store.get();
  const index = indexOf(shownPlan(store.get()));
  const slots = slotsFor(request, order, live.day.now, index ? spanOf(index)[1] : 0);
  const { time_window: _, ...customer } = order;
  const quote = await api.postToDay(live.id, 'quote', { order: customer, slots });
  store.set((state) => ({ live: { ...state.live, quote: { ...quote, customer } } }));
  return true;
}

/** Accept a slot of a quote by its place, or let the quote lapse. */
export async function answerQuote(slot) {
  const { live } = store.get();
  store.set({ live: { ...live, quote: null } });
  if (slot === null) return;
  try {
    await api.postToDay(live.id, `quotes/${live.quote.token}/accept`, { slot });
    select(`c:${live.quote.customer.id}`);
  } catch (error) {
    showFailure(error);
  }
}
