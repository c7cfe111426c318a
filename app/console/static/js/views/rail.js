/** The rail at the left: the rooms of the desk, settings and help. */

import { openTab, shownPlan } from '../actions.js';
import { isInTrouble } from '../core/dispatches.js';
import { ROOMS, roomOf, tabOf } from '../core/rooms.js';
import { layOut } from '../frame.js';
import { html } from '../libraries.js';
import { store, useStore } from '../store.js';
import { t } from '../texts.js';
import { Icon } from './icon.js';
import { Settings } from './settings.js';
import { nextOf } from './tab-list.js';

const ICON = new URL('../../icon.svg', import.meta.url).href;

/** The rail. */
export function Rail() {
  const tab = useStore((state) => state.tab);
  const folded = useStore((state) => state.frame.folded);
  const counts = useCounts();
  const names = Object.keys(ROOMS);
  const open = (name) => {
    if (name !== roomOf(store.get().tab)) openTab(lastIn(name));
    else layOut({ folded: !store.get().frame.folded });
  };
  const onKey = (event) => {
    const next = nextOf(event, names, roomOf(tab), true);
    if (!next) return;
    openTab(lastIn(next));
    requestAnimationFrame(() => document.getElementById(`room-${next}`).focus());
  };
  return html`<nav class="rail" aria-label=${t('panel.rooms')}>
    <img src=${ICON} alt="Tandem" width="24" height="24" />
    <div role="tablist" aria-label=${t('panel.rooms')} aria-orientation="vertical"
      onKeyDown=${onKey}>${names.map((name) => {
      const isOpen = name === roomOf(tab);
      return html`<button type="button" role="tab" key=${name} id=${`room-${name}`}
        aria-controls="panel" aria-selected=${isOpen} aria-expanded=${isOpen && !folded}
        tabindex=${isOpen ? 0 : -1} onClick=${() => open(name)}>
        <${Icon} name=${ROOMS[name].icon} size=${20} /><span>${t(`room.${name}`)}</span>${
          counts[name] > 0 && html`<span class="count">${counts[name]}</span>`}</button>`;
    })}</div>
    <${Settings} />
    <a href="guide/"><${Icon} name="circle-question-mark" size=${20} />
      <span>${t('header.guide')}</span></a>
  </nav>`;
}

/** Return the tab of a room that was open last. */
function lastIn(room) {
  return store.get().frame.tabs[room] ?? ROOMS[room].tabs[0];
}

/** Return how much is open in each room: who is left out, drivers in trouble, what was refused. */
function useCounts() {
  const errors = useStore((state) => state.errors);
  const out = useStore((state) => shownPlan(state)?.plan.unassigned.length ?? 0);
  const inTrouble = useStore(({ dispatch }) =>
    dispatch?.reply.links.filter(isInTrouble).length ?? 0);
  const counts = Object.fromEntries(Object.keys(ROOMS).map((room) => [
    room, errors.filter(({ keys }) => roomOf(tabOf(keys)) === room).length]));
  const asked = useStore(({ live }) =>
    [...(live?.news.values() ?? [])].filter(({ kind }) => kind === 'doubt').length);
  return { ...counts, orders: counts.orders + out, drivers: inTrouble + asked };
}
