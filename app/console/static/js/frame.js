/** How the desk is laid out: what is folded, and how wide and high its parts are. */

import { store } from './store.js';

const KEPT = 'tandem-frame';

/** Heights of the sheet that the panel is on a phone, from low to high. */
export const SHEETS = ['low', 'half', 'full'];

/** Recall what was chosen in earlier visits. */
export function recallFrame() {
  try {
    store.set(({ frame }) => ({ frame: { ...frame, ...JSON.parse(localStorage.getItem(KEPT)) } }));
  } catch {
    // As at first.
  }
}

/** Lay something out otherwise, from now on in this browser. */
export function layOut(change) {
  const frame = { ...store.get().frame, ...change };
  store.set({ frame });
  try {
    localStorage.setItem(KEPT, JSON.stringify(frame));
  } catch {
    // A browser that keeps nothing begins as at first next time.
  }
}
