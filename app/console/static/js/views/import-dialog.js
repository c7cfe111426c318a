/** What a sheet is taken for, cell by cell, before it is planned; each guess can be corrected. */

import { FIELDS, UNITS, readFields } from '../core/importing.js';
import { count } from '../core/format.js';
import { change, changeColumn, leaveImport, type, useImport } from '../importing.js';
import { html, useState } from '../libraries.js';
import { useStore } from '../store.js';
import { Dialog } from './parts.js';

const MOST_LISTED = 20;
const ENCODINGS = ['utf-8', 'cp1252', 'cp1250', 'iso8859_2', 'cp1251', 'cp1253', 'cp1254', 'cp850'];

/** The dialog. */
export function ImportDialog() {
  const importing = useStore((state) => state.importing);
  if (!importing) return null;
  const { name, reply, busy, failure, isRemembered } = importing;
  return html`<${Dialog} title=${`Import ${name}`} name="import" wide onClose=${leaveImport}>
    ${!reply && html`<p role="status">Reading the file.</p>`}
    ${reply && html`<div class="import" aria-busy=${busy}>
      <p role="status">${count(reply.customers, 'customer')} of ${count(reply.rows, 'row')}.
        ${isRemembered && ' Read as the last file like it.'}${busy && ' Reading.'}</p>
      ${failure && html`<p class="error" role="alert">${failure.message}
        ${failure.errors.map(({ message }) => ` ${message}`)}</p>`}
      <${Errors} importing=${importing} />
      <${Beside} importing=${importing} />
      <${Doubts} reply=${reply} />
      <h3>Columns</h3>
      <ul class="import-columns">${reply.columns.map(
        (column) => html`<${Column} key=${column.column} column=${column}
          meanings=${reply.meanings} />`,
      )}</ul>
      <${Reading} importing=${importing} />
    </div>
    <div class="buttons import-end"><button type="button" class="primary" id="use-import"
      disabled=${!ready(importing)} onClick=${useImport}>Plan these customers</button>
      <button type="button" onClick=${leaveImport}>Cancel</button></div>`}
  </${Dialog}>`;
}

function ready({ reply, busy, failure, texts }) {
  return reply.request !== null && !busy && !failure && !readFields(texts).wrong.length;
}

function Errors({ importing: { reply, choices } }) {
  const inRows = reply.errors.some(({ cell }) => cell);
  const leaves = Boolean(choices.leave_out_errors);
  if (!reply.num_errors) return null;
  return html`<div role="alert">
    <p class="error"><strong>${count(reply.num_errors, 'error')}.</strong> Correct the columns
      here, or the cells in the file and open it again.</p>
    <ul>${reply.errors.slice(0, MOST_LISTED).map(
      ({ cell, message }, position) => html`<li key=${position}>
        ${cell && html`<strong>${cell}</strong>: `}${message}</li>`,
    )}
    ${reply.num_errors > MOST_LISTED && html`<li>and ${reply.num_errors - MOST_LISTED} more</li>`}
    </ul></div>
    ${
      inRows &&
      html`<label class="check"><input type="checkbox" checked=${leaves} onChange=${(event) =>
        change({ choices: { ...choices, leave_out_errors: event.target.checked } })} />
        Leave out the rows with errors</label>`
    }`;
}

/** Depot, fleet and day: what no sheet of customers says. */
function Beside({ importing: { reply, texts, choices } }) {
  const { wrong } = readFields(texts);
  const asksDay = reply.day || reply.errors.some(({ code }) => code === 'SEVERAL_DAYS');
  return html`<fieldset class="import-fields"><legend>Depot and fleet</legend>
    ${FIELDS.map(
      ({ name, label, example, empty = '', help }) => html`<label key=${name}>
        <span>${label} ${help && html`<small>${help}</small>`}</span>
        <input type="text" value=${texts[name] ?? ''} id=${`import-${name}`}
          placeholder=${assumed(reply, name) ?? empty} aria-invalid=${wrong.includes(name)}
          onInput=${(event) => type(name, event.target.value)} onChange=${() => change({})} />
        ${wrong.includes(name) && html`<span
          class="error">Write it as ${example}.</span>`}</label>`,
    )}
    ${
      asksDay &&
      html`<label>Day<input type="date" value=${choices.day ?? reply.day ?? ''}
        onChange=${(event) =>
          change({ choices: { ...choices, day: event.target.value || null } })} /></label>`
    }</fieldset>`;
}

