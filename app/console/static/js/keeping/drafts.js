/** Keeps what this tab works on, as it changes, and brings it back. */

import { openRequest } from '../actions.js';
import { identifier, isKeptAlike, isUnsaved, pack, unpack } from '../core/drafts.js';
import { store } from '../store.js';
import { newId } from './database.js';
import { deleteDrafts, listDrafts, readDraft, writeDraft } from './draft-records.js';
import { draftOfTab, heldDrafts, holdDraft, noteDraftOfTab } from './tabs.js';

const MOST_DRAFTS = 12;
const SOON_MS = 200;

/** Writing may take this share of the time, so that large problems don't keep the page busy. */
const MOST_WRITING = 0.15;

const writer = newId();
const identify = identifier(newId);

let draft = null; // {id, written: ids of parts, release}
let last = { epoch: 0, request: null, run: { state: 'idle' } };
let writing = Promise.resolve();
let timer = null;
let longest = 0;
let isAdopting = false;

/**
 * Return what this tab, or the last one that was closed, worked on, and begin to keep it.
 *
 * @param isVisit whether the tab shows something else, to which nothing that was kept belongs
 */
export async function startKeeping(isVisit) {
  let found = null;
  try {
    if (!isVisit) found = await findDraft();
    if (!draft) await beginDraft();
    dropOldDrafts();
  } catch (error) {
    tell(error);
    draft ??= { id: newId(), written: new Set(), release: () => {} };
  }
  store.subscribe(note);
  document.addEventListener('visibilitychange', () => {
    if (document.visibilityState === 'hidden') keepNow();
  });
  addEventListener('pagehide', keepNow);
  return found;
}

async function findDraft() {
  const own = draftOfTab();
  if (own) return take(own, true);
  if ((await heldDrafts()).length) return null;
  const drafts = await listDrafts();
  const newest = drafts.find(({ isTrivial }) => !isTrivial) ?? drafts[0];
  return newest ? take(newest.id, false) : null;
}

/** Begin a draft for what is open from now on. */
async function beginDraft() {
  const id = newId();
  draft = { id, written: new Set(), release: await holdDraft(id, false) };
  noteDraftOfTab(id);
}

/**
 * Make a draft this tab's; return its state, or null if it is not there.
 *
 * One that another tab has is copied: each goes on with its own.
 */
async function take(id, isOwn) {
  const release = await holdDraft(id, isOwn);
  const found = await readDraft(id, release ? writer : null);
  const state = found && unpack(found.head, found.parts, identify);
  if (!state) {
    release?.();
    return null;
  }
  if (release) {
    draft = { id, written: new Set(found.parts.keys()), release };
    noteDraftOfTab(id);
  } else {
    await beginDraft();
  }
  return state;
}

/** Open a draft in this tab; what was open stays a draft. Return its state, or null. */
export async function switchDraft(id) {
  await keepNow();
  const former = draft;
  const state = await take(id, false);
  if (!state) return null;
  former.release?.();
  return state;
}

/** Open what was kept as it was; it needn't be kept again. */
export function adopt(state) {
  isAdopting = true;
  openRequest(state.request, { ...state, cut: null });
  isAdopting = false;
}

/** Return the id of this tab's draft. */
export const currentDraft = () => draft?.id ?? null;

function note(state) {
  if (isAdopting) {
    last = state;
    return;
  }
  if (!state.request || state.viewing || state.live || isKeptAlike(last, state)) return;
  const former = last;
  last = state;
  if (state.epoch !== former.epoch && former.request && isUnsaved(former)) leave(former);
  // What was opened is kept before anything is done to it.
  const isOpened = state.epoch !== former.epoch;
  timer ??= setTimeout(keepNow, isOpened ? 0 : Math.max(SOON_MS, longest / MOST_WRITING));
}

/** Leave a draft as it is, and begin another for what was opened in its place. */
function leave(former) {
  const target = draft;
  draft = { id: newId(), written: new Set(), release: null };
  const begun = draft;
  noteDraftOfTab(begun.id);
  writing = writing.then(async () => {
    await write(former, target);
    target.release?.();
    begun.release = await holdDraft(begun.id, false);
  });
}

/** Write what has changed; return when it is written. */
export function keepNow() {
  if (timer === null) return writing;
  clearTimeout(timer);
  timer = null;
  const [state, target] = [last, draft];
  writing = writing.then(() => write(state, target));
  return writing;
}

async function write(state, target) {
  const began = performance.now();
  try {
    await put(state, target);
    if (store.get().unkept) store.set({ unkept: null });
  } catch (error) {
    if (!error.isFull || !(await madeRoom())) {
      tell(error);
      return;
    }
    await put(state, target).catch(tell);
  }
  longest = performance.now() - began;
}

async function put(state, target) {
  const { head, parts } = pack(state, identify);
  const fresh = [...parts].filter(([id]) => !target.written.has(id));
  const stale = [...target.written].filter((id) => !parts.has(id));
  const own = { ...head, id: target.id, writer, changedAt: Date.now() };
  const outcome = await writeDraft(own, target.written.size === 0, fresh, stale);
  if (outcome === 'written') {
    target.written = new Set(parts.keys());
    return;
  }
  // Another tab took it, or deleted it: what this tab has is written whole.
  target.written = new Set();
  if (outcome === 'taken') {
    target.id = newId();
    noteDraftOfTab(target.id);
  }
  await put(state, target);
}

/** Delete drafts that are neither open nor among the newest. */
async function dropOldDrafts(most = MOST_DRAFTS) {
  const held = new Set([...(await heldDrafts()), draft?.id]);
  const old = (await listDrafts()).filter(({ id }) => !held.has(id)).slice(most);
  await deleteDrafts(old.map(({ id }) => id));
  return old.length;
}

async function madeRoom() {
  try {
    return (await dropOldDrafts(1)) > 0;
  } catch {
    return false;
  }
}

function tell(error) {
  store.set({ unkept: error.message });
}
