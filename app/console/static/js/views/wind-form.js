/** The wind in the fleet's tab: steady, by the hour, or as a forecast tells it. */

import { edit } from '../actions.js';
import { clock, number } from '../core/format.js';
import {
  addHour, changeKind, KINDS, kindOfWind, removeHour, staysDown, windHours,
} from '../core/wind.js';
import { html } from '../libraries.js';
import { useStore } from '../store.js';
import { Cell, Fields } from './form.js';
import { Said } from './said.js';
import { t } from '../texts.js';

const WIND = ['airspace', 'wind'];
const COLUMNS = ['from', 'speed_kmh', 'direction_deg', 'gust_kmh'];

/** The choice of its kind, and the fields of that. */
export function WindForm({ request }) {
  const schemas = useStore((state) => state.schemas);
  const errors = useStore((state) => state.errors).filter(
    ({ keys }) => keys[0] === WIND[0] && keys[1] === WIND[1] && keys[2] === 'open_meteo');
  const kind = kindOfWind(request);
  return html`<fieldset class="group"><legend>${t('field.wind')}</legend>
    <div class="buttons"><label>${t('wind.kind')} <select id="wind-kind" value=${kind}
      onChange=${(event) => edit(changeKind(request, event.target.value))}>${KINDS
        .filter((each) => each !== 'forecast' || kind === each)
        .map((each) => html`<option key=${each} value=${each}
          selected=${each === kind}>${t(`wind.kinds.${each}`)}</option>`)}</select></label></div>
    ${kind === 'steady'
      ? html`<${Fields} schema=${schemas.WindInput} keys=${WIND} request=${request}
        onChange=${edit} />`
      : html`<${Hours} request=${request} isOpen=${kind === 'hourly'} />`}
    ${errors.map((error) => html`<div class="error" key=${error.path}><${Said} ...${error} />
      </div>`)}
    <p class="help">${kind === 'forecast' ? t('wind.fromForecast') : t('wind.drop')}</p>
  </fieldset>`;
}

function Hours({ request, isOpen }) {
  const hours = windHours(request);
  return html`<table class="wind-hours" aria-label=${t('wind.hours')}><thead><tr>
      <th scope="col">${t('wind.from')}</th><th scope="col">${t('wind.speed')}</th>
      <th scope="col">${t('wind.direction')}</th><th scope="col">${t('wind.gusts')}</th>
      <th scope="col">${t('wind.down')}</th>${isOpen && html`<td></td>`}</tr></thead>
    <tbody>${hours.map((hour, place) => html`<tr key=${place}>${COLUMNS.map((name) => html`<td
        key=${name}>${isOpen
          ? html`<${HourCell} name=${name} place=${place} request=${request} />`
          : shown(name, hour[name])}</td>`)}
      <td>${staysDown(request, hour).join(', ')}</td>
      ${isOpen && html`<td><button type="button" class="quiet" disabled=${hours.length === 1}
        onClick=${() => edit(removeHour(request, place))}>${
          t('form.remove', { number: place + 1 })}</button></td>`}</tr>`)}</tbody></table>
    ${isOpen
      ? html`<button type="button" onClick=${() => edit(addHour(request))}>${
        t('wind.add')}</button>`
      : html`<button type="button" onClick=${() => edit(changeKind(request, 'hourly'))}>${
        t('wind.change')}</button>`}`;
}

function HourCell({ name, place, request }) {
  const { properties, required } = useStore((state) => state.schemas).WindHourInput;
  const label = {
    from: t('wind.from'), speed_kmh: t('wind.speed'), direction_deg: t('wind.direction'),
    gust_kmh: t('wind.gusts'),
  }[name];
  return html`<${Cell} schema=${properties[name]} keys=${[...WIND, place, name]} request=${request}
    onChange=${edit} required=${required.includes(name)}
    label=${t('wind.ofHour', { what: label, number: place + 1 })} />`;
}

function shown(name, value) {
  if (value === null) return '';
  return name === 'from' ? clock(value) : number(value);
}
