/** Keys that work everywhere but in fields. */

import { indexOf, openTab, replanFromClock, select, shownPlan, undo } from '../actions.js';
import { redoStep, undoStep } from '../hands.js';
import { openPlans, save } from '../keeping/kept.js';
import { improvePlan, plan, stop } from '../planning.js';
import { store } from '../store.js';
import { togglePlaying } from '../timeline/player.js';
import { switchTheme } from './header.js';
import { TABS } from './panel.js';

/** Keys and what they do, as the list of keys shows them. */
export const SHORTCUTS = [
  ['P', 'Plan'],
  ['S', 'Stop planning'],
  ['I', 'Improve the plan: search on from it'],
  ['R', 'Replan from the clock of the day'],
  ['Space', 'Play or pause the day'],
  ['1 to 9, 0', 'Open a tab of the panel'],
  ['Ctrl S', 'Save: keep what is open by a name'],
  ['O', 'Open a saved plan'],
  ['U', 'Undo the last change by hand, or edit of the problem'],
  ['Y', 'Redo a change by hand'],
  ['T', 'Go to the timeline; arrows then go from stop to stop'],
  ['M', 'Go to the map; arrows pan, + and \u2212 zoom'],
  ['L', 'Light or dark'],
  ['Esc', 'Put a drawing tool down, else select nothing'],
  ['?', 'This list'],
];

const ACTIONS = {
  p: plan,
  i: improvePlan,
  r: replanOrAsk,
  s: stop,
  u: () => undoStep() || undo(),
  y: redoStep,
  o: openPlans,
  l: switchTheme,
  ' ': () => togglePlaying(indexOf(shownPlan(store.get()))),
  t: () => document.querySelector('.rows canvas')?.focus(),
  m: () => document.querySelector('.map')?.focus(),
  '?': () => store.set({ dialog: { name: 'keys' } }),
  Escape: () => (store.get().tool ? store.set({ tool: null }) : select(null)),
};

/** Go on from the clock of the day; without one, ask for the time. */
function replanOrAsk() {
  if (store.get().time === null) openTab('replan');
  else replanFromClock();
}

/** Tell whether a dialog is open. */
function isAsked() {
  const { dialog, importing, keeping } = store.get();
  return Boolean(dialog || importing || keeping);
}

/** Begin to listen. */
export function listenToKeys() {
  document.addEventListener('keydown', (event) => {
    const isSave = (event.ctrlKey || event.metaKey) && event.key.toLowerCase() === 's';
    if (isSave) event.preventDefault();
    if (isAsked()) return;
    if (isSave) save();
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const target = event.target;
    const typing = target.matches('input:not([type=range]), select, textarea, [contenteditable]');
    if (typing && event.key !== 'Escape') return;
    if (event.key === ' ' && target.matches('button, summary, a, input')) return;
    const action = ACTIONS[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    const tab = /^\d$/.test(event.key) && Object.keys(TABS)[(Number(event.key) + 9) % 10];
    if (!action && !tab) return;
    event.preventDefault();
    if (tab) openTab(tab);
    else action();
  });
}
