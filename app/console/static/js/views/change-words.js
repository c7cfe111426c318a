/** What changed in a problem, as a person says it. */

import { select } from '../actions.js';
import { clock } from '../core/format.js';
import { labelOf } from '../core/schema.js';
import { windowsInWords } from '../core/windows.js';
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
  if (rest === 'time_window' || rest === 'time_windows') {
    return html`${link} may be served ${windowsInWords([after ?? []].flat())}`;
  }
  const { owner, field } = placeOf(path);
  const [then, now] = [before, after].map((value) => shown(value, field));
  return html`${owner && `${owner}: `}${field} ${then} \u2192 ${now}`;
}

/** Return whose field a path is, if someone's, and the field in words. */
function placeOf(path) {
  const [, owner = '', rest] = /^(?:(?:customers|fleet|depots)\[(.*)\]\.)?(.*)$/.exec(path);
  return { owner, field: rest.split('.').map(labelOf).join(', ').toLowerCase() };
}

const IN_SECONDS = /(duration|earliest|latest|endurance|time)$/;

function shown(value, field) {
  if (value === undefined || value === null) return 'none';
  if (typeof value === 'number' && IN_SECONDS.test(field)) return clock(value, { precise: true });
  if (Array.isArray(value) && value.every((entry) => typeof entry === 'number')) {
    return value.join(', ');
  }
  if (typeof value === 'object' && value.count !== undefined) return `${value.count} each`;
  const text = typeof value === 'object' ? JSON.stringify(value) : String(value);
  return text.length > LONGEST ? `${text.slice(0, LONGEST)}\u2026` : text;
}
