/** What if: change one thing, plan, and see the plan beside the former. */

import { besidePlan, edit, editedTo, renamePlan, select, shownPlan } from '../actions.js';
import {
  addDrone, addVehicles, changeWindows, giveWindows, withoutDrones,
} from '../core/changes.js';
import {
  movedCustomers, planDifference, planMeasures, renamedTours, requestDifferences,
} from '../core/differences.js';
import { droneCount } from '../core/drones.js';
import { fromNothing } from '../core/replanning.js';
import { clock, km, money, number, percent, signed } from '../core/format.js';
import { matchVehicles } from '../core/matching.js';
import { costTerms, judged, penaltyOf, servesFewer, trueCost } from '../core/terms.js';
import { html } from '../libraries.js';
import { plan } from '../planning.js';
import { store, useStore } from '../store.js';
import { Change } from './change-words.js';
import { windowsOf } from '../core/windows.js';
import { WindowFields } from './window-fields.js';
import { t } from '../texts.js';

const MOST_LISTED = 40;
const SOFT_COST = 30; // per hour

/** The tab. */
export function ChangesTab() {
  const entry = useStore(shownPlan);
  const former = useStore(besidePlan);
  return html`<${Changes} /><${Plans} />
    ${entry && former
        ? html`<${Differences} entry=${entry} former=${former} />`
        : html`<p class="help">${t('whatIf.help')}</p>`
    }`;
}

/** Change the problem and plan it at once. */
function changeAndPlan(change) {
  edit(change);
  plan();
}

function Changes() {
  const request = useStore((state) => state.request);
  const hasDrones = request.fleet.some((type) => droneCount(type));
  const windows = request.customers.filter((customer) => windowsOf(customer).length).length;
  const onlyOne = request.fleet.length === 1;
  return html`<section class="section"><h3>${t('whatIf.title')}</h3>
    ${request.fleet.map((type, position) => html`<div class="buttons" key=${position}>
      <span class="whole-line">${t('whatIf.now', { id: type.id, count: type.count })}${
        droneCount(type) > 0 && t('whatIf.withDrones', { count: droneCount(type) })}</span>
      <button type="button" disabled=${onlyOne && type.count === 1}
        aria-label=${t('whatIf.fewerOf', { id: type.id })}
        onClick=${() => changeAndPlan(addVehicles(request, position, -1))}>
        ${t('whatIf.fewer')}</button>
      <button type="button" aria-label=${t('whatIf.moreOf', { id: type.id })}
        onClick=${() => changeAndPlan(addVehicles(request, position, 1))}>
        ${t('whatIf.more')}</button>
      <button type="button" aria-label=${t('whatIf.addDroneOf', { id: type.id })}
        onClick=${() => changeAndPlan(addDrone(request, position))}>
        ${t('whatIf.addDrone')}</button></div>`)}
    <div class="buttons">
      <button type="button" disabled=${!hasDrones}
        onClick=${() => changeAndPlan(withoutDrones(request))}>
        ${t('whatIf.dronesOff')}</button>
      <button type="button" disabled=${!windows}
        onClick=${() => changeAndPlan(changeWindows(request, null))}>
        ${t('whatIf.windowsOff')}</button>
      <button type="button" disabled=${!windows}
        onClick=${() => changeAndPlan(changeWindows(request, SOFT_COST))}>
        ${t('whatIf.windowsSoft', { cost: SOFT_COST })}</button>
    </div>
    <${WindowChange} request=${request} />
  </section>`;
}

function WindowChange({ request }) {
  const selection = useStore((state) => state.selection);
  const id = selection?.startsWith('c:') ? selection.slice(2) : request.customers[0]?.id;
  const customer = request.customers.find((other) => other.id === id);
  if (!customer) return null;
  return html`<div class="buttons"><label>${t('whatIf.windowOf')}
    ${' '}<select value=${id} aria-label=${t('whatIf.customer')}
      onChange=${(event) => select(`c:${event.target.value}`)}>
      ${request.customers.map((other) => html`<option key=${other.id}
        value=${other.id}>${other.id}</option>`)}
    </select></label>
    <${WindowFields} customer=${customer}
      onApply=${(windows) => changeAndPlan(giveWindows(request, [id], windows))} /></div>`;
}

function Plans() {
  const plans = useStore((state) => state.plans);
  const shown = useStore((state) => state.shown);
  const besides = useStore((state) => state.besides);
  if (!plans.length) return null;
  const open = (number) =>
    store.set((state) => ({
      shown: number,
      selection: null,
      hover: null,
      besides: state.besides === number ? state.shown : state.besides,
      ...editedTo(state, state.plans.find((entry) => entry.number === number).request),
    }));
  return html`<section class="section"><h3>${t('whatIf.plans')}</h3>
    <table><thead><tr><th scope="col">${t('whatIf.plan')}</th>
      <th scope="col" class="number">${t('whatIf.cost')}</th>
      <th scope="col" class="number">${t('whatIf.served')}</th>
      <th scope="col">${t('whatIf.shown')}</th>
      <th scope="col">${t('whatIf.beside')}</th></tr></thead>
    <tbody>${plans.map(
      (entry) => html`<tr key=${entry.number}>
      <th scope="row"><${PlanName} entry=${entry} /></th>
      <td class="number">${money(trueCost(entry))}</td>
      <td class="number">${served(entry.plan.summary)}</td>
      <td><input type="radio" name="shown" aria-label=${t('whatIf.show', { name: entry.name })}
        checked=${shown === entry.number} onChange=${() => open(entry.number)} /></td>
      <td><input type="radio" name="besides" 
        aria-label=${t('whatIf.putBeside', { name: entry.name })}
        disabled=${shown === entry.number} checked=${besides === entry.number}
        onChange=${() => store.set({ besides: entry.number })} /></td></tr>`,
    )}</tbody></table></section>`;
}

