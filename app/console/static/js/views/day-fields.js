/** The problem's day, its time zone, what costs are in, and what loads are. */

import { edit } from '../actions.js';
import { dayOf } from '../core/day.js';
import { onDay } from '../core/times.js';
import { html } from '../libraries.js';
import { store, useStore } from '../store.js';
import { Field } from './form.js';
import { t } from '../texts.js';

const MIDNIGHT = 'T00:00:00';

/** A card with the fields. */
export function DayFields({ request }) {
  const { properties } = useStore((state) => state.schemas).PlanRequest;
  const day = dayOf(request);
  const parts = [day?.date, request.time_zone, request.currency].filter(Boolean);
  const field = (name) => html`<${Field} name=${name} schema=${properties[name]} keys=${[name]}
    request=${request} onChange=${edit} />`;
  return html`<details class="card" id="day"><summary>${t('day.title')}
      <span class="right">${parts.join(', ') || t('day.none')}</span></summary>
    <div class="inside"><div class="fields">
      <div class="field"><label for="day-date">${t('day.date')}</label>
        <input type="date" id="day-date" value=${day?.date ?? ''} aria-describedby="day-date-help"
          onChange=${(event) => setDate(event.target.value)} />
        <p class="help" id="day-date-help">${t('day.help')}</p></div>
      <div class="field"><label for="day-zone">${t('day.zone')}</label>
        <input type="text" id="day-zone" list="day-zones" value=${request.time_zone ?? ''}
          autocomplete="off" placeholder=${day ? t('day.zoneOfStart') : ownZone()}
          onChange=${(event) => setZone(event.target.value.trim())} />
        <datalist id="day-zones">${Intl.supportedValuesOf('timeZone').map(
          (zone) => html`<option key=${zone} value=${zone} />`,
        )}</datalist></div>
      ${field('currency')}${field('load_dimensions')}
    </div></div></details>`;
}

function ownZone() {
  return Intl.DateTimeFormat().resolvedOptions().timeZone;
}

/** Move the problem to a date, at the time of day at which it began. */
function setDate(date) {
  if (!date) {
    edit(({ plan_start: _, time_zone: __, ...rest }) => rest);
    return;
  }
  edit((request) => {
    const day = dayOf(request);
    const clock = day ? new Date(day.wallAt(day.start)).toISOString().slice(10, 19) : MIDNIGHT;
    return move(request, { plan_start: date + clock, time_zone: request.time_zone ?? ownZone() });
  });
}

function setZone(zone) {
  edit((request) => {
    const day = dayOf(request);
    if (!day || !zone) return { ...request, time_zone: zone || undefined };
    const clock = new Date(day.wallAt(day.start)).toISOString().slice(0, 19);
    return move(request, { plan_start: clock, time_zone: zone });
  });
}

function move(request, changes) {
  return onDay(store.get().schemas, request, changes);
}
