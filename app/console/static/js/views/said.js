/** What the service says of a problem, and behind a click how it says that. */

import { plainOf, saidOf } from '../core/said.js';
import { html } from '../libraries.js';
import { t } from '../texts.js';

/** An error or a warning in words; its path and the service's words are behind a click. */
export function Said({ code, path, message }) {
  return html`<span>${saidOf({ code, path, message })}</span>
    <${InApi} path=${path} message=${message} />`;
}

/** A sentence of the service; one that names settings has them behind a click. */
export function Plain({ message }) {
  const plain = plainOf(message);
  return html`<span>${plain}</span>${plain !== message && /TANDEM_/.test(message)
    && html`<${InApi} message=${message} />`}`;
}

function InApi({ path, message }) {
  return html`<details class="in-api"><summary>${t('form.inApi')}</summary>
    <p lang="en">${path && html`<code>${path}</code> `}${message}</p></details>`;
}
