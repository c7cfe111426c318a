/** What a button opens over the page, until something else is clicked. */

import { html } from '../libraries.js';

/** A button with `label`, and what it opens. */
export function Menu({ id, label, children, name = null }) {
  return html`<button type="button" class="quiet" popovertarget=${id} aria-label=${name}
      id=${`${id}-button`}>${label}</button>
    <div popover="auto" id=${id} class="menu">${children}</div>`;
}
