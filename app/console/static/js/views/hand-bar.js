/** What was changed by hand and how it was judged, and the best places of a customer. */

import { hover, openTab, shownPlan } from '../actions.js';
import { money, signed } from '../core/format.js';
import { placeInWords, rulesInWords } from '../core/hands-words.js';
import { judged, trueCost } from '../core/terms.js';
import { nameOfVehicle } from '../core/vehicle-labels.js';
import { isOnTheRoad, sendOut } from '../dispatching.js';
import { isFurther, redoStep, stepBack, stepForth, takeFit, undoStep } from '../hands.js';
import { html } from '../libraries.js';
import { improvePlan } from '../planning.js';
import { store, useStore } from '../store.js';
import { parts, t } from '../texts.js';

const MOST_RULES = 6;

/** Above the open tab, while there is something to tell. */
export function HandBar() {
  const entry = useStore(shownPlan);
  const judging = useStore((state) => state.judging);
  const asked = useStore((state) => state.fit);
  const fit = asked && asked.entry.plan === entry?.plan ? asked : null;
  const hand = entry?.hand;
  const isBroken = !fit && hand?.violations.length > 0;
  return html`<section class=${`hand-bar ${isBroken ? 'broken' : ''}`} aria-live="polite"
    aria-label=${t('hand.title')}>${
      judging && html`<p>${t('hand.judging', { what: judging })}</p>`}${
      fit && html`<${Fit} fit=${fit} />`}${
      !fit && !judging && hand && html`<${Outcome} entry=${entry} />`}${
      !fit && !judging && !hand && html`<${Again} />`}</section>`;
}

function Outcome({ entry }) {
  const { words, change, penalty, before, fromName, violations } = entry.hand;
  const rules = rulesInWords(violations, entry.plan.routes);
  const busy = useStore((state) => state.run.state !== 'idle');
  const isLive = useStore((state) => state.live !== null);
  const isBack = useStore((state) => Boolean(stepBack(state)));
  const isForth = useStore((state) => Boolean(stepForth(state)));
  const whole = trueCost(entry) - before;
  return html`<p id="hand-outcome">${words}: <strong class=${judged(change, penalty > 0)}>${
      signed(change)}</strong>${Math.abs(whole - change) > 0.005 && html`, ${parts('hand.whole', {
        sum: html`<strong class=${judged(whole, penalty > 0)}>${signed(whole)}</strong>`,
        name: fromName,
      })}`}${Math.abs(penalty) > 0.005
        && html`; ${t('hand.penalty', { sum: signed(penalty) })}`}</p>
    ${rules.length > 0 && html`<p class="late-text">${t('hand.breaks', { count: rules.length })}</p>
      <ul>${rules.slice(0, MOST_RULES).map((rule) => html`<li key=${rule}>${rule}</li>`)}
      ${rules.length > MOST_RULES && html`<li>${t('app.more', {
        count: rules.length - MOST_RULES,
      })}</li>`}</ul>`}
    <div class="buttons">
      <button type="button" disabled=${!isBack} onClick=${undoStep}>${t('hand.undo')}</button>
      <button type="button" disabled=${!isForth} onClick=${redoStep}>${t('hand.redo')}</button>
      ${!isLive && html`<button type="button" disabled=${busy} onClick=${improvePlan}>
        ${t('hand.improve')}</button>`}
      ${!isLive && !rules.length && html`<${SendNow} />`}
    </div>`;
}

/** Sends the changed plan to its drivers, unless they have links: the header sends it to those. */
function SendNow() {
  const isSent = useStore(isOnTheRoad);
  const send = async () => {
    await sendOut();
    openTab('drivers');
  };
  return !isSent && html`<button type="button" class="primary" onClick=${send}>${
    t('drivers.sendOut')}</button>`;
}

/** What was just taken back can be made again. */
function Again() {
  const step = useStore(stepForth);
  return step && html`<div class="buttons"><span>${
    t('hand.takenBack', { what: step.after.entry.hand.words })}</span>
    <button type="button" onClick=${redoStep}>${t('hand.redo')}</button></div>`;
}

function Fit({ fit }) {
  const { customer, told } = fit;
  const close = () => store.set({ fit: null });
  return html`<p><strong>${t('hand.bestFor', { id: customer.id })}</strong>
      ${told?.here && `, ${t('hand.nowWith', {
        vehicle: nameOfVehicle(told.here.vehicle),
        cost: money(told.here.saving.total),
      })}`}</p>
    ${!told && html`<p>${t('hand.trying')}</p>`}
    ${told && html`<ol class="places">${told.places.map(
      (place, position) => html`<${Place} key=${position} fit=${fit} place=${place} />`)}</ol>
      ${told.others.length > 0 && html`<details><summary>${
        t('hand.others', { count: told.others.length })}</summary><ul>${told.others.map(
        (place, position) => html`<li key=${position}>${placeInWords(place).join(', ')}: ${
          place.feasible ? signed(place.cost.total, money)
            : rulesInWords(place.reasons).join(' ')}</li>`)}</ul></details>`}
      ${!told.complete && html`<p class="help">${t('why.ask.noTime')}</p>`}`}
    <div class="buttons"><button type="button" onClick=${close}>${t('app.close')}</button></div>`;
}

function Place({ fit, place }) {
  const [who, where] = placeInWords(place);
  return html`<li onMouseEnter=${() => hover(keyOf(place))} onMouseLeave=${() => hover(null)}>
    <span>${who} <span class="help">${[where, ...notesOn(fit, place)].join(', ')}</span></span>
    <strong class="number">${signed(place.cost.total, money)}</strong>
    ${place.route && html`<button type="button" onClick=${() => takeFit(fit, place)}
      aria-label=${t('hand.takeOf', { who, where })}>${t('hand.take')}</button>`}
    ${!place.feasible && html`<span class="late-text">${
      rulesInWords(place.reasons).join(' ')}</span>`}</li>`;
}

/** Return what else is to be known of a place: an idle vehicle, a trip more than is allowed. */
function notesOn(fit, place) {
  const isIdle = fit.entry.plan.routes.every(({ vehicle }) => vehicle !== place.vehicle);
  return [
    ...(isIdle ? [t('orders.idle')] : []),
    ...(isFurther(fit, place) ? [t('orders.another')] : [])];
}

/** Return the key of the stop that a place comes after, which map and timeline mark. */
function keyOf({ position }) {
  return `c:${position.after}`;
}
