/** Rows of equal height, of which only those in view are there, and the one with the focus. */

import { html, useLayoutEffect, useRef, useState } from '../libraries.js';

const SPARE = 8; // rows on either side of those in view

/**
 * A long table.
 *
 * Keys go from row to row, also past those in view: the row with the focus and its neighbours are
 * always there. The row at `revealed` is scrolled to when it changes, -1 for none.
 *
 * @param renderRow of a row and the attributes that its `tr` needs
 */
export function LongTable({ head, rows, height, rowHeight = 36, label, renderRow, revealed = -1 }) {
  const [top, setTop] = useState(0);
  const [focused, setFocused] = useState(-1);
  const element = useRef(null);
  useLayoutEffect(() => {
    if (revealed >= 0) scrollToRow(element.current, revealed, rowHeight);
  }, [revealed]);
  // To move a row within the page takes its focus away.
  const active = /** @type {HTMLElement} */ (document.activeElement);
  const held = element.current?.contains(active) ? active : null;
  useLayoutEffect(() => {
    if (held?.isConnected && document.activeElement !== held) held.focus({ preventScroll: true });
  });
  const first = Math.max(Math.floor(top / rowHeight) - SPARE, 0);
  const last = Math.min(first + Math.ceil(height / rowHeight) + 2 * SPARE, rows.length);
  const [one, other] = rangesOf([first, last], focused, rows.length);
  const row = (index) =>
    renderRow(rows[index], { 'aria-rowindex': index + 2, 'data-row': index });
  const gap = (key, from, until) => html`<tr key=${key} aria-hidden="true"
    style=${{ height: `${(until - from) * rowHeight}px` }}></tr>`;
  // The gaps are always there: so rows that stay are not moved where others come or go.
  return html`<div class="long-table" style=${{ maxHeight: `${height}px` }} tabindex="0"
      role="region" aria-label=${label} ref=${element}
      onScroll=${(event) => setTop(event.currentTarget.scrollTop)}
      onFocusCapture=${(event) => setFocused(rowOf(event.target) ?? focused)}
      onKeyDown=${goToNeighbour}>
    <table aria-rowcount=${rows.length + 1}>
      <thead>${head}</thead>
      <tbody>${[
        gap('above', 0, one[0]), ...span(one).map(row), gap('between', one[1], other[0]),
        ...span(other).map(row), gap('below', other[1], rows.length),
      ]}</tbody>
    </table></div>`;
}

/** @param {Span} rows */
function span([from, until]) {
  return Array.from({ length: until - from }, (_, offset) => from + offset);
}

/**
 * Return two ranges of rows: those in view, and the one with the focus with its neighbours.
 *
 * @param {Span} seen
 * @param {number} focused
 * @param {number} length
 * @returns {[Span, Span]}
 */
function rangesOf([first, last], focused, length) {
  if (focused < 0 || focused >= length) return [[first, last], [last, last]];
  /** @type {Span} */
  const around = [Math.max(focused - 1, 0), Math.min(focused + 2, length)];
  if (around[1] < first) return [around, [first, last]];
  if (around[0] > last) return [[first, last], around];
  const most = Math.max(last, around[1]);
  return [[Math.min(first, around[0]), most], [most, most]];
}

function rowOf(target) {
  const row = target.closest('tr')?.dataset.row;
  return row === undefined ? null : Number(row);
}

/** Arrows go up and down, to the same place in the next row, and left and right to its box. */
function goToNeighbour(event) {
  const row = event.target.closest('tr[data-row]');
  const aside = { ArrowLeft: 'input[type=checkbox]', ArrowRight: 'th button' }[event.key];
  if (aside && row?.querySelector('input[type=checkbox]')) {
    event.preventDefault();
    row.querySelector(aside).focus();
    return;
  }
  const next = { ArrowDown: 'nextElementSibling', ArrowUp: 'previousElementSibling' }[event.key];
  const target = next && row?.[next]?.querySelector('button');
  if (!target) return;
  event.preventDefault();
  target.focus();
}

/** Scroll a row into the middle of a table, unless it is in view. In place. */
function scrollToRow(element, row, rowHeight) {
  const head = element.querySelector('thead').offsetHeight;
  const room = element.clientHeight - head;
  const above = row * rowHeight;
  if (above >= element.scrollTop && above + rowHeight <= element.scrollTop + room) return;
  element.scrollTop = above - (room - rowHeight) / 2;
}
