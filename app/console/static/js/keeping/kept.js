/** Plans that are kept by a name: what the dialogs about them show and do. */

import { openRequest, openTab, showFailure } from '../actions.js';
import * as api from '../api.js';
import { isUnsaved, planToSave } from '../core/drafts.js';
import { judgedPlan } from '../core/moving.js';
import { inSeconds } from '../core/times.js';
import { openDay } from '../living.js';
import { plan, resume } from '../planning.js';
import { resumeScenario } from '../scenarios.js';
import { store } from '../store.js';
import { language, t } from '../texts.js';
import * as browser from './browser.js';
import { newId } from './database.js';
import { deleteDrafts, listDrafts } from './draft-records.js';
import { adopt, currentDraft, switchDraft } from './drafts.js';
import * as service from './service.js';
import { heldDrafts } from './tabs.js';

/** Where plans are kept. */
const PLACES = { browser, service };

const SHARED = '#shared=';

const LOOK_MS = 10_000; // between two looks at a day

/** Change what the open dialog shows. */
export function change(patch) {
  store.set(({ keeping }) => (keeping ? { keeping: { ...keeping, ...patch } } : {}));
}

/** Close the dialog. */
export function closeKeeping() {
  store.set({ keeping: null });
}

/** Do something for the dialog, and show in it what goes wrong. */
async function attempt(work) {
  change({ busy: true, failure: null });
  try {
    return await work();
  } catch (error) {
    change({ failure: error });
    return undefined;
  } finally {
    change({ busy: false });
  }
}

/** Show what is kept. */
export async function openPlans() {
  store.set({ keeping: { view: 'plans', plans: null, drafts: [], failure: null, busy: false } });
  await refresh();
}

/** Read anew what is kept, as far as it can be reached. */
async function refresh() {
  const listed = await Promise.allSettled([listIn('browser'), listIn('service'), otherDrafts()]);
  const failed = listed.find((each) => each.status === 'rejected');
  const [inBrowser, onService, drafts] = listed.map((each) =>
    (each.status === 'fulfilled' && each.value) || []);
  const plans = [...inBrowser, ...onService].sort(
    (one, other) => Date.parse(other.changed_at) - Date.parse(one.changed_at));
  change({ plans, drafts, failure: failed?.reason ?? null });
}

async function listIn(where) {
  return (await PLACES[where].list()).map((entry) => ({ ...entry, where }));
}

/** Return the drafts of other tabs, and those that no tab has open. */
async function otherDrafts() {
  const held = await heldDrafts();
  return (await listDrafts())
    .filter(({ id, isTrivial }) => id !== currentDraft() && !isTrivial)
    .map((head) => ({ ...head, isOpen: held.includes(head.id) }));
}

/** Open a kept plan in place of what is open. */
export async function openKept({ where, id, day }) {
  // A day that is deleted was kept as it stood once.
  if (day && await openDay(day).then(() => true, () => false)) return closeKeeping();
  const kept = await attempt(() => PLACES[where].read(id));
  if (!kept) return;
  closeKeeping();
  show(await withLines(kept), { home: { where, id, version: kept.version } });
  if (!kept.plan) await plan();
}

/** Return a kept plan with its ways on roads and in the air, which may have been left out. */
async function withLines(kept) {
  const { request, plan: told } = kept;
  const isKnown = Boolean(told?.routes[0]?.trips[0].stops[1]?.geometry);
  const isPlain = request.coordinate_system !== 'geographic' && !request.airspace?.no_fly?.length;
  if (!told || isKnown || isPlain) return kept;
  const asked = { problem: api.withWays(request), plan: told };
  const verdict = await attempt(() => api.postCheck(asked));
  return verdict ? { ...kept, plan: judgedPlan(told, told, verdict) } : kept;
}

/** Show a problem, and its plan if it has one. */
function show({ name, note, request, plan: reply }, others) {
  const plans = reply ? [{ number: 1, request, plan: reply }] : [];
  const saved = { request, plan: reply };
  openRequest(request, { name, note, saved, plans, shown: reply ? 1 : null, ...others });
}

/** Put a kept plan beside the one that is looked at. */
export async function putBeside({ where, id }) {
  const kept = await attempt(() => PLACES[where].read(id));
  if (!kept) return;
  closeKeeping();
  store.set((state) => {
    const number = Math.max(0, ...state.plans.map((entry) => entry.number)) + 1;
    const entry = { number, name: kept.name, request: kept.request, plan: kept.plan };
    return { plans: [...state.plans, entry], besides: number };
  });
  openTab('changes');
}

/** Go on with a draft in this tab. */
export async function openDraft(id) {
  const state = await attempt(() => switchDraft(id));
  if (!state) {
    await refresh();
    return;
  }
  closeKeeping();
  adopt(state);
  await goOn(state);
}

/** Go on with what was under way when a draft was left. */
export async function goOn({ cut, plans }) {
  resumeScenario();
  if (cut) await resume(cut);
  else if (!plans.length) await plan();
}

/** Delete a draft. */
export async function deleteDraft(id) {
  await attempt(() => deleteDrafts([id]));
  await refresh();
}

/** Delete a kept plan; if it is open, it stays so, without being kept. */
export async function deleteKept({ where, id, version }) {
  await attempt(() => PLACES[where].remove(id, version));
  const { home } = store.get();
  if (home?.id === id && home.where === where && !store.get().keeping.failure)
    store.set({ home: null, saved: null });
  const { failure } = store.get().keeping;
  await refresh();
  if (failure) change({ failure });
}

