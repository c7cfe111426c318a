/** A sheet before its customers are used: what its columns mean, errors at their cells. */

import { openRequest } from '../actions.js';
import { count } from '../core/format.js';
import { readSheet, recogniseColumns, requestWithSheet } from '../core/table.js';
import { html, useMemo } from '../libraries.js';
import { plan } from '../planning.js';
import { store } from '../store.js';
import { LongTable } from './parts.js';

/** The tab while a sheet is looked over. */
export function SheetPreview({ sheet }) {
  const { name, rows } = sheet;
  const columns = useMemo(() => recogniseColumns(rows[0]), [rows[0]]);
  const read = useMemo(() => readSheet(rows, columns), [rows, columns]);
  const byCell = useMemo(
    () => new Map(read.errors.map((error) => [`${error.row}/${error.column}`, error.message])),
    [read],
  );
  const order = useMemo(() => lines(rows, read.errors), [rows, read]);
  const unknown = rows[0].filter((_, column) => columns[column] === null);
  const use = async () => {
    openRequest(requestWithSheet(store.get().request, read));
    await plan();
  };
  return html`<section class="section"><h3>${name}</h3>
    <p>${count(read.customers.length, 'customer')}${
      read.depots.length > 0 && ` and ${count(read.depots.length, 'depot')}`
    }, ${
      read.geographic ? 'longitude and latitude' : 'planar coordinates'
    }. ${unknown.length > 0 && `Not used: ${unknown.join(', ')}.`}</p>
    ${
      read.errors.length > 0 &&
      html`<div role="alert">
      <p class="error"><strong>${count(read.errors.length, 'error')}.
        </strong> Correct them here, or in
        the file and open it again. Lines with errors come first.</p>
      <ul>${read.errors.slice(0, 5).map(
        (error) => html`<li key=${`${error.row}/${error.column}`}>
        ${error.column === null ? error.message
          : html`<button type="button" class="link" onClick=${() => goToCell(error, rows)}>
            Line ${error.row + 1}, ${rows[0][error.column]}</button>: ${error.message}`}</li>`,
      )}</ul></div>`
    }
    <${LongTable} label="Sheet" height=${380} rowHeight=${34} rows=${order}
      head=${html`<tr><th scope="col">Line</th>${rows[0].map(
        (title, column) => html`<th scope="col"
        key=${column}>${title}<br /><small>${columns[column] ?? 'not used'}</small></th>`,
      )}</tr>`}
      renderRow=${(row) => html`<tr key=${row} class="sheet"><th scope="row">${row + 1}</th>
        ${rows[0].map(
          (_, column) => html`<${Cell} key=${column} rows=${rows} row=${row}
          column=${column} message=${byCell.get(`${row}/${column}`)} />`,
        )}</tr>`} />
    <div class="buttons">
      <button type="button" class="primary"
        disabled=${read.errors.length > 0 || !read.customers.length}
        onClick=${use}>Use these customers</button>
      <button type="button" onClick=${() => store.set({ sheet: null })}>Cancel</button></div>
  </section>`;
}

/** Go to the cell of an error; lines with errors come first, so it is there. */
function goToCell({ row, column }, rows) {
  const label = CSS.escape(labelOf(rows, row, column));
  document.querySelector(`.sheet [aria-label="${label}"]`)?.focus();
}

function labelOf(rows, row, column) {
  return `${rows[0][column]}, line ${row + 1}`;
}

/** Return the numbers of the lines, those with errors first. */
function lines(rows, errors) {
  const broken = new Set(errors.map(({ row }) => row));
  const all = rows.slice(1).map((_, index) => index + 1);
  return [...all.filter((row) => broken.has(row)), ...all.filter((row) => !broken.has(row))];
}

function Cell({ rows, row, column, message }) {
  const value = rows[row][column];
  const text = value instanceof Date ? value.toISOString().slice(11, 16) : (value ?? '');
  const change = (event) => {
    const changed = [...rows];
    changed[row] = [...rows[row]];
    changed[row][column] = event.target.value;
    store.set(({ sheet }) => ({ sheet: { ...sheet, rows: changed } }));
  };
  return html`<td class=${message ? 'invalid' : ''} title=${message}>
    <input type="text" value=${text} aria-label=${labelOf(rows, row, column)}
      aria-invalid=${Boolean(message)} onChange=${change} /></td>`;
}
