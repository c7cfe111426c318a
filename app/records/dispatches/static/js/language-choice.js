/** The choice of a language, on drivers' page and on customers'. */

import { LANGUAGES } from '../../console/js/language.js';
import { html } from '../../console/vendor/htm-3.1.1/standalone.module.js';

/** A choice with a label; `onChoose` is told the language. */
export function LanguageChoice({ label, language, onChoose }) {
  return html`<label>${label} <select value=${language}
    onChange=${(event) => onChoose(event.target.value)}>
    ${Object.entries(LANGUAGES).map(
      ([name, text]) => html`<option key=${name} value=${name} lang=${name}
        selected=${name === language}>${text}</option>`,
    )}</select></label>`;
}
