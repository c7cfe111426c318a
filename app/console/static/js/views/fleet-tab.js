/** The fleet, wind and what leaving a customer out costs, in forms made from the API's schema. */

import { edit } from '../actions.js';
import { freeName } from '../core/changes.js';
import { droneCount, needlessFields } from '../core/drones.js';
import { amounts } from '../core/format.js';
import { removeIn } from '../core/paths.js';
import { countZones, PROPOSED_BUFFER_M, withBuffer, zoneAreas } from '../core/zones.js';
import { html, useEffect, useState } from '../libraries.js';
import { useStore } from '../store.js';
import { Field } from './form.js';
import { useOpening } from './parts.js';
import { RuledFields } from './ruled-fields.js';
import { WindForm } from './wind-form.js';
import { AirspaceFields, Leave } from './zone-fields.js';
import { t } from '../texts.js';

/** What is asked of every type. */
const EVERYDAY = [
  'id', 'count', 'names', 'capacity', 'depot', 'shift', 'speed_kmh', 'costs', 'drones'];

/** What else there is. */
const TOPICS = {
  load: ['pickups', 'lifo', 'max_stops', 'skills'],
  hours: ['max_working_duration', 'overtime', 'breaks', 'driving_rules', 'max_travel_duration',
    'max_trips', 'reload_duration', 'reload_depots'],
  ways: ['start_location', 'start_location_index', 'end', 'profile', 'avoid', 'speed_profile',
    'max_trip_distance', 'revisits'],
  flying: ['flies', 'max_sorties', 'max_airborne', 'truck_waits', 'altitude', 'endurance',
    'max_range', 'max_wind_kmh', 'preset', 'launch_duration', 'recovery_duration', 'turnaround'],
  energy: ['energy', 'co2_kg_per_km', 'co2_kg_per_kwh'],
};

/** What is said of zones alone. */
const OF_ZONES = ['cleared', 'conditional', 'ground'];
const FORMATS = { ed269: 'ED-269', ed318: 'ED-318', geojson: 'GeoJSON', kml: 'KML' };
const MOST_ZONES = 12; // that are listed

/** The tab. */
export function FleetTab() {
  const request = useStore((state) => state.request);
  const schemas = useStore((state) => state.schemas);
  const [help, setHelp] = useState(false);
  const [added, setAdded] = useState(null);
  const { properties } = schemas.PlanRequest;
  useEffect(() => {
    if (!added) return;
    const field = /** @type {HTMLInputElement} */ (
      document.getElementById(`field-fleet-${added.position}-id`));
    field.closest('details').scrollIntoView({ block: 'start' });
    field.focus({ preventScroll: true });
    field.select();
  }, [added]);
  const add = () => {
    const like = request.fleet.at(-1) ?? { count: 1, capacity: [100] };
    const type = { ...like, id: freeName(request.fleet, 'type') };
    edit({ ...request, fleet: [...request.fleet, type] });
    setAdded({ position: request.fleet.length });
  };
  return html`<div class=${help ? 'section' : 'section no-help'}>
    <div class="buttons"><h3>${t('fleet.types', { count: request.fleet.length })}</h3>
      <button type="button" onClick=${add}>${t('fleet.add')}</button>
      <label><input type="checkbox" checked=${help}
        onChange=${() => setHelp(!help)} /> ${t('fleet.explain')}</label>
    </div>
    ${request.fleet.map((type, position) => html`<${VehicleType} key=${position} type=${type}
      position=${position} request=${request} isNew=${position === added?.position} />`)}
    <${WindForm} request=${request} />
    <fieldset class="group"><legend>${t('field.no_fly')}</legend>
      ${(request.airspace?.no_fly ?? []).map(
        (ring, position) => html`<div class="buttons" key=${position}>
        ${t('fleet.area', { number: position + 1, count: ring.length })}
        <button type="button" onClick=${() =>
            edit(removeIn(request, ['airspace', 'no_fly', position]))}>
          ${t('fleet.removeArea', { number: position + 1 })}</button></div>`,
      )}
      <p class="help">${request.airspace?.no_fly?.length
        ? t('fleet.moveAreas') : t('fleet.drawAreas')}</p>
    </fieldset>
    <fieldset class="group"><legend>${t('field.zones')}</legend>
      ${(request.airspace?.zones ?? []).map(
        (stated, position) => html`<div class="buttons" key=${position}>
        ${t('fleet.zones', {
          number: position + 1, format: FORMATS[stated.format], count: countZones(stated),
        })}
        <button type="button" onClick=${() =>
            edit(removeIn(request, ['airspace', 'zones', position]))}>
          ${t('fleet.removeZones', { number: position + 1 })}</button></div>`,
      )}
      ${namedZones(request).map((zone) => html`<${Leave} key=${zone.identifier} zone=${zone}
        request=${request} />`)}
      <p class="help">${t('fleet.dropZones')}</p>
    </fieldset>
    <${Airspace} request=${request} />
    <fieldset class="group"><legend>${t('fleet.leftOut')}</legend>
      <${Field} name="unassigned_cost" schema=${properties.unassigned_cost}
        keys=${['unassigned_cost']}
        request=${request} onChange=${edit} /></fieldset>
    <${Field} name="fairness" schema=${properties.fairness} keys=${['fairness']}
      request=${request} onChange=${edit} />
  </div>`;
}

