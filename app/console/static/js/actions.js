/** What the user can do to the problem and to what is shown. */

import { numbersIn } from './core/entries.js';
import { NOTHING_TYPED } from './core/orders.js';
import { getIn, parsePath } from './core/paths.js';
import { indexPlan } from './core/plan.js';
import { settledParts } from './core/replanning.js';
import { roomOf } from './core/rooms.js';
import { titleOf } from './core/said.js';
import { inSeconds } from './core/times.js';
import { layOut } from './frame.js';
import { store } from './store.js';
import { t } from './texts.js';

const MOST_UNDOS = 100;

/** Replace the problem by a changed one; the former can be brought back. */
export function edit(change) {
  store.set((state) => {
    const request = typeof change === 'function' ? change(state.request) : change;
    if (request === state.request) return {};
    return {
      ...editedTo(state, request),
      errors: state.errors.filter(({ keys }) => isUntouched(state.request, request, keys)),
    };
  });
}

/** Tell whether what an error is about is as it was, and still at the same place. */
function isUntouched(before, after, keys) {
  const count = (request) => getIn(request, keys.slice(0, 1))?.length;
  return count(before) === count(after) && getIn(before, keys) === getIn(after, keys);
}

/** Return what changes of the state where its problem becomes another, so that it is undone. */
export function editedTo({ request: former, past }, request) {
  return { request, past: [...past.slice(-MOST_UNDOS), former], ahead: [], undone: [] };
}

/** Bring back the problem as it was before the last edit since it was opened. */
export function undo() {
  store.set((state) => {
    const { request, past, ahead } = state;
    if (!past.length) return {};
    const before = {
      request: past[past.length - 1], past: past.slice(0, -1), ahead: [...ahead, request],
    };
    return { ...before, errors: [], ...formerPlan(state, before) };
  });
}

/** Return the plan to look at: the last of the problem as it is, or as it was where a day ended. */
function formerPlan(state, { request, past, ahead }) {
  const entry = shownPlan(state);
  if (!entry || entry.request === request) return {};
  const isOver = entry.request.replan && ahead.includes(entry.request);
  const lasting = new Set(isOver ? [...past, request] : [request]);
  const former = state.plans.filter((other) => lasting.has(other.request)).pop();
  if (!former) return {};
  return { shown: former.number, ...(state.besides === former.number && { besides: null }) };
}

/** Make the edit again that was undone last. */
export function redo() {
  store.set((state) => {
    const { request, past, ahead } = state;
    if (!ahead.length) return {};
    const next = {
      request: ahead[ahead.length - 1], past: [...past, request], ahead: ahead.slice(0, -1),
    };
    return { ...next, errors: [], ...formerPlan(state, next) };
  });
}

/**
 * Begin anew with a problem; what is still planned for another is no longer wanted.
 *
 * Nothing is undone across it: what was open would stand under this one's name.
 *
 * @param stated the problem, its times as anybody may write them
 * @param name what the problem is called
 * @param isSafe whether it can be had again where it came from
 * @param others what else of the state comes with it, such as its plans
 */
export function openRequest(
  stated,
  { name = t('header.untitled'), isSafe = false, ...others } = {},
) {
  const request = inSeconds(store.get().schemas, stated);
  store.set((state) => ({
    request,
    stated,
    name,
    note: '',
    home: null,
    saved: isSafe ? { request, plan: null } : null,
    viewing: null,
    epoch: state.epoch + 1,
    past: [],
    ahead: [],
    errors: [],
    failure: null,
    selection: null,
    hover: null,
    time: null,
    playing: false,
    plans: [],
    shown: null,
    besides: null,
    scenario: null,
    steps: [],
    undone: [],
    locks: [],
    doubts: {},
    fit: null,
    live: null,
    tool: null,
    order: NOTHING_TYPED,
    sweepAxes: null,
    run: { state: 'idle', points: [], message: '' },
    ...others,
  }));
}

/** Select what a key names, or nothing. */
export function select(key) {
  store.set({ selection: key });
}

/** Mark what a key names while the pointer is on it. */
export function hover(key) {
  if (store.get().hover !== key) store.set({ hover: key });
}

/** Show a tab of the panel. */
export function openTab(tab) {
  const { frame } = store.get();
  const sheet = frame.sheet === 'low' ? 'half' : frame.sheet;
  layOut({ folded: false, sheet, tabs: { ...frame.tabs, [roomOf(tab)]: tab } });
  store.set({ tab });
}

/** Show why a request failed, each error where it belongs. */
export function showFailure(error) {
  if (error.name === 'AbortError') return;
  const errors = (error.errors ?? []).map((entry) => ({ ...entry, keys: parsePath(entry.path) }));
  // What is wrong is told piece by piece: its count in the service's words says less.
  const failure = errors.length
    ? { title: t('failed.status422'), detail: t('failed.toMend', { count: errors.length }) }
    : { title: error.title ? titleOf(error) : t('failed.console'), detail: error.message };
  store.set({ failure, errors });
}

/** Close the message about a failure; errors stay where they belong until mended. */
export function closeFailure() {
  store.set({ failure: null });
}

/** Give an entry of `plans` another name. */
export function renamePlan(number, name) {
  store.set(({ plans }) => ({
    plans: plans.map((entry) => (entry.number === number ? { ...entry, name } : entry)),
  }));
}

/** Return the entry of `plans` that is looked at. */
export function shownPlan(state) {
  return state.plans.find(({ number }) => number === state.shown) ?? null;
}

/** Return the entry of `plans` that stands beside it. */
export function besidePlan(state) {
  return state.plans.find(({ number }) => number === state.besides) ?? null;
}

/** Tell whether something is planned and none of its plans is there yet: those shown are older. */
export function isWaiting({ run, plans }) {
  return run.state !== 'idle' && !plans.some(({ number }) => number === run.number);
}

const indices = new WeakMap();

/** Return the index of an entry of `plans`; made once. */
export function indexOf(entry) {
  if (!entry) return null;
  if (!indices.has(entry.plan)) {
    indices.set(entry.plan, indexPlan(entry.request, entry.plan, numbersIn(entry)));
  }
  return indices.get(entry.plan);
}

const settled = new WeakMap();

/** Return what of an entry of `plans` is settled, see `settledParts`; the same while it holds. */
export function settledOf(entry, request) {
  if (!entry) return NOTHING;
  const ahead = request.replan?.plan === entry.plan ? request.replan : null;
  const known = settled.get(entry);
  if (known?.ahead === ahead) return known.parts;
  const parts = settledParts(entry, request);
  settled.set(entry, { ahead, parts });
  return parts;
}

const NOTHING = new Map();
