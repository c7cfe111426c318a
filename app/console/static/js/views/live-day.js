/** The day as it happens: what is asked, who is late, who waits, what changed a moment ago. */

import { shownPlan, indexOf } from '../actions.js';
import { driverReason } from '../core/dispatches.js';
import { clock, duration, money } from '../core/format.js';
import {
  doubtsOf, lateInWords, lateOf, liveRemedyInWords, remedyFor, slotInWords, waitingOf,
} from '../core/living.js';
import { saidOf } from '../core/said.js';
import { nameOfVehicle } from '../core/vehicle-labels.js';
import { html, useState } from '../libraries.js';
import { seeChanges, tell } from '../living.js';
import { answerQuote } from '../quoting.js';
import { useStore } from '../store.js';
import { NewOrder } from './new-order.js';
import { SelectButton } from './parts.js';
import { t } from '../texts.js';

const MOST = 30; // rows of a list
const ON_WALL = 6;
const STEPS = [300, 3600]; // seconds that a rehearsal goes on by

/** What is to be decided, and what is to be known. */
export function LiveDay() {
  const live = useStore((state) => state.live);
  const index = indexOf(useStore(shownPlan));
  const { day, changes, isWall, told } = live;
  const most = isWall ? ON_WALL : MOST;
  const late = lateOf(day, index);
  const waiting = waitingOf(day, index?.plan);
  const changed = [...changes].filter(([, { kind }]) => kind !== 'out');
  const news = told.slice(-MOST).reverse();
  return html`<div class="live-day">
    ${day.failure && html`<p class="error" role="alert" title=${day.failure}>${
      t('live.failure')}</p>`}
    ${day.is_rehearsed && !isWall && html`<${Clock} now=${day.now} />`}
    <${Doubts} day=${day} index=${index} isAsked=${!isWall} />
    ${!isWall && (live.quote ? html`<${Quote} quote=${live.quote} />` : html`<${NewOrder} />`)}
    <${Listed} name="late" rows=${late} most=${most} row=${(order) =>
      html`<${SelectButton} of=${order.key}>${order.id}</${SelectButton}>
        <span>${nameOfVehicle(order.vehicle)}, ${clock(order.arrival)}</span>
        <span class=${`news ${live.news.get(order.key)?.kind}`}>${lateInWords(order)}</span>
        ${!isWall && html`<${Mended} order=${order} remedy=${remedyFor(day, order)} />`}`} />
    <${Listed} name="waiting" rows=${waiting} most=${most} row=${({ key, id, why, isByHand }) =>
      html`<${SelectButton} of=${key}>${id}</${SelectButton}> <span>${why}</span>
        ${isByHand && !isWall && html` <button type="button"
          aria-label=${t('live.planAgainOf', { id })} onClick=${() =>
            tell({ kind: 'order.pinned', order: id, undone: true })}>${
              t('live.planAgain')}</button>`}`} />
    <${Listed} name="changed" rows=${changed} most=${most} row=${([key, { kind, text }]) =>
      html`<${SelectButton} of=${key}>${key.slice(2)}</${SelectButton}>
        <span>${placeOf(index?.halts.get(key))}</span>
        <span class=${`news ${kind}`}>${text}</span>`}>
      ${!isWall && html`<button type="button" onClick=${seeChanges}>${t('live.seen')}</button>`}
    </${Listed}>
    <${Listed} name="told" rows=${news} most=${most} row=${(event) =>
      html`<span>${clock(event.at)}</span> <span>${inWords(event)}</span>`} />
  </div>`;
}

/** What time it is on a day that goes by what it is told, and steps on. */
function Clock({ now }) {
  return html`<section class="section"><h3>${t('live.rehearsed', { at: clock(now) })}</h3>
    <div class="buttons">${STEPS.map((step) => html`<button type="button" key=${step}
      onClick=${() => tell({ kind: 'clock', at: now + step })}>+${duration(step)}</button>`)}
    </div></section>`;
}

/** What serves an order sooner, done by one click. */
function Mended({ order, remedy }) {
  if (!remedy) return null;
  const words = liveRemedyInWords(remedy);
  return html`<span class="buttons"><span>${words}</span> <button type="button"
    aria-label=${t('live.mendOf', { id: order.id, remedy: words })}
    onClick=${() => tell(...remedy.events)}>${t('live.mend')}</button></span>`;
}

