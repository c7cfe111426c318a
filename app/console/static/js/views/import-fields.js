/** Depot, fleet and day of an import: what no sheet of customers says. */

import {
  assumedOf, CORRECTABLE, corrected, FIELDS, listedFleet, MORE_FIELDS, readFields,
} from '../core/importing.js';
import { change, correct, type } from '../importing.js';
import { html } from '../libraries.js';
import { t } from '../texts.js';

const COLUMNS = ['id', 'count', 'capacity', 'shift', 'breaks'];

/** The vehicles of the file, if it lists any; the fields that matter, the others folded away. */
export function ImportFields({ importing: { reply, texts, choices, corrections } }) {
  const { wrong } = readFields(texts);
  const asksDay =
    !reply.questions?.some(({ kind }) => kind === 'day') &&
    (reply.day || reply.errors.some(({ code }) => code === 'SEVERAL_DAYS'));
  const fields = (listed) => html`<div class="import-fields">${listed.map(
    (field) => html`<${TextField} key=${field.name} field=${field} reply=${reply}
      value=${texts[field.name] ?? ''} isWrong=${wrong.includes(field.name)} />`,
  )}${listed === FIELDS &&
    asksDay &&
    html`<label>${t('import.day')}<input type="date" value=${choices.day ?? reply.day ?? ''}
      onChange=${(event) =>
        change({ choices: { ...choices, day: event.target.value || null } })} /></label>`
  }</div>`;
  const isOpen = MORE_FIELDS.some(({ name }) => texts[name]);
  return html`<section aria-labelledby="import-fleet-title">
    <h3 id="import-fleet-title">${t('import.fleet')}</h3>
    <${Listed} reply=${reply} corrections=${corrections} />${fields(FIELDS)}
    <details open=${isOpen}><summary>${t('import.moreFields')}</summary>${fields(MORE_FIELDS)}
    </details></section>`;
}

function TextField({ field: { name, example }, reply, value, isWrong }) {
  const taken = assumedOf(reply, name);
  return html`<label><span>${t(`import.field.${name}`)} <small>${t(`import.help.${name}`)}</small>
    </span><input type="text" value=${value} id=${`import-${name}`} aria-invalid=${isWrong}
      aria-describedby=${`import-${name}-taken`}
      onInput=${(event) => type(name, event.target.value)} onChange=${() => change({})} />
    <small id=${`import-${name}-taken`}>${!value && taken && t('import.taken', { taken })}</small>
    ${isWrong && html`<span class="error">${t('import.writeAs', { example })}</span>`}</label>`;
}

/** The vehicles as the file lists them, to be corrected; fields beside them hold for all. */
function Listed({ reply, corrections }) {
  const fleet = listedFleet(reply);
  if (!fleet.length) return null;
  const { wrong } = corrected(reply.request, corrections);
  const cell = (kind, name) => (CORRECTABLE.includes(name) ? html`<input type="text"
    value=${corrections[kind.id]?.[name] ?? kind[name]}
    aria-label=${t('import.correctOf', { vehicle: kind.id, what: t(`import.listedAs.${name}`) })}
    aria-invalid=${wrong.includes(`${kind.id} ${name}`)}
    onInput=${({ target }) => correct(kind.id, name, target.value)} />` : kind[name]);
  return html`<div class="import-table" tabindex="0" role="region"
    aria-label=${t('import.listed')}><table><thead><tr>${COLUMNS.map(
      (name) => html`<th key=${name} scope="col">${t(`import.listedAs.${name}`)}</th>`,
    )}</tr></thead><tbody>${fleet.map((kind) => html`<tr key=${kind.id}>${COLUMNS.map(
      (name) => html`<td key=${name}>${cell(kind, name)}</td>`,
    )}</tr>`)}</tbody></table></div>`;
}