/** Return what is taken where nothing is stated. */
function assumed({ request }, name) {
  if (!request) return null;
  const [kind] = request.fleet;
  const geographic = request.coordinate_system === 'geographic';
  const depot = [...request.depots[0].location];
  return {
    depot: (geographic ? depot.reverse() : depot).join(', '),
    vehicles: String(kind.count),
    capacity: kind.capacity.join(' '),
  }[name];
}

function Doubts({ reply: { doubts } }) {
  if (!doubts.length) return null;
  return html`<details open><summary>${count(doubts.length, 'thing')} taken for granted</summary>
    <ul>${doubts.map(({ message }) => html`<li key=${message}>${message}</li>`)}</ul></details>`;
}

/** One column: its meaning and unit, and readings beside the raw cells. */
function Column({ column, meanings }) {
  const { heading, column: letters, meaning, unit, examples, doubts } = column;
  const { units } = meanings.find((entry) => entry.meaning === meaning);
  const label = heading || `Column ${letters}`;
  return html`<li class=${meaning === 'ignored' ? 'unused' : ''}>
    <div><strong>${label}</strong> <small>${letters}</small></div>
    <select aria-label=${`Meaning of ${label}`} value=${meaning}
      onChange=${(event) => changeColumn(column, { meaning: event.target.value, unit: null })}>
      ${meanings.map((entry) => html`<option key=${entry.meaning}
        value=${entry.meaning}>${entry.title}</option>`)}</select>
    ${units.length > 0 && html`<select aria-label=${`Unit of ${label}`} value=${unit ?? ''}
      onChange=${(event) => changeColumn(column, { meaning, unit: event.target.value })}>
      ${units.map((entry) => html`<option key=${entry} value=${entry}>${UNITS[entry]}
        </option>`)}</select>`}
    ${meaning === 'demand' && html`<${AmountUnit} key=${unit} column=${column} label=${label} />`}
    <div class="readings">${examples.map(
      ({ cell, raw, read }) => html`<span key=${cell} title=${cell}
        class=${read === null ? 'error' : ''}>${shownReading(meaning, raw, read)}</span>`,
    )}</div>
    ${doubts.map(({ message }) => html`<p key=${message} class="doubt">${message}</p>`)}</li>`;
}

function AmountUnit({ column, label }) {
  const { meaning, unit } = column;
  const [typed, setTyped] = useState(unit ?? '');
  return html`<input type="text" aria-label=${`Unit of ${label}`} placeholder="unit" value=${typed}
    onInput=${(event) => setTyped(event.target.value)}
    onChange=${() => changeColumn(column, { meaning, unit: typed.trim() || null })} />`;
}

function shownReading(meaning, raw, read) {
  if (meaning === 'ignored' || raw === read) return raw;
  return `${raw} \u2192 ${read ?? 'not read'}`;
}

/** How the file as a whole is read. */
function Reading({ importing: { reply, mapping } }) {
  const choose = (patch) => change({ mapping: { ...mapping, ...patch } });
  const options = [
    ['', 'found'],
    [',', 'a comma'],
    ['.', 'a point'],
  ];
  const orders = [
    ['', 'found'],
    ['true', 'day first'],
    ['false', 'month first'],
  ];
  const dayFirst = mapping.day_first == null ? '' : String(mapping.day_first);
  const encodings = [...new Set([reply.encoding, ...ENCODINGS])].map((name) => [name, name]);
  return html`<details><summary>How the file is read</summary><div class="import-fields">
    ${
      reply.sheets.length > 1 &&
      html`<${Choice} label="Sheet" value=${reply.sheet}
        options=${reply.sheets.map(({ name }) => [name, name])}
        onChoose=${(sheet) => choose({ sheet, columns: [] })} />`
    }
    ${
      reply.encoding &&
      html`<${Choice} label="Letters" value=${reply.encoding} options=${encodings}
        onChoose=${(encoding) => choose({ encoding })} />`
    }
    <${Choice} label="Before decimals" value=${mapping.decimals ?? ''} options=${options}
      onChoose=${(decimals) => choose({ decimals: decimals || null })} />
    <${Choice} label="Dates" value=${dayFirst} options=${orders}
      onChoose=${(first) => choose({ day_first: first === '' ? null : first === 'true' })} />
    <${Choice} label="Rows of one name and place" value=${mapping.same_place ?? 'together'}
      options=${[
        ['together', 'are one stop'],
        ['apart', 'are stops of their own'],
      ]} onChoose=${(same) => choose({ same_place: same })} />
    </div></details>`;
}

function Choice({ label, value, options, onChoose }) {
  return html`<label>${label}<select value=${value}
    onChange=${(event) => onChoose(event.target.value)}>
    ${options.map(([name, title]) => html`<option key=${name} value=${name}>${title}</option>`)}
    </select></label>`;
}
