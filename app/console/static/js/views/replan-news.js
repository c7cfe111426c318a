/** What is new since the plan: orders that came in or were cancelled, windows that changed. */

import { edit } from '../actions.js';
import { giveWindows } from '../core/changes.js';
import { requestDifferences } from '../core/differences.js';
import { choicesOf, fromNothing, setPinned } from '../core/replanning.js';
import { nameOfVehicle } from '../core/vehicle-labels.js';
import { html } from '../libraries.js';
import { takeTool } from '../map/draw-bar.js';
import { cancelOrders } from '../ordering.js';
import { useStore } from '../store.js';
import { Change } from './change-words.js';
import { NewOrder } from './new-order.js';
import { WindowFields } from './window-fields.js';
import { t } from '../texts.js';

const MOST_LISTED = 30;

/** The section. `basis` is the entry of the plans that is gone on from, if it is one. */
export function News({ request, basis }) {
  const tool = useStore((state) => state.tool);
  const changes = basis
    ? requestDifferences(fromNothing(basis.request), fromNothing(request)).filter(
        ({ path }) => !path.startsWith('options'))
    : [];
  const button = (name, text) => html`<button type="button" aria-pressed=${tool === name}
    onClick=${() => takeTool(name)}>${text}</button>`;
  return html`<section class="section"><h3>${t('news.title')}</h3>
    <${NewOrder} open />
    <div class="buttons">${button('customer', t('news.add'))}
      ${button('erase', t('news.cancel'))}</div>
    ${tool === 'customer' || tool === 'erase' ? html`<p class="help">${t('news.click')}</p>` : ''}
    <${SelectedOrder} request=${request} />
    ${changes.length > 0 && html`<ul>${changes.slice(0, MOST_LISTED).map(
      (change) => html`<li key=${change.path}><${Change} ...${change} /></li>`,
    )}${changes.length > MOST_LISTED && html`<li>${t('app.more', {
      count: changes.length - MOST_LISTED,
    })}</li>`}
    </ul>`}
  </section>`;
}

/** What can be done about the customer that is selected. */
function SelectedOrder({ request }) {
  const selection = useStore((state) => state.selection);
  const id = selection?.startsWith('c:') ? selection.slice(2) : null;
  const customer = request.customers.find((other) => other.id === id);
  if (!customer) {
    return html`<p class="help">${t('news.select')}</p>`;
  }
  const { isPlanned, mayPin, mayCancel, ...choices } = choicesOf(request, id);
  const vehicle = choices.vehicle && nameOfVehicle(choices.vehicle);
  const isPinned = (request.replan.pinned ?? []).includes(id);
  return html`<div class="card"><header><strong>${id}</strong>
      <span class="right">${
        isPlanned ? t('news.with', { vehicle }) : t('about.notYet')}</span></header>
    <div class="inside">
      ${!mayCancel && html`<p class="help">${t('news.settled')}</p>`}
      <div class="buttons">
        ${mayPin && html`<button type="button" aria-pressed=${isPinned}
          onClick=${() => edit(setPinned(request, [id], !isPinned))}>
          ${isPinned ? t('news.pinned', { vehicle }) : t('news.pin', { vehicle })}</button>`}
        <button type="button" disabled=${!mayCancel} onClick=${() => cancelOrders([id])}>
          ${t('news.cancelOrder')}</button>
      </div>
      <div class="buttons"><span>${t('about.window')}</span><${WindowFields} customer=${customer}
        onApply=${(windows) => edit(giveWindows(request, [id], windows))} /></div>
    </div></div>`;
}
