/** Plans on the road: sent to drivers, followed, and planned on from. */

import * as api from './api.js';
import { openTab, showFailure, shownPlan } from './actions.js';
import { dispatchOf, goOnAsTold, openDispatches, withMade } from './core/dispatches.js';
import { setBroken } from './core/replanning.js';
import { goOnWith } from './ordering.js';
import { plan } from './planning.js';
import { store } from './store.js';

const KEPT = 'tandem-dispatch';
const POLL_MS = 5000;

let timer = null;

/** Send the plan that is looked at to its drivers. */
export function sendOut() {
  const entry = shownPlan(store.get());
  return entry && attempt(async () => {
    keep({}, await api.postDispatch(dispatchOf(entry)), entry.plan);
  });
}

/** Tell whether drivers have links that are open. */
export function isOnTheRoad({ dispatch }) {
  return Boolean(dispatch?.reply.links.some(({ state }) => state === 'open'));
}

/** Tell whether another plan is looked at than drivers have, and it keeps all rules. */
export function isToBeSent(state) {
  const entry = shownPlan(state);
  const isOfDay = state.tab === 'drivers'
    || state.plans.some((other) => other.plan === state.dispatch?.plan);
  return isOnTheRoad(state) && !state.live && isOfDay && state.run.state === 'idle'
    && entry !== null && entry.plan !== state.dispatch.plan && !entry.hand?.violations.length;
}

/** Put the plan that is looked at in the place of what drivers have: they keep their links. */
export function sendChange() {
  const { request: problem, plan } = shownPlan(store.get());
  return attempt(async () => {
    const { reply, made } = store.get().dispatch;
    keep(made, await api.changeDispatch(reply.id, { problem, plan }), plan);
  });
}

/** Follow what was sent out before the page was loaded again. */
export async function followKept() {
  const kept = JSON.parse(sessionStorage.getItem(KEPT) ?? 'null');
  if (!kept) return;
  try {
    keep(kept.made, await api.getDispatch(kept.id));
  } catch (error) {
    if (error.status !== 404) throw error;
    sessionStorage.removeItem(KEPT);
  }
}

/** Look for plans that are on the road already, such as those sent out in a tab that was closed. */
export function lookForDispatches() {
  return attempt(async () => {
    store.set({ onTheRoad: openDispatches(await api.getDispatches()) });
  });
}

/** Follow a plan that is on the road; its links are told no more, but others can be made. */
export function followDispatch(id) {
  return attempt(async () => {
    keep({}, await api.getDispatch(id), null);
    store.set({ onTheRoad: null });
  });
}

/** Let a vehicle's link open nothing any more. */
export function revoke(link) {
  return change((id) => api.revokeLink(id, link));
}

/** Make another link for a vehicle in place of one. */
export function renew(link) {
  return change((id) => api.renewLink(id, link));
}

/** End the day: no link opens anything any more. */
export function endDay() {
  return change(api.endDispatch);
}

/** Leave what is on the road alone, so that another plan can be sent out. */
export function leaveDispatch() {
  sessionStorage.removeItem(KEPT);
  store.set({ dispatch: null, untold: null });
}

/**
 * Plan on from what drivers told, at once.
 *
 * @param broken a vehicle that can't go on, of which its driver told nothing; null: none
 * @param answers `{now, served, unserved}`: whom nobody told of; where they lack, they are asked
 */
export function goOnFromDrivers(broken, answers) {
  return attempt(async () => {
    const told = await api.getGoingOn(store.get().dispatch.reply.id, answers);
    const isAsked = !answers && told.doubtful.length > 0;
    store.set({ untold: isAsked ? { ...told, broken } : null });
    if (isAsked) return;
    const former = shownPlan(store.get())?.request;
    goOnWith((request) => {
      const next = goOnAsTold(request, told);
      return broken ? setBroken(next, broken, true) : next;
    }, former);
    openTab('replan');
    await plan();
  });
}

function change(work) {
  return attempt(async () => {
    const { reply, made } = store.get().dispatch;
    keep(made, await work(reply.id));
  });
}

async function attempt(work) {
  try {
    await work();
  } catch (error) {
    showFailure(error);
  }
}

/** Show a dispatch and ask again in a while how far it is. */
function keep(made, reply, plan = store.get().dispatch?.plan ?? null) {
  const all = withMade(made, reply);
  store.set({ dispatch: { reply, made: all, plan } });
  // Tokens are kept as the key is: until the tab is closed.
  sessionStorage.setItem(KEPT, JSON.stringify({ id: reply.id, made: all }));
  clearTimeout(timer);
  const isOpen = store.get().live || reply.links.some(({ state }) => state === 'open');
  if (isOpen) timer = setTimeout(poll, POLL_MS);
}

async function poll() {
  const { dispatch } = store.get();
  if (!dispatch) return;
  try {
    const reply = document.hidden ? dispatch.reply : await api.getDispatch(dispatch.reply.id);
    // What was changed meanwhile is newer, and may have made links that are told once.
    if (store.get().dispatch === dispatch) keep(dispatch.made, reply);
  } catch (error) {
    // An outage passes; what can't be mended is told.
    if (error.status === 0 || error.status >= 500) timer = setTimeout(poll, POLL_MS);
    else showFailure(error);
  }
}
