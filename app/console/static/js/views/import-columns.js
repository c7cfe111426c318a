/** The columns of a file: what each means, in which unit, and readings beside the raw cells. */

import { knownOr, meaningText } from '../core/importing.js';
import { changeColumn } from '../importing.js';
import { html, useState } from '../libraries.js';
import { t } from '../texts.js';

const EXAMPLE = new URL('../../examples/working-day.xlsx', import.meta.url).href;

/** All columns that hold anything. */
export function Columns({ reply }) {
  return html`<h3>${t('import.columns')}</h3>
    <ul class="import-columns">${reply.columns.map(
      (column) => html`<${Column} key=${column.column} column=${column}
        meanings=${reply.meanings} />`,
    )}</ul>
    <p><a href=${EXAMPLE} download="working-day.xlsx">${t('import.exampleSheet')}</a></p>`;
}

function Column({ column, meanings }) {
  const { heading, column: letters, meaning, unit, examples, doubts } = column;
  const { units } = meanings.find((entry) => entry.meaning === meaning);
  const name = heading || t('import.column', { letters });
  return html`<li class=${meaning === 'ignored' ? 'unused' : ''}>
    <div><strong>${name}</strong> <small>${letters}</small></div>
    <select aria-label=${t('import.meaningOf', { name })} value=${meaning}
      onChange=${(event) => changeColumn(column, { meaning: event.target.value, unit: null })}>
      ${meanings.map((entry) => html`<option key=${entry.meaning}
        value=${entry.meaning}>${meaningText(entry.meaning, entry.title)}
        </option>`)}</select>
    ${units.length > 0 && html`<select aria-label=${t('import.unitOf', { name })}
      value=${unit ?? ''}
      onChange=${(event) => changeColumn(column, { meaning, unit: event.target.value })}>
      ${units.map((entry) => html`<option key=${entry} value=${entry}>${unitText(entry)}
        </option>`)}</select>`}
    ${meaning === 'demand' && html`<${AmountUnit} key=${unit} column=${column} name=${name} />`}
    <div class="readings">${examples.map(
      ({ cell, raw, read }) => html`<span key=${cell} title=${cell}
        class=${read === null ? 'error' : ''}>${shownReading(meaning, raw, read)}</span>`,
    )}</div>
    ${doubts.map(({ message }) => html`<p key=${message} class="doubt">${message}</p>`)}</li>`;
}

/** Return a unit of bare numbers in words, and a new one as the service calls it. */
function unitText(unit) {
  return knownOr(t(`import.unit.${unit.replaceAll('.', '')}`), unit);
}

function AmountUnit({ column, name }) {
  const { meaning, unit } = column;
  const [typed, setTyped] = useState(unit ?? '');
  return html`<input type="text" aria-label=${t('import.unitOf', { name })}
    placeholder=${t('import.unitExample')} value=${typed}
    onInput=${(event) => setTyped(event.target.value)}
    onChange=${() => changeColumn(column, { meaning, unit: typed.trim() || null })} />`;
}

function shownReading(meaning, raw, read) {
  if (meaning === 'ignored' || raw === read) return raw;
  return `${raw} \u2192 ${read ?? t('import.notRead')}`;
}