/** Return the zones that leave to fly is stated for one by one; none where they are many. */
function namedZones(request) {
  const zones = new Map(zoneAreas(request).map((zone) => [zone.identifier, zone]));
  return zones.has(null) || zones.size > MOST_ZONES ? [] : [...zones.values()];
}

/** What flights keep from areas and zones, and which zones block; a distance is proposed. */
function Airspace({ request }) {
  const { no_fly: areas = [], zones = [], buffer } = request.airspace ?? {};
  const ofZones = namedZones(request).length ? OF_ZONES.slice(1) : OF_ZONES;
  return html`<fieldset class="group"><legend>${t('field.airspace')}</legend>
    <${AirspaceFields} request=${request} names=${['buffer', ...(zones.length ? ofZones : [])]} />
    ${areas.length + zones.length > 0 && buffer === undefined && html`<div class="buttons">
      <button type="button" onClick=${() => edit(withBuffer(request))}>
        ${t('fleet.keepAway', { count: PROPOSED_BUFFER_M })}</button></div>`}
  </fieldset>`;
}

function VehicleType({ type, position, request, isNew }) {
  const schemas = useStore((state) => state.schemas);
  const errors = useStore((state) => state.errors).filter(
    ({ keys }) => keys[0] === 'fleet' && keys[1] === position,
  ).length;
  const drones = droneCount(type) ? `, ${t('fleet.drones', { count: droneCount(type) })}` : '';
  const choices = { depot: request.depots.map(({ id }) => id) };
  const ofTables = request.matrices ? [] : ['profile', 'start_location_index'];
  const skip = [...ofTables, ...needlessFields(type)];
  const card = useOpening(position === 0 || isNew || errors > 0);
  return html`<details class="card" ref=${card}>
    <summary><strong>${type.id}</strong> ${errors > 0 && html`<span class="error">
      ${t('fleet.errors', { count: errors })}</span>`
    }<span class="right">${t('header.vehicles', { count: type.count })}, ${
      t('fleet.capacity', { amounts: amounts(type.capacity ?? []) }) + drones}</span></summary>
    <div class="inside">
      <${RuledFields} schema=${schemas.VehicleTypeInput} keys=${['fleet', position]}
        everyday=${EVERYDAY} topics=${TOPICS} request=${request} onChange=${edit}
        choices=${choices} skip=${skip} />
      ${request.fleet.length > 1 && html`<div class="buttons"><button type="button" onClick=${() =>
          edit(removeIn(request, ['fleet', position]))}>
          ${t('fleet.remove', { id: type.id })}</button></div>`}
    </div></details>`;
}
