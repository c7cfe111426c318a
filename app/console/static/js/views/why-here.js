/** Why a customer is served where it is: what else there is, what that costs, and what binds. */

import { shownPlan } from '../actions.js';
import { money } from '../core/format.js';
import { alternativeRows, bindingInWords, FIRST_SHOWN, noDroneInWords } from '../core/why.js';
import { leftOutOf, shipmentOf, visitsOf } from '../core/visits.js';
import { askWhy, toldOf } from '../explaining.js';
import { html } from '../libraries.js';
import { useStore } from '../store.js';
import { t } from '../texts.js';

/**
 * The button of a customer of the plan that is looked at, and what came of it.
 *
 * Whoever asks of one end of a shipment asks of the whole.
 */
export function WhyHere({ id }) {
  const entry = useStore(shownPlan);
  const whole = entry && shipmentOf(entry.request, id);
  const answer = toldOf(useStore((state) => state.why), entry, whole?.names[0] ?? id);
  const customer = entry && visitsOf(entry.request).find((each) => each.id === id);
  if (!customer) return null;
  const isOut = leftOutOf(entry.plan).some((each) => each.id === id);
  const isAsking = answer?.state === 'asking';
  return html`<div class="section"><div class="buttons"><button type="button" disabled=${isAsking}
      onClick=${() => askWhy(entry, id, whole)}>${
        isOut ? t('why.ask.price') : t('why.ask.here')}</button>
      <span role="status">${isAsking ? t('why.ask.asking') : ''}</span></div>
    ${answer?.told && html`<${Told} told=${answer.told} customer=${customer}
      id=${whole?.id ?? id} request=${entry.request} />`}</div>`;
}

function Told({ told, customer, id, request }) {
  const noDrone = noDroneInWords(told, request, customer);
  const rows = alternativeRows(told.alternatives, customer, visitsOf(request));
  const vehicles = rows.filter(({ kind }) => kind === 'vehicle');
  const more = vehicles.slice(FIRST_SHOWN);
  const first = rows.filter((row) => !more.includes(row));
  return html`
    ${told.here && html`<p>${t('why.ask.saving', {
      sum: money(told.here.saving.total),
    })}</p>`}
    ${rows.length > 0
      ? html`<${Alternatives} rows=${first} id=${id} />`
      : html`<p>${t('why.ask.nothing')}</p>`}
    ${more.length > 0 && html`<details><summary>${t('why.ask.more', {
      count: more.length,
    })}</summary>
      <${Alternatives} rows=${more} id=${t('why.ask.moreOf', { id })} /></details>`}
    ${noDrone.length > 0 && html`<h4>${t('why.noDrone.title')}</h4><ul>${noDrone.map(
      (sentence) => html`<li key=${sentence}>${sentence}</li>`,
    )}</ul>`}
    ${told.binding.length > 0 && html`<h4>${t('why.ask.binds')}</h4><ul>${told.binding.map(
      (limit) => html`<li key=${limit.rule + limit.at}>${
        bindingInWords(limit, told.shipment ?? limit.at)}</li>`,
    )}</ul>`}
    <p class="help">${t('why.ask.others')}${told.complete ? '' : ` ${t('why.ask.noTime')}`}</p>`;
}

function Alternatives({ rows, id }) {
  return html`<table aria-label=${t('why.ask.insteadOf', { id })}><thead><tr>
      <th scope="col">${t('why.ask.instead')}</th>
      <th scope="col" class="number">${t('why.ask.costs')}</th></tr></thead>
    <tbody>${rows.map((row) => html`<tr key=${row.key}>
      <th scope="row">${row.what} <span class="help">${row.where}</span>
        ${!row.feasible && html`<ul class="help">${row.reasons.map(
          (reason) => html`<li key=${reason}>${reason}</li>`)}</ul>`}</th>
      <td class="number" title=${row.terms}>${
        row.feasible ? row.cost : t('why.ask.forbidden')}</td></tr>`,
    )}</tbody></table>`;
}
