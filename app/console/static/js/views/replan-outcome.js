/** What became of the plan that was gone on from: what was settled, what was broken already. */

import { select } from '../actions.js';
import { clock } from '../core/format.js';
import { getIn, parsePath } from '../core/paths.js';
import { isDrone } from '../core/replanning.js';
import { saidOf } from '../core/said.js';
import { nameOfVehicle } from '../core/vehicle-labels.js';
import { html } from '../libraries.js';
import { parts, t } from '../texts.js';

/** The section. `entry` is a plan that goes on from another. */
export function Outcome({ entry }) {
  const { settled, excused } = entry.plan.replan;
  const unavailable = entry.request.replan?.unavailable ?? [];
  const broken = unavailable.filter((name) => !isDrone(name));
  const lost = unavailable.filter(isDrone);
  const now = entry.request.replan?.freeze_before ?? null;
  return html`<section class="section" id="replan-outcome">
    <h3>${t('outcome.title')}</h3>
    ${settled.length > 0
      ? html`<p>${now === null
          ? t('outcome.departed', { count: settled.length })
          : t('outcome.departedBy', {
            count: settled.length,
            at: clock(now, { precise: true }),
          })}</p>
        <ul>${settled.map((kept) => html`<li key=${kept.vehicle}>
          ${inWords(entry.plan, kept)}</li>`)}</ul>`
      : html`<p>${t('outcome.free')}</p>`}
    ${broken.length > 0 && html`<p>${t('outcome.broken', {
      count: broken.length,
      names: broken.map(nameOfVehicle).join(', '),
    })}</p>`}
    ${lost.length > 0 && html`<p>${t('outcome.lost', {
      count: lost.length,
      names: lost.map(nameOfVehicle).join(', '),
    })}</p>`}
    ${excused.length > 0 && html`<h4>${t('outcome.excused')}</h4>
      <ul>${excused.map((rule) => html`<li key=${rule.path + rule.code}>
        <${Place} entry=${entry} path=${rule.path} />${saidOf(rule)}</li>`)}</ul>
      <p class="help">${t('outcome.unmendable')}</p>`}
  </section>`;
}

function inWords(plan, { vehicle: of, trip, stop }) {
  const { trips } = plan.routes.find((route) => route.vehicle === of);
  const vehicle = nameOfVehicle(of);
  const { stops } = trips[trip];
  const place = stops[stop];
  const number = trip + 1;
  if (!place || stop >= stops.length - 1) {
    return trips.length > 1
      ? t('outcome.allOf', { vehicle, number })
      : t('outcome.all', { vehicle });
  }
  const link = place.kind === 'customer'
    ? html`<button type="button" class="link"
        onClick=${() => select(`c:${place.id}`)}>${place.id}</button>`
    : place.id;
  const so = { vehicle, number, stop: link, at: clock(place.arrival) };
  return trips.length > 1 ? parts('outcome.upToOf', so) : parts('outcome.upTo', so);
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
  return html`${vehicle && nameOfVehicle(vehicle)}${vehicle && id && ', '}${link}: `;
}