/** Ask by which name, and where, what is open is to be kept. */
export function askName() {
  const { name, note, home } = store.get();
  store.set({
    keeping: {
      view: 'save', name, note, where: home?.where ?? 'browser', failure: null, busy: false,
    },
  });
}

/** Keep what is open: as it is kept already, or ask how. */
export async function save() {
  const { home } = store.get();
  if (!home) {
    askName();
    return;
  }
  await saveTo(home.where, home.id, home.version);
}

/** Keep what is open by the name in the dialog, as a plan of its own. */
export function saveAsNew() {
  const { where, name, note } = store.get().keeping;
  store.set({ name: name.trim(), note });
  return saveTo(where, newId(), null);
}

/** Keep what is open as the plan that it was opened from, whatever others made of that. */
export function saveAnyway() {
  const { home } = store.get();
  return saveTo(home.where, home.id, '*');
}

/** Give what is open the name in the dialog, where it is kept too. */
export async function renameOpen() {
  const { name: typed, note } = store.get().keeping;
  const name = typed.trim();
  const { home } = store.get();
  if (home) {
    const kept = await attempt(() => PLACES[home.where].rename(home.id, { name, note },
      home.version));
    if (!kept) return;
    store.set({ home: { ...home, version: kept.version } });
  }
  store.set({ name, note });
  closeKeeping();
}

/** Return what is kept of what is open. */
function content() {
  const state = store.get();
  const { request, name, note } = state;
  return { name, note, request, plan: planToSave(state) };
}

async function saveTo(where, id, version) {
  const kept = content();
  try {
    change({ busy: true, failure: null });
    const { version: now } = await PLACES[where].write(id, kept, version);
    leaveLink();
    store.set({
      home: { where, id, version: now },
      saved: { request: kept.request, plan: kept.plan },
      keeping: null,
    });
  } catch (error) {
    if (error.status === 412) store.set({ keeping: { view: 'conflict', failure: error } });
    else if (store.get().keeping) change({ failure: error, busy: false });
    else showFailure(error);
  }
}

/** Keep what is open for all who have the key, unless it is, and make a link to it. */
export async function share() {
  const { home, live } = store.get();
  if (live) {
    await shareDay(live.day);
    return;
  }
  const isThere = home?.where === 'service';
  if (!isThere) await saveTo('service', newId(), null);
  else if (isUnsaved(store.get())) await saveTo('service', home.id, home.version);
  const now = store.get().home;
  if (now?.where !== 'service' || isUnsaved(store.get())) return; // why, is told
  await openLinks(now);
  await makeLink();
}

/** Keep the day that is followed as it goes on, and make a link to it. */
async function shareDay({ dispatch: id, plan_start: begins }) {
  const name = `${t('live.plan')}, ${new Date(begins).toLocaleDateString(language())}`;
  try {
    // It may be kept already, by another name.
    await openLinks(await api.putKeptPlan(id, { name, day: id }, null)
      .catch(() => api.getKeptPlan(id)));
    await makeLink();
  } catch (error) {
    showFailure(error);
  }
}

/** Show the links of a kept plan. */
export async function openLinks(kept) {
  store.set({ keeping: { view: 'links', kept, links: [], url: null, failure: null, busy: false } });
  const links = await attempt(() => api.getLinks(kept.id));
  if (links) change({ links });
}

/** Make a link to the plan in the dialog. */
export async function makeLink() {
  const { kept } = store.get().keeping;
  const made = await attempt(() => api.postLink(kept.id));
  if (!made) return;
  const url = new URL(document.baseURI);
  url.hash = SHARED + made.token;
  change({ url: url.href, links: [...store.get().keeping.links, made] });
}

/** End a link of the plan in the dialog. */
export async function endLink(link) {
  const { kept } = store.get().keeping;
  const ended = await attempt(() => api.deleteLink(kept.id, link));
  if (!ended) return;
  const { links } = store.get().keeping;
  change({ links: links.filter(({ id }) => id !== link), url: null });
}

/** Return the token of the link that led here, or null. */
export function tokenInAddress() {
  const { hash } = location;
  return hash.startsWith(SHARED) ? hash.slice(SHARED.length) : null;
}

/** Show the plan of a link; it is looked at, and not this browser's. */
export async function viewShared(token) {
  const shared = await api.getSharedPlan(token);
  show(shared, { viewing: token, isDay: shared.is_live });
  let last = store.get().request;
  const again = async () => {
    const now = await api.getSharedPlan(token).catch(() => null);
    if (!now || store.get().viewing !== token) return;
    last = inSeconds(store.get().schemas, now.request);
    const plans = now.plan ? [{ number: 1, request: last, plan: now.plan }] : [];
    store.set({ request: last, plans, shown: now.plan ? 1 : null });
  };
  const timer = shared.is_live && setInterval(again, LOOK_MS);
  const unsubscribe = store.subscribe(({ request, viewing }) => {
    if (viewing === token && request !== last) leaveLink();
    if (store.get().viewing === token) return;
    clearInterval(timer);
    unsubscribe();
  });
}

/** Show the plan of a link that is opened in this tab. */
export function listenToLinks() {
  addEventListener('hashchange', () => {
    const token = tokenInAddress();
    if (token) viewShared(token).catch(showFailure);
  });
}

/** What was changed of a shared plan is one's own: loaded anew, it comes back as it is. */
function leaveLink() {
  if (!store.get().viewing) return;
  history.replaceState(null, '', location.pathname + location.search);
  store.set({ viewing: null });
}
