/** Routes: vehicles, their trips, and every stop and flight of these. */

import { indexOf, shownPlan } from '../actions.js';
import { noteOf } from '../core/describe.js';
import { amounts, clock, duration, km, money, number, percent } from '../core/format.js';
import { partsOf } from '../core/plan.js';
import { vehicleColour } from '../core/palette.js';
import { customersOf } from '../core/replanning.js';
import { nameOfVehicle, titleOfVehicle } from '../core/vehicle-labels.js';
import { isVisit } from '../core/visits.js';
import { windowsInCell } from '../core/windows.js';
import { html, useEffect, useState } from '../libraries.js';
import { lock } from '../living.js';
import { useStore } from '../store.js';
import { useSavesNothing } from './drones-worth.js';
import { IdleDrones } from './idle-drones.js';
import { dropOn, Grip } from './list-drag.js';
import { Badge, linked, SelectButton, ShareBar } from './parts.js';
import { t } from '../texts.js';

/** Vehicles are unfolded at first if there are fewer. */
const MOST_OPEN = 3;

/** The tab. */
export function RoutesTab() {
  const index = indexOf(useStore(shownPlan));
  if (!index) return html`<p class="empty">${t('timeline.nothing')}</p>`;
  if (!index.vehicles.length) return html`<p class="empty">${t('timeline.unused')}</p>`;
  return html`<${Rates} index=${index} />
    ${index.vehicles.map((vehicle) => html`<${Vehicle} key=${vehicle.key} index=${index}
      vehicle=${vehicle} />`)}`;
}

function Rates({ index }) {
  const selection = useStore((state) => state.selection);
  const hovered = useStore((state) => state.hover);
  const dark = useStore((state) => state.dark);
  const trips = index.vehicles.flatMap(({ trips: own }) => own);
  return html`<section class="section"><h3>${t('routes.rates')}</h3>
    <table><thead><tr><th scope="col">${t('routes.trip')}</th>
      <th scope="col">${t('routes.loadRate')}</th>
      <th scope="col">${t('routes.workingRate')}</th></tr></thead>
    <tbody>${trips.map(
      (trip) => html`<tr key=${trip.key} ...${linked(index, trip.key, selection, hovered)}>
      <th scope="row"><${SelectButton} of=${trip.key}><${Badge} vehicle=${trip.vehicle}
        label=${trip.label} /> ${titleOfVehicle(trip.vehicle)}</${SelectButton}></th>
      <td><${ShareBar} share=${trip.reply.load_rate} text=${percent(trip.reply.load_rate)}
        label=${t('routes.loadRate')} colour=${vehicleColour(trip.vehicle.number, dark)} /></td>
      <td>${working(trip, dark)}</td></tr>`,
    )}</tbody></table></section>`;
}

/** The trip's share of the longest working duration, or why there is none. */
function working(trip, dark) {
  const longest = trip.vehicle.type?.max_working_duration;
  if (!longest) {
    return html`<span class="help">${t('routes.noLimit', {
      time: duration(trip.reply.duration),
    })}</span>`;
  }
  const share = trip.reply.duration / longest;
  return html`<${ShareBar} share=${share} text=${percent(share)} label=${t('routes.workingRate')}
    colour=${vehicleColour(trip.vehicle.number, dark)} />`;
}

function Vehicle({ index, vehicle }) {
  const selection = useStore((state) => state.selection);
  const mine = partsOf(index, selection).vehicle === vehicle;
  const [open, setOpen] = useState(index.vehicles.length < MOST_OPEN);
  useEffect(() => {
    if (mine) setOpen(true);
  }, [mine]);
  const { route } = vehicle;
  const rate = route.working_rate === null ? '' : ` (${percent(route.working_rate)})`;
  // What is folded is left out, as there may be thousands of stops.
  return html`<details class="card" open=${open}
    onToggle=${(event) => setOpen(event.currentTarget.open)}>
    <summary data-drop-vehicle=${vehicle.index}><${Badge} vehicle=${vehicle} />
      <strong>${titleOfVehicle(vehicle)}</strong>
      <span class="right">${[
        t('routes.trips', { count: vehicle.trips.length }),
        duration(route.working_duration) + rate,
        ...(route.overtime > 0
          ? [t('routes.overtime', { time: duration(route.overtime) })]
          : []),
        money(route.cost),
      ].join(', ')}</span></summary>
    ${open && html`<div class="inside"><${IdleDrones} vehicle=${vehicle.name} />
        <${LockAll} vehicle=${vehicle} />${vehicle.trips.map((trip) => html`<${Trip} key=${trip.key}
      index=${index} trip=${trip} />`)}</div>`}</details>`;
}

