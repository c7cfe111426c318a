/** The panel beside the map: what is in the room that is open. */

import { openTab, shownPlan } from '../actions.js';
import { ROOMS, roomOf } from '../core/rooms.js';
import { layOut, SHEETS } from '../frame.js';
import { html } from '../libraries.js';
import { store, useStore } from '../store.js';
import { CostsTab } from './costs-tab.js';
import { CustomersTab } from './customers-tab.js';
import { Details } from './details.js';
import { DronesLine } from './drones-line.js';
import { DriversTab } from './drivers-tab.js';
import { Edge } from './edge.js';
import { FleetTab } from './fleet-tab.js';
import { HandBar } from './hand-bar.js';
import { later } from './later.js';
import { RoutesTab } from './routes-tab.js';
import { SolveTab } from './solve-tab.js';
import { nextOf } from './tab-list.js';
import { t } from '../texts.js';

const ChangesTab = later(async () => (await import('./changes-tab.js')).ChangesTab);
const ReplanTab = later(async () => (await import('./replan-tab.js')).ReplanTab);
const ExportTab = later(async () => (await import('./export-tab.js')).ExportTab);
const ScenariosTab = later(async () => (await import('./scenarios-tab.js')).ScenariosTab);
const UnassignedTab = later(
  async () => (await import('./unassigned-tab.js')).UnassignedTab);

/** Views by tab. */
const TABS = {
  customers: CustomersTab, fleet: FleetTab, solve: SolveTab, routes: RoutesTab, costs: CostsTab,
  unassigned: UnassignedTab, changes: ChangesTab, replan: ReplanTab, scenarios: ScenariosTab,
  export: ExportTab, drivers: DriversTab,
};

/** The room that is open, what is selected beside it, and the edge between both. */
export function Panel() {
  const tab = useStore((state) => state.tab);
  const room = roomOf(tab);
  const View = TABS[tab];
  return html`<aside class="panel" aria-label=${t('panel.title')}>
    <${Sheet} />
    <div class="room" id="panel" role="tabpanel" aria-labelledby=${`room-${room}`}>
      <${RoomHead} room=${room} tab=${tab} />
      <${DronesLine} /><${HandBar} />
      <div class="tab" tabindex="0" key=${tab} role="region" aria-label=${t(`tab.${tab}`)}>
        <${View} /></div>
    </div>
    <${Edge} name="panel" range=${[320, 640]} label=${t('panel.edge')} />
    <${Details} />
  </aside>`;
}

/** The title of a room, and its tabs if it has several. */
function RoomHead({ room, tab }) {
  const { tabs } = ROOMS[room];
  const out = useStore((state) => shownPlan(state)?.plan.unassigned.length ?? 0);
  const onKey = (event) => {
    const next = nextOf(event, tabs, store.get().tab);
    if (!next) return;
    openTab(next);
    requestAnimationFrame(() => document.getElementById(`tab-${next}`).focus());
  };
  return html`<header class="room-head"><h2>${t(`room.${room}`)}</h2>
    ${tabs.length > 1 && html`<div class="tabs" role="tablist" aria-label=${t('panel.tabs')}
      onKeyDown=${onKey}>${tabs.map((name) => html`<button type="button" role="tab" key=${name}
        id=${`tab-${name}`} aria-selected=${tab === name} tabindex=${tab === name ? 0 : -1}
        onClick=${() => openTab(name)}>${t(`tab.${name}`)}${
          name === 'unassigned' && out > 0 && html`<span class="count">${out}</span>`
        }</button>`)}</div>`}
  </header>`;
}

/** What a phone's sheet is taken by: a click or a drag brings it to another height. */
function Sheet() {
  const sheet = useStore((state) => state.frame.sheet);
  const go = (steps) => {
    const next = Math.min(Math.max(SHEETS.indexOf(sheet) + steps, 0), SHEETS.length - 1);
    layOut({ sheet: SHEETS[next] });
  };
  const drag = (event) => {
    const { clientY: from, currentTarget: grip } = event;
    grip.setPointerCapture(event.pointerId);
    grip.onpointerup = ({ clientY: to }) => {
      grip.onpointerup = null;
      const steps = Math.round((from - to) / (window.innerHeight / 3));
      if (Math.abs(to - from) < 8) layOut({ sheet: sheet === 'half' ? 'full' : 'half' });
      else go(steps || Math.sign(from - to));
    };
  };
  const press = ({ key }) => go({ ArrowUp: 1, Enter: 1, ArrowDown: -1 }[key] ?? 0);
  return html`<button type="button" class="sheet-grip" aria-label=${t('panel.sheet')}
    onPointerDown=${drag} onKeyDown=${press}></button>`;
}
