/** Why the drones of a vehicle fly nothing. */

import { shownPlan } from '../actions.js';
import { idleAtHubs, idleCarriers, idleInWords } from '../core/idle-drones.js';
import { nameOfVehicle } from '../core/vehicle-labels.js';
import { askIdle, IDLE, toldOf } from '../explaining.js';
import { html, useEffect } from '../libraries.js';
import { store, useStore } from '../store.js';
import { t } from '../texts.js';

/** Plans of so many customers are asked about without a click. */
const MOST_CUSTOMERS = 300;

/** Why the drones of `vehicle` fly nothing; without one of all vehicles, and how many of hubs. */
export function IdleDrones({ vehicle = null }) {
  const entry = useStore(shownPlan);
  const answer = toldOf(useStore((state) => state.why), entry, IDLE);
  const idle = useStore(({ run, judging }) => run.state === 'idle' && judging === null);
  const names = entry
    ? idleCarriers(entry).filter((name) => vehicle === null || name === vehicle)
    : [];
  const isSmall = (entry?.request.customers.length ?? 0) <= MOST_CUSTOMERS;
  const isToBeAsked = names.length > 0 && isSmall && idle && !answer && !entry.hand;
  useEffect(() => {
    // Another of these may have asked meanwhile.
    if (isToBeAsked && !toldOf(store.get().why, entry, IDLE)) askIdle(entry, true);
  }, [isToBeAsked, entry]);
  const hubs = entry && vehicle === null ? idleAtHubs(entry) : [];
  if (!names.length && !hubs.length) return null;
  const isOpen = (!answer || answer.state === 'failed') && !isToBeAsked;
  const told = new Map(answer?.told?.idle_drones.map((each) => [each.vehicle, each]));
  return html`<ul class="idle-drones">${names.map((name) => html`<li key=${name}>${
    t('idleDrones.idle', { vehicle: nameOfVehicle(name) })}${told.has(name) && html` ${
    idleInWords(told.get(name))}`}</li>`)}${hubs.map(({ type, count, all }) => html`<li
      key=${`hub ${type}`}>${t('idleDrones.ofHub', { type, count, all })}</li>`)}</ul>
    ${names.length > 0 && isOpen && html`<button type="button" class="link" disabled=${!idle}
      onClick=${() => askIdle(entry)}>${t('idleDrones.ask')}</button>`}`;
}
