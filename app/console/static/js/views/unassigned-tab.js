/** Customers that no vehicle serves: why, and what would change that, one click away. */

import { edit, indexOf, shownPlan } from '../actions.js';
import { count, number } from '../core/format.js';
import { applyRemedy } from '../core/remedies.js';
import { html } from '../libraries.js';
import { plan } from '../planning.js';
import { useStore } from '../store.js';
import { linked, SelectButton } from './parts.js';
import { WhyHere } from './why-here.js';

/** The tab. */
export function UnassignedTab() {
  const entry = useStore(shownPlan);
  const request = useStore((state) => state.request);
  if (!entry) return html`<p class="empty">Nothing is planned yet.</p>`;
  const { unassigned, summary } = entry.plan;
  if (!unassigned.length) return html`<p class="empty">Every customer is served.</p>`;
  return html`<section class="section"><h3>${count(unassigned.length, 'customer')} unassigned</h3>
    ${summary.must_unserved > 0 && html`<p>${number(summary.must_unserved, 0)} of them must be
      served: nothing says what leaving them out may cost.</p>`}
    ${unassigned.map(
      (customer) => html`<${Unassigned} key=${customer.id} customer=${customer}
      index=${indexOf(entry)} request=${request} />`,
    )}</section>`;
}

function Unassigned({ customer, index, request }) {
  const selection = useStore((state) => state.selection);
  const hovered = useStore((state) => state.hover);
  const key = `c:${customer.id}`;
  return html`<article class="card" ...${linked(index, key, selection, hovered)}>
    <header><${SelectButton} of=${key}><strong>${customer.id}</strong></${SelectButton}></header>
    <div class="inside">${customer.reasons.map(
      (reason) => html`<div key=${reason.vehicle_type}>
      <p><strong>${reason.vehicle_type}</strong>: ${reason.message}</p>
      ${reason.remedy && html`<${Remedy} customer=${customer} reason=${reason}
        request=${request} />`}
    </div>`,
    )}<${WhyHere} id=${customer.id} /></div></article>`;
}

function Remedy({ customer, reason, request }) {
  const changed = applyRemedy(request, customer.id, reason);
  const apply = () => {
    edit(changed);
    plan();
  };
  const sentence = reason.remedy.charAt(0).toUpperCase() + reason.remedy.slice(1);
  return html`<div class="buttons"><span>${sentence}.</span>
    ${
      changed &&
      html`<button type="button" onClick=${apply}
      aria-label=${['Apply and plan again: ' + reason.remedy, reason.vehicle_type,
        customer.id].join(', ')}>
      Apply and plan again</button>`
    }</div>`;
}
