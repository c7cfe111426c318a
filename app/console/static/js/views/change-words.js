/** What changed in a problem, as a person says it. */

import { select } from '../actions.js';
import { fieldChange } from '../core/changed-words.js';
import { windowsInWords } from '../core/windows.js';
import { html } from '../libraries.js';
import { parts, t } from '../texts.js';

/** An entry of `requestDifferences`. */
export function Change({ path, before, after }) {
  const [, id, rest] = /^customers\[(.*)\](?:\.(.*))?$/.exec(path) ?? [];
  const link = html`<button type="button" class="link"
    onClick=${() => select(`c:${id}`)}>${id}</button>`;
  if (id !== undefined && rest === undefined) {
    return before === undefined
      ? html`${parts('change.newOrder', { order: link })}`
      : t('change.cancelled', { id });
  }
  if (rest === 'time_window' || rest === 'time_windows') {
    const windows = windowsInWords([after ?? []].flat());
    return html`${parts('change.mayBe', { order: link, windows })}`;
  }
  return fieldChange({ path, before, after });
}