function served({ served: number, customers }) {
  return number < customers ? t('whatIf.servedOf', { number, customers }) : number;
}

/** The name of a plan, which can be written over. */
function PlanName({ entry }) {
  const commit = (event) => {
    const name = event.target.value.trim();
    if (name) renamePlan(entry.number, name);
    else event.target.value = entry.name;
  };
  return html`<input type="text" class="plan-name" value=${entry.name} title=${entry.name}
    aria-label=${t('whatIf.nameOf', { number: entry.number })}
    maxlength="100" onChange=${commit} />`;
}

const SHOWN = { distance: km, drone_distance: km, makespan: clock, load_rate: percent };

/** What changed in the problem and in the plan between two entries of the plans. */
export function Differences({ entry, former }) {
  const changes = requestDifferences(
    fromNothing(former.request),
    fromNothing(entry.request),
  ).filter(({ path }) => !path.startsWith('options'));
  const pairs = matchVehicles(former, entry);
  const moved = movedCustomers(former, entry, pairs);
  return html`<section class="section"
    id="differences"><h3>${t('whatIf.besideOf', { name: entry.name, former: former.name })}</h3>
    <p id="plan-difference"><strong>${planDifference(former, entry)}</strong></p>
    ${changes.length > 0
        ? html`<ul>${changes.slice(0, MOST_LISTED).map(
            (change) => html`<li key=${change.path}><${Change} ...${change} /></li>`,
          )}
      ${changes.length > MOST_LISTED && html`<li>${t('app.more', {
        count: changes.length - MOST_LISTED,
      })}</li>`}</ul>`
        : html`<p class="help">${t('whatIf.same')}</p>`
    }
    <${Figures} entry=${entry} former=${former} />
    <${Tours} tours=${renamedTours(pairs)} />
    <h4>${t('whatIf.moved', { count: moved.length })}</h4>
    <table><tbody>${moved.slice(0, MOST_LISTED).map(
      ({ id, before, now }) => html`<tr key=${id}>
      <th scope="row"><button type="button" class="link"
        onClick=${() => select(`c:${id}`)}>${id}</button></th>
      <td>${before ?? t('whatIf.notThere')}</td><td>${now ?? t('whatIf.notThere')}</td></tr>`,
    )}</tbody></table>
    ${moved.length > MOST_LISTED && html`<p class="help">${t('app.more', {
      count: moved.length - MOST_LISTED,
    })}</p>`}
  </section>`;
}

/** Costs and measures of two plans; penalties that nobody stated stand apart from what is paid. */
function Figures({ entry, former }) {
  const both = [former, entry];
  const costs = both.map(({ plan }) => plan.cost);
  const penalties = both.map(penaltyOf);
  const isForFewer = servesFewer(entry, former);
  /** @type {(name: string, both: any[], show?: any, isCost?: boolean) => any} */
  const line = (name, [before, now], show = money, isCost = true) => html`<${Difference}
    key=${name} name=${name} before=${before} now=${now} show=${show}
    judge=${(change) => (isCost ? judged(change, isForFewer) : '')} />`;
  const paid = (term) => costs.map((cost, index) =>
    (cost[term] ?? 0) - (term === 'unassigned' ? penalties[index] : 0));
  return html`<table><thead><tr><th scope="col"></th>
      <th scope="col" class="number">${former.name}</th>
      <th scope="col" class="number">${entry.name}</th>
      <th scope="col" class="number">${t('whatIf.difference')}</th></tr></thead><tbody>
    ${line(t('whatIf.costs'), both.map(trueCost))}
    ${costTerms(...costs)
      .filter(([term]) => term !== 'unassigned' || paid(term).some((amount) => amount > 0))
      .map(([term, name]) => line(name, paid(term)))}
    ${planMeasures(former.plan, entry.plan).map(({ key, name, before, now }) =>
      line(name, [before, now], SHOWN[key] ?? ((value) => number(value, 0)), false))}
    ${penalties.some(Boolean) && html`${line(t('whatIf.penalty'), penalties)}
      ${line(t('whatIf.withPenalty'), costs.map(({ total }) => total))}`}
  </tbody></table>
  ${penalties.some(Boolean) && html`<p class="help">${t('whatIf.penaltyHelp')}</p>`}`;
}

/** Tours that go on under another vehicle's name. */
function Tours({ tours }) {
  if (!tours.length) return null;
  return html`<ul>${tours.map(({ before, now, shared }) => html`<li key=${now}>${
    t('whatIf.renamed', { now, before, count: shared })}</li>`)}</ul>`;
}

function Difference({ name, before, now, show, judge }) {
  const change = now - before;
  return html`<tr><th scope="row">${name}</th><td class="number">${show(before)}</td>
    <td class="number">${show(now)}</td>
    <td class=${`number ${judge(change)}`}>${signed(change, show)}</td></tr>`;
}
