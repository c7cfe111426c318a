/** Icons, each beside a word or with a tip. */

import { html } from '../libraries.js';

const SPRITE = new URL('../../vendor/lucide-1.62.0/icons.svg', import.meta.url).href;

/** An icon by its name in the sprite. */
export function Icon({ name, size = 16 }) {
  return html`<svg class="icon" width=${size} height=${size} aria-hidden="true">
    <use href=${`${SPRITE}#${name}`} /></svg>`;
}

/** A button that is an icon alone, with its word as a tip and for who listens. */
export function IconButton({ name, label, ...others }) {
  return html`<button type="button" class="icon-button" aria-label=${label} title=${label}
    ...${others}><${Icon} name=${name} /></button>`;
}
