/** Replanning: go on from a plan while its day is under way, or search on from it. */

import { besidePlan, edit, shownPlan } from '../actions.js';
import { clock, money, parseClock, signed } from '../core/format.js';
import { nowOf } from '../core/orders.js';
import { setIn } from '../core/paths.js';
import { fromNothing } from '../core/replanning.js';
import { saidOf } from '../core/said.js';
import { judged, servesFewer, trueCost } from '../core/terms.js';
import { html, useLayoutEffect, useState } from '../libraries.js';
import { goOnWith, replanFrom } from '../ordering.js';
import { improvePlan, plan } from '../planning.js';
import { store, useStore } from '../store.js';
import { Differences } from './changes-tab.js';
import { Errors, errorsAt } from './replan-errors.js';
import { News } from './replan-news.js';
import { Outcome } from './replan-outcome.js';
import { PinnedCustomers, Vehicles } from './replan-vehicles.js';
import { parts, t } from '../texts.js';

/** The tab. */
export function ReplanTab() {
  const request = useStore((state) => state.request);
  const entry = useStore(shownPlan);
  const former = useStore(besidePlan);
  const isResult = Boolean(entry?.plan.replan) && entry.plan !== request.replan?.plan;
  if (!entry && !request.replan) return html`<p class="empty">${t('timeline.nothing')}</p>`;
  return html`
    ${request.replan ? html`<${Draft} request=${request} entry=${entry} />`
      : html`<${Beginning} entry=${entry} />`}
    ${isResult && html`<${Outcome} entry=${entry} />`}
    ${isResult && former && html`<${Differences} entry=${entry} former=${former} />`}`;
}

/** Before anything is settled: from when on, or look for a cheaper plan. */
function Beginning({ entry }) {
  const time = useStore((state) => state.time);
  return html`<section class="section"><h3>${t('replan.title')}</h3>
      <p class="help">${t('replan.help')}</p>
      <${Now} value=${minuteOf(time) ?? nowOf(entry.request)} label=${t('player.replan')}
        onSet=${replanFrom} />
    </section>
    <${Improve} entry=${entry} />`;
}

function minuteOf(time) {
  return time === null ? null : Math.round(time / 60) * 60;
}

function Improve({ entry }) {
  const busy = useStore((state) => state.run.state !== 'idle');
  return html`<section class="section"><h3>${t('replan.improve')}</h3>
    <p class="help">${t('replan.improveHelp', { name: entry.name })}</p>
    <div class="buttons"><button type="button" disabled=${busy}
      onClick=${improvePlan}>${t('replan.improve')}</button></div></section>`;
}

/** A time of day, taken from the clock of the day or typed. */
function Now({ value, label, onSet, errors = [], primary = true }) {
  const [text, setText] = useState('');
  useLayoutEffect(() => setText(clock(value, { precise: true })), [value]);
  const now = parseClock(text);
  const isWrong = now === null || now < 0;
  const id = 'field-replan-freeze_before';
  return html`<div class=${`field now ${errors.length ? 'invalid' : ''}`}>
    <label for=${id}>${t('field.freeze_before')}</label>
    <input type="text" id=${id} value=${text} placeholder="--:--" autocomplete="off"
      aria-invalid=${(isWrong && text !== '') || errors.length > 0}
      aria-describedby="replan-now-error"
      onInput=${(event) => setText(event.target.value)}
      onKeyDown=${(event) => event.key === 'Enter' && !isWrong && onSet(now)} />
    <button type="button" class=${primary ? 'primary' : ''} disabled=${isWrong || now === value
      && !primary} onClick=${() => onSet(now)}>${label}</button>
    <p class="error" id="replan-now-error">${errors.map(saidOf).join(' ')}
      ${isWrong && text !== '' ? t('replan.clock', { example: '10:30' }) : ''}</p></div>`;
}

/** What goes on from which plan, what is new, and which vehicles can do it. */
function Draft({ request, entry }) {
  const errors = useStore((state) => state.errors);
  const time = useStore((state) => state.time);
  const basis = useStore(({ plans, request: { replan } }) =>
    plans.find((other) => other.plan === replan?.plan));
  const now = request.replan.freeze_before ?? null;
  const name = basis ? t('replan.quoted', { name: basis.name }) : t('replan.given');
  const set = (instant) =>
    goOnWith((edited) => setIn(edited, ['replan', 'freeze_before'], instant), basis?.request);
  const isFurther = entry && entry.plan !== request.replan.plan;
  return html`<section class="section">
      <h3>${now === null
        ? t('replan.from', { name })
        : t('replan.fromAt', { name, at: clock(now, { precise: true }) })}</h3>
      <${Errors} errors=${errorsAt(errors, (keys) => keys.length < 2)} />
      <${Now} value=${now} label=${t('replan.change')} onSet=${set} primary=${false}
        errors=${errorsAt(errors, (keys) => keys[1] === 'freeze_before')} />
      <${Verdict} />
      <div class="buttons">
        <button type="button" class="primary" onClick=${plan}>${t('header.goOn')}</button>
        ${time !== null && minuteOf(time) !== now && html`<button type="button"
          onClick=${() => set(minuteOf(time))}>${t('replan.moveTo', { at: clock(time) })}</button>`}
        ${isFurther && html`<button type="button"
          onClick=${() => replanFrom(minuteOf(time) ?? now ?? 0)}>
          ${t('replan.goOn')}</button>`}
        ${isFurther && html`<button type="button"
          onClick=${improvePlan}>${t('replan.improveNew')}</button>`}
        <button type="button" onClick=${() => edit(fromNothing(request))}>
          ${t('replan.stop')}</button>
      </div></section>
    <${News} request=${request} basis=${basis} />
    <${Vehicles} request=${request} basis=${basis} errors=${errors} />
    <${PinnedCustomers} request=${request} errors=${errors} />`;
}

/** What the plan costs beside the former, in a line. */
function Verdict() {
  const entry = useStore(shownPlan);
  const former = useStore(besidePlan);
  const request = useStore((state) => state.request);
  if (!former || !entry?.plan.replan || entry.plan === request.replan?.plan) return null;
  const [now, before] = [entry, former].map(trueCost);
  const out = entry.plan.unassigned.length;
  return html`<p id="replan-verdict">${parts('replan.verdict', {
    cost: html`<strong>${money(now)}</strong>`,
    change: html`<span class=${judged(now - before, servesFewer(entry, former))}>${
      signed(now - before)}</span>`,
    name: former.name,
  })}${out > 0 && html`; <button type="button" class="link"
      onClick=${() => store.set({ tab: 'unassigned' })}>${
        t('replan.out', { count: out })}</button>`}.</p>`;
}
