/** The panel beside the map: the problem, its plan, and what else can be asked. */

import { openTab, shownPlan } from '../actions.js';
import { html, useEffect, useRef } from '../libraries.js';
import { store, useStore } from '../store.js';
import { ChangesTab } from './changes-tab.js';
import { CostsTab } from './costs-tab.js';
import { CustomersTab } from './customers-tab.js';
import { DronesLine } from './drones-line.js';
import { DriversTab } from './drivers-tab.js';
import { FleetTab } from './fleet-tab.js';
import { HandBar } from './hand-bar.js';
import { later } from './later.js';
import { ReplanTab } from './replan-tab.js';
import { RoutesTab } from './routes-tab.js';
import { SolveTab } from './solve-tab.js';
import { t } from '../texts.js';

const ExportTab = later(async () => (await import('./export-tab.js')).ExportTab);
const ScenariosTab = later(async () => (await import('./scenarios-tab.js')).ScenariosTab);
const UnassignedTab = later(
  async () => (await import('./unassigned-tab.js')).UnassignedTab,
);

/** Views by tab, in order; the digit of each of the first ten, 0 for the tenth, is its shortcut. */
export const TABS = {
  customers: CustomersTab,
  fleet: FleetTab,
  solve: SolveTab,
  routes: RoutesTab,
  costs: CostsTab,
  unassigned: UnassignedTab,
  changes: ChangesTab,
  replan: ReplanTab,
  scenarios: ScenariosTab,
  export: ExportTab,
  drivers: DriversTab,
};

/** Parts of a problem that the customers' tab has. */
const OF_CUSTOMERS = new Set(['customers', 'shipments', 'depots', 'launch_sites', 'relations',
  'incompatible_goods', 'coordinate_system', 'planar_unit', 'planar_rounding']);

/** Return the tab where a place of the request is edited. */
export function tabOf(keys) {
  if (OF_CUSTOMERS.has(keys[0])) return 'customers';
  if (keys[0] === 'replan') return 'replan';
  return keys[0] === 'options' ? 'solve' : 'fleet';
}

/** The tabs and the one that is open. */
export function Panel() {
  const tab = useStore((state) => state.tab);
  const errors = useStore((state) => state.errors);
  const unassigned = useStore((state) => shownPlan(state)?.plan.unassigned.length ?? 0);
  const counts = Object.fromEntries(
    Object.keys(TABS).map((name) => [
      name,
      errors.filter(({ keys }) => tabOf(keys) === name).length,
    ]),
  );
  counts.unassigned = unassigned;
  const opened = useRef(tab);
  useEffect(() => {
    if (opened.current === tab) return;
    opened.current = tab;
    document.getElementById(`tab-${tab}`).scrollIntoView({ block: 'nearest', inline: 'nearest' });
  }, [tab]);
  const View = TABS[tab];
  return html`<aside class="panel" aria-label=${t('panel.title')}>
    <div class="tabs" role="tablist" aria-label=${t('panel.tabs')}
      onKeyDown=${onKey}>
      ${Object.keys(TABS).map(
        (name) => html`<button type="button" role="tab"
        key=${name} id=${`tab-${name}`} aria-controls="tab-body" aria-selected=${tab === name}
        tabindex=${tab === name ? 0 : -1} onClick=${() => openTab(name)}>${t(`tab.${name}`)}${
          counts[name] > 0 && html`<span class="count">${counts[name]}</span>`
        }</button>`,
      )}
    </div>
    <${DronesLine} /><${HandBar} />
    <div class="tab" role="tabpanel" id="tab-body" aria-labelledby=${`tab-${tab}`} tabindex="0"
      key=${tab}><h2 class="visually-hidden">${t(`tab.${tab}`)}</h2><${View} /></div>
  </aside>`;
}

function onKey(event) {
  const names = Object.keys(TABS);
  const position = names.indexOf(store.get().tab);
  const next = {
    ArrowLeft: position - 1,
    ArrowRight: position + 1,
    Home: 0,
    End: names.length - 1,
  };
  if (!(event.key in next)) return;
  event.preventDefault();
  const name = names[(next[event.key] + names.length) % names.length];
  openTab(name);
  requestAnimationFrame(() => document.getElementById(`tab-${name}`).focus());
}