/** Locks all customers of a vehicle, or lets go of them. */
function LockAll({ vehicle }) {
  const locks = useStore((state) => state.locks);
  const ids = customersOf(vehicle.route);
  const isLocked = ids.length > 0 && ids.every((id) => locks.includes(id));
  return html`<div class="buttons"><button type="button" aria-pressed=${isLocked}
    aria-label=${t('routes.lockOf', { vehicle: nameOfVehicle(vehicle.name) })}
    onClick=${() => lock(ids, !isLocked)}>${
      isLocked ? t('routes.allLocked') : t('routes.lockAll')}</button>
    </div>`;
}

function Trip({ index, trip }) {
  const selection = useStore((state) => state.selection);
  const hovered = useStore((state) => state.hover);
  const { reply } = trip;
  const halts = [...trip.stops, ...trip.sorties.flatMap(({ visits }) => visits)];
  const columns = {
    window: halts.some((halt) => isVisit(halt) && windowOf(halt)),
    late: halts.some(({ lateness }) => lateness > 0),
  };
  return html`<div class="section"><h4><${SelectButton}
    of=${trip.key}>${t('routes.tripNumber', { number: trip.index + 1 })}</${SelectButton}>
      ${' '}<span class="help">${[
        t('routes.load', {
          load: `${amounts(reply.load)} (${percent(reply.load_rate)})`,
        }),
        km(reply.distance),
        duration(reply.duration),
        ...(trip.vehicle.flies && reply.energy_wh != null
          ? [t('routes.energy', { energy: number(reply.energy_wh, 1) })]
          : []),
      ].join(', ')}</span></h4>
    <table class="trip-stops" data-late=${columns.late && columns.window}><thead><tr>
      <th scope="col">${t('routes.stop')}</th><th scope="col">${t('about.arrival')}</th>
      ${columns.window && html`<th scope="col">${t('about.window')}</th>`}
      ${columns.late && html`<th scope="col">${t('routes.late')}</th>`}
      <th scope="col" class="number">${t('about.loaded')}</th></tr></thead>
    <tbody>${trip.stops.map((halt) => html`
      <${Stop} key=${halt.key} index=${index} halt=${halt} selection=${selection}
        hovered=${hovered} columns=${columns} />
      ${trip.sorties
        .filter((sortie) => sortie.from === halt)
        .map((sortie) => html`<${Sortie}
        key=${sortie.key} index=${index} sortie=${sortie} selection=${selection}
          hovered=${hovered} columns=${columns} />`)}`)}
    </tbody></table></div>`;
}

/** Return the window of a halt in words, an empty text without one. */
function windowOf({ window }) {
  return window && (window.earliest > 0 || window.latest != null) ? windowsInCell([window]) : '';
}

function Stop({ index, halt, selection, hovered, columns }) {
  const isLocked = useStore((state) => state.locks).includes(halt.id);
  return html`<tr class=${halt.lateness > 0 ? 'late' : ''} ...${dropOn(halt)}
    ...${linked(index, halt.key, selection, hovered)}>
    <th scope="row">${halt.kind === 'customer' && html`<${Grip} index=${index} halt=${halt} />`}
      <${SelectButton} of=${halt.key}>${halt.id}</${SelectButton}>${isLocked
        && halt.kind === 'customer' && html` <span
          class="lock-mark">${t('routes.locked')}</span>`}${noteOf(halt)
        && html` <span class="help">${noteOf(halt)}</span>`}${halt.alternative
        && html` <span class="help">${t('about.servedAt')} ${halt.alternative}</span>`}</th>
    <td>${clock(halt.arrival)}${halt.waiting > 0 && html` <span
      class="help">+${duration(halt.waiting)}</span>`}</td>
    ${columns.window && html`<td>${isVisit(halt) ? windowOf(halt) : ''}</td>`}
    ${columns.late && html`<td class="lateness">${
      halt.lateness > 0 ? duration(halt.lateness) : ''}</td>`}
    <td class="number">${amounts(halt.load)}</td></tr>`;
}

function Sortie({ index, sortie, selection, hovered, columns }) {
  const { reply } = sortie;
  const isUseless = useSavesNothing(sortie);
  const drone = sortie.drone.slice(sortie.drone.lastIndexOf('/') + 1);
  return html`<tr ...${linked(index, sortie.key, selection, hovered)}>
      <td colspan="5" class="help"><${SelectButton}
        of=${sortie.key}>${t('routes.flies', { drone })}</${SelectButton}>
        ${' '}${t('routes.flight', {
          from: clock(reply.launch_time), until: clock(reply.recovery_time),
          way: km(reply.distance), back: sortie.to.id,
        })}${isUseless && html`<strong class="late-text">, ${
          t('routes.useless')}</strong>`}</td></tr>
    ${sortie.visits.map((halt) => html`<${Stop} key=${halt.key} index=${index} halt=${halt}
      selection=${selection} hovered=${hovered} columns=${columns} />`)}`;
}
