/** The texts of customers' page, in their language or the one that was chosen. */

import { speaking } from '../../console/js/language.js';
import de from '../texts/de.js';
import en from '../texts/en.js';

/** As in the console: `t` returns a text, `language` and `choose` are about the language. */
export const { t, language, choose } = speaking({ en, de });
