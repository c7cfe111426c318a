/** What changed in a problem, as a person says it. */

import { select } from '../actions.js';
import { timeWindow } from '../core/format.js';
import { html } from '../libraries.js';

const LONGEST = 60;

/** An entry of `requestDifferences`. */
export function Change({ path, before, after }) {
  const [, id, rest] = /^customers\[(.*)\](?:\.(.*))?$/.exec(path) ?? [];
  const link = html`<button type="button" class="link"
    onClick=${() => select(`c:${id}`)}>${id}</button>`;
  if (id !== undefined && rest === undefined) {
    return before === undefined ? html`${link} is a new order` : html`${id} is cancelled`;
  }
  if (rest === 'time_window') return html`${link} may be served ${timeWindow(after)}`;
  return html`<code>${path}</code>: ${shown(before)} \u2192 ${shown(after)}`;
}

function shown(value) {
  if (value === undefined || value === null) return 'none';
  const text = typeof value === 'object' ? JSON.stringify(value) : String(value);
  return text.length > LONGEST ? `${text.slice(0, LONGEST)}\u2026` : text;
}
