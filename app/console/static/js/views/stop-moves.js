/** What can be done by hand with a customer of the plan: put elsewhere, locked, left out. */

import { indexOf, shownPlan } from '../actions.js';
import { moveInWords } from '../core/hands-words.js';
import { placeAt, placeBeside, vehiclesFor } from '../core/moving.js';
import { leftOutOf, shipmentOf } from '../core/visits.js';
import { nameOfVehicle } from '../core/vehicle-labels.js';
import { askFit, moveCustomerTo } from '../hands.js';
import { html } from '../libraries.js';
import { lock } from '../living.js';
import { useStore } from '../store.js';
import { t } from '../texts.js';

/** Put a customer at a place, and say so. */
export function move(index, id, place) {
  return moveCustomerTo(id, place, moveInWords(index, id, place));
}

/** The buttons of a customer. */
export function StopMoves({ id }) {
  const entry = useStore(shownPlan);
  const locks = useStore((state) => state.locks);
  const index = indexOf(entry);
  const halt = index?.halts.get(`c:${id}`);
  const isKnown = index && (halt || leftOutOf(entry.plan).some((other) => other.id === id));
  // A shipment's ends belong together, and aren't moved one by one.
  const whole = isKnown && shipmentOf(entry.request, id);
  if (whole) {
    return html`<div class="buttons" role="group" aria-label=${t('stop.move', { id: whole.id })}>
      <button type="button" onClick=${() => askFit({ id })}>${t('stop.best')}</button></div>`;
  }
  const customer = isKnown && customerOf(entry, id);
  if (!customer) return null;
  const isLocked = locks.includes(id);
  return html`<div class="buttons" role="group" aria-label=${t('stop.move', { id })}>
    ${halt && html`<${Beside} index=${index} halt=${halt} step=${-1}
        name=${t('stop.earlier')} />
      <${Beside} index=${index} halt=${halt} step=${1}
        name=${t('stop.later')} />`}
    <${ToVehicle} index=${index} id=${id} halt=${halt} />
    <button type="button" onClick=${() => askFit(customer)}>
      ${t('stop.best')}</button>
    ${halt && html`<button type="button" aria-pressed=${isLocked}
      onClick=${() => lock([id], !isLocked)}>${
        isLocked ? t('stop.locked') : t('stop.lock')}</button>
      <button type="button" onClick=${() => move(index, id, null)}>
        ${t('stop.leaveOut')}</button>`}</div>`;
}

function customerOf({ request }, id) {
  return request.customers.find((customer) => customer.id === id);
}

function Beside({ index, halt, step, name }) {
  const place = placeBeside(halt, step);
  return html`<button type="button" disabled=${!place}
    onClick=${() => move(index, halt.id, place)}>${name}</button>`;
}

/** A choice of vehicles; the customer comes where it is served at the time that it is now. */
function ToVehicle({ index, id, halt }) {
  const others = vehiclesFor(index.request, index)
    .filter(({ vehicle }) => !vehicle || vehicle !== halt?.vehicle || halt.sortie);
  const give = (event) => {
    const { name, vehicle, type } = others[Number(event.target.value)];
    event.target.value = '';
    const time = halt?.serviceStart ?? 0;
    move(index, id, vehicle ? placeAt(vehicle, time, halt) : { vehicle: name, type });
  };
  return html`<select aria-label=${t('stop.give', { id })} value="" onChange=${give}>
    <option value="" disabled hidden>${t('stop.toVehicle')}</option>
    ${others.map(({ name, vehicle }, position) => html`<option key=${name}
      value=${position}>${vehicle ? nameOfVehicle(name)
        : t('stop.unused', { name: nameOfVehicle(name) })}</option>`)}</select>`;
}
