/** Keys that work everywhere but in fields. */

import { indexOf, openTab, redo, select, shownPlan } from '../actions.js';
import { ROOMS } from '../core/rooms.js';
import { redoStep, undoLast } from '../hands.js';
import { openPlans, save } from '../keeping/kept.js';
import { replanFromClock } from '../ordering.js';
import { improvePlan, plan, stop } from '../planning.js';
import { store } from '../store.js';
import { togglePlaying } from '../timeline/player.js';
import { focusFirst } from './focus.js';
import { switchTheme } from './settings.js';

/** Where the browser keeps that single keys do nothing. */
const KEPT = 'tandem-single-keys';

/** Keys that do something by themselves, as the list of keys shows them; they can be put off. */
export const SINGLE_KEYS = [
  'plan', 'stop', 'improve', 'replan', 'play', 'tabs', 'open', 'undo', 'redo', 'timeline', 'map',
  'theme', 'list'];

/** Keys that work in any case. */
export const OTHER_KEYS = ['undo', 'redo', 'save', 'escape'];

const redoLast = () => redoStep() || redo();

const ACTIONS = {
  p: plan,
  i: improvePlan,
  r: replanOrAsk,
  s: stop,
  u: undoLast,
  y: redoLast,
  o: openPlans,
  l: switchTheme,
  ' ': () => togglePlaying(indexOf(shownPlan(store.get()))),
  t: () => focusFirst('.rows canvas'),
  m: () => focusFirst('.map'),
  '?': () => store.set({ dialog: { name: 'keys' } }),
};

const putDown = () => (store.get().tool ? store.set({ tool: null }) : select(null));

/** Go on from the clock of the day; without one, ask for the time. */
function replanOrAsk() {
  if (store.get().time === null) openTab('replan');
  else replanFromClock();
}

/** Tell whether keys do something by themselves. */
export function singleKeysWork() {
  return localStorage.getItem(KEPT) !== 'off';
}

/** Have keys do something by themselves or not, from now on in this browser. */
export function setSingleKeys(work) {
  if (work) localStorage.removeItem(KEPT);
  else localStorage.setItem(KEPT, 'off');
}

/** Tell whether a dialog is open. */
function isAsked() {
  const { dialog, importing, keeping } = store.get();
  return Boolean(dialog || importing || keeping);
}

/** Return what a key pressed with Ctrl does, if anything. */
function actionWithControl({ key, shiftKey }) {
  const letter = key.toLowerCase();
  if (letter === 's') return save;
  if (letter === 'z') return shiftKey ? redoLast : undoLast;
  return letter === 'y' ? redoLast : null;
}

/** Return what a key does by itself, if anything. */
function actionAlone({ key, target }) {
  if (key === 'Escape') return putDown;
  if (!singleKeysWork()) return null;
  if (key === ' ' && target.matches('button, summary, a, input')) return null;
  if (/^\d$/.test(key)) {
    const [tab] = Object.values(ROOMS)[Number(key) - 1]?.tabs ?? [];
    return tab && (() => openTab(tab));
  }
  return ACTIONS[key.length === 1 ? key.toLowerCase() : key];
}

/** Return what a press of a key does, if anything. */
function actionOf(event) {
  const { target } = event;
  const typing = target.matches('input:not([type=range]), select, textarea, [contenteditable]');
  if (event.altKey) return null;
  if (event.ctrlKey || event.metaKey) {
    const action = actionWithControl(event);
    // Within a field its own typing is undone.
    const undoes = typing && !target.matches('select, [type=checkbox], [type=radio]');
    return undoes && action !== save ? null : action;
  }
  return typing && event.key !== 'Escape' ? null : actionAlone(event);
}

/** Begin to listen. */
export function listenToKeys() {
  document.addEventListener('keydown', (event) => {
    const action = actionOf(event);
    if (isAsked()) {
      if (action === save) event.preventDefault();
      return;
    }
    if (!action) return;
    event.preventDefault();
    action();
  });
}
