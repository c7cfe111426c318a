/** Depot, fleet and day of an import: what no sheet of customers says. */

import { FIELDS, readFields } from '../core/importing.js';
import { change, type } from '../importing.js';
import { html } from '../libraries.js';
import { t } from '../texts.js';

/** The fields, each with what is taken where it is empty. */
export function ImportFields({ importing: { reply, texts, choices } }) {
  const { wrong } = readFields(texts);
  const asksDay =
    !reply.questions?.some(({ kind }) => kind === 'day') &&
    (reply.day || reply.errors.some(({ code }) => code === 'SEVERAL_DAYS'));
  return html`<fieldset class="import-fields"><legend>${t('import.fleet')}</legend>
    ${FIELDS.map((field) => html`<${TextField} key=${field.name} field=${field} reply=${reply}
      value=${texts[field.name] ?? ''} isWrong=${wrong.includes(field.name)} />`)}
    ${
      asksDay &&
      html`<label>${t('import.day')}<input type="date" value=${choices.day ?? reply.day ?? ''}
        onChange=${(event) =>
          change({ choices: { ...choices, day: event.target.value || null } })} /></label>`
    }</fieldset>`;
}

function TextField({ field: { name, example, empty = '' }, reply, value, isWrong }) {
  const help = t(`import.help.${name}`);
  return html`<label><span>${t(`import.field.${name}`)} <small>${help}</small></span>
    <input type="text" value=${value} id=${`import-${name}`} aria-invalid=${isWrong}
      placeholder=${assumed(reply, name) ?? empty}
      onInput=${(event) => type(name, event.target.value)} onChange=${() => change({})} />
    ${isWrong && html`<span class="error">${t('import.writeAs', { example })}</span>`}</label>`;
}

/** Return what is taken where nothing is stated, of several types what they have in common. */
function assumed({ request }, name) {
  if (!request) return null;
  const alike = (value) => {
    const [first, ...others] = request.fleet.map(value);
    return others.every((other) => other === first) ? first : undefined;
  };
  const geographic = request.coordinate_system === 'geographic';
  const depot = request.depots[0].location;
  return {
    depot: Array.isArray(depot) ? (geographic ? [...depot].reverse() : depot).join(', ') : null,
    vehicles: String(request.fleet.reduce((sum, { count }) => sum + count, 0)),
    capacity: text(alike(({ capacity }) => capacity.join(' '))),
    max_trips: text(alike((kind) => kind.max_trips)),
    per_hour: text(alike(({ costs }) => costs?.per_hour)),
    per_km: text(alike(({ costs }) => costs?.per_km)),
    currency: request.currency,
  }[name];
}

function text(value) {
  return value === undefined ? null : String(value);
}
