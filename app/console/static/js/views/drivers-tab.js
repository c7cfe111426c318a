/** Drivers: links for their phones, sheets, and how far they are. */

import { indexOf, settledOf, shownPlan } from '../actions.js';
import {
  behindPlan, driverReason, isBrokenDown, linksByVehicle, standingText,
} from '../core/dispatches.js';
import { clock, duration } from '../core/format.js';
import { nameOfVehicle } from '../core/vehicle-labels.js';
import {
  endDay, followDispatch, goOnFromDrivers, leaveDispatch, lookForDispatches, renew, revoke, sendOut,
} from '../dispatching.js';
import { html, useState } from '../libraries.js';
import { beginDay, openDay, tell } from '../living.js';
import { useStore } from '../store.js';
import { printSheets } from './driver-sheets.js';
import { Badge } from './parts.js';
import { Proofs } from './proofs.js';
import { UntoldOrders } from './untold-orders.js';
import { LiveDay } from './live-day.js';
import { language, t } from '../texts.js';

/** The tab. */
export function DriversTab() {
  const dispatch = useStore((state) => state.dispatch);
  const entry = useStore(shownPlan);
  const isLive = useStore((state) => state.live !== null);
  const road = dispatch && html`<${OnTheRoad} dispatch=${dispatch} isLive=${isLive} />`;
  if (isLive) return html`<${LiveDay} />${road}`;
  if (road) return road;
  if (!entry) return html`<p class="empty">${t('timeline.nothing')}</p><${Others} />`;
  return html`<section class="section"><h3>${t('drivers.send')}</h3>
    <p class="help">${t('drivers.sendHelp', { number: entry.number })}</p>
    <div class="buttons"><button type="button" class="primary" onClick=${() => beginDay(false)}>
      ${t('live.begin')}</button><button type="button" onClick=${sendOut}>
      ${t('drivers.sendOut')}</button><button type="button" onClick=${() => beginDay(true)}>
      ${t('live.rehearse')}</button></div></section><${Others} />`;
}

/** Plans that are on the road already, to be followed again. */
function Others() {
  const found = useStore((state) => state.onTheRoad);
  return html`<section class="section"><h3>${t('drivers.already')}</h3>
    <p class="help">${t('drivers.alreadyHelp')}</p>
    ${!found && html`<div class="buttons"><button type="button"
      onClick=${lookForDispatches}>${t('drivers.look')}</button></div>`}
    ${found && !found.length && html`<p class="help">${t('drivers.none')}</p>`}
    ${found?.map(({ id, day, words }) => html`<div class="buttons" key=${id}><span>${words}</span>
      <button type="button" aria-label=${t('drivers.followOf', { words })}
        onClick=${() => (day ? openDay(day) : followDispatch(id))}>${
          t('drivers.follow')}</button></div>`)}</section>`;
}

function OnTheRoad({ dispatch, isLive }) {
  const request = useStore((state) => state.request);
  const untold = useStore((state) => state.untold);
  const entry = useStore(shownPlan);
  const index = indexOf(entry);
  const vehicles = new Map(index?.vehicles.map((vehicle) => [vehicle.name, vehicle]));
  const links = linksByVehicle(dispatch);
  const isOpen = dispatch.reply.links.some(({ state }) => state !== 'over');
  const isGeographic = entry?.request.coordinate_system === 'geographic';
  return html`<section class="section"><h3>${t('drivers.road')}</h3>
      <div class="buttons">
        ${!isLive && html`<button type="button" class="primary"
          onClick=${() => goOnFromDrivers(null)}>${t('drivers.replan')}</button>`}
        <button type="button" disabled=${!index} onClick=${() =>
          printSheets(index.vehicles, settledOf(entry, request), isGeographic, links)}>
          ${t('drivers.print')}</button>
        ${isOpen ? html`<button type="button" onClick=${endDay}>
          ${t('drivers.end')}</button>`
          : html`<button type="button" onClick=${leaveDispatch}>
            ${t('drivers.anew')}</button>`}
      </div>
      ${untold && html`<${UntoldOrders} key=${untold.replan.freeze_before} told=${untold} />`}
      <ul class="links">${[...links.values()].map(
        (link) => html`<${Link} key=${link.id} link=${link} isLive=${isLive}
          vehicle=${vehicles.get(link.vehicle)} />`,
      )}</ul></section>
    <${Proofs} dispatch=${dispatch.reply.id} /><${Failures} links=${[...links.values()]} />`;
}

