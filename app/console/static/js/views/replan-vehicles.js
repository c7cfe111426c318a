/** Vehicles of the plan that is gone on from: where they are, whom they keep, which are broken. */

import { edit, indexOf } from '../actions.js';
import { setIn } from '../core/paths.js';
import { nameOfVehicle } from '../core/vehicle-labels.js';
import {
  basisRoutes, dronesOnTheWay, idleVehicles, isDrone, setBroken, setPinned, whereabouts,
} from '../core/replanning.js';
import { html } from '../libraries.js';
import { takeTool } from '../map/draw-bar.js';
import { useStore } from '../store.js';
import { Badge, SelectButton } from './parts.js';
import { Errors, errorsAt } from './replan-errors.js';
import { ParcelsBack } from './replan-parcels.js';
import { t } from '../texts.js';

const MOST_IDLE = 200;

/** The section. */
export function Vehicles({ request, basis, errors }) {
  const index = indexOf(basis);
  const byName = new Map(index?.vehicles.map((vehicle) => [vehicle.name, vehicle]));
  const states = basisRoutes(request);
  const { unavailable = [] } = request.replan;
  const rows = states.map((state, position) => ({
    ...state,
    position,
    vehicle: byName.get(state.route.vehicle),
    errors: errorsAt(errors, ([, section, part, at]) =>
      section === 'plan'
        ? part === 'routes' && at === position
        : section === 'unavailable' && unavailable[part] === state.route.vehicle),
  }));
  const order = (row) => row.vehicle?.index ?? row.position;
  rows.sort((first, second) => order(first) - order(second));
  const used = new Set(states.map(({ route }) => route.vehicle));
  const others = unavailable.filter((name) => !used.has(name));
  const whole = (names) => names.filter((name) => !others.includes(name)).slice(0, MOST_IDLE);
  const [idle, drones] = [idleVehicles(request), dronesOnTheWay(request)].map(whole);
  return html`<section class="section"><h3>${t('replan.vehicles')}</h3>
    <table class="replan-vehicles"><thead><tr><th scope="col">${t('about.vehicle')}</th>
      <th scope="col">${t('replan.keepsAll')}</th>
      <th scope="col">${t('replan.broken')}</th></tr></thead>
    <tbody>${rows.map((row) => html`<${Row} key=${row.route.vehicle} row=${row}
      request=${request} />`)}
    ${others.map((name) => html`<${BrokenRow} key=${name} name=${name} request=${request}
      id=${`field-replan-unavailable-${unavailable.indexOf(name)}`}
      errors=${errorsAt(errors, ([, section, position]) =>
        section === 'unavailable' && unavailable[position] === name)} />`)}</tbody></table>
    <${Broken} label=${t('replan.anotherBroken')} hint=${t('replan.chooseVehicle')}
      names=${idle} request=${request} />
    <${Broken} label=${t('replan.droneLost')} hint=${t('replan.chooseDrone')}
      names=${drones} request=${request} />
    ${unavailable.some((name) => !isDrone(name)) && html`<${ParcelsBack} request=${request}
      errors=${errors} />`}
  </section>`;
}

function Row({ row, request }) {
  const { route, progress, open, vehicle, position, errors } = row;
  const { pinned = [], pin_all: pinAll, freeze_before: now } = request.replan;
  const name = nameOfVehicle(route.vehicle);
  const keepsAll = pinAll || (open.length > 0 && open.every((id) => pinned.includes(id)));
  const place = progress.isBroken ? t('replan.isBroken') : whereabouts(route, progress, now ?? -1);
  const left = progress.isBroken
    ? t('replan.forOthers', { count: open.length })
    : t('replan.toGo', { count: open.length });
  return html`<tr><th scope="row">
      ${vehicle && html`<${SelectButton} of=${vehicle.key}><${Badge} vehicle=${vehicle} /> ${name}
        </${SelectButton}>`}${!vehicle && name}
      <div class="help">${place}; ${left}</div>
      <${Errors} errors=${errors} id=${`field-replan-plan-routes-${position}`} /></th>
    <td><input type="checkbox" aria-label=${t('replan.keepsOf', { name })} checked=${keepsAll}
      disabled=${pinAll || progress.isBroken || !open.length}
      onChange=${() => edit(setPinned(request, open, !keepsAll))} /></td>
    <td><input type="checkbox" aria-label=${t('replan.brokenOf', { name })}
      checked=${progress.isBroken}
      onChange=${() => edit(setBroken(request, route.vehicle, !progress.isBroken))} /></td></tr>`;
}

/** A choice of what else is broken. */
function Broken({ label, hint, names, request }) {
  return names.length > 0 && html`<label>${label} <select value=""
    onChange=${(event) => edit(setBroken(request, event.target.value, true))}>
    <option value="" disabled hidden>${hint}</option>
    ${names.map((name) => html`<option key=${name} value=${name}>${
      nameOfVehicle(name)}</option>`)}</select>
    </label>`;
}

/** A drone that is lost, or a vehicle that is broken and that the plan doesn't use. */
function BrokenRow({ name, request, id, errors }) {
  const state = isDrone(name) ? t('replan.grounded') : t('replan.brokenUnused');
  const called = nameOfVehicle(name);
  return html`<tr><th scope="row">${called}<div class="help">${state}</div>
      <${Errors} errors=${errors} /></th><td></td>
    <td><input type="checkbox" id=${id} aria-label=${t('replan.brokenOf', { name: called })} checked
      onChange=${() => edit(setBroken(request, name, false))} /></td></tr>`;
}

/** Customers who stay with their vehicles. */
export function PinnedCustomers({ request, errors }) {
  const tool = useStore((state) => state.tool);
  const { pinned = [], pin_all: pinAll = false } = request.replan;
  return html`<section class="section"><h3>${t('replan.pinned')}</h3>
    <label><input type="checkbox" checked=${pinAll}
      onChange=${() => edit(setIn(request, ['replan', 'pin_all'], !pinAll))} />
      ${' '}${t('replan.pinAll')}</label>
    <div class="buttons"><button type="button" aria-pressed=${tool === 'pin'} disabled=${pinAll}
        onClick=${() => takeTool('pin')}>${t('replan.pinOnMap')}</button>
      ${pinned.length > 0 && html`<button type="button"
        onClick=${() => edit(setPinned(request, pinned, false))}>
        ${t('replan.letGoAll')}</button>`}</div>
    ${pinned.length > 0 && html`<ul class="chips" aria-label=${t('replan.pinnedList')}>${pinned.map(
      (id, position) => html`<li key=${id}><span>${id}</span><button type="button" class="quiet"
        id=${`field-replan-pinned-${position}`} aria-label=${t('replan.letGo', { id })}
        onClick=${() => edit(setPinned(request, [id], false))}>\u00d7</button>
        <${Errors} errors=${errorsAt(errors, ([, section, at]) =>
          section === 'pinned' && at === position)} /></li>`,
    )}</ul>`}
    ${!pinned.length && !pinAll && html`<p class="help">${t('replan.nonePinned')}</p>`}</section>`;
}
