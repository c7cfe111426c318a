/** What became of the plan that was gone on from: what was settled, what was broken already. */

import { select } from '../actions.js';
import { clock, count, timesInWords } from '../core/format.js';
import { getIn, parsePath } from '../core/paths.js';
import { isDrone } from '../core/replanning.js';
import { html } from '../libraries.js';

/** The section. `entry` is a plan that goes on from another. */
export function Outcome({ entry }) {
  const { settled, excused } = entry.plan.replan;
  const unavailable = entry.request.replan?.unavailable ?? [];
  const broken = unavailable.filter((name) => !isDrone(name));
  const lost = unavailable.filter(isDrone);
  const now = entry.request.replan?.freeze_before ?? null;
  return html`<section class="section" id="replan-outcome"><h3>What stayed as it was</h3>
    ${settled.length > 0
      ? html`<p>${count(settled.length, 'vehicle')} had departed${
          now === null ? '' : ` by ${clock(now, { precise: true })}`}:</p>
        <ul>${settled.map((kept) => html`<li key=${kept.vehicle}>
          ${inWords(entry.plan, kept)}</li>`)}</ul>`
      : html`<p>Nothing had departed, so all was free.</p>`}
    ${broken.length > 0 && html`<p>${broken.join(', ')} ${broken.length > 1 ? 'do' : 'does'} nothing
      more: others serve whom ${broken.length > 1 ? 'they' : 'it'} hadn't reached.</p>`}
    ${lost.length > 0 && html`<p>${lost.join(', ')} ${lost.length > 1 ? 'are' : 'is'} launched no
      more.</p>`}
    ${excused.length > 0 && html`<h4>Broken already, by what had happened</h4>
      <ul>${excused.map((rule) => html`<li key=${rule.path + rule.code}>
        <${Place} entry=${entry} path=${rule.path} />${timesInWords(rule.message)}</li>`)}</ul>
      <p class="help">Nothing can mend these; all other rules are kept.</p>`}
  </section>`;
}

function inWords(plan, { vehicle, trip, stop }) {
  const { trips } = plan.routes.find((route) => route.vehicle === vehicle);
  const { stops } = trips[trip];
  const place = stops[stop];
  const which = trips.length > 1 ? `trip ${trip + 1} ` : '';
  if (!place || stop >= stops.length - 1) {
    return `${vehicle}: all of ${which.trim() || 'its trip'}.`;
  }
  const link = place.kind === 'customer'
    ? html`<button type="button" class="link"
        onClick=${() => select(`c:${place.id}`)}>${place.id}</button>`
    : place.id;
  return html`${vehicle}: ${which}up to ${link}, ${clock(place.arrival)}.`;
}

/** The customer or vehicle that a path of the plan or problem names. */
function Place({ entry, path }) {
  const keys = parsePath(path.replace(/^\$\.plan\b/, '$'));
  const isCustomer = (position) => keys[position] === 'stops' || keys[position] === 'customers';
  const at = keys.findLastIndex((_, position) => isCustomer(position));
  const source = keys[0] === 'customers' ? entry.request : entry.plan;
  const id = at >= 0 && getIn(source, keys.slice(0, at + 2))?.id;
  const vehicle = keys[0] === 'routes' && entry.plan.routes[keys[1]]?.vehicle;
  const link = id && html`<button type="button" class="link"
    onClick=${() => select(`c:${id}`)}>${id}</button>`;
  if (!id && !vehicle) return null;
  return html`${vehicle}${vehicle && id && ', '}${link}: `;
}
