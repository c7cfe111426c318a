/** The console's texts, in the language of whoever reads them. */

import de from '../texts/de.js';
import en from '../texts/en.js';
import { speaking } from './language.js';

/**
 * `t` returns a text by its key, `parts` one that has elements within; `language` is what is
 * spoken, and `choose` changes it. Constants of a module are made before a language is chosen:
 * they hold keys, never texts.
 */
export const { t, parts, language, choose } = speaking({ en, de });
