/** What an import takes for granted, or can't use, in the language of the page. */

import { GRANTED } from '../../texts/granted-de.js';
import { language } from '../texts.js';

/** Return a doubt or an error of an import in words, the service's where there are no others. */
export function grantedInWords({ code, message, cell, column }) {
  const known = language() === 'de' ? GRANTED[code] ?? null : null;
  const text = Array.isArray(known)
    ? known.find(([words]) => message.includes(words))?.[1] : known;
  if (!text) return message;
  const values = {
    cell, column,
    number: /(?<![\w.])\d[\d:.,]*\b/.exec(message)?.[0],
    names: /.*: (.+)$/.exec(message)?.[1],
  };
  const told = text.replace(/\{\{(\w+)\}\}/g, (_, name) => values[name] ?? '');
  return told.replace(/^: /, '');
}
