/** Sheets for drivers, one page or more for each vehicle, for the printer alone. */

import { carriedInWords, noteOf } from '../core/describe.js';
import { amounts, clock, duration, pointText, shownDate, timeWindow } from '../core/format.js';
import { standingOf } from '../core/replanning.js';
import { titleOfVehicle } from '../core/vehicle-labels.js';
import { isVisit } from '../core/visits.js';
import { html, render } from '../libraries.js';
import { t } from '../texts.js';

const BLANK = '______________'; // to be written on
const COLUMNS = ['number', 'arrival', 'leave', 'stop', 'window', 'amount', 'drones', 'done'];

function standingInWords(standing) {
  return standing === 'open' ? '' : t(`sheet.standing.${standing}`);
}

/**
 * Print the sheets of vehicles.
 *
 * @param parts what of the plan is settled, of `settledParts`
 * @param isGeographic whether places are longitudes and latitudes
 * @param links of vehicles, by name, if they have any
 */
export function printSheets(vehicles, parts, isGeographic, links = new Map()) {
  const holder = document.getElementById('sheets') ?? document.createElement('div');
  holder.id = 'sheets';
  document.body.append(holder);
  render(
    html`${vehicles.map((vehicle) => html`<${Sheet}
      key=${vehicle.key} vehicle=${vehicle} parts=${parts} isGeographic=${isGeographic}
      link=${links.get(vehicle.name)} />`)}`,
    holder);
  window.print();
}

function Sheet({ vehicle, parts, isGeographic, link }) {
  return html`<article class="sheet-page">
    ${link?.qr && html`<figure class="qr"><img src=${link.qr} alt="" />
      <figcaption>${t('sheet.phone')}</figcaption></figure>`}
    <h1>${titleOfVehicle(vehicle)}</h1>
    <p>${t('sheet.head', {
      time: duration(vehicle.route.working_duration),
      line: BLANK,
      date: shownDate() || BLANK,
    })}</p>
    ${vehicle.trips.map((trip) => html`<section key=${trip.key}>
      <h2>${t('sheet.trip', { number: trip.index + 1, load: amounts(trip.reply.load) })}</h2>
      <table><thead><tr>${COLUMNS
        .filter((name) => name !== 'drones' || trip.sorties.length)
        .map((name) => html`<th key=${name}>${t(`sheet.${name}`)}</th>`)}</tr></thead>
      <tbody>${trip.stops.map(
        (halt, position) => html`<tr key=${halt.key}><td>${position || ''}</td>
        <td>${clock(halt.arrival)}</td><td>${clock(halt.departure)}</td>
        <td><strong>${halt.id}</strong>${noteOf(halt) && html` <small>${noteOf(halt)}</small>`
        }${place(halt, isGeographic)}</td>
        <td>${isVisit(halt) ? timeWindow(halt.window) : ''}</td>
        <td>${isVisit(halt) ? handed(halt.source) : ''}</td>
        ${trip.sorties.length > 0 && html`<td>${orders(trip, halt).map((order) => html`<div
          key=${order}>${order}</div>`)}</td>`}
        <td>${standingInWords(standingOf(parts, {
          vehicle: vehicle.name, trip: trip.index, stop: position }))}</td></tr>`,
      )}
      </tbody></table></section>`,
    )}
  </article>`;
}

/** Return what is delivered, and what is picked up. */
function handed({ demand, pickup }) {
  return pickup
    ? t('sheet.handed', { out: amounts(demand), back: amounts(pickup) })
    : amounts(demand);
}

/** Return where a stop is and what is told of it. */
function place({ location, source }, isGeographic) {
  const { address, ...told } = source?.info ?? {};
  const where = [address, location && pointText(location, { isGeographic })].filter(Boolean);
  return html`${where.map((text) => html`<br key=${text} /><small>${text}</small>`)}
    ${Object.entries(told).map(([name, text]) => html`<div key=${name}><small>${
      carriedInWords(name)}:</small> ${text}</div>`)}`;
}

/** Return what the driver does with drones at a stop. */
function orders(trip, halt) {
  const name = (sortie) => sortie.drone.slice(sortie.drone.lastIndexOf('/') + 1);
  const launches = trip.sorties.filter(({ from }) => from === halt).map((sortie) =>
    t('sheet.launch', {
      at: clock(sortie.reply.launch_time),
      drone: name(sortie),
      names: sortie.visits.map(({ id, source }) => `${id} (${handed(source)})`).join(', '),
    }));
  const recoveries = trip.sorties.filter(({ to }) => to === halt).map((sortie) =>
    t('sheet.recover', { at: clock(sortie.reply.recovery_time), drone: name(sortie) }));
  return [...launches, ...recoveries].sort((first, second) =>
    first.localeCompare(second, 'en', { numeric: true }));
}
