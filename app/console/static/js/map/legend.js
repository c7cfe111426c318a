/** What the marks and lines of the map mean. */

import { html } from '../libraries.js';
import { t } from '../texts.js';
import { visitsOf } from '../core/visits.js';

/**
 * The legend, for who asks.
 *
 * @param request that is drawn
 * @param index of the plan that is drawn, if there is one
 * @param parts what of it is settled
 */
export function MapLegend({ request, index, parts }) {
  const entries = entriesOf(request, index, parts);
  if (!entries.length) return null;
  return html`<details class="map-legend">
    <summary>${t('legend.title')}</summary><ul>${entries.map(
      ([sign, name]) => html`<li key=${name}><${Sign} sign=${sign} />${t(`legend.${name}`)}</li>`,
    )}</ul></details>`;
}

function entriesOf(request, index, parts) {
  const pinned = (request.replan?.pinned ?? []).length > 0;
  const some = (test) => index?.vehicles.some((vehicle) => vehicle.trips.some(test));
  const drives = index?.vehicles.some((vehicle) => !vehicle.flies);
  const flies = some((trip) => trip.vehicle.flies || trip.sorties.length > 0);
  const isNew = index && visitsOf(request).some(({ id }) => !index.customers.has(id));
  const lost = [...parts.values()].some(({ isBroken, isOver }) => isBroken && !isOver);
  const entries = [
    [drives, 'road', 'vehicle'],
    [some((trip) => trip.index > 0 && !trip.vehicle.flies), 'later', 'later'],
    [flies, 'flight', 'flight'],
    [drives, 'truck', 'byTruck'],
    [flies, 'drone', 'byDrone'],
    [request.launch_sites?.length > 0, 'site', 'site'],
    [index?.plan.unassigned.length > 0, 'out', 'unassigned'],
    [isNew, 'new', 'isNew'],
    [!index && visitsOf(request).length > 0, 'new', 'customer'],
    [parts.size > 0, 'settled', 'settled'],
    [lost, 'lost', 'lost'],
    [pinned, 'pin', 'pinned'],
    [request.airspace?.no_fly?.length > 0, 'area', 'area'],
    [request.airspace?.zones?.length > 0, 'zone', 'zone'],
    [keepsAway(request.airspace), 'kept', 'kept']];
  return entries.filter(([there]) => there).map(([, sign, name]) => [sign, name]);
}

function keepsAway({ no_fly: areas = [], zones = [], buffer = 0 } = {}) {
  return buffer > 0 && areas.length + zones.length > 0;
}

const SIGNS = {
  road: html`<path class="ink" d="M1 7H25" stroke-width="2.5" />`,
  later: html`<path class="ink" d="M1 7H25" stroke-width="2.5" stroke-dasharray="9 5" />`,
  flight: html`<path class="ink" d="M1 7H25" stroke-width="1.6" stroke-dasharray="5 4" />`,
  truck: html`<circle class="filled" cx="13" cy="7" r="4.5" />`,
  drone: html`<circle class="ink" cx="13" cy="7" r="4" stroke-width="2.2" />`,
  site: html`<rect class="ink" x="5" y="2" width="16" height="10" rx="5" stroke-width="1.5" />`,
  out: html`<path class="red" d="M9 3L17 11M17 3L9 11" stroke-width="3" />`,
  new: html`<circle class="grey" cx="13" cy="7" r="4.5" />`,
  settled: html`<path class="ink" d="M1 7H25" stroke-width="2" stroke-dasharray="1 5"
    stroke-linecap="round" opacity="0.6" /><circle class="filled" cx="13" cy="7" r="4"
    opacity="0.5" />`,
  lost: html`<path class="red" d="M1 7H25" stroke-width="1.5" stroke-dasharray="7 6" />`,
  pin: html`<path class="filled" d="M9 4H17L13 11Z" />`,
  area: html`<rect class="area" x="4" y="2" width="18" height="10" stroke-width="1.5"
    stroke-dasharray="6 3" />`,
  zone: html`<rect class="area" x="4" y="2" width="18" height="10" stroke-width="1" />`,
  kept: html`<rect class="area" x="1" y="0" width="24" height="14" rx="6" stroke="none" />`,
};

function Sign({ sign }) {
  return html`<svg viewBox="0 0 26 14" width="26" height="14"
    aria-hidden="true">${SIGNS[sign]}</svg>`;
}