/** Return what was told from the road, in words. */
function inWords({ kind, vehicle, reason, about }) {
  const name = kind.replace('.', '_');
  return [vehicle && nameOfVehicle(vehicle), t(`live.kind.${name}`),
    about.order ?? about.orders?.join(', '), reason && driverReason(reason)]
    .filter(Boolean).join(', ');
}

function placeOf(halt) {
  return halt && `${nameOfVehicle(halt.vehicle.name)}, ${clock(halt.arrival)}`;
}

/** A list with its title and count; nothing where it is empty. */
function Listed({ name, rows, most, row, children }) {
  if (!rows.length) return null;
  return html`<section class="section listed" data-list=${name}>
    <div class="buttons"><h3>${t(`live.list.${name}`, { count: rows.length })}</h3>
      ${children}</div>
    <ul>${rows.slice(0, most).map((each, at) => html`<li key=${at}>${row(each)}</li>`)}</ul>
    ${rows.length > most && html`<p class="help">${t('app.more', {
      count: rows.length - most })}</p>`}</section>`;
}

/** Orders of which nobody told, asked by vehicle: all of one are answered together. */
function Doubts({ day, index, isAsked }) {
  const doubts = doubtsOf(day);
  if (!doubts.length) return null;
  return html`<section class="section listed untold" data-list="doubts">
    <h3>${t('untold.title')}</h3>
    ${doubts.map(([vehicle, orders]) => html`<${VehicleDoubts} key=${vehicle} vehicle=${vehicle}
      orders=${orders} index=${index} now=${day.now} isAsked=${isAsked} />`)}</section>`;
}

function VehicleDoubts({ vehicle, orders, index, now, isAsked }) {
  const [answers, setAnswers] = useState({});
  const answer = (ids, kind) => {
    const all = { ...answers, ...Object.fromEntries(ids.map((id) => [id, kind])) };
    setAnswers(all);
    // A vehicle has done what was told of it, no more: one answer alone would be for all.
    if (!orders.every(({ id }) => all[id])) return;
    tell(...orders.map(({ id }) => ({
      kind: all[id], vehicle, order: id,
      at: Math.min(index?.halts.get(`c:${id}`)?.departure ?? now, now),
      ...(all[id] === 'vehicle.failed' && { reason: t('live.unserved') }),
    })));
  };
  const button = (ids, kind, text, label) => html`<button type="button" aria-label=${label}
    aria-pressed=${ids.every((id) => answers[id] === kind)}
    onClick=${() => answer(ids, kind)}>${text}</button>`;
  const ids = orders.map(({ id }) => id);
  return html`<fieldset><legend>${nameOfVehicle(vehicle)}</legend>
    ${isAsked && orders.length > 1 && html`<div class="buttons">
      ${button(ids, 'vehicle.served', t('live.allServed'))}</div>`}
    <ul>${orders.map(({ id, arrival }) => html`<li key=${id}>
      <span>${t('untold.served', { customer: id, at: clock(arrival) })}</span>
      ${isAsked && html`<span class="buttons">
        ${button([id], 'vehicle.served', t('live.served'), t('live.servedOf', { id }))}
        ${button([id], 'vehicle.failed', t('live.unserved'), t('live.unservedOf', { id }))}
      </span>`}</li>`)}</ul></fieldset>`;
}

/** The slots of a quote, one of which may be accepted. */
function Quote({ quote }) {
  const { customer, slots, best } = quote;
  return html`<section class="card quote" aria-label=${t('live.quote', { id: customer.id })}>
    <header><strong>${t('live.quote', { id: customer.id })}</strong></header>
    <ul class="inside">${slots.map((slot, at) => html`<li key=${at} data-best=${at === best}>
      <span>${slotInWords(slot)}</span>
      ${slot.feasible ? html`<span>${nameOfVehicle(slot.vehicle)}, ${clock(slot.arrival)}</span>
        <strong>${money(slot.cost)}</strong>
        <button type="button" class=${at === best ? 'primary' : ''}
          aria-label=${t('live.acceptOf', { slot: slotInWords(slot) })}
          onClick=${() => answerQuote(at)}>${t('live.accept')}</button>`
        : html`<span class="help">${slot.why.length ? saidOf(slot.why[0])
          : t('live.noRoom')}</span>`}</li>`)}</ul>
    <div class="buttons inside"><button type="button" onClick=${() => answerQuote(null)}>${
      t('live.dismiss')}</button></div></section>`;
}
