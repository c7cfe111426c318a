/** Replanning: go on from a plan while its day is under way, or search on from it. */

import { besidePlan, edit, shownPlan } from '../actions.js';
import { clock, money, number, parseClock, signed } from '../core/format.js';
import { nowOf } from '../core/orders.js';
import { setIn } from '../core/paths.js';
import { fromNothing } from '../core/replanning.js';
import { trueCost } from '../core/terms.js';
import { html, useLayoutEffect, useState } from '../libraries.js';
import { goOnWith, replanFrom } from '../ordering.js';
import { improvePlan, plan } from '../planning.js';
import { store, useStore } from '../store.js';
import { Differences } from './changes-tab.js';
import { Errors, errorsAt } from './replan-errors.js';
import { News } from './replan-news.js';
import { Outcome } from './replan-outcome.js';
import { PinnedCustomers, Vehicles } from './replan-vehicles.js';

/** The tab. */
export function ReplanTab() {
  const request = useStore((state) => state.request);
  const entry = useStore(shownPlan);
  const former = useStore(besidePlan);
  const isResult = Boolean(entry?.plan.replan) && entry.plan !== request.replan?.plan;
  if (!entry && !request.replan) return html`<p class="empty">Nothing is planned yet.</p>`;
  return html`
    ${request.replan ? html`<${Draft} request=${request} entry=${entry} />`
      : html`<${Beginning} entry=${entry} />`}
    ${isResult && html`<${Outcome} entry=${entry} />`}
    ${isResult && former && html`<${Differences} entry=${entry} former=${former} />`}`;
}

/** Before anything is settled: from when on, or look for a cheaper plan. */
function Beginning({ entry }) {
  const time = useStore((state) => state.time);
  return html`<section class="section"><h3>The day is under way</h3>
      <p class="help">Say what time it is: what has departed by then stays as it is in this plan,
        ${' '}and the rest is planned anew, with new orders, cancelled ones and
        broken vehicles.</p>
      <${Now} value=${minuteOf(time) ?? nowOf(entry.request)} label="Replan from here"
        onSet=${replanFrom} />
    </section>
    <${Improve} entry=${entry} />`;
}

function minuteOf(time) {
  return time === null ? null : Math.round(time / 60) * 60;
}

function Improve({ entry }) {
  const busy = useStore((state) => state.run.state !== 'idle');
  return html`<section class="section"><h3>Improve this plan</h3>
    <p class="help">Search on from \u201c${entry.name}\u201d for a cheaper one, as long as the time
      limit says.</p>
    <div class="buttons"><button type="button" disabled=${busy}
      onClick=${improvePlan}>Improve this plan</button></div></section>`;
}

/** A time of day, taken from the clock of the day or typed. */
function Now({ value, label, onSet, errors = [], primary = true }) {
  const [text, setText] = useState('');
  useLayoutEffect(() => setText(clock(value, { precise: true })), [value]);
  const now = parseClock(text);
  const isWrong = now === null || now < 0;
  const id = 'field-replan-freeze_before';
  return html`<div class=${`field now ${errors.length ? 'invalid' : ''}`}>
    <label for=${id}>Now</label>
    <input type="text" id=${id} value=${text} placeholder="10:30" autocomplete="off"
      aria-invalid=${(isWrong && text !== '') || errors.length > 0}
      aria-describedby="replan-now-error"
      onInput=${(event) => setText(event.target.value)}
      onKeyDown=${(event) => event.key === 'Enter' && !isWrong && onSet(now)} />
    <button type="button" class=${primary ? 'primary' : ''} disabled=${isWrong || now === value
      && !primary} onClick=${() => onSet(now)}>${label}</button>
    <p class="error" id="replan-now-error">${errors.map(({ message }) => message).join(' ')}
      ${isWrong && text !== '' ? 'State a time of day such as 10:30.' : ''}</p></div>`;
}

/** What goes on from which plan, what is new, and which vehicles can do it. */
function Draft({ request, entry }) {
  const errors = useStore((state) => state.errors);
  const time = useStore((state) => state.time);
  const basis = useStore(({ plans, request: { replan } }) =>
    plans.find((other) => other.plan === replan?.plan));
  const now = request.replan.freeze_before ?? null;
  const name = basis ? `\u201c${basis.name}\u201d` : 'the plan that came with the problem';
  const set = (instant) =>
    goOnWith((edited) => setIn(edited, ['replan', 'freeze_before'], instant), basis?.request);
  const isFurther = entry && entry.plan !== request.replan.plan;
  return html`<section class="section">
      <h3>Go on from ${name}${now === null ? '' : `, at ${clock(now, { precise: true })}`}</h3>
      <${Errors} errors=${errorsAt(errors, (keys) => keys.length < 2)} />
      <${Now} value=${now} label="Change" onSet=${set} primary=${false}
        errors=${errorsAt(errors, (keys) => keys[1] === 'freeze_before')} />
      <${Verdict} />
      <div class="buttons">
        <button type="button" class="primary" onClick=${plan}>Plan on</button>
        ${time !== null && minuteOf(time) !== now && html`<button type="button"
          onClick=${() => set(minuteOf(time))}>Move to ${clock(time)}</button>`}
        ${isFurther && html`<button type="button"
          onClick=${() => replanFrom(minuteOf(time) ?? now ?? 0)}>
          Go on from the new plan</button>`}
        ${isFurther && html`<button type="button"
          onClick=${improvePlan}>Improve the new plan</button>`}
        <button type="button" onClick=${() => edit(fromNothing(request))}>Stop replanning</button>
      </div></section>
    <${News} request=${request} basis=${basis} />
    <${Vehicles} request=${request} basis=${basis} errors=${errors} />
    <${PinnedCustomers} request=${request} errors=${errors} />`;
}

function judgeOf(change) {
  if (Math.abs(change) < 0.005) return '';
  return change > 0 ? 'delta-bad' : 'delta-good';
}

/** What the plan costs beside the former, in a line. */
function Verdict() {
  const entry = useStore(shownPlan);
  const former = useStore(besidePlan);
  const request = useStore((state) => state.request);
  if (!former || !entry?.plan.replan || entry.plan === request.replan?.plan) return null;
  const [now, before] = [entry, former].map(trueCost);
  const out = entry.plan.unassigned.length;
  return html`<p id="replan-verdict">The new plan costs <strong>${money(now)}</strong>,
    ${' '}<span class=${judgeOf(now - before)}>${signed(now - before)}
    </span> beside \u201c${former.name}\u201d${out > 0 && html`; <button type="button" class="link"
      onClick=${() => store.set({ tab: 'unassigned' })}>${number(out, 0)} left out</button>`}.</p>`;
}
