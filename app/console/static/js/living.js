/** The day as it happens: begun, followed as the service tells it, and told what the desk knows. */

import { indexOf, openRequest, shownPlan, showFailure } from './actions.js';
import * as api from './api.js';
import { dayOf } from './core/dispatches.js';
import { changesOf, locksOf, newsOf, pinsOf, untoldOf, withUntold } from './core/living.js';
import { numbersOf } from './core/plan.js';
import { inSeconds } from './core/times.js';
import { followDispatch } from './dispatching.js';
import { setLocked } from './hands.js';
import { latestOf } from './planning.js';
import { store } from './store.js';
import { t } from './texts.js';

const NUMBER = 1; // of the day's plan among plans
const LOOK_MS = 5000;
const STEP = 60; // seconds after which more of a plan has happened
const QUARTER = 900; // seconds
const FRESH_MS = 300_000; // for which a screen on the wall shows what changed

let following = new AbortController();

/** Return the day that the address opens, `#day=monday`, and whether it is for a wall. */
export function dayInAddress() {
  const asked = new URLSearchParams(location.hash.slice(1));
  return asked.get('day') && { id: asked.get('day'), isWall: asked.has('wall') };
}

/**
 * Begin a day with the problem that is open, and the plan that is looked at.
 *
 * @param isRehearsed whether it goes by the times that it is told, from before the first departure
 */
export function beginDay(isRehearsed) {
  return attempt(async () => {
    const entry = shownPlan(store.get());
    const { request } = store.get();
    const options = { ...request.options, times: 'seconds', geometry: true };
    const replan = entry && { plan: entry.plan, freeze_before: 0 };
    const problem = { ...request, ...dayOf(request), options, replan };
    const first = Math.min(...entry?.plan.routes.map(({ trips }) => trips[0].stops[0].departure)
      ?? [0]);
    const clock = Math.max(0, QUARTER * Math.floor(first / QUARTER - 1));
    const begun = await api.postDay({ problem, ...(isRehearsed && { clock }) });
    await openDay(begun.id, false, store.get().name);
  });
}

/** Open a day and follow it until something else is opened. */
export async function openDay(id, isWall = false, name = null) {
  following.abort();
  following = new AbortController();
  const { signal } = following;
  const day = await api.getDay(id);
  const live = { id: day.id, isWall, day, base: null, since: null, changedAt: 0,
    changes: new Map(), news: new Map(), told: [], quote: null };
  const problem = await api.getDay(id, '/problem');
  const dated = `${t('room.day')} ${problem.plan_start?.slice(0, 10) ?? ''}`.trim();
  const opened = { name: name || dated, isSafe: true, live, tab: 'drivers' };
  openRequest(problem, opened);
  history.replaceState(null, '', `#day=${encodeURIComponent(day.id)}${isWall ? '&wall' : ''}`);
  await refresh();
  followDispatch(day.dispatch);
  const timer = setInterval(() => {
    if (isFollowed(live.id)) refresh();
    else leave();
  }, LOOK_MS);
  signal.addEventListener('abort', () => clearInterval(timer));
  api.followDay(day.id, hear, signal).catch(showFailure);
}

/** Follow a day no more, and don't open it again by the address. */
function leave() {
  following.abort();
  if (!store.get().live) history.replaceState(null, '', location.pathname + location.search);
}

function isFollowed(id) {
  return store.get().live?.id === id && !following.signal.aborted;
}

/** Note what people told; whatever it was, the day stands otherwise now. */
function hear(event) {
  const { live } = store.get();
  if (live && KNOWN.has(event.kind)) store.set({ live: { ...live, told: [...live.told, event] } });
  if (live) refresh();
}

/** Kinds of events that are listed as they come. */
const KNOWN = new Set(['vehicle.failed', 'vehicle.broken', 'plan.seen', 'drone.lost']);