function Link({ link, vehicle, isLive }) {
  const name = nameOfVehicle(link.vehicle);
  const of = { vehicle: name };
  const late = behindPlan(link);
  const isUnseen = useStore(({ live }) => live && isNewTo(link, live, indexOf(live.since)));
  const [shown, setShown] = useState(false);
  const [copied, setCopied] = useState(false);
  const copy = async () => {
    await navigator.clipboard.writeText(link.url);
    setCopied(true);
  };
  return html`<li class="card"><header>
      <strong>${vehicle && html`<${Badge} vehicle=${vehicle} /> `}${name}</strong>
      <span class="right" aria-live="polite">${standingText(link)}${late > 0 &&
        html` <strong class="late-text">+${duration(late)}</strong>`}
        ${isUnseen ? html` <span class="news doubt">${t('live.unseen')}</span>`
          : link.seen_at && ` ${t('live.seenAt', { at: timeOf(link.seen_at) })}`}</span></header>
    <div class="inside"><div class="buttons">
      ${link.url && link.state === 'open' && html`
        <button type="button" onClick=${copy} 
          aria-label=${t('drivers.copyOf', of)}>
          ${copied ? t('drivers.copied') : t('drivers.copy')}</button>
        <button type="button" onClick=${() => setShown(!shown)} aria-expanded=${shown}
          aria-label=${t('drivers.qrOf', of)}>${t('drivers.qr')}</button>
        <a href=${link.url} target="_blank" rel="noopener noreferrer"
          aria-label=${t('drivers.openOf', of)}>${t('kept.open')}</a>`}
      ${link.state === 'open' && html`${isLive ? html`<${LiveTellings} link=${link} of=${of} />`
        : html`<button type="button" onClick=${() => goOnFromDrivers(link.vehicle)}
        aria-label=${t('drivers.brokenOf', of)}>${t('drivers.broken')}</button>`}
      <button type="button" onClick=${() => revoke(link.id)}
        aria-label=${t('drivers.revokeOf', of)}>${t('drivers.revoke')}</button>`}
      ${link.state !== 'over' && html`<button type="button" onClick=${() => renew(link.id)}
        aria-label=${t('drivers.renewOf', of)}>${t('drivers.renew')}</button>`}
    </div>
    ${shown && html`<img class="qr" src=${link.qr} alt=${t('drivers.qrOf', of)} />`}
    </div></li>`;
}

const timeOf = (instant) =>
  new Date(instant).toLocaleTimeString(language(), { timeStyle: 'short' });

/** Tell whether what changed is about a vehicle whose driver has not said that it was seen. */
function isNewTo({ vehicle, seen_at: seen }, { changes, changedAt }, before) {
  const isAbout = [...changes].some(([key, change]) => ['new', 'moved', 'out'].includes(change.kind)
    && [change.vehicle, before?.halts.get(key)?.vehicle.name].includes(vehicle));
  return isAbout && !(new Date(seen ?? 0).getTime() >= changedAt);
}

const DELAYS = [10, 20, 30, 60, 120]; // minutes

/** What the desk may tell of a vehicle on the road. */
function LiveTellings({ link, of }) {
  const { vehicle } = link;
  const undone = isBrokenDown(link);
  return html`<button type="button" aria-label=${undone ? null : t('drivers.brokenOf', of)}
      onClick=${() => tell({ kind: 'vehicle.broken', vehicle, ...(undone && { undone }) })}>
      ${undone ? t('live.whole') : t('drivers.broken')}</button>
    <select aria-label=${t('live.delayOf', of)} value="" onChange=${({ target }) => {
      tell({ kind: 'vehicle.delayed', vehicle, by: 60 * Number(target.value) });
      target.value = '';
    }}><option value="">${t('live.delay')}</option>
      ${DELAYS.map((minutes) => html`<option key=${minutes} value=${minutes}>
        +${duration(60 * minutes)}</option>`)}</select>`;
}

function Failures({ links }) {
  const rows = links.flatMap(({ vehicle, standing }) =>
    standing
      .filter(({ state }) => state === 'failed')
      .map((step) => ({ vehicle, key: `${vehicle} ${step.id}`, ...step })));
  if (!rows.length) return null;
  return html`<section class="section"><h3>${t('drivers.failed')}</h3><ul>${rows.map(
    ({ key, vehicle, place, reason, time }) => html`<li key=${key}>${place},
      ${nameOfVehicle(vehicle)},
      ${' '}${clock(time)}: ${driverReason(reason)}</li>`,
  )}</ul></section>`;
}
