/** What the plan costs, by term and by vehicle, beside the former plan if one is chosen. */

import { besidePlan, shownPlan } from '../actions.js';
import { flightCount } from '../core/drones.js';
import { duration, km, money, number, percent } from '../core/format.js';
import { legsInWords } from '../core/legs.js';
import { costTerms, penaltyOf, trueTerms } from '../core/terms.js';
import { nameOfVehicle } from '../core/vehicle-labels.js';
import { html } from '../libraries.js';
import { useStore } from '../store.js';
import { DronesWorth } from './drones-worth.js';
import { ShareBar } from './parts.js';
import { t } from '../texts.js';

/** The tab. */
export function CostsTab() {
  const entry = useStore(shownPlan);
  const former = useStore(besidePlan);
  if (!entry) return html`<p class="empty">${t('timeline.nothing')}</p>`;
  const { plan } = entry;
  const cost = trueTerms(entry);
  const penalty = penaltyOf(entry);
  return html`<section class="section"><h3>${t('costs.byTerm')}</h3>
      <table><thead><tr><th scope="col">${t('costs.term')}</th>
        <th scope="col" class="number">${t('costs.cost')}</th>
        <th scope="col">${t('costs.share')}</th></tr></thead>
      <tbody>${costTerms(cost).map(
        ([term, name]) => html`<tr key=${term}><th scope="row">${name}</th>
        <td class="number">${money(cost[term])}</td>
        <td><${ShareBar} share=${shareOf(cost, term)} text=${percent(shareOf(cost, term))}
          label=${name} /></td></tr>`,
      )}
        <tr><th scope="row"><strong>${t('costs.total')}</strong></th>
          <td class="number"><strong>${money(cost.total)}</strong></td><td></td></tr>
        ${penalty > 0 && html`<tr id="penalty"><th scope="row">${t('whatIf.penalty')}</th>
          <td class="number">${money(penalty)}</td><td></td></tr>`}</tbody></table>
      ${penalty > 0 && html`<p class="help">${t('whatIf.penaltyHelp')}</p>`}
      ${former && html`<p class="help">${t('costs.beside', { name: former.name })}</p>`}
    </section>
    <section class="section"><h3>${t('costs.byVehicle')}</h3>
      <table><thead><tr><th scope="col">${t('costs.vehicle')}</th>
        <th scope="col" class="number">${t('costs.cost')}</th>
        <th scope="col">${t('costs.works')}</th></tr></thead>
      <tbody>${plan.routes.map((route) => html`<tr key=${route.vehicle}>
          <th scope="row">${nameOfVehicle(route.vehicle)}</th>
        <td class="number">${money(route.cost)}</td><td>${duration(route.working_duration)}</td>
          </tr>`)}
      </tbody></table></section>
    <${DronesWorth} />
    <${Summary} summary=${plan.summary} flights=${flightCount(entry)} />
    <${Legs} legs=${plan.legs} />`;
}

function shareOf(cost, term) {
  return cost.total > 0 ? cost[term] / cost.total : 0;
}

function Legs({ legs }) {
  const lines = legsInWords(legs);
  if (lines.length === 0) return null;
  return html`<section class="section"><h3>${t('costs.driving')}</h3>${lines.map(
    (line) => html`<p class="help" key=${line}>${line}</p>`,
  )}</section>`;
}

function Summary({ summary, flights }) {
  const rates = summary.load_rate;
  const rows = [
    [t('about.driven'), km(summary.distance)],
    [t('about.flown'), km(summary.drone_distance)],
    ...(summary.energy_wh == null
      ? []
      : [[t('costs.energy'), `${number(summary.energy_wh, 1)} Wh`]]),
    [t('about.trips'), number(summary.trips, 0)],
    ...(summary.vehicles_lacking > 0
      ? [[t('term.too_few_vehicles'), number(summary.vehicles_lacking, 0)]]
      : []),
    [t('about.flights'), number(flights, 0)],
    ...(summary.co2_kg == null ? [] : [['CO\u2082', `${number(summary.co2_kg, 1)} kg`]]),
    [t('costs.loadRate'), t('costs.rates', {
      min: percent(rates.min), max: percent(rates.max), mean: percent(rates.mean),
    })]];
  return html`<section class="section"><h3>${t('costs.numbers')}</h3>
    <table><tbody>${rows.map(
    ([name, value]) => html`<tr key=${name}><th scope="row">${name}</th><td>${value}</td></tr>`,
  )}</tbody></table></section>`;
}
