/** What changed in a problem, as a person says it. */

import { select } from '../actions.js';
import { fieldChange } from '../core/changed-words.js';
import { windowsInWords } from '../core/windows.js';
import { html } from '../libraries.js';

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
  return fieldChange({ path, before, after });
}
