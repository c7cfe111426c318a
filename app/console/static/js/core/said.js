/** What the service says of a problem, for dispatchers: without the API's names and settings. */

import { language, t } from '../texts.js';
import { timesInWords } from './format.js';
import { parsePath } from './paths.js';
import { closureInWords } from './zone-words.js';

/** Names of fields and settings, places in a request, and what is written as in a request. */
const OF_THE_API = /`|\bids?\b|TANDEM_|\$\.|[a-z]\w*_\w|\[\w+, ?\w+\]|"\w+":|\w\[\d+\]/;

const SETTING = / \(`?TANDEM_\w+`?[^)]*\)/g;

const BOUND = /must be at (least|most) (-?[\d.]+)/;

/**
 * Return what is said in the page's language and without the API's terms, as far as it is known.
 *
 * @param code of an error or a warning
 * @param path of what it is about
 * @param message in the service's words, English ones
 * @param zone that keeps drones away, if it is about one
 */
export function saidOf({ code, path = '', message, zone = null }) {
  if (zone) return closureInWords(zone);
  const plain = plainOf(withoutDescription(message, path));
  if (language() === 'en' && !OF_THE_API.test(plain)) return plain;
  const [, side, number] = BOUND.exec(plain) ?? [];
  if (side) return t(`bound.${side}`, { number: Number(number) });
  return t(`said.${code}`, { defaultValue: plain });
}

/** Return a message without the API's description of the field, which forms say in words. */
function withoutDescription(message, path) {
  const name = parsePath(path).findLast((key) => typeof key === 'string');
  const end = name ? message.indexOf(` ${name}: `) : -1;
  return end > 0 ? message.slice(0, end) : message;
}

/** Return a message without settings, which operators alone can change. */
export function plainOf(message) {
  return timesInWords(message).replace(SETTING, '');
}

/** Return the title of a failure in the page's language, as far as it is known by its status. */
export function titleOf({ status, title }) {
  return language() === 'en' ? title : t(`failed.status${status}`, { defaultValue: title });
}
