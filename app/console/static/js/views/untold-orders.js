/** The question whether orders were served that the plan has as served, and nobody told. */

import { clock } from '../core/format.js';
import { nameOfVehicle } from '../core/vehicle-labels.js';
import { goOnFromDrivers } from '../dispatching.js';
import { html, useState } from '../libraries.js';
import { store } from '../store.js';
import { t } from '../texts.js';

/** The question; `told` is the reply that has them as `doubtful`. */
export function UntoldOrders({ told }) {
  const { broken, doubtful, replan } = told;
  const [served, setServed] = useState(
    new Set(doubtful.filter((order) => order.is_served).map(({ customer }) => customer)));
  const choose = (orders, isServed) => {
    const chosen = new Set(served);
    orders.forEach(({ customer }) => (isServed ? chosen.add(customer) : chosen.delete(customer)));
    setServed(chosen);
  };
  const answer = () => {
    const customers = doubtful.map(({ customer }) => customer);
    goOnFromDrivers(broken, {
      now: replan.freeze_before,
      served: customers.filter((customer) => served.has(customer)),
      unserved: customers.filter((customer) => !served.has(customer)),
    });
  };
  const vehicles = [...new Set(doubtful.map(({ vehicle }) => vehicle))];
  return html`<section class="section untold"><h3>${t('untold.title')}</h3>
    <p class="help">${t('untold.help')}</p>
    ${vehicles.map((vehicle) => html`<${Orders} key=${vehicle} vehicle=${vehicle} served=${served}
      orders=${doubtful.filter((order) => order.vehicle === vehicle)} choose=${choose} />`)}
    <div class="buttons"><button type="button" class="primary" onClick=${answer}>
        ${t('untold.goOn')}</button>
      <button type="button" onClick=${() => store.set({ untold: null })}>
        ${t('untold.cancel')}</button></div></section>`;
}

function Orders({ vehicle, orders, served, choose }) {
  const areAll = orders.every(({ customer }) => served.has(customer));
  return html`<fieldset><legend>${nameOfVehicle(vehicle)}</legend>
    ${orders.length > 1 && html`<label class="check"><input type="checkbox" checked=${areAll}
      onChange=${(event) => choose(orders, event.target.checked)} />
      ${t('untold.all')}</label>`}
    ${orders.map((order) => html`<label class="check" key=${order.customer}>
      <input type="checkbox" checked=${served.has(order.customer)}
        onChange=${(event) => choose([order], event.target.checked)} />
      ${t('untold.served', { customer: order.customer, at: clock(order.time) })}</label>`)}
  </fieldset>`;
}
