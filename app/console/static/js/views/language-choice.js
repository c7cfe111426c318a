/** The choice of a language, for the whole page. */

import { showFailure } from '../actions.js';
import { html } from '../libraries.js';
import { LANGUAGES } from '../language.js';
import { store } from '../store.js';
import { choose, language, t } from '../texts.js';

/** A list of languages, each as its speakers call it. */
export function LanguageChoice() {
  const change = async (event) => {
    try {
      await choose(event.target.value);
    } catch (error) {
      showFailure(error);
    }
    store.set({ language: language() });
    // All of the page is another one then.
    requestAnimationFrame(() => document.getElementById('language').focus());
  };
  return html`<select class="quiet" id="language" aria-label=${t('header.language')}
    onChange=${change}>${Object.entries(LANGUAGES).map(
      ([name, label]) => html`<option key=${name} value=${name} lang=${name}
        selected=${name === language()}>${label}</option>`,
    )}</select>`;
}
