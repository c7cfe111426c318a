/** Shipments, relations, depots, launch sites and what else is neither customer nor fleet. */

import { edit, openTab } from '../actions.js';
import { freeName, removeCustomers } from '../core/changes.js';
import { number } from '../core/format.js';
import { removeIn, setIn } from '../core/paths.js';
import { placeOf } from '../core/places.js';
import { ofTheirKinds, withShipments } from '../core/relations.js';
import { labelOf } from '../core/schema.js';
import { endsOf } from '../core/visits.js';
import { html } from '../libraries.js';
import { store, useStore } from '../store.js';
import { Field, Fields } from './form.js';
import { useOpening } from './parts.js';
import { t } from '../texts.js';

/** Shipments, open where one is selected. */
export function Shipments({ request }) {
  const schemas = useStore((state) => state.schemas);
  const selection = useStore((state) => state.selection);
  const isSelected = (request.shipments ?? []).some((shipment) =>
    endsOf(shipment).some(({ name }) => selection === `c:${name}`));
  return html`<details class="card" ref=${useOpening(isSelected)}><summary>${labelOf('shipments')}
      <span class="right">${number(request.shipments?.length ?? 0, 0)}</span></summary>
    <div class="inside"><${Field} name="shipments" keys=${['shipments']} request=${request}
      schema=${schemas.PlanRequest.properties.shipments}
      onChange=${(changed) => edit(withShipments(request, changed))} /></div></details>`;
}

/** What says who goes with whom. */
const OF_COMPANY = ['relations', 'incompatible_goods'];

/** Who goes with whom, and which goods, open where something is wrong with it. */
export function Relations({ request }) {
  const { properties } = useStore((state) => state.schemas).PlanRequest;
  const isWrong = useStore((state) => state.errors).some(({ keys }) =>
    OF_COMPANY.includes(keys[0]));
  const count = OF_COMPANY.reduce((sum, name) => sum + (request[name]?.length ?? 0), 0);
  return html`<details class="card" ref=${useOpening(isWrong)}><summary>${labelOf('relations')}
      <span class="right">${number(count, 0)}</span></summary>
    <div class="inside">${OF_COMPANY.map((name) => html`<${Field} key=${name} name=${name}
      keys=${[name]} request=${request} schema=${properties[name]}
      onChange=${(changed) => edit(ofTheirKinds(request, changed))} />`)}
    </div></details>`;
}

/** Depots, launch sites and how places are stated. */
export function Places({ request }) {
  const schemas = useStore((state) => state.schemas);
  const { properties } = schemas.PlanRequest;
  const addDepot = () =>
    edit(
      setIn(request, ['depots', request.depots.length], {
        id: freeName(request.depots, 'depot'),
        location: [...(placeOf(request.depots[0]) ?? [0, 0])],
      }));
  return html`<details class="card"><summary>${t('customers.places')}
      <span class="right">${t('customers.depots', {
        count: request.depots.length,
      })}</span></summary>
    <div class="inside">
      <${Field} name="coordinate_system" schema=${properties.coordinate_system}
        keys=${['coordinate_system']} request=${request} onChange=${edit} />
      ${request.coordinate_system !== 'geographic' &&
        ['planar_unit', 'planar_rounding'].map((name) => html`<${Field} key=${name} name=${name}
        schema=${properties[name]} keys=${[name]} request=${request}
          onChange=${edit} />`)
      }
      ${request.coordinate_system === 'geographic' && request.roads !== 'none' &&
        html`<${Field} name="approach" owner="RoadsInput" keys=${['roads', 'approach']}
          schema=${schemas.RoadsInput.properties.approach} request=${request}
          onChange=${edit} />`}
      ${request.depots.map((_, position) => html`<fieldset class="group" key=${position}>
        <legend>${t('where.depot', { id: String(position + 1) })}</legend>
        <${Fields} schema=${schemas.DepotInput} keys=${['depots', position]} request=${request}
          onChange=${edit} skip=${request.matrices ? [] : ['location_index']} />
        ${request.depots.length > 1 &&
          html`<div class="buttons"><button type="button" onClick=${() =>
            edit(removeIn(request, ['depots', position]))}>
            ${t('customers.removeDepot')}</button></div>`
        }
      </fieldset>`)}
      <${Field} name="launch_sites" schema=${properties.launch_sites} keys=${['launch_sites']}
        request=${request} onChange=${edit} />
      <div class="buttons"><button type="button" onClick=${addDepot}>
        ${t('customers.addDepot')}</button>
        <button type="button" onClick=${clear}>${t('customers.empty')}</button></div>
    </div></details>`;
}

/** Keep depots and fleet, drop customers and no-fly areas. */
function clear() {
  edit((request) => {
    const { matrices, ...rest } = request;
    return {
      ...removeCustomers(rest, rest.customers.map(({ id }) => id)),
      ...(rest.airspace && { airspace: { ...rest.airspace, no_fly: [] } }),
    };
  });
  store.set({ selection: null });
  openTab('customers');
}
