/** What the plan costs, by term and by vehicle, beside the former plan if one is chosen. */

import { besidePlan, shownPlan } from '../actions.js';
import { duration, km, money, number, percent } from '../core/format.js';
import { legsInWords } from '../core/legs.js';
import { costTerms } from '../core/terms.js';
import { html } from '../libraries.js';
import { useStore } from '../store.js';
import { DronesWorth } from './drones-worth.js';
import { ShareBar } from './parts.js';

/** The tab. */
export function CostsTab() {
  const entry = useStore(shownPlan);
  const former = useStore(besidePlan);
  if (!entry) return html`<p class="empty">Nothing is planned yet.</p>`;
  const { plan } = entry;
  return html`<section class="section"><h3>Cost by term</h3>
      <table><thead><tr><th scope="col">Term</th><th scope="col" class="number">Cost</th>
        <th scope="col">Share</th></tr></thead>
      <tbody>${costTerms(plan.cost).map(
        ([term, name]) => html`<tr key=${term}><th scope="row">${name}</th>
        <td class="number">${money(plan.cost[term])}</td>
        <td><${ShareBar} share=${shareOf(plan.cost, term)} text=${percent(shareOf(plan.cost, term))}
          label=${name} /></td></tr>`,
      )}
        <tr><th scope="row"><strong>Total</strong></th>
          <td class="number"><strong>${money(plan.cost.total)}</strong></td><td></td></tr></tbody>
            </table>
      ${former && html`<p class="help">
        What if shows this plan beside \u201c${former.name}\u201d.</p>`}
    </section>
    <section class="section"><h3>Cost by vehicle</h3>
      <table><thead><tr><th scope="col">Vehicle</th><th scope="col" class="number">Cost</th>
        <th scope="col">Works</th></tr></thead>
      <tbody>${plan.routes.map(
        (route) => html`<tr key=${route.vehicle}><th scope="row">${route.vehicle}</th>
        <td class="number">${money(route.cost)}</td><td>${duration(route.working_duration)}</td>
          </tr>`,
      )}
      </tbody></table></section>
    <${DronesWorth} />
    <${Summary} summary=${plan.summary} />
    <${Legs} legs=${plan.legs} />`;
}

function shareOf(cost, term) {
  return cost.total > 0 ? cost[term] / cost.total : 0;
}

function Legs({ legs }) {
  const lines = legsInWords(legs);
  if (lines.length === 0) return null;
  return html`<section class="section"><h3>Driving</h3>${lines.map(
    (line) => html`<p class="help" key=${line}>${line}</p>`,
  )}</section>`;
}

function Summary({ summary }) {
  const rates = summary.load_rate;
  const rows = [
    ['Driven', km(summary.distance)],
    ['Flown', km(summary.drone_distance)],
    ...(summary.energy_wh == null
      ? []
      : [['Energy of flights', `${number(summary.energy_wh, 1)} Wh`]]),
    ['Trips', number(summary.trips, 0)],
    ['Flights', number(summary.sorties, 0)],
    ...(summary.co2_kg == null ? [] : [['CO\u2082', `${number(summary.co2_kg, 1)} kg`]]),
    ['Load rate', `${percent(rates.min)} to ${percent(rates.max)}, mean ${percent(rates.mean)}`],
  ];
  return html`<section class="section"><h3>In numbers</h3><table><tbody>${rows.map(
    ([name, value]) => html`<tr key=${name}><th scope="row">${name}</th><td>${value}</td></tr>`,
  )}</tbody></table></section>`;
}
