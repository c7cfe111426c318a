/** Drivers: links for their phones, sheets, and how far they are. */

import { indexOf, settledOf, shownPlan } from '../actions.js';
import { linksByVehicle, standingText } from '../core/dispatches.js';
import { clock } from '../core/format.js';
import {
  endDay,
  followDispatch,
  goOnFromDrivers,
  leaveDispatch,
  lookForDispatches,
  renew,
  revoke,
  sendChange,
  sendOut,
} from '../dispatching.js';
import { html, useState } from '../libraries.js';
import { useStore } from '../store.js';
import { printSheets } from './driver-sheets.js';
import { Badge } from './parts.js';

/** The tab. */
export function DriversTab() {
  const dispatch = useStore((state) => state.dispatch);
  const entry = useStore(shownPlan);
  if (dispatch) return html`<${OnTheRoad} dispatch=${dispatch} />`;
  if (!entry) return html`<p class="empty">Nothing is planned yet.</p><${Others} />`;
  return html`<section class="section"><h3>Send the plan to its drivers</h3>
    <p class="help">Each vehicle of plan ${entry.number} gets a link that opens its day on a phone,
      and shows nothing of the others. It ends with the day.</p>
    <div class="buttons"><button type="button" class="primary" onClick=${sendOut}>Send to drivers
      </button></div></section><${Others} />`;
}

/** Plans that are on the road already, to be followed again. */
function Others() {
  const found = useStore((state) => state.onTheRoad);
  return html`<section class="section"><h3>On the road already</h3>
    <p class="help">Plans that were sent out before, here or elsewhere.</p>
    ${!found && html`<div class="buttons"><button type="button"
      onClick=${lookForDispatches}>Look for them</button></div>`}
    ${found && !found.length && html`<p class="help">There is none.</p>`}
    ${found?.map(({ id, words }) => html`<div class="buttons" key=${id}><span>${words}</span>
      <button type="button" aria-label=${`Follow the plan of ${words}`}
        onClick=${() => followDispatch(id)}>Follow</button></div>`)}</section>`;
}

function OnTheRoad({ dispatch }) {
  const request = useStore((state) => state.request);
  const entry = useStore(shownPlan);
  const index = indexOf(entry);
  const vehicles = new Map(index?.vehicles.map((vehicle) => [vehicle.name, vehicle]));
  const links = linksByVehicle(dispatch);
  const isOpen = dispatch.reply.links.some(({ state }) => state !== 'over');
  const isGeographic = entry?.request.coordinate_system === 'geographic';
  return html`<section class="section"><h3>On the road</h3>
      <div class="buttons">
        <button type="button" class="primary" onClick=${goOnFromDrivers}>Replan from what drivers
          told</button>
        <button type="button" disabled=${!index} onClick=${() =>
          printSheets(index.vehicles, settledOf(entry, request), isGeographic, links)}>
          Print sheets with links</button>
        ${isOpen && entry && entry.plan !== dispatch.plan && html`<button type="button"
          onClick=${sendChange}>Send plan ${entry.number} to their phones</button>`}
        ${isOpen ? html`<button type="button" onClick=${endDay}>End the day</button>`
          : html`<button type="button" onClick=${leaveDispatch}>Send out anew</button>`}
      </div>
      <ul class="links">${[...links.values()].map(
        (link) => html`<${Link} key=${link.id} link=${link}
          vehicle=${vehicles.get(link.vehicle)} />`,
      )}</ul></section>
    <${Failures} links=${[...links.values()]} />`;
}

function Link({ link, vehicle }) {
  const [shown, setShown] = useState(false);
  const [copied, setCopied] = useState(false);
  const copy = async () => {
    await navigator.clipboard.writeText(link.url);
    setCopied(true);
  };
  return html`<li class="card"><header>
      <strong>${vehicle && html`<${Badge} vehicle=${vehicle} /> `}${link.vehicle}</strong>
      <span class="right" aria-live="polite">${standingText(link)}</span></header>
    <div class="inside"><div class="buttons">
      ${link.url && link.state === 'open' && html`
        <button type="button" onClick=${copy} aria-label=${`Copy the link of ${link.vehicle}`}>
          ${copied ? 'Copied' : 'Copy link'}</button>
        <button type="button" onClick=${() => setShown(!shown)} aria-expanded=${shown}
          aria-label=${`QR code of ${link.vehicle}`}>QR code</button>
        <a href=${link.url} target="_blank" rel="noopener noreferrer"
          aria-label=${`Open the day of ${link.vehicle}`}>Open</a>`}
      ${link.state === 'open' && html`<button type="button" onClick=${() => revoke(link.id)}
        aria-label=${`Revoke the link of ${link.vehicle}`}>Revoke</button>`}
      ${link.state !== 'over' && html`<button type="button" onClick=${() => renew(link.id)}
        aria-label=${`New link for ${link.vehicle}`}>New link</button>`}
    </div>
    ${shown && html`<img class="qr" src=${link.qr} alt=${`QR code of ${link.vehicle}'s link`} />`}
    </div></li>`;
}

function Failures({ links }) {
  const rows = links.flatMap(({ vehicle, standing }) =>
    standing
      .filter(({ state }) => state === 'failed')
      .map((step) => ({ vehicle, key: `${vehicle} ${step.id}`, ...step })),
  );
  if (!rows.length) return null;
  return html`<section class="section"><h3>What failed</h3><ul>${rows.map(
    ({ key, vehicle, place, reason, time }) => html`<li key=${key}>${place}, ${vehicle},
      ${' '}${clock(time)}: ${reason}</li>`,
  )}</ul></section>`;
}
