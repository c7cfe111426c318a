/** Errors of what is to be replanned, where they belong. */

import { html } from '../libraries.js';
import { Said } from './said.js';

/** Return the errors of `request.replan` whose keys a test accepts. */
export function errorsAt(errors, test) {
  return errors.filter(({ keys }) => keys[0] === 'replan' && test(keys));
}

/** Messages one below the other. */
export function Errors({ errors, id }) {
  return errors.map(
    (error) => html`<div class="error" id=${id} tabindex=${id ? -1 : undefined}
      key=${error.path + error.code}><${Said} ...${error} /></div>`);
}
