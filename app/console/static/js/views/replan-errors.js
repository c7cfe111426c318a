/** Errors of what is to be replanned, where they belong. */

import { timesInWords } from '../core/format.js';
import { html } from '../libraries.js';

/** Return the errors of `request.replan` whose keys a test accepts. */
export function errorsAt(errors, test) {
  return errors.filter(({ keys }) => keys[0] === 'replan' && test(keys));
}

/** Messages one below the other. */
export function Errors({ errors, id }) {
  return errors.map(
    ({ message, path, code }) => html`<p class="error" id=${id} tabindex=${id ? -1 : undefined}
      key=${path + code}>${timesInWords(message)}</p>`,
  );
}