/** Look how the day stands, and take its plan if that is another. */
const refresh = latestOf(async () => {
  const { live } = store.get();
  if (!live) return;
  const day = await api.getDay(live.id);
  const isOther = !live.base || day.revision !== live.day.revision;
  const [problem, made] = isOther && day.plan_number ? await Promise.all([
    api.getDay(live.id, '/problem'), api.getDay(live.id, '/plan?times=seconds')]) : [];
  if (isFollowed(live.id)) store.set((state) => shownAs(state, day, problem, made?.plan));
});

/** Return what changes of the state where a day stands otherwise. */
function shownAs(state, day, problem, plan) {
  const { live, schemas, request, plans, time } = state;
  const former = plans.find(({ number }) => number === NUMBER);
  const base = problem ? inSeconds(schemas, problem) : live.base;
  const untold = live.base ? untoldOf(live.base, request) : [];
  const patch = { time: time === null || time === live.day.now ? day.now : time,
    locks: day.orders.filter(({ pinned }) => pinned?.vehicle).map(({ id }) => id) };
  const entry = { ...former, request: base, replan: { freeze_before: day.now } };
  const isStale = live.isWall && live.changes.size && Date.now() - live.changedAt > FRESH_MS;
  if (!plan && !isStale && day.now - former?.replan.freeze_before < STEP) {
    return { ...patch, live: { ...live, day } };
  }
  if (plan) {
    // Vehicles keep their numbers, and so their colours.
    const numbers = numbersOf({ ...base, replan: former && { plan: former.plan } }, plan);
    Object.assign(entry, { number: NUMBER, name: t('live.plan'), plan,
      numbers: Object.fromEntries(numbers) });
    Object.assign(patch, { shown: state.shown ?? NUMBER, request: withUntold(base, untold),
      past: untold.length ? [base] : [], ahead: [] });
  }
  if (!entry.plan) return { ...patch, live: { ...live, day, base } };
  const since = (!isStale && live.since) || (former ?? entry);
  const index = indexOf(entry);
  const changes = plan || isStale ? changesOf(indexOf(since), index) : live.changes;
  const news = newsOf(day, index, changes);
  return {
    ...patch,
    plans: [entry, ...plans.filter(({ number }) => number !== NUMBER)],
    live: { ...live, day, base, since, changes, news: isSame(news, live.news) ? live.news : news,
      changedAt: plan ? Date.now() : live.changedAt },
  };
}

function isSame(one, other) {
  return JSON.stringify([...one]) === JSON.stringify([...other]);
}

/** Say that what changed was seen: from now on, what changes next is shown. */
export function seeChanges() {
  store.set(({ live, plans }) => {
    const since = plans.find(({ number }) => number === NUMBER);
    const news = newsOf(live.day, indexOf(since), new Map());
    return { live: { ...live, since, changes: new Map(), news } };
  });
}

/** Tell the day what happened, each at its `at` or now; tell whether that was taken. */
export function tell(...events) {
  const { id, day } = store.get().live;
  return attempt(async () => {
    await api.postToDay(id, 'events', events.map((event) => ({
      event_id: crypto.randomUUID(), at: day.now, ...event })));
    refresh();
  });
}

/** Return what was changed here and isn't told yet: orders, and where they were put by hand. */
export function untoldIn(state) {
  const { live, request } = state;
  const entry = shownPlan(state);
  return live?.base ? [...untoldOf(live.base, request),
    ...(entry?.hand ? pinsOf(indexOf(entry), entry.hand.moved) : [])] : [];
}

/** Tell what was changed here; the day's plan is then the one that is looked at. */
export async function tellEdits() {
  if (!await tell(...untoldIn(store.get()))) return;
  store.set(({ plans }) => ({ plans: plans.filter(({ number }) => number === NUMBER),
    shown: NUMBER, besides: null, steps: [], undone: [] }));
}

/** Keep customers with their vehicles, or let go of them. */
export function lock(ids, isLocked) {
  const { live, plans } = store.get();
  if (!live) setLocked(ids, isLocked);
  else tell(...locksOf(indexOf(plans.find(({ number }) => number === NUMBER)), ids, isLocked));
}

/** Do something and tell whether that went well; what went wrong is shown. */
async function attempt(work) {
  try {
    await work();
    return true;
  } catch (error) {
    showFailure(error);
    return false;
  }
}
