/** The console's texts, in the language of whoever reads them. */

import { speaking, wanted } from './language.js';

/** Return the texts of a language, which are fetched once they are wanted. */
async function load(name) {
  return (await import(`../texts/${name}.js`)).default;
}

const first = wanted();

/**
 * `t` returns a text by its key, `parts` one that has elements within; `language` is what is
 * spoken, and `choose` changes it. Constants of a module are made before a language is chosen:
 * they hold keys, never texts.
 */
export const { t, parts, language, choose } = speaking(
  { [first]: await load(first) },
  load);
