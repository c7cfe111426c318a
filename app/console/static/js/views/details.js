/** What is selected, over the map: what it is, why it is so, and its fields. */

import { edit, indexOf, select, shownPlan } from '../actions.js';
import { describe } from '../core/describe.js';
import { flightOfSortie, flightOfTrip } from '../core/height-profile.js';
import { partsOf } from '../core/plan.js';
import { renamed } from '../core/relations.js';
import { zoneOf } from '../core/zones.js';
import { html, useState } from '../libraries.js';
import { cancelOrders } from '../ordering.js';
import { useStore } from '../store.js';
import { PlaceOf } from './address-search.js';
import { HeightProfile } from './height-profile.js';
import { IconButton } from './icon.js';
import { Facts } from './parts.js';
import { Proofs } from './proofs.js';
import { RuledFields } from './ruled-fields.js';
import { StopMoves } from './stop-moves.js';
import { WhyHere } from './why-here.js';
import { ZoneFields } from './zone-fields.js';
import { t } from '../texts.js';

/** What is asked of every customer. */
const EVERYDAY = ['id', 'location', 'location_index', 'demand', 'service_duration', 'time_window'];

/** The view, while something is selected, or a customer has errors. */
export function Details() {
  const request = useStore((state) => state.request);
  const selection = useStore((state) => state.selection);
  const wrong = useStore(({ errors }) => errors.find(({ keys: [section, position] }) =>
    section === 'customers' && typeof position === 'number')?.keys[1]);
  const dispatch = useStore((state) => state.dispatch);
  const index = indexOf(useStore(shownPlan));
  const key = selection ?? (request.customers[wrong] ? `c:${request.customers[wrong].id}` : null);
  const about = key && describe(request, index, key);
  if (!about) return null;
  const id = key[0] === 'c' ? key.slice(2) : null;
  const flight = flightOf(index, key);
  const zone = zoneOf(request, key);
  return html`<section class="details" aria-label=${t('panel.details')}>
    <header><h2>${about.title}</h2>
      <${IconButton} name="x" label=${t('app.close')} onClick=${() => select(null)} /></header>
    <div class="inside"><${Facts} facts=${about.facts} />
      ${flight && html`<${HeightProfile} flight=${flight} rules=${index.plan.rules}
        ground=${request.airspace?.ground} />`}
      ${zone && html`<${ZoneFields} key=${key} request=${request} zone=${zone} />`}
      ${id !== null && html`<${StopMoves} id=${id} /><${WhyHere} id=${id} />
        ${dispatch && html`<${Proofs} key=${`proofs ${id}`} dispatch=${dispatch.reply.id}
          order=${id} />`}
        <${CustomerForm} key=${id} id=${id} request=${request} isWrong=${wrong !== undefined} />`}
    </div></section>`;
}

/** Return the flight that a key names, null if it names none. */
function flightOf(index, key) {
  const { sortie, trip } = key[0] === 's' || key[0] === 't' ? partsOf(index, key) : {};
  if (sortie) return flightOfSortie(sortie);
  return trip?.vehicle.flies ? flightOfTrip(trip) : null;
}

/** The fields of a customer, unfolded where orders are worked on. */
function CustomerForm({ id, request, isWrong }) {
  const schemas = useStore((state) => state.schemas);
  const isOrders = useStore((state) => state.tab === 'customers');
  const [chosen, setChosen] = useState(null);
  const position = request.customers.findIndex((customer) => customer.id === id);
  if (position < 0) return null;
  const isOpen = chosen ?? (isOrders || isWrong);
  const change = (changed) => {
    const name = changed.customers[position]?.id;
    edit(name && name !== id ? renamed(changed, id, name) : changed);
    if (name && name !== id) select(`c:${name}`);
  };
  return html`<details class="card" open=${isOpen}
    onToggle=${(event) => setChosen(event.currentTarget.open)}>
    <summary>${t('customers.edit')}</summary>
    ${isOpen && html`<div class="inside"><${PlaceOf} request=${request} id=${id} />
      <${RuledFields} schema=${schemas.CustomerInput} keys=${['customers', position]}
        everyday=${EVERYDAY} topics=${{}} request=${request} onChange=${change}
        skip=${request.matrices ? [] : ['location_index']} />
      <div class="buttons"><button type="button" onClick=${() => cancelOrders([id])}>${
        t('customers.remove')}</button></div></div>`}</details>`;
}
