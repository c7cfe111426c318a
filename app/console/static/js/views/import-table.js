/** The first rows of a file as they are: what each column is read as, and made of each cell. */

import { grantedInWords, isMarked, knownOr, madeOf, meaningText } from '../core/importing.js';
import { changeColumn } from '../importing.js';
import { html, useState } from '../libraries.js';
import { t } from '../texts.js';

const EXAMPLE = new URL('../../examples/working-day.xlsx', import.meta.url).href;

/** The table; under each heading its meaning is chosen, the likeliest first. */
export function ImportTable({ reply: { columns, meanings, table_rows: rows } }) {
  const marked = columns.filter(isMarked).length;
  return html`<div>
    <h3 id="import-table-title">${t('import.columns')}
      ${marked > 0 && html` <button type="button" class="to-look-at" onClick=${lookAtNext}>
        ${t('import.marked', { count: marked })}</button>`}</h3>
    <div class="import-table" tabindex="0" role="region" aria-labelledby="import-table-title">
    <table><thead><tr><td></td>${columns.map((column) => html`<${Heading} key=${column.column}
      column=${column} meanings=${meanings} />`)}</tr></thead>
      <tbody>${rows.map((row, at) => html`<tr key=${row}><th scope="row">${row}</th>
        ${columns.map((column) => html`<${Cell} key=${column.column} column=${column}
          cell=${column.cells[at]} />`)}</tr>`)}</tbody></table></div>
    <p><a href=${EXAMPLE} download="working-day.xlsx">${t('import.exampleSheet')}</a></p>
  </div>`;
}

/** Move to the next column that is to be looked at, behind the last the first. */
function lookAtNext() {
  const marked = [...document.querySelectorAll('.import-table :is(.open, .doubtful) > .meaning')];
  const at = marked.indexOf(lookedAt);
  lookedAt = marked[(at + 1) % marked.length];
  lookedAt.focus();
}

let lookedAt = null;

function Heading({ column, meanings }) {
  const { heading, column: letters, meaning, unit, certainty, pair, doubts } = column;
  const name = heading || t('import.column', { letters });
  return html`<th scope="col" class=${certainty}><span class="heading">${name}
      <small>${letters}</small></span>
    <${MeaningOf} column=${column} name=${name} meanings=${meanings} />
    <${UnitOf} key=${unit} column=${column} name=${name} meanings=${meanings} />
    ${pair && html`<small class="pair">${t('import.with', { column: pair })}</small>`}
    ${certainty === 'open' && html`<small class="doubt">${t('import.open')}</small>`}
    ${certainty === 'doubtful' && html`<small class="doubt">${doubtText(doubts[0])}</small>
      <button type="button" onClick=${() => changeColumn(column, { meaning, unit })}>
        ${t('import.right')}</button>`}</th>`;
}

function doubtText(doubt) {
  return knownOr(t(`import.doubt.${doubt.code}`), grantedInWords(doubt));
}

function MeaningOf({ column, name, meanings }) {
  const { meaning, certainty, likely } = column;
  const titles = Object.fromEntries(meanings.map((entry) => [entry.meaning, entry.title]));
  const others = meanings.filter((entry) => !likely.includes(entry.meaning));
  const option = (entry) =>
    html`<option key=${entry} value=${entry}>${meaningText(entry, titles[entry])}</option>`;
  return html`<select class="meaning" aria-label=${t('import.meaningOf', { name })}
    value=${certainty === 'open' ? '' : meaning}
    onChange=${(event) => changeColumn(column, { meaning: event.target.value, unit: null })}>
    ${certainty === 'open' && html`<option value="" disabled hidden>?</option>`}
    <optgroup label=${t('import.likely')}>${likely.map(option)}</optgroup>
    <optgroup label=${t('import.other')}>${others.map((entry) => option(entry.meaning))}</optgroup>
  </select>`;
}

/** The unit of bare numbers, or of amounts, which may be a new one. */
function UnitOf({ column, name, meanings }) {
  const { meaning, unit } = column;
  const [typed, setTyped] = useState(unit ?? '');
  const { units } = meanings.find((entry) => entry.meaning === meaning);
  const label = t('import.unitOf', { name });
  const take = (value) => changeColumn(column, { meaning, unit: value || null });
  if (meaning === 'demand') {
    return html`<input type="text" aria-label=${label} placeholder=${t('import.unitExample')}
      value=${typed} onInput=${(event) => setTyped(event.target.value)}
      onChange=${() => take(typed.trim())} />`;
  }
  if (!units.length || unit === 'clock') return null; // no bare numbers
  return html`<select aria-label=${label} value=${unit ?? ''}
    onChange=${(event) => take(event.target.value)}>${units.map(
      (entry) => html`<option key=${entry} value=${entry}>
        ${knownOr(t(`import.unit.${entry.replaceAll('.', '')}`), entry)}</option>`,
    )}</select>`;
}

function Cell({ column, cell }) {
  if (!cell) return html`<td class=${column.certainty}></td>`;
  const made = madeOf(column.meaning, cell);
  return html`<td class=${column.certainty} title=${cell.cell}>${cell.raw}
    ${made && html`<small class=${cell.read === null ? 'error' : ''}>${made}</small>`}</td>`;
}
