/** What if: change one thing, plan, and see the plan beside the former. */

import { besidePlan, edit, select, shownPlan } from '../actions.js';
import { addVehicles, changeWindows, giveWindows, withoutDrones } from '../core/changes.js';
import { movedCustomers, planMeasures, requestDifferences } from '../core/differences.js';
import { fromNothing } from '../core/replanning.js';
import { clock, count, km, money, number, percent, signed } from '../core/format.js';
import { costTerms } from '../core/terms.js';
import { html } from '../libraries.js';
import { plan } from '../planning.js';
import { store, useStore } from '../store.js';
import { Change } from './change-words.js';
import { windowsOf } from '../core/windows.js';
import { WindowFields } from './window-fields.js';

const MOST_LISTED = 40;
const SOFT_COST = 30; // per hour

/** The tab. */
export function ChangesTab() {
  const entry = useStore(shownPlan);
  const former = useStore(besidePlan);
  return html`<${Changes} /><${Plans} />
    ${
      entry && former
        ? html`<${Differences} entry=${entry} former=${former} />`
        : html`<p class="help">
          After a change the former plan stays, and the differences appear here.</p>`
    }`;
}

/** Change the problem and plan it at once. */
function changeAndPlan(change) {
  edit(change);
  plan();
}

function Changes() {
  const request = useStore((state) => state.request);
  const hasDrones = request.fleet.some((type) => type.drones?.count);
  const windows = request.customers.filter((customer) => windowsOf(customer).length).length;
  const onlyOne = request.fleet.length === 1;
  return html`<section class="section"><h3>Change one thing and plan again</h3>
    ${request.fleet.map(
      (type, position) => html`<div class="buttons" key=${position}>
      <button type="button" disabled=${onlyOne && type.count === 1}
        aria-label=${`One ${type.id} fewer`}
        onClick=${() => changeAndPlan(addVehicles(request, position, -1))}>One fewer</button>
      <button type="button" aria-label=${`One ${type.id} more`}
        onClick=${() => changeAndPlan(addVehicles(request, position, 1))}>One more</button>
      <span>${type.id}, now ${type.count}</span></div>`,
    )}
    <div class="buttons">
      <button type="button" disabled=${!hasDrones}
        onClick=${() => changeAndPlan(withoutDrones(request))}>
        Drones off</button>
      <button type="button" disabled=${!windows}
        onClick=${() => changeAndPlan(changeWindows(request, null))}>
        Windows off</button>
      <button type="button" disabled=${!windows}
        onClick=${() => changeAndPlan(changeWindows(request, SOFT_COST))}>
          Windows soft, ${SOFT_COST} per hour</button>
    </div>
    <${WindowChange} request=${request} />
  </section>`;
}

function WindowChange({ request }) {
  const selection = useStore((state) => state.selection);
  const id = selection?.startsWith('c:') ? selection.slice(2) : request.customers[0]?.id;
  const customer = request.customers.find((other) => other.id === id);
  if (!customer) return null;
  return html`<div class="buttons"><label>Window of <select value=${id} aria-label="Customer"
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
      request: state.plans.find((entry) => entry.number === number).request,
      past: [...state.past, state.request],
    }));
  return html`<section class="section"><h3>Plans</h3>
    <table><thead><tr><th scope="col">Plan</th><th scope="col" class="number">Cost</th>
      <th scope="col" class="number">Served</th><th scope="col">Shown</th><th
        scope="col">Beside</th></tr></thead>
    <tbody>${plans.map(
      ({ number: own, plan: { cost, summary } }) => html`<tr key=${own}>
      <th scope="row">Plan ${own}</th><td class="number">${money(cost.total)}</td>
      <td class="number">${summary.served}</td>
      <td><input type="radio" name="shown" aria-label=${`Show plan ${own}`} checked=${shown === own}
        onChange=${() => open(own)} /></td>
      <td><input type="radio" name="besides" aria-label=${`Put plan ${own} beside`}
        disabled=${shown === own} checked=${besides === own}
        onChange=${() => store.set({ besides: own })} /></td></tr>`,
    )}</tbody></table></section>`;
}

const SHOWN = { distance: km, drone_distance: km, makespan: clock, load_rate: percent };

/** What changed in the problem and in the plan between two entries of the plans. */
export function Differences({ entry, former }) {
  const changes = requestDifferences(
    fromNothing(former.request),
    fromNothing(entry.request),
  ).filter(({ path }) => !path.startsWith('options'));
  const moved = movedCustomers(former, entry);
  const head = html`<tr><th scope="col"></th><th scope="col"
    class="number">Plan ${former.number}</th>
    <th scope="col" class="number">Plan ${entry.number}</th><th scope="col"
      class="number">Difference</th></tr>`;
  const costs = [former.plan.cost, entry.plan.cost];
  return html`<section class="section"
    id="differences"><h3>Plan ${entry.number} beside plan ${former.number}</h3>
    ${
      changes.length > 0
        ? html`<ul>${changes.slice(0, MOST_LISTED).map(
            (change) => html`<li key=${change.path}><${Change} ...${change} /></li>`,
          )}
      ${changes.length > MOST_LISTED && html`<li>and ${changes.length - MOST_LISTED} more</li>`}
        </ul>`
        : html`<p class="help">The problem is the same.</p>`
    }
    <table><thead>${head}</thead><tbody>
      ${[['total', 'Total'], ...costTerms(...costs)].map(
        ([term, name]) => html`<${Difference} key=${term} name=${name}
        before=${costs[0][term] ?? 0} now=${costs[1][term] ?? 0} show=${money} cost />`,
      )}
      ${planMeasures(former.plan, entry.plan).map(
        ({ key, name, before, now }) => html`<${Difference}
        key=${key} name=${name} before=${before} now=${now}
          show=${SHOWN[key] ?? ((value) => number(value, 0))} />`,
      )}
    </tbody></table>
    <h4>${count(moved.length, 'customer')} with another vehicle, or none</h4>
    <table><tbody>${moved.slice(0, MOST_LISTED).map(
      ({ id, before, now }) => html`<tr key=${id}>
      <th scope="row"><button type="button" class="link"
        onClick=${() => select(`c:${id}`)}>${id}</button></th>
      <td>${before ?? 'not there'}</td><td>${now ?? 'not there'}</td></tr>`,
    )}</tbody></table>
    ${moved.length > MOST_LISTED && html`<p
      class="help">and ${moved.length - MOST_LISTED} more</p>`}
  </section>`;
}

function Difference({ name, before, now, show, cost = false }) {
  const change = now - before;
  const judged = !cost || Math.abs(change) < 0.005 ? '' : change < 0 ? 'delta-good' : 'delta-bad';
  return html`<tr><th scope="row">${name}</th><td class="number">${show(before)}</td>
    <td class="number">${show(now)}</td>
    <td class=${`number ${judged}`}>${signed(change, show)}</td></tr>`;
}
